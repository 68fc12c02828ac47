//! OctoMap's numbering of voxels, with its arithmetic: points are `f32`, a
//! coordinate times 1 / voxel is rounded down to its key, and the centre of a
//! voxel is rounded to `f32` again. So a point that lies within rounding of a
//! border falls on the same side as it does there.

use super::grid::Grid;
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
        each(|k| floor(self.scaled(p[k])) - self.first[k])
    }

    /// The octant of its voxel that a point lies in, 0 to 7.
    #[inline(always)]
    pub fn octant(&self, p: [f32; 3]) -> u8 {
        let upper = |k: usize| {
            let x = self.scaled(p[k]);
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

/// The floor; `f64::floor` is a call where the processor has no instruction for it.
#[inline(always)]
fn floor(x: f64) -> i32 {
    let toward_zero = x as i32;
    toward_zero - i32::from(f64::from(toward_zero) > x)
}
