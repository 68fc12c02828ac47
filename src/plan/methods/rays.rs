//! Rays of a view through the map, as the methods of information gain count them.
//!
//! OA, UV, RSV, RSE, PC, AF and AE cast the rays of a view's depth image and add up
//! what the voxels on them promise. Definitions: Delmerico et al. 2018, and their
//! implementation `rpg_ig_active_reconstruction`, which differs in two things:
//! the visibility of a voxel multiplies p where the paper has 1 − p, and a measured
//! voxel between two bounds counts as unknown. [`Reading`] tells which is meant.

use rayon::prelude::*;

use super::{Choice, Situation};
use crate::geometry::Point;
use crate::map::{Occupancy, Voxel};
use crate::plan::Viewpoint;
use crate::plan::world::World;

/// Rays a row of the depth image, at most: every k-th pixel is taken in both
/// directions, k being the least with which these suffice. For a Kinect v2 (512 × 424)
/// that is every fourth: 128 × 106 rays, 11 mm apart at 1 m.
pub(super) const RAYS_A_ROW: u32 = 128;

/// Below the first a voxel is free and above the second occupied, as the reference
/// implementation ships them.
const BOUNDS: (f64, f64) = (0.2, 0.8);

/// Whose definition is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reading {
    /// The paper's.
    Published,
    /// The reference implementation's.
    Implemented,
}

/// A voxel on a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Visit {
    /// The voxel.
    pub voxel: Voxel,
    /// P(occupied), ½ where never measured.
    pub probability: f64,
    /// Whether some measurement changed it.
    pub measured: bool,
    /// What it counts as.
    pub state: Occupancy,
}

impl Visit {
    fn of(world: &dyn World, voxel: Voxel, reading: Reading) -> Self {
        let probability = world.probability(voxel);
        let p = probability.unwrap_or(0.5);
        let state = match reading {
            Reading::Published => world.occupancy(voxel),
            Reading::Implemented if p < BOUNDS.0 => Occupancy::Free,
            Reading::Implemented if p > BOUNDS.1 => Occupancy::Occupied,
            Reading::Implemented => Occupancy::Unknown,
        };
        Self {
            voxel,
            probability: p,
            measured: probability.is_some(),
            state,
        }
    }

    /// H(p) of the voxel, nats.
    pub fn entropy(&self) -> f64 {
        if !self.measured {
            return std::f64::consts::LN_2;
        }
        let term = |p: f64| if p > 0.0 { -p * p.ln() } else { 0.0 };
        term(self.probability) + term(1.0 - self.probability)
    }

    pub fn is_unknown(&self) -> bool {
        self.state == Occupancy::Unknown
    }
}

impl Reading {
    /// What passing a voxel leaves of the visibility of those behind.
    fn passing(self, visit: &Visit) -> f64 {
        match self {
            Self::Published => 1.0 - visit.probability,
            Self::Implemented => visit.probability,
        }
    }

    /// Every voxel of a ray with vis_i, the product over the voxels before it.
    pub fn with_visibility(self, ray: &[Visit]) -> impl Iterator<Item = (f64, &Visit)> {
        ray.iter().scan(1.0, move |visibility, visit| {
            let here = *visibility;
            *visibility *= self.passing(visit);
            Some((here, visit))
        })
    }
}

/// Whether a ray ends on a surface.
pub(super) fn ends_occupied(ray: &[Visit]) -> bool {
    ray.last().is_some_and(|end| end.state == Occupancy::Occupied)
}

/// The view of the largest value, each the sum of `value` over its rays.
pub(super) fn largest_sum(
    situation: &Situation<'_>,
    reading: Reading,
    value: impl Fn(&[Visit]) -> f64 + Sync,
) -> Option<Choice> {
    let add = |sum: &mut f64, ray: &[Visit]| *sum += value(ray);
    largest(situation, reading, add, |sum: f64| sum)
}

/// The view of the largest value: `count` takes in its rays one by one, `value` says
/// what the count is worth.
pub(super) fn largest<T: Default>(
    situation: &Situation<'_>,
    reading: Reading,
    count: impl Fn(&mut T, &[Visit]) + Sync,
    value: impl Fn(T) -> f64 + Sync,
) -> Option<Choice> {
    let of_view = |view: &usize| {
        let mut counted = T::default();
        let viewpoint = &situation.candidates[*view];
        for_each_ray(situation.world, viewpoint, reading, |ray| count(&mut counted, ray));
        value(counted)
    };
    let values: Vec<f64> = situation.gains.views.par_iter().map(of_view).collect();
    situation.largest(&values)
}

/// Calls `take` with the voxels of every ray that meets the space: from the least
/// depth of the sensor to the first occupied voxel, that one included, or to where the
/// ray leaves the space or the sensor's range.
fn for_each_ray(world: &dyn World, view: &Viewpoint, reading: Reading, mut take: impl FnMut(&[Visit])) {
    let mut ray = Vec::new();
    for (from, to) in view.rays(RAYS_A_ROW) {
        ray.clear();
        walk(world, &from, &to, reading, &mut ray);
        if !ray.is_empty() {
            take(&ray);
        }
    }
}

fn walk(world: &dyn World, from: &Point, to: &Point, reading: Reading, ray: &mut Vec<Visit>) {
    for voxel in world.grid().along(from, to) {
        ray.push(Visit::of(world, voxel, reading));
        if world.occupancy(voxel) == Occupancy::Occupied {
            return;
        }
    }
}
