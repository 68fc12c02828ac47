//! Point clouds: binary PLY and PCD 0.7, three 32-bit floats a point.

use std::io::{self, Write};

use crate::geometry::Point;

/// Writes a binary little-endian PLY file.
///
/// # Errors
/// Writing fails.
pub fn ply(points: &[Point], out: &mut dyn Write) -> io::Result<()> {
    let count = points.len();
    write!(
        out,
        "ply\nformat binary_little_endian 1.0\ncomment measured points, metres\nelement vertex {count}\n\
         property float x\nproperty float y\nproperty float z\nend_header\n"
    )?;
    binary(points, out)
}

/// Writes a binary PCD file.
///
/// # Errors
/// Writing fails.
pub fn pcd(points: &[Point], out: &mut dyn Write) -> io::Result<()> {
    let count = points.len();
    write!(
        out,
        "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n\
         WIDTH {count}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {count}\nDATA binary\n"
    )?;
    binary(points, out)
}

fn binary(points: &[Point], out: &mut dyn Write) -> io::Result<()> {
    for c in points
        .iter()
        .flat_map(|p| p.coords.iter().copied().collect::<Vec<f64>>())
    {
        out.write_all(&(c as f32).to_le_bytes())?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clouds_are_headers_and_floats() {
        let points = [Point::new(1.0, -2.5, 0.25), Point::new(0.0, 0.5, 4.0)];
        let floats: Vec<u8> = [1.0_f32, -2.5, 0.25, 0.0, 0.5, 4.0]
            .iter()
            .flat_map(|x| x.to_le_bytes())
            .collect();
        for (write, end) in [
            (ply as fn(&[Point], &mut dyn Write) -> io::Result<()>, "end_header\n"),
            (pcd, "DATA binary\n"),
        ] {
            let mut bytes = Vec::new();
            write(&points, &mut bytes).unwrap();
            let at = bytes.len() - floats.len();
            assert_eq!(bytes[at..], floats);
            let header = std::str::from_utf8(&bytes[..at]).unwrap();
            assert!(header.ends_with(end) && header.contains(" 2\n"), "{header}");
        }
    }
}
