//! What the planner sees: colour, depth, intrinsics and pose. Nothing else.

use crate::geometry::{Camera, Point, Pose};

/// One measurement of an RGB-D camera.
#[derive(Clone, Debug)]
pub struct Observation {
    /// The camera that took it.
    pub camera: Camera,
    /// Where it stood.
    pub world_from_camera: Pose,
    /// Colour, of the size of `camera.colour`.
    pub colour: ColourImage,
    /// Depth, of the size of `camera.depth`.
    pub depth: DepthImage,
}

/// 8-bit sRGB, row by row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ColourImage {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width · height` pixels.
    pub pixels: Vec<[u8; 3]>,
}

/// z-depth in metres, row by row; 0 means *no reading*.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthImage {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width · height` readings.
    pub metres: Vec<f32>,
}

impl ColourImage {
    /// The pixel at column `u`, row `v`.
    pub fn at(&self, u: u32, v: u32) -> [u8; 3] {
        self.pixels[v as usize * self.width as usize + u as usize]
    }
}

impl DepthImage {
    /// The reading at column `u`, row `v`, metres; `None` where there is none.
    pub fn at(&self, u: u32, v: u32) -> Option<f64> {
        let z = self.metres[v as usize * self.width as usize + u as usize];
        (z.is_finite() && z > 0.0).then_some(f64::from(z))
    }
}

impl Observation {
    /// The measured point of depth pixel (u, v), world axes; `None` without a reading.
    pub fn point(&self, u: u32, v: u32) -> Option<Point> {
        let z = self.depth.at(u, v)?;
        let ray = self.camera.depth.ray(f64::from(u) + 0.5, f64::from(v) + 0.5);
        Some(self.world_from_camera * Point::from(ray * z))
    }

    /// Where the camera stood, world axes.
    pub fn eye(&self) -> Point {
        Point::from(self.world_from_camera.translation.vector)
    }
}
