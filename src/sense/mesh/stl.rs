//! STL, binary and ASCII.
//!
//! Whether a file is binary is told by its length, not by its first word:
//! many binary files begin with `solid`.

use std::io::Cursor;

use super::read::{GREY, MOST_TRIANGLES, Soup};
use super::{MeshError, Paint};
use crate::geometry::Point;

/// Bytes before the first triangle of a binary file, and of a triangle.
const HEADER: usize = 84;
const TRIANGLE: usize = 50;

pub(super) fn read(bytes: &[u8], soup: &mut Soup) -> Result<(), MeshError> {
    let stated = stated_triangles(bytes);
    let fits = |n: usize| bytes.len() >= HEADER + n * TRIANGLE;
    let exact = stated.is_some_and(|n| bytes.len() == HEADER + n * TRIANGLE);
    let text = bytes.trim_ascii_start().starts_with(b"solid") && !exact;
    match stated {
        _ if text => read_text(bytes, soup),
        Some(n) if n > MOST_TRIANGLES && fits(n) => Err(soup.too_many(n)),
        Some(n) if fits(n) => read_binary(&bytes[..HEADER + n * TRIANGLE], soup),
        Some(n) => {
            let held = (bytes.len() - HEADER) / TRIANGLE;
            Err(soup.malformed(format!("it states {n} triangles and holds {held}")))
        }
        None => Err(soup.malformed("it is shorter than the header of an STL file")),
    }
}

fn stated_triangles(bytes: &[u8]) -> Option<usize> {
    let count: [u8; 4] = bytes.get(80..HEADER)?.try_into().ok()?;
    Some(u32::from_le_bytes(count) as usize)
}

/// The header's text is blanked: a `solid` there would send the reader to ASCII.
fn read_binary(bytes: &[u8], soup: &mut Soup) -> Result<(), MeshError> {
    let mut blanked = bytes.to_vec();
    blanked[..80].fill(0);
    read_triangles(blanked, soup)
}

/// The reader wants the first line to begin with `solid`.
fn read_text(bytes: &[u8], soup: &mut Soup) -> Result<(), MeshError> {
    read_triangles(bytes.trim_ascii_start().to_vec(), soup)
}

fn read_triangles(bytes: Vec<u8>, soup: &mut Soup) -> Result<(), MeshError> {
    let mut cursor = Cursor::new(bytes);
    let triangles = stl_io::create_stl_reader(&mut cursor).map_err(|e| soup.malformed(e.to_string().to_lowercase()))?;
    for (k, triangle) in triangles.enumerate() {
        let triangle =
            triangle.map_err(|e| soup.malformed(format!("triangle {}: {}", k + 1, e.to_string().to_lowercase())))?;
        let corners = triangle
            .vertices
            .map(|v| Point::new(f64::from(v[0]), f64::from(v[1]), f64::from(v[2])));
        soup.push(corners, Paint::Flat(GREY))?;
    }
    Ok(())
}
