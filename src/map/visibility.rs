//! Sight lines: whether occupied voxels hide a voxel from an eye.
//!
//! A line runs from the centre of the voxel to the eye. Unknown and
//! pre-occupied voxels are transparent. The result is that of stepping voxel by
//! voxel, to the last bit; empty space is leapt over.
//!
//! A line that passes exactly through an edge or a corner crosses x before y
//! and y before z, so a voxel that it only touches there can hide its target.

use super::clearance::{Axis, Block, Clearance};
use super::grid::{Grid, Voxel};
use super::walk::each;
use crate::geometry::Point;

/// What can be seen of a space in one state of its map. Shared by threads.
#[derive(Clone, Copy, Debug)]
pub struct Visibility<'a> {
    grid: Grid,
    clearance: &'a Clearance,
}

/// What one eye can see.
#[derive(Clone, Copy, Debug)]
pub struct Sight<'a> {
    grid: Grid,
    clearance: &'a Clearance,
    /// In voxels from the origin of the grid.
    eye: [f64; 3],
    /// Squared, in voxels.
    tolerance: f64,
}

impl<'a> Visibility<'a> {
    pub(super) fn new(grid: Grid, clearance: &'a Clearance) -> Self {
        Self { grid, clearance }
    }

    /// What an eye can see. An occupied voxel whose centre lies within
    /// `tolerance` metres of the centre of a target does not hide it.
    pub fn from(&self, eye: &Point, tolerance: f64) -> Sight<'a> {
        // A billionth, so that a tolerance of two voxels includes the second.
        let reach = (tolerance / self.grid.voxel).max(0.0) + 1e-9;
        Sight {
            grid: self.grid,
            clearance: self.clearance,
            eye: self.grid.in_voxels(eye),
            tolerance: reach * reach,
        }
    }
}

impl Sight<'_> {
    /// Whether no occupied voxel hides a voxel.
    #[inline]
    pub fn sees(&self, voxel: Voxel) -> bool {
        if self.clearance.is_empty() {
            return true;
        }
        let target = self.grid.cell(voxel).map(|c| c as i32);
        Line::entering(self.clearance, target, self.eye).is_none_or(|line| self.is_clear(line))
    }

    fn is_clear(&self, mut line: Line) -> bool {
        loop {
            let word = match self.clearance.block(line.place as usize) {
                Block::Clear(1) => 0,
                Block::Clear(distance) => {
                    if !line.leap(distance) {
                        return true;
                    }
                    continue;
                }
                Block::Occupied(word) => word,
            };
            match line.step_through(word, self.tolerance) {
                Step::Left => {}
                Step::Ended => return true,
                Step::Hidden => return false,
            }
        }
    }
}

/// The time at which a line reaches the eye.
const ONE: u64 = 1 << 62;

/// A line from the centre of a voxel to an eye.
///
/// Axes along which it descends are reversed (cell c is −1 − c there), so that
/// it only ever ascends. The n-th border of axis k is crossed at (2n − 1) ·
/// `half` + k, in whole units, `half` being a multiple of 4: leaps and steps
/// agree exactly, no two times are equal, and a time names its axis.
struct Line {
    axes: [Axis; 3],
    half: [u64; 3],
    /// Borders a unit of time.
    rate: [f64; 3],
    target: [i32; 3],
    /// First cell of the current block.
    corner: [i32; 3],
    /// The current cell in its block, two bits an axis.
    at: u32,
    /// Place of the current block.
    place: i64,
    /// When the next border of each axis is crossed.
    next: [u64; 3],
    /// Turns bits of a block's word that count along reversed axes.
    turned: u32,
    /// When it has left the box of occupied blocks or reached the eye.
    leave: u64,
}

/// How the way through a block ends.
enum Step {
    Left,
    Ended,
    Hidden,
}

/// The crossing of a border, counted from 1.
#[derive(Clone, Copy)]
struct Crossing {
    axis: usize,
    border: i32,
    time: u64,
}

