//! Predicted voxels and which of them have been inspected (eqs. 3 and 6).
//!
//! PV_ij is every voxel that contains a sample of the predicted polygons. A
//! voxel x of it is *inspected* when there is evidence about x, and some
//! visited view was a look at x that counts:
//!
//! - evidence: a measured point lies within ξ of its centre, or (setting
//!   `observed`) it was measured free;
//! - a look: x is inside the images, the depth range and the detector's
//!   envelope, and not hidden. Where a measured point lies within ξ of x, an
//!   occupied voxel within ξ of it, or one that touches it, does not hide it,
//!   for by eq. 3 that point inspects it: a surface measured just in front of
//!   its predicted place, or in the next layer of voxels, would otherwise hide
//!   that place for ever. Where none does, every occupied voxel hides, or x
//!   would stay reachable and never be inspected.
//!
//! A look counts only if the detector was run on it: where no definite rule
//! detects the feature, views taken before its antecedents were measured are
//! none.
//!
//! A detector that needs the feature whole counts a look only when at least
//! ξ_ned of PV_ij passes all of this in that one view. A voxel of several
//! polygons (an edge of a shell) is seen when any of them faces the view.
//!
//! Whether something hid a voxel is decided when the view is taken, and for all
//! visited views anew when a prediction is made or replaced.

use std::collections::{BTreeMap, BTreeSet};

use super::look::Look;
use super::world::World;
use crate::geometry::{Point, Polygon, Vector};
use crate::map::{Grid, Occupancy, Voxel};
use crate::primitives::Envelope;
use crate::rules::{Inspected, Task, Visibility};

/// A voxel of PV_ij.
#[derive(Clone, Debug, PartialEq)]
pub struct PredictedVoxel {
    /// The voxel.
    pub voxel: Voxel,
    /// Its centre, metres.
    pub centre: Point,
    /// Outward normals of the polygons with a sample in it.
    pub normals: Vec<Vector>,
}

/// What decides about inspection, out of a task.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Criteria {
    /// ξ, metres.
    pub near: f64,
    /// ξ_ned, a share.
    pub absent: f64,
    /// How eq. 3 counts a voxel.
    pub inspected: Inspected,
    /// What hides a voxel.
    pub visibility: Visibility,
}

impl From<&Task> for Criteria {
    fn from(task: &Task) -> Self {
        Self {
            near: task.thresholds.near,
            absent: task.thresholds.absent,
            inspected: task.inspected,
            visibility: task.visibility,
        }
    }
}

/// PV_ij: the voxels that contain a sample of the polygons, samples at most
/// half a voxel apart, ascending.
///
/// Empty, and so no prediction, where the polygons lie outside the grid or
/// reach further than its diagonal beyond it.
pub fn predicted_voxels(polygons: &[Polygon], grid: &Grid) -> Vec<PredictedVoxel> {
    let mut normals: BTreeMap<Voxel, Vec<Vector>> = BTreeMap::new();
    for polygon in polygons.iter().filter(|p| within_reach(p, grid)) {
        let samples = polygon.samples(grid.voxel / 2.0);
        let voxels: BTreeSet<Voxel> = samples.iter().filter_map(|p| grid.containing(p)).collect();
        for voxel in voxels {
            normals.entry(voxel).or_default().push(polygon.normal());
        }
    }
    let predicted = |(voxel, normals)| PredictedVoxel {
        voxel,
        centre: grid.centre(voxel),
        normals,
    };
    normals.into_iter().map(predicted).collect()
}

/// Bounds the number of samples: no use comes of a polygon far outside.
fn within_reach(polygon: &Polygon, grid: &Grid) -> bool {
    let extent = Vector::from(grid.size.map(f64::from)) * grid.voxel;
    let centre = grid.origin + extent / 2.0;
    let reach = 1.5 * extent.norm();
    polygon.vertices().iter().all(|v| (v - centre).norm() <= reach)
}

