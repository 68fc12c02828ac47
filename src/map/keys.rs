//! OctoMap's numbering of voxels, with its arithmetic: points are `f32`, a
//! coordinate times 1 / voxel is rounded down to its key, and the centre of a
//! voxel is rounded to `f32` again. So a point that lies within rounding of a
//! border falls on the same side as it does there.

use super::grid::Grid;
use super::readings::{RUN, Run};
use super::walk::each;
use crate::geometry::Point;

/// Integer coordinates beyond this are nowhere.
const FARTHEST: f64 = 2.5e8;

/// The voxels of a grid and beyond, in integer coordinates of the grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Keys {
    /// Key of the first voxel along each axis, counted from the world's origin.
    first: [i32; 3],
    /// Edge of a voxel, metres.
    pub voxel: f64,
    per_voxel: f64,
    /// Voxels along each axis.
    pub size: [i32; 3],
}

impl Keys {
    /// The keys of a grid.
    pub fn of(grid: &Grid) -> Self {
        Self {
            first: each(|k| {
                (grid.origin[k] / grid.voxel)
                    .round()
                    .clamp(-2.0 * FARTHEST, 2.0 * FARTHEST) as i32
            }),
            voxel: grid.voxel,
            per_voxel: 1.0 / grid.voxel,
            size: each(|k| grid.size[k] as i32),
        }
    }

    /// A point in OctoMap's precision; `None` where it is too far to have a key.
    #[inline(always)]
    pub fn point(&self, p: &Point) -> Option<[f32; 3]> {
        let near = |k: usize| (p[k] * self.per_voxel).abs() < FARTHEST;
        (near(0) && near(1) && near(2)).then(|| each(|k| p[k] as f32))
    }

    /// The voxel of a point, which may lie outside the grid.
    #[inline(always)]
    pub fn cell(&self, p: [f32; 3]) -> [i32; 3] {
        each(|k| floor(self.scaled(p[k])).wrapping_sub(self.first[k]))
    }

    /// The voxels of points, and which of these are near enough to have one.
    #[inline(always)]
    pub fn cells(&self, points: &Run) -> ([[i32; RUN]; 3], [bool; RUN]) {
        let (mut cells, mut near) = ([[0; RUN]; 3], [true; RUN]);
        for k in 0..3 {
            let places = cells[k].iter_mut().zip(&mut near);
            for ((cell, near), &x) in places.zip(&points[k]) {
                *near &= (x * self.per_voxel).abs() < FARTHEST;
                *cell = floor(self.scaled(x as f32)).wrapping_sub(self.first[k]);
            }
        }
        (cells, near)
    }

    /// The octant of its voxel that a point lies in, 0 to 7.
    #[inline(always)]
    pub fn octant(&self, p: &Point) -> u8 {
        let upper = |k: usize| {
            let x = self.scaled(p[k] as f32);
            u8::from(x - f64::from(floor(x)) >= 0.5) << k
        };
        upper(0) | upper(1) | upper(2)
    }

    /// Whether a voxel is one of the grid's.
    #[inline(always)]
    pub fn has(&self, cell: [i32; 3]) -> bool {
        let within = |k: usize| cell[k].cast_unsigned() < self.size[k].cast_unsigned();
        within(0) && within(1) && within(2)
    }

    /// Middle of a voxel along an axis, metres.
    #[inline(always)]
    pub fn middle(&self, k: usize, cell: i32) -> f64 {
        (f64::from(cell + self.first[k]) + 0.5) * self.voxel
    }

    #[inline(always)]
    fn scaled(&self, coordinate: f32) -> f64 {
        self.per_voxel * f64::from(coordinate)
    }
}

/// The floor of a number that an `i32` holds; `f64::floor` is a call where the
/// processor has no instruction for it. Adding 1.5 · 2⁵² leaves the nearest whole
/// number in the lowest bits.
#[inline(always)]
fn floor(x: f64) -> i32 {
    const SHIFT: f64 = 6_755_399_441_055_744.0;
    let shifted = x + SHIFT;
    let nearest = shifted.to_bits() as i32;
    nearest.wrapping_sub(i32::from(shifted - SHIFT > x))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_floor_is_the_floor() {
        let halves = (-9..9).map(|n| f64::from(n) / 2.0);
        let beside = |x: f64| [x.next_down(), x, x.next_up()];
        let far = [-2.5e8, 2.5e8, 1e-300, -1e-300, 123_456_789.999_999];
        for x in halves.chain(far).flat_map(beside) {
            assert_eq!(f64::from(floor(x)), x.floor(), "{x}");
        }
    }
}
