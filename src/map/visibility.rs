//! Sight lines: whether occupied voxels hide a voxel from an eye, and what a ray
//! meets first.
//!
//! A sight line runs from the centre of the voxel to the eye. Unknown and
//! pre-occupied voxels are transparent.

use super::clearance::Clearance;
use super::grid::{Grid, Voxel};
use super::line::Line;
use super::rays::{Ray, Tracks};
use super::walk::each;
use crate::geometry::Point;

/// What can be seen of a space in one state of its map. Shared by threads.
#[derive(Clone, Copy, Debug)]
pub struct Visibility<'a> {
    grid: Grid,
    tracks: Tracks,
    clearance: &'a Clearance,
}

/// What one eye can see.
#[derive(Clone, Copy, Debug)]
pub struct Sight<'a> {
    grid: Grid,
    clearance: &'a Clearance,
    /// In voxels from the origin of the grid.
    eye: [f64; 3],
}

impl<'a> Visibility<'a> {
    pub(super) fn new(grid: Grid, clearance: &'a Clearance) -> Self {
        Self {
            grid,
            tracks: Tracks::of(&grid),
            clearance,
        }
    }

    /// What an eye can see.
    pub fn from(&self, eye: &Point) -> Sight<'a> {
        Sight {
            grid: self.grid,
            clearance: self.clearance,
            eye: self.grid.in_voxels(eye),
        }
    }

    /// The first occupied voxel on a ray, at most where it leaves the grid.
    #[inline]
    pub fn first_hit(&self, ray: &Ray) -> Option<Voxel> {
        let (from, along) = self.tracks.segment(ray)?;
        let cell = self.tracks.cell(from).map(|c| c as i32);
        let mut line = Line::entering(self.clearance, cell, from, along)?;
        if line.is_clear(self.clearance, -1.0) {
            return None;
        }
        self.grid.at(line.cell().map(i64::from))
    }
}

impl Sight<'_> {
    /// Whether no occupied voxel hides a voxel. One whose centre lies within
    /// `tolerance` metres of the centre of the voxel does not.
    #[inline]
    pub fn sees(&self, voxel: Voxel, tolerance: f64) -> bool {
        let cell = self.grid.cell(voxel).map(|c| c as i32);
        let centre = cell.map(|c| f64::from(c) + 0.5);
        let along = each(|k| self.eye[k] - centre[k]);
        // A billionth, so that a tolerance of two voxels includes the second.
        let reach = (tolerance / self.grid.voxel).max(0.0) + 1e-9;
        let line = Line::entering(self.clearance, cell, centre, along);
        line.is_none_or(|mut line| line.is_clear(self.clearance, reach * reach))
    }
}
