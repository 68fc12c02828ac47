//! A line that leaps over empty space, to the next occupied voxel.
//!
//! The result is that of stepping voxel by voxel, to the last bit. Through an edge
//! or a corner, x is crossed before y and y before z, so a voxel that the line only
//! touches there can be met.

use super::clearance::{Axis, Block, Clearance};
use super::walk::each;

/// The time at which a line ends.
const ONE: u64 = 1 << 62;

/// A line through a grid, at one of its cells.
///
/// Axes along which it descends are reversed (cell c is −1 − c there), so that
/// it only ever ascends. The n-th border of axis k is crossed at `first[k] +
/// (n − 1) · period[k]` in whole units, which is k modulo 4: leaps and steps
/// agree exactly, no two times are equal, and a time names its axis.
pub(super) struct Line {
    axes: [Axis; 3],
    first: [u64; 3],
    period: [u64; 3],
    /// Borders a unit of time.
    rate: [f64; 3],
    /// Of a cell: from the border behind the start to the start.
    begun: [f64; 3],
    /// The cell it starts in.
    start: [i32; 3],
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
    /// When it has left the box of occupied blocks or ended.
    leave: u64,
}

/// How the way through a block ends.
enum Step {
    Left,
    Ended,
    Met,
}

/// The crossing of a border, counted from 1.
#[derive(Clone, Copy)]
struct Crossing {
    axis: usize,
    border: i32,
    time: u64,
}

impl Line {
    /// The line `along` from a point in a cell, at its first cell in the box of
    /// occupied blocks; `None` where it misses the box or is not finite. All in
    /// voxels.
    #[inline]
    pub fn entering(clearance: &Clearance, cell: [i32; 3], from: [f64; 3], along: [f64; 3]) -> Option<Self> {
        if clearance.is_empty() || !along.iter().all(|d| d.is_finite()) {
            return None;
        }
        let down = each(|k| along[k] < 0.0);
        let begun = each(|k| {
            let above = from[k] - f64::from(cell[k]);
            if down[k] { 1.0 - above } else { above }
        });
        let units = |cells: f64, k: usize| (ONE as f64 * cells / along[k].abs()).min(ONE as f64) as u64 & !3;
        let mut line = Self {
            axes: each(|k| clearance.axis(k, down[k])),
            first: each(|k| units(1.0 - begun[k], k) | k as u64),
            period: each(|k| units(1.0, k)),
            rate: each(|k| along[k].abs() * (1.0 / ONE as f64)),
            begun,
            start: each(|k| if down[k] { !cell[k] } else { cell[k] }),
            corner: [0; 3],
            at: 0,
            place: 0,
            next: [0; 3],
            turned: (0..3).map(|k| u32::from(down[k]) * (3 << (2 * k))).sum(),
            leave: ONE,
        };
        line.enter().then_some(line)
    }

    /// Whether the line ends without meeting an occupied voxel other than those whose
    /// centre lies within the root of `tolerance`, in voxels, of the first one's; if
    /// not, it stands in the one that it met.
    #[inline]
    pub fn is_clear(&mut self, clearance: &Clearance, tolerance: f64) -> bool {
        loop {
            let word = match clearance.block(self.place as usize) {
                Block::Clear(1) => 0,
                Block::Clear(distance) => {
                    if !self.leap(distance) {
                        return true;
                    }
                    continue;
                }
                Block::Occupied(word) => word,
            };
            match self.step_through(word, tolerance) {
                Step::Left => {}
                Step::Ended => return true,
                Step::Met => return false,
            }
        }
    }

    /// The cell it stands in.
    pub fn cell(&self) -> [i32; 3] {
        each(|k| {
            let cell = self.corner[k] + self.along_block(k);
            if self.turned >> (2 * k) & 1 == 1 { !cell } else { cell }
        })
    }

    /// Goes to where the line enters the box; `false` where it misses it.
    #[inline(always)]
    fn enter(&mut self) -> bool {
        let mut entry: Option<Crossing> = None;
        for k in 0..3 {
            let first = self.axes[k].low - self.start[k];
            let beyond = self.axes[k].high - self.start[k];
            if beyond <= 0 {
                return false;
            }
            self.leave = self.leave.min(self.crossing(k, beyond).time);
            if first > 0 && entry.is_none_or(|e| self.crossing(k, first).time > e.time) {
                entry = Some(self.crossing(k, first));
            }
        }
        match entry {
            None => self.stand_in(self.start),
            Some(entry) if entry.time < self.leave => self.jump(entry),
            Some(_) => return false,
        }
        true
    }

    #[inline(always)]
    fn crossing(&self, axis: usize, border: i32) -> Crossing {
        let later = self.period[axis].saturating_mul(border as u64 - 1);
        Crossing {
            axis,
            border,
            time: self.first[axis].saturating_add(later),
        }
    }

    /// Leaves the cube of blocks nearer than `distance` to the current one;
    /// `false` where the line ends in it.
    #[inline(always)]
    fn leap(&mut self, distance: i32) -> bool {
        let [x, y, z] = each(|k| self.crossing(k, self.corner[k] + 4 * distance - self.start[k]));
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
        let mut cell = each(|k| self.start[k] + self.borders_by(k, to.time));
        cell[to.axis] = self.start[to.axis] + to.border;
        self.stand_in(cell);
    }

    #[inline(always)]
    fn stand_in(&mut self, cell: [i32; 3]) {
        let [x, y, z] = each(|k| (cell[k] & 3) << (2 * k));
        self.at = (x | y | z) as u32;
        self.corner = each(|k| cell[k] & !3);
        self.next = each(|k| self.crossing(k, cell[k] - self.start[k] + 1).time);
        let [x, y, z] = each(|k| self.axes[k].place(cell[k]));
        self.place = x + y + z;
    }

    /// Borders of an axis crossed by a time, from an estimate that is right or
    /// one too low.
    #[inline(always)]
    fn borders_by(&self, k: usize, time: u64) -> i32 {
        let n = (time as i64 as f64 * self.rate[k] + (self.begun[k] - 1e-3)) as i32;
        n + i32::from(self.crossing(k, n + 1).time <= time)
    }

    /// Steps through the current block, to the next one.
    #[inline(always)]
    fn step_through(&mut self, word: u64, tolerance: f64) -> Step {
        loop {
            if word >> (self.at ^ self.turned) & 1 == 1 && self.distance_squared() > tolerance {
                return Step::Met;
            }
            let time = self.next[0].min(self.next[1]).min(self.next[2]);
            if time >= self.leave {
                return Step::Ended;
            }
            // Without branches on the axis: which is next cannot be foretold.
            self.next = each(|k| self.next[k] + if self.next[k] == time { self.period[k] } else { 0 });
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

    /// Where the current cell lies in its block.
    #[inline(always)]
    fn along_block(&self, k: usize) -> i32 {
        (self.at >> (2 * k) & 3) as i32
    }

    /// From the centre of the first cell to that of the current one, in voxels.
    fn distance_squared(&self) -> f64 {
        let along = |k: usize| f64::from(self.corner[k] + self.along_block(k) - self.start[k]);
        (0..3).map(|k| along(k) * along(k)).sum()
    }
}