/// The voxels that a prediction tags (eq. 6): unknown now and within `near` of
/// PV_ij, centre to centre, ascending.
///
/// Layer by layer: the voxels within `near` of one are runs along x.
pub fn tagged<W: World + ?Sized>(world: &W, voxels: &[PredictedVoxel], near: f64) -> Vec<Voxel> {
    let grid = world.grid();
    let [width, depth, height] = grid.size.map(i64::from);
    let cells: Vec<[i64; 3]> = voxels.iter().map(|v| grid.cell(v.voxel)).collect();
    let (Some(first), Some(last)) = (cells.first(), cells.last()) else {
        return Vec::new();
    };
    let radius = (near / grid.voxel).clamp(0.0, width.max(depth).max(height) as f64);
    let reach = radius.floor() as i64;
    let mut tagged = Vec::new();
    for z in (first[2] - reach).max(0)..=(last[2] + reach).min(height - 1) {
        let mut layer = vec![false; (width * depth) as usize];
        let below = cells.partition_point(|c| c[2] < z - reach);
        for [x, y, from] in cells[below..].iter().take_while(|c| c[2] <= z + reach) {
            for row in (y - reach).max(0)..=(y + reach).min(depth - 1) {
                let Some(half) = half_width(radius, row - y, z - from) else {
                    continue;
                };
                let (start, end) = ((x - half).max(0), (x + half).min(width - 1));
                layer[(row * width + start) as usize..=(row * width + end) as usize].fill(true);
            }
        }
        let around = layer.iter().enumerate().filter(|(_, marked)| **marked);
        let voxels = around.filter_map(|(k, _)| grid.at([k as i64 % width, k as i64 / width, z]));
        tagged.extend(voxels.filter(|v| world.occupancy(*v) == Occupancy::Unknown));
    }
    tagged
}

/// Half the run along x, in cells, of what lies within `radius` cells, the
/// border included; `None` where the row lies beyond.
fn half_width(radius: f64, dy: i64, dz: i64) -> Option<i64> {
    let left = radius * radius + 1e-9 - (dy * dy + dz * dz) as f64;
    (left >= 0.0).then(|| left.sqrt().floor() as i64)
}

/// Which of the predicted voxels have a measured point within `near` metres.
pub fn touched<W: World + ?Sized>(world: &W, voxels: &[PredictedVoxel], near: f64) -> Vec<bool> {
    voxels.iter().map(|v| world.measured_within(&v.centre, near)).collect()
}

/// Which of the predicted voxels are reachable in a look: inside the images, the
/// depth range and the envelope, and not hidden, where `touched` by what lies farther
/// than `near` metres in front. Only those that `wanted` names by their index are
/// tested.
pub fn reachable<W: World + ?Sized>(
    look: &Look<'_, W>,
    voxels: &[PredictedVoxel],
    touched: &[bool],
    envelope: &Envelope,
    near: f64,
    wanted: impl Fn(usize) -> bool,
) -> Vec<bool> {
    let own_surface = near.max(touching(look.grid()));
    let sees = |k: usize, v: &PredictedVoxel| {
        let faces = |n: &Vector| look.view().could_detect(&v.centre, n, envelope);
        let tolerance = if touched[k] { own_surface } else { 0.0 };
        v.normals.iter().any(faces) && look.sees(v.voxel, tolerance)
    };
    let tested = voxels.iter().enumerate();
    tested.map(|(k, v)| wanted(k) && sees(k, v)).collect()
}

/// Largest distance between the centres of voxels that touch, metres.
fn touching(grid: &Grid) -> f64 {
    3.0_f64.sqrt() * grid.voxel
}

/// Which of the predicted voxels there is evidence about.
pub fn evidence<W: World + ?Sized>(
    world: &W,
    voxels: &[PredictedVoxel],
    touched: &[bool],
    criteria: &Criteria,
) -> Vec<bool> {
    let free_counts = criteria.inspected == Inspected::Observed;
    let is_free = |v: &PredictedVoxel| world.occupancy(v.voxel) == Occupancy::Free;
    let known = |(v, touched): (&PredictedVoxel, &bool)| *touched || free_counts && is_free(v);
    voxels.iter().zip(touched).map(known).collect()
}

/// Which of the predicted voxels are inspected, given what each visited view
/// reached of them (one row a view) and the evidence about them.
pub fn inspected(looks: &[Vec<bool>], evidence: &[bool], whole: bool, absent: f64) -> Vec<bool> {
    let mut done = vec![false; evidence.len()];
    for look in looks {
        let passed = |k: usize| look[k] && evidence[k];
        let count = (0..evidence.len()).filter(|k| passed(*k)).count();
        if whole && !reaches(count, evidence.len(), absent) {
            continue;
        }
        for (k, done) in done.iter_mut().enumerate() {
            *done |= passed(k);
        }
    }
    done
}

/// Whether `count` of `total` is at least a share; nothing of nothing is not.
pub fn reaches(count: usize, total: usize, share: f64) -> bool {
    total > 0 && count as f64 >= share * total as f64 - 1e-9
}