impl Line {
    /// The line at its first cell in the box of occupied blocks; `None` where
    /// it misses the box, or the eye is nowhere.
    #[inline]
    fn entering(clearance: &Clearance, target: [i32; 3], eye: [f64; 3]) -> Option<Self> {
        let along = each(|k| eye[k] - (f64::from(target[k]) + 0.5));
        if !along.iter().all(|d| d.is_finite()) {
            return None;
        }
        let down = each(|k| along[k] < 0.0);
        let target = each(|k| if down[k] { !target[k] } else { target[k] });
        let mut line = Self {
            axes: each(|k| clearance.axis(k, down[k])),
            half: each(|k| (ONE as f64 * 0.5 / along[k].abs()).min(ONE as f64) as u64 & !3),
            rate: each(|k| along[k].abs() * (1.0 / ONE as f64)),
            target,
            corner: [0; 3],
            at: 0,
            place: 0,
            next: [0; 3],
            turned: (0..3).map(|k| u32::from(down[k]) * (3 << (2 * k))).sum(),
            leave: ONE,
        };
        line.enter().then_some(line)
    }

    /// Goes to where the line enters the box; `false` where it misses it.
    #[inline(always)]
    fn enter(&mut self) -> bool {
        let mut entry: Option<Crossing> = None;
        for k in 0..3 {
            let first = self.axes[k].low - self.target[k];
            let beyond = self.axes[k].high - self.target[k];
            if beyond <= 0 {
                return false;
            }
            self.leave = self.leave.min(self.crossing(k, beyond).time);
            if first > 0 && entry.is_none_or(|e| self.crossing(k, first).time > e.time) {
                entry = Some(self.crossing(k, first));
            }
        }
        match entry {
            None => self.stand_in(self.target),
            Some(entry) if entry.time < self.leave => self.jump(entry),
            Some(_) => return false,
        }
        true
    }

    #[inline(always)]
    fn crossing(&self, axis: usize, border: i32) -> Crossing {
        let halves = 2 * border as u64 - 1;
        Crossing {
            axis,
            border,
            time: self.half[axis].saturating_mul(halves) | axis as u64,
        }
    }

    /// Leaves the cube of blocks nearer than `distance` to the current one;
    /// `false` where the line ends in it.
    #[inline(always)]
    fn leap(&mut self, distance: i32) -> bool {
        let [x, y, z] = each(|k| self.crossing(k, self.corner[k] + 4 * distance - self.target[k]));
        let nearer = if y.time < x.time { y } else { x };
        let exit = if z.time < nearer.time { z } else { nearer };
        if exit.time < self.leave {
            self.jump(exit);
        }
        exit.time < self.leave
    }

    /// Goes to a crossing ahead.
    #[inline(always)]
    fn jump(&mut self, to: Crossing) {
        let mut cell = each(|k| self.target[k] + self.borders_by(k, to.time));
        cell[to.axis] = self.target[to.axis] + to.border;
        self.stand_in(cell);
    }

    #[inline(always)]
    fn stand_in(&mut self, cell: [i32; 3]) {
        let [x, y, z] = each(|k| (cell[k] & 3) << (2 * k));
        self.at = (x | y | z) as u32;
        self.corner = each(|k| cell[k] & !3);
        self.next = each(|k| self.crossing(k, cell[k] - self.target[k] + 1).time);
        let [x, y, z] = each(|k| self.axes[k].place(cell[k]));
        self.place = x + y + z;
    }

    /// Borders of an axis crossed by a time, from an estimate that is right or
    /// one too low.
    #[inline(always)]
    fn borders_by(&self, k: usize, time: u64) -> i32 {
        let n = (time as i64 as f64 * self.rate[k] + (0.5 - 1e-3)) as i32;
        n + i32::from(self.crossing(k, n + 1).time <= time)
    }

    /// Steps through the current block, to the next one.
    #[inline(always)]
    fn step_through(&mut self, word: u64, tolerance: f64) -> Step {
        loop {
            if word >> (self.at ^ self.turned) & 1 == 1 && self.distance_squared() > tolerance {
                return Step::Hidden;
            }
            let time = self.next[0].min(self.next[1]).min(self.next[2]);
            if time >= self.leave {
                return Step::Ended;
            }
            // Without branches on the axis: which is next cannot be foretold.
            self.next = each(|k| self.next[k] + if self.next[k] == time { 2 * self.half[k] } else { 0 });
            let axis = (time & 3) as usize;
            let last = 3 << (2 * axis);
            if self.at & last == last {
                self.at ^= last;
                self.corner[axis] += 4;
                self.place += self.axes[axis].stride;
                return Step::Left;
            }
            self.at += 1 << (2 * axis);
        }
    }

    /// From the centre of the target to that of the current voxel, in voxels.
    fn distance_squared(&self) -> f64 {
        let along = |k: usize| f64::from(self.corner[k] + (self.at >> (2 * k) & 3) as i32 - self.target[k]);
        (0..3).map(|k| along(k) * along(k)).sum()
    }
}
