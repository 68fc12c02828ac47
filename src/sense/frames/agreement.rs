//! How well fused frames agree: one frame's points seen from the next.

use rayon::prelude::*;

use super::{FrameError, Recording};
use crate::geometry::{Intrinsics, Point, Pose};
use crate::sense::DepthImage;

/// Every so many pixels a point is compared.
const STRIDE: u32 = 4;
/// How far the nearest point is looked for, pixels.
const AROUND: i64 = 8;

/// Two frames and how they agree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Whose points are compared.
    pub first: usize,
    /// With whose depth.
    pub second: usize,
    /// Share of the points that fall on a reading of the second.
    pub shared: f64,
    /// Median of |z of the point − reading it falls on|, metres.
    pub difference: Option<f64>,
    /// Median distance to the nearest point of the second within 8 pixels, metres.
    pub nearest: Option<f64>,
}

/// A depth image and where it was taken.
pub(super) struct Look {
    pub depth: DepthImage,
    pub camera: Intrinsics,
    pub world_from_camera: Pose,
}

impl Look {
    pub fn of(recording: &Recording, k: usize) -> Result<Self, FrameError> {
        let seen = recording.observe(k)?;
        Ok(Self {
            depth: seen.depth,
            camera: seen.camera.depth,
            world_from_camera: seen.world_from_camera,
        })
    }

    /// The point of a pixel, camera axes.
    fn point(&self, u: u32, v: u32) -> Option<Point> {
        let z = self.depth.at(u, v)?;
        Some(Point::from(self.camera.ray(f64::from(u) + 0.5, f64::from(v) + 0.5) * z))
    }

    /// Points of every `stride`-th pixel of every such row.
    pub fn points(&self, stride: u32) -> impl Iterator<Item = Point> + '_ {
        let rows = (stride / 2..self.depth.height).step_by(stride as usize);
        let columns = move || (stride / 2..self.depth.width).step_by(stride as usize);
        rows.flat_map(move |v| columns().filter_map(move |u| self.point(u, v)))
    }

    /// The reading where a point in camera axes falls, with its pixel.
    pub fn reading(&self, p: &Point) -> Option<(f64, [u32; 2])> {
        let (u, v) = self.camera.project(p)?;
        let (u, v) = (u as u32, v as u32);
        Some((self.depth.at(u, v)?, [u, v]))
    }

    /// Distance to the nearest point within [`AROUND`] pixels of (u, v).
    fn nearest(&self, p: &Point, [u, v]: [u32; 2]) -> Option<f64> {
        let inside = |u: i64, v: i64| {
            let (u, v) = (u32::try_from(u).ok()?, u32::try_from(v).ok()?);
            (u < self.depth.width && v < self.depth.height).then(|| self.point(u, v))?
        };
        let (u, v) = (i64::from(u), i64::from(v));
        let window = (-AROUND..=AROUND).flat_map(|y| (-AROUND..=AROUND).map(move |x| (u + x, v + y)));
        let distances = window.filter_map(|(u, v)| Some((inside(u, v)? - p).norm()));
        distances.min_by(f64::total_cmp)
    }
}

/// How successive frames agree: all pairs, or `most` spread evenly.
///
/// # Errors
/// A frame cannot be read.
pub fn agreement(recording: &Recording, most: usize) -> Result<Vec<Pair>, FrameError> {
    let compared = spread(recording.frames.len().saturating_sub(1), most);
    let pair = |first: usize| {
        Ok(compare(
            &Look::of(recording, first)?,
            &Look::of(recording, first + 1)?,
            first,
        ))
    };
    compared.into_par_iter().map(pair).collect()
}

/// At most `most` of the numbers below `count`, spread evenly.
pub(super) fn spread(count: usize, most: usize) -> Vec<usize> {
    let taken = count.min(most);
    (0..taken).map(|k| k * count / taken).collect()
}

fn compare(a: &Look, b: &Look, first: usize) -> Pair {
    let b_from_a = b.world_from_camera.inverse() * a.world_from_camera;
    let (mut all, mut differences, mut nearest) = (0, Vec::new(), Vec::new());
    for p in a.points(STRIDE) {
        all += 1;
        let seen = b_from_a * p;
        if let Some((z, pixel)) = b.reading(&seen) {
            differences.push((z - seen.z).abs());
            nearest.extend(b.nearest(&seen, pixel));
        }
    }
    Pair {
        first,
        second: first + 1,
        shared: differences.len() as f64 / f64::from(all.max(1)),
        difference: median(differences),
        nearest: median(nearest),
    }
}

/// The middle value; `None` of nothing.
pub(super) fn median(mut values: Vec<f64>) -> Option<f64> {
    let middle = values.len() / 2;
    if values.is_empty() {
        return None;
    }
    let (_, value, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    Some(*value)
}
