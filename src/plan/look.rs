//! What a view sees of a world, in the task's kind of visibility.

use std::sync::OnceLock;

use super::viewpoint::Viewpoint;
use super::world::World;
use crate::map::{CentreView, Grid, Voxel, VoxelSet};
use crate::rules::Visibility;

/// A view on a world as it is now. By centres, what is occupied is drawn when something
/// is first asked, once a look.
pub struct Look<'a, W: ?Sized> {
    world: &'a W,
    view: &'a Viewpoint,
    visibility: Visibility,
    centres: OnceLock<Option<CentreView>>,
}

/// Voxels to be counted in many looks.
#[derive(Clone, Debug)]
pub struct Targets {
    voxels: Vec<Voxel>,
    set: VoxelSet,
}

impl Targets {
    /// Some voxels of a world.
    pub fn of<W: World + ?Sized>(world: &W, voxels: Vec<Voxel>) -> Self {
        Self {
            set: VoxelSet::of(world.grid(), &voxels),
            voxels,
        }
    }
}

impl<'a, W: World + ?Sized> Look<'a, W> {
    /// What a view sees.
    pub fn of(world: &'a W, view: &'a Viewpoint, visibility: Visibility) -> Self {
        Self {
            world,
            view,
            visibility,
            centres: OnceLock::new(),
        }
    }

    /// The world.
    pub fn world(&self) -> &'a W {
        self.world
    }

    /// The grid of the world.
    pub fn grid(&self) -> &Grid {
        self.world.grid()
    }

    /// The view.
    pub fn view(&self) -> &'a Viewpoint {
        self.view
    }

    /// Whether nothing hides a voxel but what lies within `tolerance` metres of it.
    #[inline]
    pub fn sees(&self, voxel: Voxel, tolerance: f64) -> bool {
        match self.centres() {
            Some(centres) => centres.sees(voxel, tolerance),
            None => self.world.visible(self.view.eye(), voxel, tolerance),
        }
    }

    /// Number of voxels inside the depth image and range that nothing hides.
    pub fn count(&self, targets: &Targets) -> usize {
        match self.centres() {
            Some(centres) => centres.count(&targets.set) as usize,
            None => self.count_within(targets, 0.0),
        }
    }

    /// The same, where what lies within `tolerance` metres of a voxel does not hide it.
    pub fn count_within(&self, targets: &Targets, tolerance: f64) -> usize {
        let grid = self.world.grid();
        let reached = |v: &&Voxel| self.view.measures(&grid.centre(**v)) && self.sees(**v, tolerance);
        targets.voxels.iter().filter(reached).count()
    }

    fn centres(&self) -> Option<&CentreView> {
        match self.visibility {
            Visibility::Exact => None,
            Visibility::Centre => self.centres.get_or_init(|| self.world.centre_view(self.view)).as_ref(),
        }
    }
}
