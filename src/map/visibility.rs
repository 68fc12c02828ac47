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

/// A line from the centre of a voxel, counted in borders crossed along each
/// axis. The n-th border along an axis is crossed at (n − ½) · period; the eye
/// is at time 1.
struct Line {
    target: [i32; 3],
    step: [i32; 3],
    rate: [f64; 3],
    period: [f64; 3],
    crossed: [i32; 3],
    leave: f64,
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
        let rate = along.map(f64::abs);
        if !rate.iter().all(|r| r.is_finite()) {
            return None;
        }
        let mut line = Self {
            target,
            step: along.map(|d| if d < 0.0 { -1 } else { 1 }),
            rate,
            period: rate.map(f64::recip),
            crossed: [0; 3],
            leave: 1.0,
        };
        let (mut enter, mut axis, mut borders) = (0.0, 0, 0);
        for k in 0..3 {
            let (first, beyond) = line.span(k, clearance.low[k], clearance.high[k]);
            if beyond <= 0 {
                return None;
            }
            line.leave = line.leave.min(line.time(k, beyond));
            let time = line.time(k, first);
            if time > enter {
                (enter, axis, borders) = (time, k, first);
            }
        }
        if enter >= line.leave {
            return None;
        }
        if enter > 0.0 {
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

    #[inline(always)]
    fn time(&self, k: usize, border: i32) -> f64 {
        (f64::from(border) - 0.5) * self.period[k]
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
        let (axis, time) = earliest([0, 1, 2].map(|k| self.time(k, exit[k])));
        if time >= self.leave {
            return false;
        }
        self.jump(axis, exit[axis], time);
        true
    }

    /// Goes to where a border of an axis is crossed.
    #[inline(always)]
    fn jump(&mut self, axis: usize, border: i32, time: f64) {
        for k in 0..3 {
            self.crossed[k] = if k == axis {
                border
            } else {
                self.borders_by(k, time, k < axis)
            };
        }
    }

    /// Borders of an axis crossed by a time. The estimate is set right by the
    /// times that stepping compares, so that leaps and steps agree.
    #[inline(always)]
    fn borders_by(&self, k: usize, time: f64, inclusive: bool) -> i32 {
        let n = (time * self.rate[k] + 0.5) as i32;
        let crossed = |t: f64| if inclusive { t <= time } else { t < time };
        if !crossed(self.time(k, n)) {
            n - 1
        } else {
            n + i32::from(crossed(self.time(k, n + 1)))
        }
    }

    /// Steps through a block with occupied voxels.
    #[inline(always)]
    fn cross(&mut self, word: u64, tolerance: f64) -> Crossing {
        let mut cell = self.cell();
        loop {
            let bit = (cell[0] & 3) | (cell[1] & 3) << 2 | (cell[2] & 3) << 4;
            if word >> bit & 1 == 1 && self.distance_squared() > tolerance {
                return Crossing::Hidden;
            }
            let (k, time) = earliest([0, 1, 2].map(|k| self.time(k, self.crossed[k] + 1)));
            if time >= self.leave {
                return Crossing::Ended;
            }
            let before = cell[k];
            self.crossed[k] += 1;
            cell[k] += self.step[k];
            if before >> 2 != cell[k] >> 2 {
                return Crossing::Left;
            }
        }
    }

    /// From the centre of the target to that of the current voxel, in voxels.
    fn distance_squared(&self) -> f64 {
        self.crossed.iter().map(|&n| f64::from(n) * f64::from(n)).sum()
    }
}

#[inline(always)]
fn earliest(times: [f64; 3]) -> (usize, f64) {
    let [x, y, z] = times;
    if x <= y && x <= z {
        (0, x)
    } else if y <= z {
        (1, y)
    } else {
        (2, z)
    }
}
