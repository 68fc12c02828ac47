//! Space behind measured surfaces: what PC and AF count as occluded.
//!
//! From every visited view a line runs through each occupied voxel that the view
//! measures, and on for 0.3 m. Unmeasured voxels on it are occluded, as many steps
//! behind the surface as the line takes to reach them; of several lines the least
//! counts.

use super::rays::Visit;
use crate::geometry::Point;
use crate::map::Occupancy;
use crate::plan::Viewpoint;
use crate::plan::world::World;

/// How far behind a surface space is occluded, metres.
const REACH: f64 = 0.3;
/// Not occluded.
const NOT: u16 = u16::MAX;

/// The occluded voxels of a space.
pub(super) struct Occluded {
    /// d_max: steps of a voxel's edge in 0.3 m.
    pub most: u16,
    steps: Vec<u16>,
}

impl Occluded {
    /// What the surfaces hide from the visited views.
    pub fn of(world: &dyn World, visited: &[Viewpoint]) -> Self {
        let grid = world.grid();
        let mut occluded = Self {
            most: (REACH / grid.voxel).round().clamp(1.0, f64::from(NOT - 1)) as u16,
            steps: vec![NOT; grid.len() as usize],
        };
        let surface = world.occupied();
        for view in visited {
            for voxel in &surface {
                let centre = grid.centre(*voxel);
                if view.measures(&centre) && world.visible(view.eye(), *voxel, 0.0) {
                    occluded.mark(world, view.eye(), &centre);
                }
            }
        }
        occluded
    }

    fn mark(&mut self, world: &dyn World, eye: &Point, surface: &Point) {
        let end = surface + (surface - eye).normalize() * REACH;
        let behind = world.grid().along(surface, &end).skip(1);
        for (d, voxel) in (1..=self.most).zip(behind) {
            if world.occupancy(voxel) == Occupancy::Unknown {
                let steps = &mut self.steps[voxel.0 as usize];
                *steps = d.min(*steps);
            }
        }
    }

    /// d: how many steps behind a surface an occluded voxel lies; `None` of others.
    pub fn steps_behind(&self, visit: &Visit) -> Option<u16> {
        Some(self.steps[visit.voxel.0 as usize]).filter(|d| *d != NOT)
    }
}
