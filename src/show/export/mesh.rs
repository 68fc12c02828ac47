//! Polygons as a mesh: ASCII PLY with a colour a feature, and OBJ with a group
//! an instance.

use std::io::{self, Write};

use crate::geometry::Polygon;

/// A predicted face.
pub struct Face<'a> {
    /// The feature.
    pub feature: &'a str,
    /// The instance's key, as the log has it.
    pub key: &'a str,
    /// Its outline.
    pub polygon: &'a Polygon,
}

/// Colours of features in turn: Okabe and Ito's, told apart by all eyes.
const COLOURS: [[u8; 3]; 7] = [
    [230, 159, 0],
    [86, 180, 233],
    [0, 158, 115],
    [240, 228, 66],
    [0, 114, 178],
    [213, 94, 0],
    [204, 121, 167],
];

/// Writes an ASCII PLY file, a polygon a face; comments name the instances in order.
///
/// # Errors
/// Writing fails.
pub fn ply(faces: &[Face], out: &mut dyn Write) -> io::Result<()> {
    let corners: usize = faces.iter().map(|f| f.polygon.vertices().len()).sum();
    writeln!(out, "ply\nformat ascii 1.0\ncomment predicted faces, metres")?;
    for (k, face) in faces.iter().enumerate() {
        writeln!(out, "comment face {k} {} {}", face.feature, face.key)?;
    }
    writeln!(
        out,
        "element vertex {corners}\nproperty double x\nproperty double y\nproperty double z"
    )?;
    writeln!(
        out,
        "element face {}\nproperty list uchar int vertex_indices",
        faces.len()
    )?;
    writeln!(
        out,
        "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header"
    )?;
    for p in faces.iter().flat_map(|f| f.polygon.vertices()) {
        writeln!(out, "{} {} {}", p.x, p.y, p.z)?;
    }
    let (mut first, mut features) = (0, Vec::new());
    for face in faces {
        if !features.contains(&face.feature) {
            features.push(face.feature);
        }
        let place = features.iter().position(|f| *f == face.feature).unwrap_or(0);
        let count = face.polygon.vertices().len();
        write!(out, "{count}")?;
        for corner in first..first + count {
            write!(out, " {corner}")?;
        }
        let [r, g, b] = COLOURS[place % COLOURS.len()];
        writeln!(out, " {r} {g} {b}")?;
        first += count;
    }
    Ok(())
}

/// Writes an OBJ file, a group an instance.
///
/// # Errors
/// Writing fails.
pub fn obj(faces: &[Face], out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "# predicted faces, metres")?;
    let mut first = 1;
    for face in faces {
        writeln!(out, "g {} {}", face.feature, face.key.replace(char::is_whitespace, "_"))?;
        for p in face.polygon.vertices() {
            writeln!(out, "v {} {} {}", p.x, p.y, p.z)?;
        }
        let count = face.polygon.vertices().len();
        write!(out, "f")?;
        for corner in first..first + count {
            write!(out, " {corner}")?;
        }
        writeln!(out)?;
        first += count;
    }
    Ok(())
}
