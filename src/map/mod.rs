//! The model space: voxels of four states, tags, insertion and ray walks.

mod grid;

pub use grid::{Grid, Voxel};

use std::collections::BTreeMap;

use crate::geometry::Point;
use crate::rules::{SensorModel, Space};
use crate::sense::Observation;

/// What the measurements say of a voxel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Occupancy {
    /// Never measured.
    Unknown,
    /// Rays passed.
    Free,
    /// A surface lies in it.
    Occupied,
}

/// Voxels by state; they sum to the size of the grid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Unknown and not pre-occupied.
    pub unknown: u64,
    /// Free.
    pub free: u64,
    /// Occupied.
    pub occupied: u64,
    /// Unknown and tagged by a prediction.
    pub preoccupied: u64,
}

/// The map of a bounded space.
pub struct Map {
    grid: Grid,
    _todo: BTreeMap<u32, Vec<Voxel>>,
}

/// The space has more voxels than a map can hold.
#[derive(Debug, thiserror::Error)]
#[error("a space of {0} voxels does not fit; use a larger voxel or a smaller space")]
pub struct TooLarge(pub f64);

/// Names an instance whose prediction tags voxels; the session hands these out.
pub type Tag = u32;

#[allow(unused_variables)]
impl Map {
    /// An unknown space.
    ///
    /// # Errors
    /// More voxels than a `u32` numbers.
    pub fn new(space: &Space, model: SensorModel) -> Result<Self, TooLarge> {
        todo!()
    }
    /// The voxel grid.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }
    /// Inserts a measurement: rays from the eye through every reading. Returns
    /// the number of measured points inside the space.
    pub fn insert(&mut self, observation: &Observation) -> usize {
        todo!()
    }
    /// State of a voxel by measurement alone.
    pub fn occupancy(&self, voxel: Voxel) -> Occupancy {
        todo!()
    }
    /// Whether some measured point lies within `radius` metres of `p` (PC_t of eq. 3).
    pub fn measured_within(&self, p: &Point, radius: f64) -> bool {
        todo!()
    }
    /// Measured points, one a voxel (the first measured), in voxel order.
    pub fn points(&self) -> Vec<Point> {
        todo!()
    }
    /// Tags voxels (eq. 6). Replaces what the tag named before. Only voxels
    /// that are unknown show as pre-occupied.
    pub fn tag(&mut self, tag: Tag, voxels: Vec<Voxel>) {
        todo!()
    }
    /// Drops a tag.
    pub fn untag(&mut self, tag: Tag) {
        todo!()
    }
    /// Whether a voxel is unknown and tagged.
    pub fn is_preoccupied(&self, voxel: Voxel) -> bool {
        todo!()
    }
    /// The tags of a voxel, ascending.
    pub fn tags(&self, voxel: Voxel) -> Vec<Tag> {
        todo!()
    }
    /// Occupied voxels, ascending.
    pub fn occupied(&self) -> Vec<Voxel> {
        todo!()
    }
    /// Rear-side voxels, ascending: unknown, face-adjacent to an occupied voxel
    /// on its far side as seen from a view that measured it.
    pub fn rear_side(&self) -> Vec<Voxel> {
        todo!()
    }
    /// Whether no occupied voxel hides `voxel` from `eye`. An occupied voxel
    /// whose centre lies within `tolerance` metres of the centre of `voxel`
    /// does not hide it.
    pub fn visible(&self, eye: &Point, voxel: Voxel, tolerance: f64) -> bool {
        todo!()
    }
    /// Voxels by state.
    pub fn counts(&self) -> Counts {
        todo!()
    }
}
