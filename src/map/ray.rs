//! Rays as OctoMap walks them (`computeRayKeys`, after Amanatides and Woo 1987),
//! to the last bit: the same voxels in the same order, ties included.
//!
//! A ray ends at the centre of a voxel, so rounding cannot carry it past: it
//! makes as many steps as the voxels' coordinates differ by. Outside the grid it
//! takes all its steps at once; times are then products where OctoMap sums, which
//! can differ only for a ray within 1e-12 of an edge.

use super::keys::Keys;
use super::walk::each;

/// Where rays of a frame start.
#[derive(Clone, Copy)]
pub(super) struct Eye {
    /// OctoMap's precision, metres.
    pub at: [f32; 3],
    /// The voxel that it is in.
    pub cell: [i32; 3],
}

/// The voxels of the grid that a ray misses.
#[derive(Debug)]
pub(super) struct Ray {
    /// The first of them.
    pub cell: [i32; 3],
    /// The others, one a step.
    pub steps: u32,
    /// Axes that it descends along, one bit each.
    pub down: u8,
    /// Distance at which the next border of each axis is crossed.
    pub next: [f64; 3],
    /// Distance between borders of an axis.
    pub period: [f64; 3],
}

/// A number of borders of an axis, the last of which is crossed at a distance.
#[derive(Clone, Copy)]
struct Crossing {
    axis: usize,
    borders: i32,
    at: f64,
}

impl Ray {
    /// The ray from an eye to a voxel, which it does not miss; `None` where it
    /// misses none of the grid.
    #[inline]
    pub fn between(keys: &Keys, eye: &Eye, end: [i32; 3]) -> Option<Self> {
        if eye.cell == end {
            return None;
        }
        let mut ray = Self::toward(keys, eye, end);
        if !keys.has(eye.cell) && !ray.enter(keys, end) {
            return None;
        }
        ray.steps = match keys.has(end) {
            true => distance(ray.cell, end).checked_sub(1)?,
            false => ray.steps_inside(keys),
        };
        Some(ray)
    }

    fn toward(keys: &Keys, eye: &Eye, end: [i32; 3]) -> Self {
        let along = each(|k| keys.middle(k, end[k]) as f32 - eye.at[k]);
        let length = f64::from(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]).sqrt() as f32;
        let direction = each(|k| along[k] / length);
        let half = |k: usize| f64::from((keys.voxel * 0.5).copysign(f64::from(direction[k])) as f32);
        let border = |k: usize| keys.middle(k, eye.cell[k]) + half(k);
        let moves = each(|k| direction[k] != 0.0);
        Self {
            cell: eye.cell,
            steps: 0,
            down: (0..3).fold(0, |down, k| down | u8::from(direction[k] < 0.0) << k),
            next: each(|k| {
                let crossed = (border(k) - f64::from(eye.at[k])) / f64::from(direction[k]);
                if moves[k] { crossed } else { f64::MAX }
            }),
            period: each(|k| keys.voxel / f64::from(direction[k].abs())),
        }
    }

    /// Goes to the first voxel in the grid; `false` where the ray ends before or
    /// passes the grid by.
    fn enter(&mut self, keys: &Keys, end: [i32; 3]) -> bool {
        let mut last: Option<Crossing> = None;
        for k in 0..3 {
            let borders = match (self.is_down(k), self.cell[k]) {
                (false, cell) if cell < 0 => -cell,
                (true, cell) if cell >= keys.size[k] => cell - keys.size[k] + 1,
                _ => continue,
            };
            let crossing = self.crossing(k, borders);
            if last.is_none_or(|last| crossing.at > last.at) {
                last = Some(crossing);
            }
        }
        let Some(last) = last.filter(|last| last.at < f64::MAX) else {
            return false;
        };
        let borders = each(|k| self.borders_until(k, last));
        if (0..3).any(|k| borders[k] > (end[k] - self.cell[k]).abs()) {
            return false;
        }
        self.cell = each(|k| self.cell[k] + if self.is_down(k) { -borders[k] } else { borders[k] });
        self.next = each(|k| {
            let later = self.next[k] + f64::from(borders[k]) * self.period[k];
            if borders[k] > 0 { later } else { self.next[k] }
        });
        keys.has(self.cell)
    }

    /// Steps from a voxel of the grid to the last one, where the ray goes on.
    fn steps_inside(&self, keys: &Keys) -> u32 {
        let to_leave = |k: usize| {
            if self.is_down(k) {
                self.cell[k] + 1
            } else {
                keys.size[k] - self.cell[k]
            }
        };
        let [x, y, z] = each(|k| self.crossing(k, to_leave(k)));
        let yz = if y.at < z.at { y } else { z };
        let first = if x.at < yz.at { x } else { yz };
        let borders = (0..3).map(|k| self.borders_until(k, first).cast_unsigned());
        borders.sum::<u32>() - 1
    }

    #[inline(always)]
    fn is_down(&self, k: usize) -> bool {
        self.down >> k & 1 == 1
    }

    fn crossing(&self, axis: usize, borders: i32) -> Crossing {
        let at = match self.next[axis] {
            f64::MAX => f64::MAX,
            next => next + f64::from(borders - 1) * self.period[axis],
        };
        Crossing { axis, borders, at }
    }

    /// Borders of an axis crossed up to a crossing, itself included. At equal
    /// distances z comes before y and y before x.
    fn borders_until(&self, k: usize, until: Crossing) -> i32 {
        if k == until.axis {
            return until.borders;
        }
        let before = |at: f64| at < until.at || (at == until.at && k > until.axis);
        if !before(self.next[k]) {
            return 0;
        }
        let n = ((until.at - self.next[k]) / self.period[k]) as i32;
        let n = n.saturating_add(1);
        match (
            before(self.crossing(k, n).at),
            before(self.crossing(k, n.saturating_add(1)).at),
        ) {
            (false, _) => n - 1,
            (_, true) => n + 1,
            _ => n,
        }
    }
}

/// Steps from one voxel to another.
fn distance(from: [i32; 3], to: [i32; 3]) -> u32 {
    (0..3).map(|k| from[k].abs_diff(to[k])).sum()
}
