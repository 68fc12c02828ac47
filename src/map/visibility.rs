//! Sight lines: whether occupied voxels hide a voxel from an eye.
//!
//! A line runs from the centre of the voxel to the eye. Unknown and
//! pre-occupied voxels are transparent. The result is that of stepping voxel by
//! voxel, to the last bit; empty space is leapt over.
//!
//! A line that passes exactly through an edge or a corner crosses x before y
//! and y before z, so a voxel that it only touches there can hide its target.

use super::clearance::{Block, Clearance};
use super::grid::{Grid, Voxel};
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
            let block = self.clearance.block(line.cell());
            let gone_on = match block {
                Block::Clear(distance) => line.leap(distance),
                Block::Occupied(word) => match line.cross(word, self.tolerance) {
                    Crossing::Hidden => return false,
                    Crossing::Left => true,
                    Crossing::Ended => false,
                },
            };
            if !gone_on {
                return true;
            }
        }
    }
}

/// The time at which a line reaches the eye.
const ONE: u64 = 1 << 62;

/// A line from the centre of a voxel, counted in borders crossed along each
/// axis. The n-th border of an axis is crossed at (2n − 1) · `half`, in whole
/// units, so that leaps and steps agree exactly.
struct Line {
    target: [i32; 3],
    step: [i32; 3],
    half: [u64; 3],
    /// Borders a unit of time.
    rate: [f64; 3],
    crossed: [i32; 3],
    /// When it has left the box of occupied blocks or reached the eye.
    leave: u64,
}

enum Crossing {
    Hidden,
    Left,
    Ended,
}

impl Line {
    /// The line at its first cell in the box of occupied blocks; `None` where
    /// it misses the box, or the eye is nowhere.
    #[inline]
    fn entering(clearance: &Clearance, target: [i32; 3], eye: [f64; 3]) -> Option<Self> {
        let along = [0, 1, 2].map(|k| eye[k] - (f64::from(target[k]) + 0.5));
        if !along.iter().all(|d| d.is_finite()) {
            return None;
        }
        let mut line = Self {
            target,
            step: along.map(|d| if d < 0.0 { -1 } else { 1 }),
            half: along.map(|d| (ONE as f64 * 0.5 / d.abs()).min(ONE as f64) as u64),
            rate: along.map(|d| d.abs() / ONE as f64),
            crossed: [0; 3],
            leave: ONE,
        };
        let (mut enter, mut axis, mut borders) = (0, 0, 0);
        for k in 0..3 {
            let (first, beyond) = line.span(k, clearance.low[k], clearance.high[k]);
            if beyond <= 0 {
                return None;
            }
            line.leave = line.leave.min(line.time(k, beyond));
            if first > 0 && line.time(k, first) > enter {
                (enter, axis, borders) = (line.time(k, first), k, first);
            }
        }
        if enter >= line.leave {
            return None;
        }
        if borders > 0 {
            line.jump(axis, borders, enter);
        }
        Some(line)
    }

    /// Borders crossed on reaching the cells from `low` to before `high`, and
    /// on having left them.
    #[inline(always)]
    fn span(&self, k: usize, low: i32, high: i32) -> (i32, i32) {
        let at = self.target[k];
        if self.step[k] > 0 {
            (low - at, high - at)
        } else {
            (at - high + 1, at - low + 1)
        }
    }

    /// When a border, counted from 1, is crossed.
    #[inline(always)]
    fn time(&self, k: usize, border: i32) -> u64 {
        self.half[k].saturating_mul(2 * border as u64 - 1)
    }

    #[inline(always)]
    fn cell(&self) -> [i32; 3] {
        [0, 1, 2].map(|k| self.target[k] + self.step[k] * self.crossed[k])
    }

    /// Leaves a cube of clear blocks around the current one; `false` where the
    /// line ends in it.
    #[inline(always)]
    fn leap(&mut self, distance: i32) -> bool {
        let cell = self.cell();
        let exit = [0, 1, 2].map(|k| {
            let block = cell[k] >> 2;
            self.span(k, (block - distance + 1) * 4, (block + distance) * 4).1
        });
        let times = [0, 1, 2].map(|k| self.time(k, exit[k]));
        let first = earliest(times);
        let axis = usize::from(first[1]) + 2 * usize::from(first[2]);
        let time = times[0].min(times[1]).min(times[2]);
        if time < self.leave {
            self.jump(axis, exit[axis], time);
        }
        time < self.leave
    }

    /// Goes to where a border of an axis is crossed.
    #[inline(always)]
    fn jump(&mut self, axis: usize, border: i32, time: u64) {
        for k in 0..3 {
            self.crossed[k] = if k == axis {
                border
            } else {
                self.borders_by(k, time, k < axis)
            };
        }
    }

    /// Borders of an axis crossed by a time, itself included or not.
    #[inline(always)]
    fn borders_by(&self, k: usize, time: u64, inclusive: bool) -> i32 {
        let before = time + u64::from(inclusive);
        // The estimate is off by one at most.
        let n = (time as i64 as f64 * self.rate[k] + 0.5) as i32;
        n + i32::from(self.time(k, n + 1) < before) - i32::from(n > 0 && self.time(k, n) >= before)
    }

    /// Steps through a block with occupied voxels.
    #[inline(always)]
    fn cross(&mut self, word: u64, tolerance: f64) -> Crossing {
        let mut at = self.cell().map(|c| c & 3);
        let mut next = [0, 1, 2].map(|k| self.time(k, self.crossed[k] + 1));
        loop {
            let bit = at[0] | at[1] << 2 | at[2] << 4;
            if word >> bit & 1 == 1 && self.distance_squared() > tolerance {
                return Crossing::Hidden;
            }
            if next[0].min(next[1]).min(next[2]) >= self.leave {
                return Crossing::Ended;
            }
            // Without branches: which axis is next cannot be foretold.
            let first = earliest(next);
            for k in 0..3 {
                next[k] += u64::from(first[k]) * 2 * self.half[k];
                self.crossed[k] += i32::from(first[k]);
                at[k] += i32::from(first[k]) * self.step[k];
            }
            if (at[0] | at[1] | at[2]) & !3 != 0 {
                return Crossing::Left;
            }
        }
    }

    /// From the centre of the target to that of the current voxel, in voxels.
    fn distance_squared(&self) -> f64 {
        self.crossed.iter().map(|&n| f64::from(n) * f64::from(n)).sum()
    }
}

/// Which of three times comes first; x before y before z where equal.
#[inline(always)]
fn earliest([x, y, z]: [u64; 3]) -> [bool; 3] {
    let first = (x <= y) & (x <= z);
    let second = !first & (y <= z);
    [first, second, !first & !second]
}
