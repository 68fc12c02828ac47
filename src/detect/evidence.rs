//! What detectors found, kept so that views of one instance can be merged.

use super::faces::Face;
use super::plane_fit::Plane;
use super::scan::Scan;
use crate::geometry::{Point, Pose, Vector, frame_facing};

/// What a detector found, kept so that views of one feature can be merged.
#[derive(Clone, Debug)]
pub enum Evidence {
    /// Points of a planar face.
    Face(FaceEvidence),
    /// Looks at a marker.
    Marker(MarkerEvidence),
}

/// The seen parts of a planar face.
///
/// Points lie on the plane fitted in each view and cover the footprints of the
/// face's pixels, so that the cover ends where the face ends.
#[derive(Clone, Debug)]
pub struct FaceEvidence {
    /// Points of the face, world axes, about `spacing` apart.
    pub points: Vec<Point>,
    /// Distance between neighbouring points, metres.
    pub spacing: f64,
    /// Size of a pixel on the face in its coarser direction, metres; the mean over the points.
    pub grain: f64,
    /// Sum of the outward normals of the views, world axes.
    pub outward: Vector,
}

/// Looks at a marker.
#[derive(Clone, Debug)]
pub struct MarkerEvidence {
    /// Each look, oldest first.
    pub looks: Vec<Look>,
    /// Edge of the square of modules, metres, as declared.
    pub size: f64,
}

/// One look at a marker.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// `world_from_marker`: x right, y up on the print, z out of it.
    pub pose: Pose,
    /// How much the look counts: pixels of the colour image that the code covers.
    pub weight: f64,
}

/// Least distance between kept points, metres.
const SPACING: f64 = 0.003;
/// About how many points a view adds at most.
const POINTS_A_VIEW: f64 = 15_000.0;
/// Most points that a face keeps; beyond it the spacing doubles.
const MOST_POINTS: usize = 40_000;
/// Most looks that a marker keeps.
const MOST_LOOKS: usize = 64;

/// A spread about the plane beyond which borders are taken to be frayed, metres.
const CLEAN: f64 = 0.0008;
/// How many pixels wide a frayed border is.
const NOISY_GRAIN: f64 = 1.6;
/// Half edge of the window that straightens frayed borders, pixels.
const SMOOTHING: usize = 2;
/// Share of the window that must belong to the face.
const MAJORITY: f64 = 0.4;

impl FaceEvidence {
    /// The evidence of a face in one view.
    pub(super) fn of(scan: &Scan, face: &Face) -> Self {
        let spacing = SPACING.max((face.area / POINTS_A_VIEW).sqrt());
        let noisy = face.rms > CLEAN;
        let pixels = if noisy {
            smoothed(scan, &face.pixels)
        } else {
            face.pixels.clone()
        };
        let grains: Vec<f64> = pixels.iter().map(|&p| grain(scan, p, &face.plane)).collect();
        let mut points = Vec::new();
        for (&pixel, grain) in pixels.iter().zip(&grains) {
            cover(
                scan,
                pixel,
                &face.plane,
                (grain / spacing).ceil().clamp(1.0, 8.0) as usize,
                &mut points,
            );
        }
        let points = thinned(points, spacing, &face.plane.normal);
        let blur = if noisy { NOISY_GRAIN } else { 1.0 };
        let grain = blur * grains.iter().sum::<f64>() / grains.len().max(1) as f64;
        Self {
            points,
            spacing,
            grain,
            outward: face.plane.normal,
        }
    }

    fn merge(&mut self, other: Self) {
        let (mine, theirs) = (self.points.len() as f64, other.points.len() as f64);
        self.grain = (self.grain * mine + other.grain * theirs) / f64::max(mine + theirs, 1.0);
        self.spacing = self.spacing.max(other.spacing);
        self.outward += other.outward;
        let mut points = std::mem::take(&mut self.points);
        points.extend(other.points);
        self.points = thinned(points, self.spacing, &self.outward);
        while self.points.len() > MOST_POINTS {
            self.spacing *= 2.0;
            self.points = thinned(std::mem::take(&mut self.points), self.spacing, &self.outward);
        }
    }
}

impl Evidence {
    /// Adds another view's evidence of the same instance. Evidence of another
    /// kind is left out.
    pub fn merge(&mut self, other: Evidence) {
        match (self, other) {
            (Self::Face(mine), Self::Face(theirs)) => mine.merge(theirs),
            (Self::Marker(mine), Self::Marker(theirs)) => {
                mine.looks.extend(theirs.looks);
                let surplus = mine.looks.len().saturating_sub(MOST_LOOKS);
                mine.looks.drain(..surplus);
            }
            _ => {}
        }
    }
}

/// The pixels around which the face holds the majority: straightens borders
/// that noise has frayed and fills lost readings.
fn smoothed(scan: &Scan, pixels: &[usize]) -> Vec<usize> {
    let cloud = &scan.cloud;
    let mut votes = vec![0_u32; cloud.points.len()];
    for &pixel in pixels {
        cloud.square(pixel, SMOOTHING).for_each(|p| votes[p] += 1);
    }
    let all = (2 * SMOOTHING + 1).pow(2) as f64;
    (0..votes.len())
        .filter(|&p| f64::from(votes[p]) > MAJORITY * all)
        .collect()
}

/// The longer side of a pixel's footprint on a plane, metres.
fn grain(scan: &Scan, pixel: usize, plane: &Plane) -> f64 {
    let ray = scan.cloud.world_from_camera * scan.cloud.ray(pixel, 0.5, 0.5);
    let cosine = plane.normal.dot(&ray.normalize()).abs().max(0.1);
    // The ray has z = 1, so it meets the plane at this z-depth.
    let depth = (plane.distance(&scan.cloud.eye()) / plane.normal.dot(&ray)).abs();
    depth / scan.cloud.intrinsics.fx.min(scan.cloud.intrinsics.fy) / cosine
}

/// Adds `side`² points of a pixel's footprint on the plane.
fn cover(scan: &Scan, pixel: usize, plane: &Plane, side: usize, points: &mut Vec<Point>) {
    let eye = scan.cloud.eye();
    let middle = |k: usize| (k as f64 + 0.5) / side as f64;
    for v in 0..side {
        for u in 0..side {
            let ray = scan.cloud.world_from_camera * scan.cloud.ray(pixel, middle(u), middle(v));
            points.extend(plane.hit(&eye, &ray));
        }
    }
}

/// One point a cell of edge `spacing` in the face's plane, in a fixed order.
fn thinned(points: Vec<Point>, spacing: f64, normal: &Vector) -> Vec<Point> {
    let plane = frame_facing(Point::origin(), *normal);
    let mut keyed: Vec<((i64, i64), Point)> = points
        .into_iter()
        .map(|p| {
            let local = plane.inverse_transform_point(&p);
            (
                ((local.x / spacing).floor() as i64, (local.y / spacing).floor() as i64),
                p,
            )
        })
        .collect();
    keyed.sort_by_key(|(cell, _)| *cell);
    keyed.dedup_by_key(|(cell, _)| *cell);
    keyed.into_iter().map(|(_, p)| p).collect()
}
