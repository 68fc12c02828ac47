//! A planar region drawn as seen head-on.

use nalgebra::Point2;

use crate::detect::account::{Condition, Judgement, Unit};
use crate::detect::cloud::Cloud;
use crate::detect::scan::Luma;
use crate::detect::segment::Region;
use crate::geometry::{Point, Pose, frame_facing};

/// Smallest side of a patch that can hold a code, metres.
const SMALLEST: f64 = 0.03;
/// Air around the region's measured points, metres.
const MARGIN: f64 = 0.01;
/// Pixels of the patch for one of the colour image where it is seen closest.
const OVERSAMPLING: f64 = 1.25;
/// Most pixels of a patch; a larger one is drawn coarser.
const MOST_PIXELS: f64 = 2.5e6;
/// Regions seen flatter than this (cosine of incidence) show nothing readable.
const FLATTEST: f64 = 0.12;

/// Brightness of a planar region on a square grid in its plane; rows run down.
pub struct Patch {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Brightness, row by row.
    pub values: Vec<u8>,
    world_from_plane: Pose,
    left_top: Point2<f64>,
    per_metre: f64,
}

impl Patch {
    /// Draws a region; `None` where no code fits on it.
    pub fn of(cloud: &Cloud, region: &Region, luma: &Luma, judged: &mut Judgement) -> Option<Self> {
        let eye = cloud.eye();
        let first = region.pixels.first().map(|&p| cloud.points[p])?;
        if !judged.holds(seen_at(region.plane.normal.dot(&(eye - first).normalize()))) {
            return None;
        }
        let foot = first - region.plane.normal * region.plane.distance(&first);
        let world_from_plane = frame_facing(foot, region.plane.normal);
        let (low, high) = extent(cloud, region, &world_from_plane);
        let size = high - low;
        if !judged.holds(Condition::at_least("extent", Unit::Length, size.min(), SMALLEST)) {
            return None;
        }
        let nearest = region
            .pixels
            .iter()
            .map(|&p| cloud.depths[p])
            .fold(f64::INFINITY, f64::min);
        let wanted = luma.intrinsics.fx / nearest * OVERSAMPLING;
        let per_metre = wanted.min((MOST_PIXELS / (size.x * size.y)).sqrt());
        let mut patch = Self {
            width: (size.x * per_metre).ceil() as usize,
            height: (size.y * per_metre).ceil() as usize,
            values: Vec::new(),
            world_from_plane,
            left_top: Point2::new(low.x, high.y),
            per_metre,
        };
        patch.draw(cloud, luma);
        Some(patch)
    }

    /// The point of the plane at patch coordinates (x right, y down, pixels), world axes.
    pub fn point(&self, x: f64, y: f64) -> Point {
        let p = self.left_top + nalgebra::Vector2::new(x, -y) / self.per_metre;
        self.world_from_plane * Point::new(p.x, p.y, 0.0)
    }

    /// Brightness at patch coordinates, bilinear; clamped at the border.
    pub fn at(&self, x: f64, y: f64) -> f64 {
        let x = (x - 0.5).clamp(0.0, self.width as f64 - 1.001);
        let y = (y - 0.5).clamp(0.0, self.height as f64 - 1.001);
        let (left, top) = (x as usize, y as usize);
        let (fx, fy) = (x - left as f64, y - top as f64);
        let value =
            |u: usize, v: usize| f64::from(self.values[v.min(self.height - 1) * self.width + u.min(self.width - 1)]);
        let upper = value(left, top) * (1.0 - fx) + value(left + 1, top) * fx;
        let lower = value(left, top + 1) * (1.0 - fx) + value(left + 1, top + 1) * fx;
        upper * (1.0 - fy) + lower * fy
    }

    fn draw(&mut self, cloud: &Cloud, luma: &Luma) {
        let pose = cloud.world_from_camera.inverse();
        let start = pose * self.point(0.5, 0.5);
        let right = (pose * self.point(1.5, 0.5)) - start;
        let down = (pose * self.point(0.5, 1.5)) - start;
        let k = luma.intrinsics;
        self.values = Vec::with_capacity(self.width * self.height);
        for y in 0..self.height {
            let mut p = start + down * y as f64;
            for _ in 0..self.width {
                let inverse = 1.0 / p.z;
                self.values
                    .push(luma.at(k.fx * p.x * inverse + k.cx, k.fy * p.y * inverse + k.cy));
                p += right;
            }
        }
    }
}

/// Whether a region is turned to the camera enough, by the cosine of incidence.
fn seen_at(cosine: f64) -> Condition {
    let bounds = (None, Some(FLATTEST.acos()));
    let incidence = cosine.clamp(-1.0, 1.0).acos();
    Condition::quantity("incidence", Unit::Angle, incidence, bounds, cosine >= FLATTEST)
}

/// The region's bounds in its plane, metres.
fn extent(cloud: &Cloud, region: &Region, world_from_plane: &Pose) -> (Point2<f64>, Point2<f64>) {
    let to_plane = world_from_plane.inverse();
    let mut low = Point2::new(f64::INFINITY, f64::INFINITY);
    let mut high = Point2::new(f64::NEG_INFINITY, f64::NEG_INFINITY);
    for &pixel in &region.pixels {
        let p = (to_plane * cloud.points[pixel]).xy();
        low = low.inf(&p);
        high = high.sup(&p);
    }
    let margin = nalgebra::Vector2::repeat(MARGIN);
    (low - margin, high + margin)
}
