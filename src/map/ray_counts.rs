//! Counts of voxels on rays: what information gain over an image is made of.

use super::planning::{PlanningGrid, State};
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

/// Which voxels the rays of one view have met: of every unknown voxel the number of
/// the last such view. Kept from view to view, so that none has to clear it.
#[derive(Clone, Debug)]
pub struct Seen {
    /// The last view that met a voxel, or [`FREE`] or [`OCCUPIED`].
    last: Vec<u8>,
    view: u8,
}

const FREE: u8 = 254;
const OCCUPIED: u8 = 255;

impl Seen {
    /// Nothing seen of a planning grid as it is now.
    pub fn new(grid: &PlanningGrid) -> Self {
        let last = |state: State| match (state.is_occupied(), state.is_unknown()) {
            (true, _) => OCCUPIED,
            (_, false) => FREE,
            _ => 0,
        };
        Self {
            last: grid.states().map(last).collect(),
            view: 0,
        }
    }

    /// Begins a view.
    fn begin(&mut self) -> u8 {
        if self.view + 1 == FREE {
            let unknown = self.last.iter_mut().filter(|last| **last < FREE);
            unknown.for_each(|last| *last = 0);
            self.view = 0;
        }
        self.view += 1;
        self.view
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
    /// once. `seen` was made of this grid and may have served other views.
    pub fn distinct_unknown(&self, rays: &[Ray], seen: &mut Seen) -> RayCounts {
        let mut counts = RayCounts::default();
        let (view, last) = (seen.begin(), &mut seen.last[..]);
        for ray in rays {
            self.walk_numbers(ray, |voxel| {
                let Some(last) = last.get_mut(voxel.0 as usize) else {
                    return false;
                };
                counts.steps += 1;
                if *last == OCCUPIED {
                    counts.hits += 1;
                    return false;
                }
                if *last != view && *last != FREE {
                    counts.unknown += 1;
                    *last = view;
                }
                true
            });
        }
        counts
    }
}
