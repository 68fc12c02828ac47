//! Counts of voxels on rays: what information gain over an image is made of.

use super::planning::PlanningGrid;
use super::rays::Ray;

/// What some rays met.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCounts {
    /// Voxels met; one met by several rays counts for each.
    pub steps: u64,
    /// Rays that ended in an occupied voxel.
    pub hits: u64,
    /// Unknown voxels before that.
    pub unknown: u64,
}

impl std::ops::Add for RayCounts {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            steps: self.steps + other.steps,
            hits: self.hits + other.hits,
            unknown: self.unknown + other.unknown,
        }
    }
}

impl std::iter::Sum for RayCounts {
    fn sum<I: Iterator<Item = Self>>(counts: I) -> Self {
        counts.fold(Self::default(), std::ops::Add::add)
    }
}

/// Which voxels the rays of one view have met: the number of the last such view,
/// voxel by voxel. Kept from view to view, so that none has to clear it.
#[derive(Clone, Debug)]
pub struct Seen {
    last: Vec<u8>,
    view: u8,
}

impl Seen {
    /// Nothing seen of a planning grid.
    pub fn new(grid: &PlanningGrid) -> Self {
        Self {
            last: vec![0; grid.grid().len() as usize],
            view: 0,
        }
    }

    /// Begins a view.
    fn begin(&mut self) {
        if self.view == u8::MAX {
            self.last.fill(0);
            self.view = 0;
        }
        self.view += 1;
    }
}

impl PlanningGrid {
    /// Unknown voxels that rays meet before an occupied one, once a ray.
    pub fn unknown_on_rays(&self, rays: &[Ray]) -> RayCounts {
        let (mut counts, mut known) = (RayCounts::default(), 0);
        for ray in rays {
            let mut hit = false;
            self.walk(ray, |_, state| {
                counts.steps += 1;
                known += u64::from(!state.is_unknown());
                hit = state.is_occupied();
                !hit
            });
            counts.hits += u64::from(hit);
        }
        counts.unknown = counts.steps - known;
        counts
    }

    /// Unknown voxels that the rays of one view meet before an occupied one, each
    /// once. `seen` was made for this grid and may have served other views.
    pub fn distinct_unknown(&self, rays: &[Ray], seen: &mut Seen) -> RayCounts {
        seen.begin();
        let (view, last) = (seen.view, &mut seen.last[..]);
        let mut counts = RayCounts::default();
        for ray in rays {
            self.walk(ray, |voxel, state| {
                counts.steps += 1;
                if state.is_occupied() {
                    counts.hits += 1;
                    return false;
                }
                if state.is_unknown()
                    && let Some(last) = last.get_mut(voxel.0 as usize)
                {
                    counts.unknown += u64::from(*last != view);
                    *last = view;
                }
                true
            });
        }
        counts
    }
}
