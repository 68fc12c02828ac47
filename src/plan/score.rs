//! View status: what a candidate view would gain (eqs. 8 and 9).
//!
//! Only voxels that could matter are tested for visibility: predicted ones,
//! rear-side ones and, for the overlap, occupied and pre-occupied ones. Views
//! are independent and their results are collected by index.

use rayon::prelude::*;

use super::features::Predicted;
use super::inspection::{reachable, reaches};
use super::knowledge::Knowledge;
use super::look::{Look, Targets};
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
    let looks = || {
        let look = |v: &usize| Look::of(world, &candidates[*v], knowledge.criteria.visibility);
        unvisited.par_iter().map(look)
    };
    let feature: Vec<FeatureGain> = looks().map(|l| feature_gain(&l, status, knowledge)).collect();
    let w = feature.iter().all(|g| g.bits <= 0.0);
    let seen: Vec<usize> = if w {
        let rear = Targets::of(world, world.rear_side());
        looks().map(|look| look.count(&rear)).collect()
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
pub fn feature_gain<W: World + ?Sized>(look: &Look<'_, W>, status: &Status, knowledge: &Knowledge) -> FeatureGain {
    let mut best = FeatureGain::default();
    for id in knowledge.library.feature_ids() {
        let weight = status.weights[id.index()];
        if weight <= 0.0 {
            continue;
        }
        for (key, predicted) in &status.feature(id).predicted {
            let reach = reach(look, predicted, knowledge);
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
pub fn reachable_count<W: World + ?Sized>(look: &Look<'_, W>, predicted: &Predicted, knowledge: &Knowledge) -> u64 {
    reach(look, predicted, knowledge).counted(knowledge)
}

/// Voxels of PV_ij that a view reaches, inspected or not.
pub fn shown_count<W: World + ?Sized>(look: &Look<'_, W>, predicted: &Predicted, knowledge: &Knowledge) -> usize {
    let reached = reached(look, predicted, knowledge, |_| true);
    reached.into_iter().filter(|r| *r).count()
}

fn reach<W: World + ?Sized>(look: &Look<'_, W>, predicted: &Predicted, knowledge: &Knowledge) -> Reach {
    let whole = predicted.envelope.whole;
    let open = |k: usize| !predicted.inspected[k];
    let reached = reached(look, predicted, knowledge, |k| whole || open(k));
    let all = reached.iter().filter(|r| **r).count();
    Reach {
        open: reached.iter().enumerate().filter(|(k, r)| **r && open(*k)).count(),
        enough: !whole || reaches(all, predicted.voxels.len(), knowledge.criteria.absent),
    }
}

fn reached<W: World + ?Sized>(
    look: &Look<'_, W>,
    predicted: &Predicted,
    knowledge: &Knowledge,
    wanted: impl Fn(usize) -> bool,
) -> Vec<bool> {
    let (voxels, touched) = (&predicted.voxels, &predicted.touched);
    reachable(
        look,
        voxels,
        touched,
        &predicted.envelope,
        knowledge.criteria.near,
        wanted,
    )
}

/// G_so(v) after the gain floor: reachable rear-side voxels.
pub fn surface_gain<W: World + ?Sized>(look: &Look<'_, W>, rear: &Targets, knowledge: &Knowledge) -> u64 {
    floored(look.count(rear), knowledge)
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
pub fn overlap_share<W: World + ?Sized>(look: &Look<'_, W>, parts: &OverlapParts, near: f64) -> f64 {
    let occupied = look.count(&parts.occupied);
    let preoccupied = look.count_within(&parts.preoccupied, near);
    let rear = look.count(&parts.rear_side);
    occupied as f64 / ((occupied + preoccupied + rear) as f64).max(1.0)
}

/// The voxels that an overlap is counted from.
#[derive(Clone, Debug)]
pub struct OverlapParts {
    occupied: Targets,
    preoccupied: Targets,
    rear_side: Targets,
}

impl OverlapParts {
    /// Gathers them.
    pub fn of<W: World + ?Sized>(world: &W, status: &Status) -> Self {
        let predicted = status.features.iter().flat_map(|f| f.predicted.values());
        let mut tagged: Vec<Voxel> = predicted.flat_map(|p| p.tagged.iter().copied()).collect();
        tagged.sort_unstable();
        tagged.dedup();
        let mut rear_side = world.rear_side();
        rear_side.retain(|v| tagged.binary_search(v).is_err());
        tagged.retain(|v| world.occupancy(*v) == Occupancy::Unknown);
        Self {
            occupied: Targets::of(world, world.occupied()),
            preoccupied: Targets::of(world, tagged),
            rear_side: Targets::of(world, rear_side),
        }
    }
}
