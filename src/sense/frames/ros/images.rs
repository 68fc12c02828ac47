//! Image messages as depth and colour.

use super::messages::{Compressed, Image};
use crate::sense::frames::picture::{self, fits};
use crate::sense::{ColourImage, DepthImage};

/// What an Image message is.
pub(super) enum Converted {
    Depth(DepthImage),
    Colour(ColourImage),
    /// An encoding that is neither.
    Other,
}

/// Converts an image; what is wrong otherwise.
pub(super) fn convert(image: &Image) -> Result<Converted, String> {
    let bytes = match image.encoding.as_str() {
        "16UC1" | "mono16" => 2,
        "32FC1" => 4,
        "rgb8" | "bgr8" => 3,
        "rgba8" | "bgra8" => 4,
        "mono8" | "8UC1" => 1,
        _ => return Ok(Converted::Other),
    };
    fits(image.size)?;
    let [width, height] = image.size;
    let row = width as usize * bytes;
    let step = image.step.max(row);
    if (step.saturating_mul(height as usize - 1)).saturating_add(row) > image.data.len() {
        return Err(format!(
            "an image of {width} × {height} pixels that has {} bytes",
            image.data.len()
        ));
    }
    let rows = (0..height as usize).map(|v| &image.data[v * step..][..row]);
    let pixels = rows.flat_map(|row| row.chunks_exact(bytes));
    Ok(match image.encoding.as_str() {
        "16UC1" | "mono16" => depth(image.size, pixels.map(|p| millimetres([p[0], p[1]], image.big_endian))),
        "32FC1" => depth(
            image.size,
            pixels.map(|p| metres([p[0], p[1], p[2], p[3]], image.big_endian)),
        ),
        "bgr8" | "bgra8" => colour(image.size, pixels.map(|p| [p[2], p[1], p[0]])),
        "mono8" | "8UC1" => colour(image.size, pixels.map(|p| [p[0]; 3])),
        _ => colour(image.size, pixels.map(|p| [p[0], p[1], p[2]])),
    })
}

/// Converts a compressed colour image; `None` for compressed depth.
pub(super) fn unpack(image: &Compressed) -> Result<Option<ColourImage>, String> {
    if image.format.contains("compressedDepth") {
        return Ok(None);
    }
    picture::colour_of(image.data).map(Some)
}

fn depth([width, height]: [u32; 2], metres: impl Iterator<Item = f32>) -> Converted {
    Converted::Depth(DepthImage {
        width,
        height,
        metres: metres.collect(),
    })
}

fn colour([width, height]: [u32; 2], pixels: impl Iterator<Item = [u8; 3]>) -> Converted {
    Converted::Colour(ColourImage {
        width,
        height,
        pixels: pixels.collect(),
    })
}

fn millimetres(bytes: [u8; 2], big_endian: bool) -> f32 {
    let raw = if big_endian {
        u16::from_be_bytes(bytes)
    } else {
        u16::from_le_bytes(bytes)
    };
    if raw == u16::MAX {
        0.0
    } else {
        (f64::from(raw) / 1000.0) as f32
    }
}

fn metres(bytes: [u8; 4], big_endian: bool) -> f32 {
    if big_endian {
        f32::from_be_bytes(bytes)
    } else {
        f32::from_le_bytes(bytes)
    }
}
