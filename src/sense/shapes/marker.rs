//! Printed QR codes on thin plates.

use qrcodegen::{QrCode, QrCodeEcc};

use crate::geometry::Point;
use crate::rules::Marker;
use crate::sense::SceneError;
use crate::sense::mesh::{Mesh, Paint, Texture};

/// Thickness of a plate, metres.
pub const PLATE: f64 = 0.004;
/// Modules of white around a code (ISO/IEC 18004).
const QUIET: i32 = 4;
const WHITE: [u8; 3] = [245, 245, 245];
const BLACK: [u8; 3] = [18, 18, 18];

/// The plate of a marker in the object's frame: its printed face lies in the
/// marker's plane, its body behind. The edge is `size · (n + 8) / n` for a
/// code of n modules; the code is the smallest version that holds the text at
/// error correction M or better.
///
/// # Errors
/// A text that no code holds, or an edge that is not 1 mm to 10 m.
pub fn plate(marker: &Marker) -> Result<Mesh, SceneError> {
    let refuse = |reason: String| SceneError::Marker {
        text: marker.text.clone(),
        reason,
    };
    if !(0.001..=10.0).contains(&marker.size) {
        return Err(refuse(format!(
            "its size is {} mm; expected 1 mm to 10000 mm",
            marker.size * 1e3
        )));
    }
    let code = QrCode::encode_text(&marker.text, QrCodeEcc::Medium)
        .map_err(|_| refuse("it is longer than a QR code can hold".to_owned()))?;
    let modules = f64::from(code.size());
    let half = marker.size * (modules + 2.0 * f64::from(QUIET)) / modules / 2.0;
    let mut mesh = block(half).moved(&marker.object_from_marker);
    mesh.textures.push(print(&code));
    Ok(mesh)
}

/// The print, a texel a module.
fn print(code: &QrCode) -> Texture {
    let n = code.size() + 2 * QUIET;
    let module = |k: i32| code.get_module(k % n - QUIET, k / n - QUIET);
    Texture {
        width: n as u32,
        height: n as u32,
        pixels: (0..n * n).map(|k| if module(k) { BLACK } else { WHITE }).collect(),
    }
}

/// A plate with its printed face at z = 0: triangles 0 and 1.
fn block(half: f64) -> Mesh {
    let corner = |k: u32| {
        let x = if k & 1 == 0 { -half } else { half };
        let y = if k & 2 == 0 { -half } else { half };
        Point::new(x, y, if k & 4 == 0 { -PLATE } else { 0.0 })
    };
    let triangles = vec![
        [4, 5, 7],
        [4, 7, 6],
        [0, 3, 1],
        [0, 2, 3],
        [0, 1, 5],
        [0, 5, 4],
        [1, 3, 7],
        [1, 7, 5],
        [3, 2, 6],
        [3, 6, 7],
        [2, 0, 4],
        [2, 4, 6],
    ];
    let face = |uv| Paint::Image {
        texture: 0,
        uv,
        tint: [255; 3],
    };
    let mut paints = vec![Paint::Flat(WHITE); triangles.len()];
    paints[0] = face([[0.0, 1.0], [1.0, 1.0], [1.0, 0.0]]);
    paints[1] = face([[0.0, 1.0], [1.0, 0.0], [0.0, 0.0]]);
    Mesh {
        vertices: (0..8).map(corner).collect(),
        triangles,
        paints,
        ..Mesh::default()
    }
}
