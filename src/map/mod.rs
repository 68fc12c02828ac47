//! The model space: voxels of four states, tags, insertion and ray walks.
//!
//! A bounded grid cut into bricks of 8³ voxels that are made when something
//! first happens in them. A measurement is traced into bits and then applied in
//! one pass, so no voxel changes twice a frame and no set of keys is kept. The
//! map knows nothing of features or rules; the planner calls it.

mod brick;
mod bricks;
mod cell_projection;
mod centre_view;
mod clearance;
mod depth_window;
mod every_ray;
mod grid;
mod keys;
mod layout;
mod line;
mod log_odds;
mod marks;
pub mod octomap;
mod planning;
mod points;
mod projection;
mod pyramid;
mod ray;
mod ray_counts;
mod rays;
mod readings;
mod rear_side;
mod surface;
mod table;
mod tags;
mod trace;
mod visibility;
mod voxel_set;
mod walk;

pub use centre_view::CentreView;
pub use grid::{Grid, Voxel};
pub use octomap::{OctoMap, write_bt, write_ot};
pub use planning::{PlanningGrid, State};
pub use ray_counts::{RayCounts, Seen};
pub use rays::{Ray, image_rays};
pub use tags::Tag;
pub use visibility::{Sight, Visibility};
pub use voxel_set::VoxelSet;

use std::sync::OnceLock;

