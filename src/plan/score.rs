//! View status: what a candidate view would gain (eqs. 8 and 9).
//!
//! Only voxels that could matter are tested for visibility: predicted ones,
//! rear-side ones and, for the overlap, occupied and pre-occupied ones. Views
//! are independent and their results are collected by index.

use std::collections::BTreeSet;

use rayon::prelude::*;

use super::features::Predicted;
use super::inspection::{reachable, reaches};
use super::knowledge::Knowledge;
use super::status::Status;
use super::viewpoint::Viewpoint;
use super::world::World;
use crate::map::{Occupancy, Voxel};
use crate::rules::FeatureId;

/// The instance that gave a view its G_fd.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Target {
    /// The feature.
    pub feature: FeatureId,
    /// The instance's key.
    pub key: String,
    /// Its voxels that the view reaches and that are not yet inspected.
    pub reached: usize,
    /// |PV_ij|.
    pub voxels: usize,
}

/// G_fd of a view.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FeatureGain {
    /// Bits.
    pub bits: f64,
    /// Where they come from: the first of the largest, in feature and key order.
    pub target: Option<Target>,
    /// The largest gain that does not count: below the floor, or of a feature
    /// that must be seen whole and is not.
    pub uncounted: Option<Target>,
}

/// The gains of all unvisited views, in their order.
#[derive(Clone, Debug, PartialEq)]
pub struct Gains {
    /// Indices of the unvisited views, ascending.
    pub views: Vec<usize>,
    /// G_fd of each.
    pub feature: Vec<FeatureGain>,
    /// W: whether G_fd is 0 for every unvisited view.
    pub w: bool,
    /// G_so of each after the gain floor; all 0 where W is 0 and it does not matter.
    pub surface: Vec<u64>,
    /// The largest G_so before the gain floor; 0 where W is 0.
    pub most_surface: usize,
}

impl Gains {
    /// G_fd + W · G_so of the `k`-th unvisited view.
    pub fn total(&self, k: usize) -> f64 {
        let surface = if self.w { self.surface[k] as f64 } else { 0.0 };
        self.feature[k].bits + surface
    }

    /// s_ail (eq. 11): no unvisited view gains anything.
    pub fn exhausted(&self) -> bool {
        (0..self.views.len()).all(|k| self.total(k) <= 0.0)
    }

    /// The gain of a feature that comes nearest to counting while none does.
    pub fn most_uncounted(&self) -> Option<&Target> {
        let all = self.feature.iter().filter_map(|g| g.uncounted.as_ref());
        all.reduce(|most, next| if next.reached > most.reached { next } else { most })
    }
}

/// The gains of the candidates that `unvisited` names.
pub fn gains<W: World + ?Sized>(
    world: &W,
    candidates: &[Viewpoint],
    unvisited: &[usize],
    status: &Status,
    knowledge: &Knowledge,
) -> Gains {
    let each = || unvisited.par_iter().map(|v| &candidates[*v]);
    let feature: Vec<FeatureGain> = each().map(|v| feature_gain(world, v, status, knowledge)).collect();
    let w = feature.iter().all(|g| g.bits <= 0.0);
    let seen: Vec<usize> = if w {
        let rear = world.rear_side();
        each().map(|v| reachable_plain(world, v, &rear, 0.0)).collect()
    } else {
        vec![0; unvisited.len()]
    };
    Gains {
        views: unvisited.to_vec(),
        feature,
        w,
        most_surface: seen.iter().copied().max().unwrap_or(0),
        surface: seen.into_iter().map(|n| floored(n, knowledge)).collect(),
    }
}

/// G_fd(v) = max over i, j of w_i · n_ij(v) / n_t,ij.
pub fn feature_gain<W: World + ?Sized>(
    world: &W,
    view: &Viewpoint,
    status: &Status,
    knowledge: &Knowledge,
) -> FeatureGain {
    let mut best = FeatureGain::default();
    for id in knowledge.library.feature_ids() {
        let weight = status.weights[id.index()];
        if weight <= 0.0 {
            continue;
        }
        for (key, predicted) in &status.feature(id).predicted {
            let reach = reach(world, view, predicted, knowledge);
            let target = || Target {
                feature: id,
                key: key.clone(),
                reached: reach.open,
                voxels: predicted.voxels.len(),
            };
            let n = reach.counted(knowledge);
            let bits = weight * n as f64 / predicted.voxels.len() as f64;
            if bits > best.bits {
                (best.bits, best.target) = (bits, Some(target()));
            }
            if n == 0 && reach.open > best.uncounted.as_ref().map_or(0, |t| t.reached) {
                best.uncounted = Some(target());
            }
        }
    }
    best
}

