//! The model space: voxels of four states, tags, insertion and ray walks.
//!
//! A bounded grid cut into bricks of 8³ voxels that are made when something
//! first happens in them. A measurement is traced into bits and then applied in
//! one pass, so no voxel changes twice a frame and no set of keys is kept. The
//! map knows nothing of features or rules; the planner calls it.

mod brick;
mod bricks;
mod clearance;
mod frame;
mod grid;
mod layout;
mod log_odds;
pub mod octomap;
mod points;
mod rear_side;
mod tags;
mod visibility;
mod walk;

pub use grid::{Grid, Voxel};
pub use octomap::{OctoMap, write_bt, write_ot};
pub use tags::Tag;
pub use visibility::{Sight, Visibility};

use std::sync::OnceLock;

use rayon::prelude::*;

use crate::geometry::Point;
use crate::rules::{SensorModel, Space};
use crate::sense::Observation;
use brick::Brick;
use bricks::Bricks;
use clearance::Clearance;
use frame::Frame;
use layout::{Bits, Layout, addresses};
use log_odds::LogOdds;
use tags::Tags;

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

/// The map of a bounded space. Two maps are equal where every voxel has the
/// same log-odds, tags, first point and far faces.
#[derive(Clone, Debug)]
pub struct Map {
    grid: Grid,
    layout: Layout,
    model: LogOdds,
    bricks: Bricks,
    tags: Tags,
    /// Distances for sight lines, made on first use after a measurement.
    clearance: OnceLock<Clearance>,
}

/// The space has more voxels than a map can hold.
#[derive(Debug, thiserror::Error)]
#[error("a space of {0} voxels does not fit; use a larger voxel or a smaller space")]
pub struct TooLarge(pub f64);

impl Map {
    /// An unknown space.
    ///
    /// # Errors
    /// More voxels than a `u32` numbers, or more than 65,536 along an axis.
    pub fn new(space: &Space, model: SensorModel) -> Result<Self, TooLarge> {
        let voxels = space.size.map(|extent| extent / space.voxel).product();
        let grid = Grid::covering(space).ok_or(TooLarge(voxels))?;
        let layout = Layout::new(grid);
        Ok(Self {
            bricks: Bricks::new(layout.len()),
            grid,
            layout,
            model: LogOdds::quantised(&model),
            tags: Tags::default(),
            clearance: OnceLock::new(),
        })
    }

    /// The voxel grid.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Inserts a measurement: rays from the eye through every reading. Returns
    /// the number of measured points inside the space.
    ///
    /// Every voxel that a ray passes before its end is missed, the one it ends
    /// in is hit, each once a frame and hits first. A reading beyond the space
    /// only misses; a pixel without one does nothing.
    pub fn insert(&mut self, observation: &Observation) -> usize {
        let frame = Frame::trace(&self.grid, &self.layout, observation);
        self.bricks.make_all(|brick| frame.touches(brick));
        let eye = observation.eye();
        for reading in &frame.readings {
            let centre = self.grid.centre(self.layout.voxel(reading.address));
            let far = rear_side::far_faces(&eye, &centre);
            let brick = self.bricks.make(reading.address.brick());
            brick.hit(reading, far);
        }
        let model = self.model;
        self.bricks
            .par_iter_mut()
            .for_each(|brick| brick.apply(frame.passed(brick.index), &model));
        self.clearance = OnceLock::new();
        frame.readings.len()
    }

    /// State of a voxel by measurement alone.
    pub fn occupancy(&self, voxel: Voxel) -> Occupancy {
        match self.layout.address_of(voxel) {
            Some(at) if self.bricks.test(at, |b| &b.occupied) => Occupancy::Occupied,
            Some(at) if self.bricks.test(at, |b| &b.known) => Occupancy::Free,
            _ => Occupancy::Unknown,
        }
    }

    /// P(occupied) of a voxel; `None` where it was never measured.
    pub fn probability(&self, voxel: Voxel) -> Option<f64> {
        let at = self.layout.address_of(voxel)?;
        let log_odds = self.bricks.get(at.brick())?.log_odds(at)?;
        Some(self.model.probability(log_odds))
    }

    /// Whether some measured point lies within `radius` metres of `p` (PC_t of
    /// eq. 3). Of each voxel the first point of every octant is remembered, so
    /// more points count than [`Map::points`] lists.
    pub fn measured_within(&self, p: &Point, radius: f64) -> bool {
        let reach = crate::geometry::Vector::repeat(radius);
        let (low, high) = (self.block_of(&(p - reach)), self.block_of(&(p + reach)));
        let near = |q: &Point| nalgebra::distance_squared(p, q) <= radius * radius;
        let [xs, ys, zs] = [0, 1, 2].map(|k| low[k]..=high[k]);
        zs.into_iter().any(|z| {
            let row = |y| xs.clone().any(|x| self.points_of_block([x, y, z]).iter().any(near));
            ys.clone().any(row)
        })
    }