use crate::geometry::{DepthRange, Intrinsics, Point, Pose};
use crate::rules::{SensorModel, Space};
use crate::sense::Observation;
use brick::{Brick, is_known};
use bricks::Bricks;
use clearance::Clearance;
use layout::{Bits, Layout, addresses};
use log_odds::LogOdds;
use marks::Marks;
use projection::Projection;
use readings::Readings;
use tags::Tags;
use trace::Trace;

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
    /// Whether points and seen sides of surfaces are kept.
    surfaces: bool,
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
            surfaces: true,
            clearance: OnceLock::new(),
        })
    }

    /// The voxel grid.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The same map, which keeps occupancy alone: no points are remembered and
    /// no sides of surfaces, so that [`Map::points`] and [`Map::rear_side`] are
    /// empty, and a measured voxel takes about a byte.
    #[must_use]
    pub fn of_occupancy_alone(self) -> Self {
        Self {
            surfaces: false,
            ..self
        }
    }

    /// Inserts a measurement by exact rays: that of [`Map::insert_cloud`] with
    /// the points of the depth image. A pixel without a reading does nothing.
    pub fn insert(&mut self, observation: &Observation) -> usize {
        let keep = self.surfaces;
        self.insert_rays(&observation.eye(), |trace| readings::of_image(trace, observation, keep))
    }

    /// Inserts points measured from an eye, world axes. Returns the number of
    /// points inside the space.
    ///
    /// Every voxel that holds a point is hit. A ray goes from the eye to the
    /// centre of each, and misses the voxels before it that are not hit
    /// themselves; each voxel changes once. The sets are those of OctoMap's
    /// `insertPointCloud` with `discretize` (Hornung et al. 2013, version 1.9.7)
    /// clipped to the space. A point beyond the space only misses; one that is not
    /// finite does nothing, and neither does a cloud whose eye is not.
    pub fn insert_cloud(&mut self, eye: &Point, points: &[Point]) -> usize {
        let keep = self.surfaces;
        self.insert_rays(eye, |trace| readings::of_cloud(trace, points, keep))
    }

    /// Inserts a measurement by a ray to every reading: hits are those of
    /// [`Map::insert`], and every voxel that a ray passes before its end is missed.
    /// The sets are those of OctoMap's `insertPointCloud` without `discretize`, and
    /// there are as many rays as readings: for maps that are to be like OctoMap's.
    pub fn insert_every_ray(&mut self, observation: &Observation) -> usize {
        let marks = Marks::new(self.bricks.len());
        let (eye, table) = (observation.eye(), self.bricks.table());
        let trace = Trace::from(&self.layout, table, &marks, &eye, false);
        let readings = trace.map_or_else(Readings::default, |trace| {
            let readings = readings::of_image(&trace, observation, self.surfaces);
            every_ray::miss(&self.layout, table, &marks, observation);
            readings
        });
        self.conclude(marks, &eye, readings)
    }

    /// Inserts a depth image by projection: the voxels that hold points are hit,
    /// and those whose centres lie nearer than the reading of the pixel that they
    /// fall on are missed. Returns the number of points inside the space.
    ///
    /// Hits are those of [`Map::insert`]. Voxels are missed whose centre is seen,
    /// not those that a ray to a reading grazes: slivers along silhouettes stay
    /// unknown, and between rays that are farther apart than voxels none do. Time
    /// follows the surface and not the volume.
    pub fn insert_projected(&mut self, observation: &Observation) -> usize {
        let marks = Marks::new(self.bricks.len());
        let (eye, table) = (observation.eye(), self.bricks.table());
        let trace = Trace::from(&self.layout, table, &marks, &eye, false);
        let readings = trace.map_or_else(Readings::default, |trace| {
            let readings = readings::of_image(&trace, observation, self.surfaces);
            Projection::of(&self.layout, table, &marks, observation).carve();
            readings
        });
        self.conclude(marks, &eye, readings)
    }

    fn insert_rays(&mut self, eye: &Point, read: impl FnOnce(&Trace) -> Readings) -> usize {
        let marks = Marks::new(self.bricks.len());
        let trace = Trace::from(&self.layout, self.bricks.table(), &marks, eye, true);
        let readings = trace.map_or_else(Readings::default, |trace| {
            let readings = read(&trace);
            trace.rays();
            readings
        });
        self.conclude(marks, eye, readings)
    }

    /// Applies the marks of a frame and keeps its readings.
    fn conclude(&mut self, marks: Marks, eye: &Point, readings: Readings) -> usize {
        self.bricks.apply(marks, &self.layout, &self.model);
        for reading in &readings.kept {
            let centre = self.grid.centre(self.layout.voxel(reading.address));
            let far = rear_side::far_faces(eye, &centre);
            if let Some(brick) = self.bricks.get_mut(reading.address.brick()) {
                brick.surface.get_or_insert_default().keep(reading, far);
            }
        }
        self.clearance = OnceLock::new();
        readings.inside
    }

    /// State of a voxel by measurement alone.
    pub fn occupancy(&self, voxel: Voxel) -> Occupancy {
        let at = self.layout.address_of(voxel);
        match at.map(|at| self.bricks.value(at)).filter(|&value| is_known(value)) {
            None => Occupancy::Unknown,
            Some(value) if self.model.is_occupied(value) => Occupancy::Occupied,
            Some(_) => Occupancy::Free,
        }
    }

    /// P(occupied) of a voxel; `None` where it was never measured.
    pub fn probability(&self, voxel: Voxel) -> Option<f64> {
        let value = self.bricks.value(self.layout.address_of(voxel)?);
        is_known(value).then(|| self.model.probability(value))
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
        let voxels = voxels.into_iter().filter_map(|v| self.layout.address_of(v)).collect();
        self.tags.set(tag, voxels);
    }

    /// Drops a tag.
    pub fn untag(&mut self, tag: Tag) {
        self.tags.drop(tag);
    }

    /// Whether a voxel is unknown and tagged.
    pub fn is_preoccupied(&self, voxel: Voxel) -> bool {
        let at = self.layout.address_of(voxel);
        at.is_some_and(|at| self.tags.has(at) && !is_known(self.bricks.value(at)))
    }

    /// The tags of a voxel, ascending.
    pub fn tags(&self, voxel: Voxel) -> Vec<Tag> {
        let at = self.layout.address_of(voxel);
        at.map_or_else(Vec::new, |at| self.tags.of_voxel(at))
    }

    /// Occupied voxels, ascending.
    pub fn occupied(&self) -> Vec<Voxel> {
        let occupied = self.bricks.states(&self.model).map(|b| (b.index, b.occupied));
        self.voxels(occupied)
    }

    /// Free and occupied voxels, ascending.
    pub fn measured(&self) -> Vec<Voxel> {
        let measured = self.bricks.states(&self.model).map(|b| (b.index, b.known));
        self.voxels(measured)
    }

    /// Pre-occupied voxels, ascending.
    pub fn preoccupied(&self) -> Vec<Voxel> {
        self.voxels(self.preoccupied_bits())
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
        self.visibility().from(eye).sees(voxel, tolerance)
    }

    /// What can be seen of the space as it is now.
    pub fn visibility(&self) -> Visibility<'_> {
        Visibility::new(self.grid, self.clearance())
    }

    /// What a depth camera would see of the space as it is now, by the centres of
    /// voxels.
    pub fn centre_view(&self, image: &Intrinsics, range: DepthRange, world_from_camera: &Pose) -> CentreView {
        CentreView::of(&self.grid, self.clearance(), image, range, world_from_camera)
    }

    fn clearance(&self) -> &Clearance {
        self.clearance
            .get_or_init(|| Clearance::of(&self.layout, &self.bricks, &self.model))
    }

    /// Unknown voxels, tagged or not.
    pub fn unknown(&self) -> VoxelSet {
        VoxelSet::of_bricks(
            &self.layout,
            (0..self.bricks.len()).map(|index| (index, self.unknown_bits(index))),
        )
    }

    /// The states of all voxels as they are now, for rays: a byte a voxel.
    pub fn planning_grid(&self) -> PlanningGrid {
        PlanningGrid::of(&self.layout, &self.bricks, &self.model, &self.tags)
    }

    /// Voxels by state.
    pub fn counts(&self) -> Counts {
        let states = self.bricks.states(&self.model);
        let (known, occupied) = states.fold((0, 0), |(known, occupied), b| {
            (known + count(&b.known), occupied + count(&b.occupied))
        });
        let preoccupied = self.preoccupied_bits().map(|b| count(&b.1)).sum::<u64>();
        Counts {
            unknown: u64::from(self.grid.len()) - known - preoccupied,
            free: known - occupied,
            occupied,
            preoccupied,
        }
    }

    /// Bricks that a frame was measured in beside those of one value, and bytes
    /// of the heap that the map takes.
    pub fn memory(&self) -> (usize, usize) {
        self.bricks.memory()
    }

    fn unknown_bits(&self, brick: usize) -> Bits {
        let known = self
            .bricks
            .states_of(brick, &self.model)
            .map_or([0; layout::WORDS], |b| b.known);
        let inside = self.layout.inside(brick);
        std::array::from_fn(|w| inside[w] & !known[w])
    }

    fn preoccupied_bits(&self) -> impl Iterator<Item = (usize, Bits)> {
        self.tags.bricks().map(|(brick, tagged)| {
            let known = self
                .bricks
                .states_of(brick, &self.model)
                .map_or([0; layout::WORDS], |b| b.known);
            (brick, std::array::from_fn(|w| tagged[w] & !known[w]))
        })
    }

    fn voxels(&self, bricks: impl Iterator<Item = (usize, Bits)>) -> Vec<Voxel> {
        let mut voxels = Vec::new();
        for (index, bits) in bricks {
            voxels.extend(addresses(index, &bits).map(|at| self.layout.voxel(at)));
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

fn count(bits: &Bits) -> u64 {
    bits.iter().map(|w| u64::from(w.count_ones())).sum()
}