/// What a view reaches of a predicted instance.
struct Reach {
    /// Reachable voxels that are not yet inspected.
    open: usize,
    /// Whether the look would count.
    enough: bool,
}

impl Reach {
    fn counted(&self, knowledge: &Knowledge) -> u64 {
        if self.enough { floored(self.open, knowledge) } else { 0 }
    }
}

/// n_ij(v) after the gain floor: the not yet inspected voxels of PV_ij that are
/// reachable. 0 where the detector needs the feature whole and the view shows
/// less than ξ_ned of it.
pub fn reachable_count<W: World + ?Sized>(
    world: &W,
    view: &Viewpoint,
    predicted: &Predicted,
    knowledge: &Knowledge,
) -> u64 {
    reach(world, view, predicted, knowledge).counted(knowledge)
}

/// Voxels of PV_ij that a view reaches, inspected or not.
pub fn shown_count<W: World + ?Sized>(
    world: &W,
    view: &Viewpoint,
    predicted: &Predicted,
    knowledge: &Knowledge,
) -> usize {
    let near = knowledge.criteria.near;
    let reached = reachable(world, view, &predicted.voxels, &predicted.envelope, near, |_| true);
    reached.into_iter().filter(|r| *r).count()
}

fn reach<W: World + ?Sized>(world: &W, view: &Viewpoint, predicted: &Predicted, knowledge: &Knowledge) -> Reach {
    let whole = predicted.envelope.whole;
    let open = |k: usize| !predicted.inspected[k];
    let (near, absent) = (knowledge.criteria.near, knowledge.criteria.absent);
    let wanted = |k| whole || open(k);
    let reached = reachable(world, view, &predicted.voxels, &predicted.envelope, near, wanted);
    let all = reached.iter().filter(|r| **r).count();
    Reach {
        open: reached.iter().enumerate().filter(|(k, r)| **r && open(*k)).count(),
        enough: !whole || reaches(all, predicted.voxels.len(), absent),
    }
}

/// G_so(v) after the gain floor: reachable rear-side voxels.
pub fn surface_gain<W: World + ?Sized>(world: &W, view: &Viewpoint, rear: &[Voxel], knowledge: &Knowledge) -> u64 {
    floored(reachable_plain(world, view, rear, 0.0), knowledge)
}

/// Gains below the task's floor are none.
fn floored(n: usize, knowledge: &Knowledge) -> u64 {
    if n < knowledge.task.gain_floor as usize {
        0
    } else {
        n as u64
    }
}

/// The share that G_ovlp judges: reachable occupied voxels over those, the
/// reachable pre-occupied and the reachable rear-side ones. A voxel that is
/// both pre-occupied and rear-side counts once; a view that reaches nothing
/// has no overlap.
pub fn overlap_share<W: World + ?Sized>(world: &W, view: &Viewpoint, parts: &OverlapParts, near: f64) -> f64 {
    let occupied = reachable_plain(world, view, &parts.occupied, 0.0);
    let preoccupied = reachable_plain(world, view, &parts.preoccupied, near);
    let rear = reachable_plain(world, view, &parts.rear_side, 0.0);
    occupied as f64 / ((occupied + preoccupied + rear) as f64).max(1.0)
}

/// The voxels that an overlap is counted from.
#[derive(Clone, Debug)]
pub struct OverlapParts {
    occupied: Vec<Voxel>,
    preoccupied: Vec<Voxel>,
    rear_side: Vec<Voxel>,
}

impl OverlapParts {
    /// Gathers them.
    pub fn of<W: World + ?Sized>(world: &W, status: &Status) -> Self {
        let predicted = status.features.iter().flat_map(|f| f.predicted.values());
        let tagged: BTreeSet<Voxel> = predicted.flat_map(|p| p.tagged.iter().copied()).collect();
        let unknown = |v: &Voxel| world.occupancy(*v) == Occupancy::Unknown;
        let mut rear_side = world.rear_side();
        rear_side.retain(|v| !tagged.contains(v));
        Self {
            occupied: world.occupied(),
            preoccupied: tagged.into_iter().filter(unknown).collect(),
            rear_side,
        }
    }
}

/// Voxels inside the depth image and range that nothing hides.
fn reachable_plain<W: World + ?Sized>(world: &W, view: &Viewpoint, voxels: &[Voxel], tolerance: f64) -> usize {
    let grid = world.grid();
    let reached = |v: &&Voxel| view.measures(&grid.centre(**v)) && world.visible(view.eye(), **v, tolerance);
    voxels.iter().filter(reached).count()
}