    /// Measured points, one a voxel (the first measured), in voxel order.
    pub fn points(&self) -> Vec<Point> {
        let of_brick = |b: &'_ Brick| {
            let surface = b.surface.as_deref().into_iter();
            let base = b.index * layout::VOXELS;
            let points = surface.flat_map(move |s| s.points.firsts().map(move |(i, p)| (layout::Address(base + i), p)));
            points.map(|(at, p)| (self.layout.voxel(at), p)).collect::<Vec<_>>()
        };
        let mut points: Vec<_> = self.bricks.iter().flat_map(of_brick).collect();
        points.sort_unstable_by_key(|p| p.0);
        points.into_iter().map(|p| p.1).collect()
    }

    /// Tags voxels (eq. 6). Replaces what the tag named before. Only voxels
    /// that are unknown show as pre-occupied. Numbers outside the grid are
    /// passed over.
    pub fn tag(&mut self, tag: Tag, voxels: Vec<Voxel>) {
        self.untag(tag);
        let voxels = voxels.into_iter().filter_map(|v| self.layout.address_of(v)).collect();
        for (index, bits) in self.tags.set(tag, voxels) {
            let brick = self.bricks.make(*index);
            or_into(&mut brick.tagged, bits);
        }
    }

    /// Drops a tag.
    pub fn untag(&mut self, tag: Tag) {
        for index in self.tags.drop(tag) {
            self.bricks.make(index).tagged = self.tags.of_brick(index);
        }
    }

    /// Whether a voxel is unknown and tagged.
    pub fn is_preoccupied(&self, voxel: Voxel) -> bool {
        let at = self.layout.address_of(voxel);
        at.is_some_and(|at| self.bricks.test(at, |b| &b.tagged) && !self.bricks.test(at, |b| &b.known))
    }

    /// The tags of a voxel, ascending.
    pub fn tags(&self, voxel: Voxel) -> Vec<Tag> {
        let at = self.layout.address_of(voxel);
        at.map_or_else(Vec::new, |at| self.tags.of_voxel(at))
    }

    /// Occupied voxels, ascending.
    pub fn occupied(&self) -> Vec<Voxel> {
        self.voxels_where(|b| b.occupied)
    }

    /// Free and occupied voxels, ascending.
    pub fn measured(&self) -> Vec<Voxel> {
        self.voxels_where(|b| b.known)
    }

    /// Pre-occupied voxels, ascending.
    pub fn preoccupied(&self) -> Vec<Voxel> {
        self.voxels_where(preoccupied)
    }

    /// Rear-side voxels, ascending: unknown, face-adjacent to an occupied voxel
    /// on its far side as seen from a view that measured it.
    pub fn rear_side(&self) -> Vec<Voxel> {
        rear_side::rear_side(self)
    }

    /// Whether no occupied voxel hides `voxel` from `eye`. An occupied voxel
    /// whose centre lies within `tolerance` metres of the centre of `voxel`
    /// does not hide it. Many questions of one eye: [`Map::visibility`].
    pub fn visible(&self, eye: &Point, voxel: Voxel, tolerance: f64) -> bool {
        self.visibility().from(eye, tolerance).sees(voxel)
    }

    /// What can be seen of the space as it is now.
    pub fn visibility(&self) -> Visibility<'_> {
        let clearance = self.clearance.get_or_init(|| Clearance::of(&self.layout, &self.bricks));
        Visibility::new(self.grid, clearance)
    }

    /// Voxels by state.
    pub fn counts(&self) -> Counts {
        let total = |bits: fn(&Brick) -> Bits| self.bricks.iter().map(|b| count(&bits(b))).sum::<u64>();
        let (known, occupied) = (total(|b| b.known), total(|b| b.occupied));
        let preoccupied = total(preoccupied);
        Counts {
            unknown: u64::from(self.grid.len()) - known - preoccupied,
            free: known - occupied,
            occupied,
            preoccupied,
        }
    }

    fn voxels_where(&self, bits: impl Fn(&Brick) -> Bits) -> Vec<Voxel> {
        let mut voxels = Vec::new();
        for brick in self.bricks.iter() {
            voxels.extend(addresses(brick.index, &bits(brick)).map(|at| self.layout.voxel(at)));
        }
        voxels.sort_unstable();
        voxels
    }

    /// Coordinates of the block of 4³ voxels that holds a point, or the
    /// nearest one of the grid.
    fn block_of(&self, p: &Point) -> [usize; 3] {
        let cells = self.grid.in_voxels(p);
        [0, 1, 2].map(|k| cells[k].clamp(0.0, f64::from(self.grid.size[k]) - 1.0) as usize / 4)
    }

    fn points_of_block(&self, block: [usize; 3]) -> &[Point] {
        let at = self.layout.address(block.map(|b| b * 4));
        let surface = self.bricks.get(at.brick()).and_then(|b| b.surface.as_deref());
        surface.map_or(&[], |s| s.points.of_word(at.word()))
    }
}

impl PartialEq for Map {
    fn eq(&self, other: &Self) -> bool {
        self.grid == other.grid && self.model == other.model && self.bricks == other.bricks && self.tags == other.tags
    }
}

fn preoccupied(brick: &Brick) -> Bits {
    std::array::from_fn(|w| brick.tagged[w] & !brick.known[w])
}

fn count(bits: &Bits) -> u64 {
    bits.iter().map(|w| u64::from(w.count_ones())).sum()
}

fn or_into(bits: &mut Bits, more: &Bits) {
    for (word, add) in bits.iter_mut().zip(more) {
        *word |= add;
    }
}
