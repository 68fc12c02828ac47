//! The planning grid: the states of all voxels of the space, a byte each, for rays.
//!
//! Made anew from the bricks for every decision. A voxel's place is its number, so a
//! ray needs one index; what was never measured nor tagged is 0 and takes no memory
//! until something is written beside it.

use rayon::prelude::*;

use super::bricks::Bricks;
use super::grid::{Grid, Voxel};
use super::layout::{Bits, Layout};
use super::log_odds::LogOdds;
use super::rays::{Ray, Tracks};
use super::tags::Tags;

const KNOWN: u8 = 1;
const OCCUPIED: u8 = 2;
const TAGGED: u8 = 4;
const MARKED: u8 = 8;

/// What a ray meets in a voxel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct State(u8);

impl State {
    /// Never measured, tagged or not.
    #[inline(always)]
    pub fn is_unknown(self) -> bool {
        self.0 & KNOWN == 0
    }

    /// Unknown and tagged by a prediction.
    #[inline(always)]
    pub fn is_preoccupied(self) -> bool {
        self.0 & (KNOWN | TAGGED) == TAGGED
    }

    /// Rays passed and no surface lies in it.
    #[inline(always)]
    pub fn is_free(self) -> bool {
        self.0 & (KNOWN | OCCUPIED) == KNOWN
    }

    /// A surface lies in it.
    #[inline(always)]
    pub fn is_occupied(self) -> bool {
        self.0 & OCCUPIED != 0
    }

    /// Whether it was named by [`PlanningGrid::mark`].
    #[inline(always)]
    pub fn is_marked(self) -> bool {
        self.0 & MARKED != 0
    }
}

/// The states of a space for rays, as they were when it was made.
#[derive(Clone, Debug)]
pub struct PlanningGrid {
    grid: Grid,
    tracks: Tracks,
    states: Vec<u8>,
}

impl PlanningGrid {
    pub(super) fn of(layout: &Layout, bricks: &Bricks, model: &LogOdds, tags: &Tags) -> Self {
        let grid = *layout.grid();
        let mut states = vec![0; grid.len() as usize];
        let [width, depth, _] = grid.size.map(|n| n as usize);
        // Layers of bricks are whole stretches of the states.
        let layers = states.par_chunks_mut(8 * width * depth).enumerate();
        layers.for_each(|(layer, states)| {
            let stride = layout.strides[2];
            for index in layer * stride..(layer + 1) * stride {
                let measured = bricks.states_of(index, model);
                let (known, occupied) = measured.map_or_else(Default::default, |b| (b.known, b.occupied));
                let planes = [(KNOWN, known), (OCCUPIED, occupied), (TAGGED, tags.of_brick(index))];
                if planes.iter().any(|(_, bits)| *bits != Bits::default()) {
                    fill(states, [width, depth], layout.corner(index), &planes);
                }
            }
        });
        Self {
            tracks: Tracks::of(&grid),
            grid,
            states,
        }
    }

    /// The voxel grid.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The state of a voxel; unknown for a number that is none of the grid's.
    #[inline(always)]
    pub fn state(&self, voxel: Voxel) -> State {
        State(self.states.get(voxel.0 as usize).copied().unwrap_or(0))
    }

    /// Marks voxels, for instance the rear-side ones, so that rays can tell them.
    /// Numbers outside the grid are passed over.
    pub fn mark(&mut self, voxels: &[Voxel]) {
        for voxel in voxels {
            if let Some(state) = self.states.get_mut(voxel.0 as usize) {
                *state |= MARKED;
            }
        }
    }

    /// Meets the voxels on a ray in order, until the visitor says `false` or the ray
    /// ends or leaves the grid.
    ///
    /// ```
    /// # use vpl::{geometry::Point, map::{Map, Ray}, rules::{SensorModel, Space}};
    /// # let space = Space { centre: Point::origin(), size: [1.0; 3].into(), voxel: 0.1 };
    /// # let map = Map::new(&space, SensorModel::default()).unwrap();
    /// let grid = map.planning_grid();
    /// let ray = Ray::between(&Point::new(-2.0, 0.05, 0.05), &Point::new(0.0, 0.05, 0.05));
    /// let mut unknown = 0;
    /// grid.walk(&ray, |_, state| {
    ///     unknown += u32::from(state.is_unknown());
    ///     !state.is_occupied()
    /// });
    /// assert_eq!(unknown, 6);
    /// ```
    #[inline(always)]
    pub fn walk(&self, ray: &Ray, mut visit: impl FnMut(Voxel, State) -> bool) {
        let state = |voxel: Voxel| self.states.get(voxel.0 as usize);
        self.walk_numbers(ray, |voxel| {
            state(voxel).is_some_and(|state| visit(voxel, State(*state)))
        });
    }

    /// The same without looking at the states.
    #[inline(always)]
    pub(super) fn walk_numbers(&self, ray: &Ray, visit: impl FnMut(Voxel) -> bool) {
        if let Some(track) = self.tracks.track(ray) {
            track.walk(visit);
        }
    }

    /// The states of all voxels in the order of their numbers.
    pub(super) fn states(&self) -> impl ExactSizeIterator<Item = State> {
        self.states.iter().map(|state| State(*state))
    }
}

/// Writes the states of a brick into its layer.
fn fill(states: &mut [u8], [width, depth]: [usize; 2], [x, y, _]: [usize; 3], planes: &[(u8, Bits)]) {
    let columns = (width - x).min(8);
    for (z, slice) in states.chunks_exact_mut(width * depth).enumerate() {
        for (row, line) in slice[y * width..].chunks_exact_mut(width).take(8).enumerate() {
            let values = planes
                .iter()
                .map(|(flag, bits)| spread(bits, row, z) * u64::from(*flag));
            let bytes = values.sum::<u64>().to_le_bytes();
            line[x..x + columns].copy_from_slice(&bytes[..columns]);
        }
    }
}

/// A row of a brick's bits as bytes of 0 and 1.
#[inline(always)]
fn spread(bits: &Bits, y: usize, z: usize) -> u64 {
    let (word, shift) = ((y / 4) << 1 | (z / 4) << 2, 4 * (y % 4) + 16 * (z % 4));
    let half = |word: u64| ((word >> shift & 0xf) * 0x0020_4081) & 0x0101_0101;
    half(bits[word]) | half(bits[word + 1]) << 32
}
