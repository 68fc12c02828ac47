//! What share of an object's observable surface a run has measured.
//!
//! Samples lie area-uniformly on the object inside the model space. A sample
//! is *observable* when it faces some candidate view in which a noise-free
//! depth pixel lies within ξ of it, on a triangle that faces the same side.
//! It is *covered* when a measured point lies within ξ. Points outside the
//! space (the backdrop) do not count.

mod bound;
mod index;
mod samples;

pub use bound::least_views;

use index::Index;
use rayon::prelude::*;
use samples::Sample;

use super::raster::Visibility;
use super::{Observation, Simulator};
use crate::geometry::{Bounds, Camera, Point, Pose};

/// Candidate views held in memory at a time.
const VIEWS_AT_ONCE: usize = 64;

/// The coverage of one run.
#[derive(Clone, Debug)]
pub struct Coverage {
    points: Vec<Point>,
    seen: Vec<bool>,
    covered: usize,
    left: Index,
    space: Bounds,
    near: f64,
}

impl Coverage {
    /// Samples the object of a simulator and keeps what `camera` can observe
    /// from `views` (`world_from_camera`). `near` is ξ, metres.
    pub fn new(simulator: &Simulator, camera: &Camera, views: &[Pose], near: f64) -> Self {
        let space = simulator.space().bounds();
        let samples = samples::on(simulator.mesh(), &space);
        let mut observable = vec![false; samples.len()];
        for some in views.chunks(VIEWS_AT_ONCE) {
            let drawn: Vec<View> = some.iter().map(|pose| View::of(simulator, camera, pose)).collect();
            observable
                .par_iter_mut()
                .zip(&samples)
                .filter(|(known, _)| !**known)
                .for_each(|(known, sample)| *known = drawn.iter().any(|view| view.shows(sample, near)));
        }
        let points = samples
            .iter()
            .zip(observable)
            .filter_map(|(sample, observable)| observable.then_some(sample.at))
            .collect();
        Self::of(points, space, near)
    }

    fn of(points: Vec<Point>, space: Bounds, near: f64) -> Self {
        Self {
            seen: vec![false; points.len()],
            covered: 0,
            left: Index::of(&points, near),
            points,
            space,
            near,
        }
    }

    /// The same observable samples, none covered yet, counted within another distance.
    pub fn within(&self, near: f64) -> Self {
        Self::of(self.points.clone(), self.space, near)
    }

    /// Observable samples.
    pub fn samples(&self) -> &[Point] {
        &self.points
    }

    /// Which samples are covered.
    pub fn seen(&self) -> &[bool] {
        &self.seen
    }

    /// Counts every reading of an observation; gives the number of samples that it added.
    pub fn observe(&mut self, observation: &Observation) -> usize {
        let (width, height) = (observation.depth.width, observation.depth.height);
        let points: Vec<Point> = (0..height)
            .flat_map(|v| (0..width).filter_map(move |u| observation.point(u, v)))
            .collect();
        self.add(&points)
    }

    /// Counts measured points, world axes; gives the number of samples that they added.
    pub fn add(&mut self, points: &[Point]) -> usize {
        let before = self.covered;
        for p in points.iter().filter(|p| self.space.contains(p)) {
            for k in self.left.take_within(p, self.near, &self.points) {
                self.seen[k as usize] = true;
                self.covered += 1;
            }
        }
        self.covered - before
    }

    /// Covered samples over observable ones; `None` where nothing is observable.
    pub fn share(&self) -> Option<f64> {
        (!self.points.is_empty()).then(|| self.covered as f64 / self.points.len() as f64)
    }
}

/// A candidate view and what it shows.
struct View<'a> {
    drawn: Visibility<'a>,
    camera: &'a Camera,
    world_from_camera: Pose,
}

impl<'a> View<'a> {
    fn of(simulator: &'a Simulator, camera: &'a Camera, world_from_camera: &Pose) -> Self {
        Self {
            drawn: simulator.visibility(camera, world_from_camera),
            camera,
            world_from_camera: *world_from_camera,
        }
    }

    fn shows(&self, sample: &Sample, near: f64) -> bool {
        let eye = Point::from(self.world_from_camera.translation.vector);
        if (eye - sample.at).dot(&sample.normal) <= 0.0 {
            return false;
        }
        let at = self.world_from_camera.inverse_transform_point(&sample.at);
        let image = &self.camera.depth;
        if at.z <= near {
            return false;
        }
        let (u, v) = (image.fx * at.x / at.z + image.cx, image.fy * at.y / at.z + image.cy);
        let (du, dv) = (image.fx * near / (at.z - near), image.fy * near / (at.z - near));
        let columns = window(u, du, image.width);
        let rows = window(v, dv, image.height);
        rows.into_iter()
            .any(|v| columns.clone().any(|u| self.pixel_shows(u, v, &at, sample, near)))
    }

    /// Whether a pixel reads within `near` of a sample at `at` in camera axes.
    fn pixel_shows(&self, u: usize, v: usize, at: &Point, sample: &Sample, near: f64) -> bool {
        let k = v * self.camera.depth.width as usize + u;
        let Some(depth) = self.drawn.depth(k).map(f64::from) else {
            return false;
        };
        let ray = self.camera.depth.ray(u as f64 + 0.5, v as f64 + 0.5);
        self.camera.range.contains(depth)
            && (ray * depth - at.coords).norm_squared() <= near * near
            && self.drawn.triangle(k).is_some_and(|(triangle, front)| {
                front && self.drawn.mesh.vector_area(triangle as usize).dot(&sample.normal) > 0.0
            })
    }
}

/// Pixels whose centres lie within `reach` of an image coordinate.
fn window(middle: f64, reach: f64, size: u32) -> std::ops::Range<usize> {
    let first = (middle - 0.5 - reach).ceil().max(0.0);
    let last = (middle - 0.5 + reach).floor().min(f64::from(size) - 1.0);
    if first <= last {
        first as usize..last as usize + 1
    } else {
        0..0
    }
}

#[cfg(test)]
mod tests;
