//! Colour as the depth camera would see it.
//!
//! Where the two cameras stand apart, depth stays as it was measured and every
//! depth pixel looks its colour up: its point is projected into the colour
//! image. Pixels without a reading, and those outside the colour image, are
//! black. Where something hides a point from the colour camera alone, it gets
//! the colour of what hides it.

use crate::geometry::{Intrinsics, Point, Pose};
use crate::sense::{ColourImage, DepthImage};

/// The colours of depth pixels; an image of the depth image's size.
pub(super) fn colours(
    depth: &DepthImage,
    depth_camera: &Intrinsics,
    colour: &ColourImage,
    colour_camera: &Intrinsics,
    colour_from_depth: &Pose,
) -> ColourImage {
    let look_up = |u: u32, v: u32| {
        let z = depth.at(u, v)?;
        let ray = depth_camera.ray(f64::from(u) + 0.5, f64::from(v) + 0.5);
        let (x, y) = colour_camera.project(&(colour_from_depth * Point::from(ray * z)))?;
        Some(colour.at(x as u32, y as u32))
    };
    let rows = 0..depth.height;
    let pixels = rows.flat_map(|v| (0..depth.width).map(move |u| look_up(u, v).unwrap_or_default()));
    ColourImage {
        width: depth.width,
        height: depth.height,
        pixels: pixels.collect(),
    }
}
