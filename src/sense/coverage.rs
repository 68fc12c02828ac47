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
mod view;

pub use bound::least_views;

use index::Index;
use rayon::prelude::*;
use samples::Sample;
use view::View;

use super::{Observation, Simulator};
use crate::geometry::{Bounds, Camera, Point, Pose};

/// Candidate views held in memory at a time.
const VIEWS_AT_ONCE: usize = 64;
/// Consecutive samples that are looked for together.
const NEIGHBOURS: usize = 1_024;

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
            let drawn: Vec<View> = some.par_iter().map(|pose| View::of(simulator, camera, pose)).collect();
            observable
                .par_chunks_mut(NEIGHBOURS)
                .zip(samples.par_chunks(NEIGHBOURS))
                .for_each(|(known, samples)| mark(known, samples, &drawn, near));
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

/// Marks the samples that some view shows. What showed one mostly shows the next,
/// so it is asked first.
fn mark(known: &mut [bool], samples: &[Sample], views: &[View], near: f64) {
    let mut last = 0;
    for (known, sample) in known.iter_mut().zip(samples).filter(|(known, _)| !**known) {
        let mut order = (last..views.len()).chain(0..last);
        if let Some(view) = order.find(|&view| views[view].shows(sample, near)) {
            (*known, last) = (true, view);
        }
    }
}

#[cfg(test)]
mod tests;
