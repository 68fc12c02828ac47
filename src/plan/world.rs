//! What the planner needs to know of the model space.
//!
//! Statuses, inspection and scoring read the space through this view, so that
//! they can be checked on worlds of a few voxels made by hand. The map is the
//! one implementation that a session uses.

use super::viewpoint::Viewpoint;
use crate::geometry::Point;
use crate::map::{CentreView, Grid, Map, Occupancy, Voxel};

/// A measured space, read only.
pub trait World: Sync {
    /// The voxel grid.
    fn grid(&self) -> &Grid;
    /// State of a voxel by measurement alone.
    fn occupancy(&self, voxel: Voxel) -> Occupancy;
    /// P(occupied) of a voxel; `None` where it was never measured.
    fn probability(&self, voxel: Voxel) -> Option<f64>;
    /// Whether a measured point lies within `radius` metres of `p` (PC_t of eq. 3).
    fn measured_within(&self, p: &Point, radius: f64) -> bool;
    /// Whether no occupied voxel hides `voxel` from `eye`, except those whose
    /// centre lies within `tolerance` metres of its centre.
    fn visible(&self, eye: &Point, voxel: Voxel, tolerance: f64) -> bool;
    /// What a view sees by the centres of voxels; `None` where only sight lines answer.
    fn centre_view(&self, _: &Viewpoint) -> Option<CentreView> {
        None
    }
    /// Occupied voxels, ascending.
    fn occupied(&self) -> Vec<Voxel>;
    /// Rear-side voxels, ascending: unknown, face-adjacent to an occupied voxel
    /// on its far side as seen from a view that measured it.
    fn rear_side(&self) -> Vec<Voxel>;
}

impl World for Map {
    fn grid(&self) -> &Grid {
        Map::grid(self)
    }

    fn occupancy(&self, voxel: Voxel) -> Occupancy {
        Map::occupancy(self, voxel)
    }

    fn probability(&self, voxel: Voxel) -> Option<f64> {
        Map::probability(self, voxel)
    }

    fn measured_within(&self, p: &Point, radius: f64) -> bool {
        Map::measured_within(self, p, radius)
    }

    fn visible(&self, eye: &Point, voxel: Voxel, tolerance: f64) -> bool {
        Map::visible(self, eye, voxel, tolerance)
    }

    fn centre_view(&self, view: &Viewpoint) -> Option<CentreView> {
        let camera = view.camera();
        Some(Map::centre_view(self, &camera.depth, camera.range, view.pose()))
    }

    fn occupied(&self) -> Vec<Voxel> {
        Map::occupied(self)
    }

    fn rear_side(&self) -> Vec<Voxel> {
        Map::rear_side(self)
    }
}
