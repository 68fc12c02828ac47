//! The measured points of one view, in image order and clipped to the space.

use crate::geometry::{Bounds, Intrinsics, Point, Pose, Vector};
use crate::sense::Observation;

/// Organised points: a window of the depth image around the space.
pub struct Cloud {
    /// Columns of the window.
    pub width: usize,
    /// Rows of the window.
    pub height: usize,
    /// Column and row of the window's first pixel in the depth image.
    pub corner: (u32, u32),
    /// Measured points, world axes; meaningless where `depths` is 0.
    pub points: Vec<Point>,
    /// z-depths, metres; 0 without a reading inside the space.
    pub depths: Vec<f64>,
    /// Intrinsics of the whole depth image.
    pub intrinsics: Intrinsics,
    /// Where the camera stood.
    pub world_from_camera: Pose,
}

impl Cloud {
    /// The points of an observation that lie within `bounds`.
    pub fn new(observation: &Observation, bounds: &Bounds) -> Self {
        let intrinsics = observation.camera.depth;
        let pose = observation.world_from_camera;
        let (columns, rows) = window(&intrinsics, &pose, bounds);
        let (width, height) = (columns.len(), rows.len());
        let mut points = Vec::with_capacity(width * height);
        let mut depths = Vec::with_capacity(width * height);
        for v in rows.clone() {
            for u in columns.clone() {
                let point = observation.point(u, v).filter(|p| bounds.contains(p));
                let depth = point.and(observation.depth.at(u, v));
                points.push(point.unwrap_or_else(Point::origin));
                depths.push(depth.unwrap_or(0.0));
            }
        }
        let corner = (columns.start, rows.start);
        Self {
            width,
            height,
            corner,
            points,
            depths,
            intrinsics,
            world_from_camera: pose,
        }
    }

    /// Whether a pixel of the window holds a point.
    pub fn holds(&self, pixel: usize) -> bool {
        self.depths[pixel] > 0.0
    }

    /// Column and row within the window.
    pub fn place(&self, pixel: usize) -> (usize, usize) {
        (pixel % self.width, pixel / self.width)
    }

    /// The up to four neighbours of a pixel.
    pub fn neighbours(&self, pixel: usize) -> impl Iterator<Item = usize> + use<> {
        let (x, y) = self.place(pixel);
        let (w, h) = (self.width, self.height);
        [
            (x > 0).then(|| pixel.wrapping_sub(1)),
            (x + 1 < w).then(|| pixel + 1),
            (y > 0).then(|| pixel.wrapping_sub(w)),
            (y + 1 < h).then(|| pixel + w),
        ]
        .into_iter()
        .flatten()
    }

    /// Columns and rows of the square of half edge `radius` about a pixel,
    /// clipped to the window.
    pub fn square(&self, pixel: usize, radius: usize) -> impl Iterator<Item = usize> + use<> {
        let (x, y) = self.place(pixel);
        let columns = x.saturating_sub(radius)..=(x + radius).min(self.width - 1);
        let rows = y.saturating_sub(radius)..=(y + radius).min(self.height - 1);
        let width = self.width;
        rows.flat_map(move |v| columns.clone().map(move |u| v * width + u))
    }

    /// Ray of z = 1 through (du, dv) of a pixel, (0.5, 0.5) its centre; camera axes.
    pub fn ray(&self, pixel: usize, du: f64, dv: f64) -> Vector {
        let (x, y) = self.place(pixel);
        let u = f64::from(self.corner.0) + x as f64 + du;
        let v = f64::from(self.corner.1) + y as f64 + dv;
        self.intrinsics.ray(u, v)
    }

    /// The camera's centre, world axes.
    pub fn eye(&self) -> Point {
        Point::from(self.world_from_camera.translation.vector)
    }

    /// Area that a pixel covers on a surface of unit `normal` (world axes), m².
    pub fn footprint_area(&self, pixel: usize, normal: &Vector) -> f64 {
        let ray = self.world_from_camera * self.ray(pixel, 0.5, 0.5);
        let z = self.depths[pixel];
        z * z / (self.intrinsics.fx * self.intrinsics.fy) / normal.dot(&ray).abs().max(0.05)
    }
}

/// Columns and rows that the projection of a box covers, clipped to the image;
/// all where the box reaches behind the camera.
pub fn window(k: &Intrinsics, pose: &Pose, bounds: &Bounds) -> (std::ops::Range<u32>, std::ops::Range<u32>) {
    let corners = (0..8).map(|c| {
        let pick = |axis: usize| {
            if c >> axis & 1 == 0 {
                bounds.min[axis]
            } else {
                bounds.max[axis]
            }
        };
        pose.inverse_transform_point(&Point::new(pick(0), pick(1), pick(2)))
    });
    let (mut u, mut v) = ((f64::INFINITY, f64::NEG_INFINITY), (f64::INFINITY, f64::NEG_INFINITY));
    for p in corners {
        if p.z < 1e-3 {
            return (0..k.width, 0..k.height);
        }
        let (x, y) = (k.fx * p.x / p.z + k.cx, k.fy * p.y / p.z + k.cy);
        u = (u.0.min(x), u.1.max(x));
        v = (v.0.min(y), v.1.max(y));
    }
    let clip = |(low, high): (f64, f64), size: u32| {
        let most = f64::from(size);
        let end = (high.ceil() + 1.0).clamp(0.0, most) as u32;
        let start = (low.floor() - 1.0).clamp(0.0, most) as u32;
        start..end.max(start)
    };
    (clip(u, k.width), clip(v, k.height))
}
