//! A frame traced through the grid by rays: what OctoMap's `insertPointCloud`
//! does with `discretize`. Every voxel with a point is hit; from the eye to the
//! centre of each goes one ray, which misses the voxels before it.

use rayon::prelude::*;

use super::keys::Keys;
use super::layout::{AXES, Address, Layout, addresses};
use super::marks::{self, Marks, Words};
use super::ray::{Eye, Ray};
use super::table::Table;
use crate::geometry::Point;

/// A frame being traced. Nothing of the map changes but the table's entries,
/// which lead to the marks until these are applied.
pub(super) struct Trace<'a> {
    pub keys: Keys,
    layout: &'a Layout,
    table: &'a Table,
    marks: &'a Marks,
    eye: Eye,
    /// Whether rays go to points outside the grid.
    beyond: bool,
}

impl<'a> Trace<'a> {
    /// A frame seen from an eye; `None` for an eye that is nowhere.
    pub fn from(layout: &'a Layout, table: &'a Table, marks: &'a Marks, eye: &Point, beyond: bool) -> Option<Self> {
        let keys = Keys::of(layout.grid());
        let at = keys.point(eye)?;
        let eye = Eye {
            at,
            cell: keys.cell(at),
        };
        Some(Self {
            keys,
            layout,
            table,
            marks,
            eye,
            beyond,
        })
    }

    /// Address of a cell inside the grid.
    #[inline(always)]
    pub fn address(&self, cell: [i32; 3]) -> Address {
        self.layout.address(cell.map(|c| c as usize))
    }

    /// Marks the voxel of a measured point as hit. A point outside the grid has
    /// its ray at once: no set of such voxels is kept, and marks can repeat.
    #[inline(always)]
    pub fn end(&self, cell: [i32; 3], inside: bool) {
        if inside {
            self.marks.hit(self.table, self.address(cell));
        } else if self.beyond {
            self.ray(cell);
        }
    }

    /// Marks what the rays to all hit voxels miss.
    pub fn rays(&self) {
        (0..self.marks.len()).into_par_iter().with_min_len(8).for_each(|mark| {
            let Some((brick, hits)) = self.marks.hits(mark) else {
                return;
            };
            for at in addresses(brick, &hits) {
                self.ray(self.layout.cell(at).map(|c| c as i32));
            }
        });
    }

    fn ray(&self, end: [i32; 3]) {
        let Some(ray) = Ray::between(&self.keys, &self.eye, end) else {
            return;
        };
        match ray.down {
            0 => self.walk::<0>(&ray),
            1 => self.walk::<1>(&ray),
            2 => self.walk::<2>(&ray),
            3 => self.walk::<3>(&ray),
            4 => self.walk::<4>(&ray),
            5 => self.walk::<5>(&ray),
            6 => self.walk::<6>(&ray),
            _ => self.walk::<7>(&ray),
        };
    }

    /// Marks the voxels of a ray; `None` where it has left the grid. Branches on
    /// the axis: neighbouring rays cross the same borders in the same order, and
    /// are foretold.
    fn walk<const DOWN: u8>(&self, ray: &Ray) -> Option<()> {
        let mut stand = Stand::<DOWN>::at(self, ray.cell)?;
        let ([mut x, mut y, mut z], [dx, dy, dz]) = (ray.next, ray.period);
        stand.mark();
        for _ in 0..ray.steps {
            if x < y {
                if x < z {
                    x += dx;
                    stand.step::<0>(self)?;
                } else {
                    z += dz;
                    stand.step::<2>(self)?;
                }
            } else if y < z {
                y += dy;
                stand.step::<1>(self)?;
            } else {
                z += dz;
                stand.step::<2>(self)?;
            }
            stand.mark();
        }
        Some(())
    }
}

/// Where a ray stands that descends along the axes of `DOWN`.
struct Stand<'a, const DOWN: u8> {
    /// The voxel's place in its brick: the bits that each axis has in it.
    local: [u32; 3],
    words: &'a Words,
    brick: usize,
    /// Bricks ahead along each axis.
    ahead: [u32; 3],
}

impl<'a, const DOWN: u8> Stand<'a, DOWN> {
    #[inline(always)]
    fn at(trace: &Trace<'a>, cell: [i32; 3]) -> Option<Self> {
        let at = trace.address(cell);
        let ahead = |k: usize| {
            let (brick, bricks) = (cell[k] as u32 / 8, trace.layout.bricks[k] as u32);
            if DOWN >> k & 1 == 1 { brick } else { bricks - 1 - brick }
        };
        Some(Self {
            local: AXES.map(|axis| axis & at.local() as u32),
            words: trace.marks.misses(trace.table, at.brick())?,
            brick: at.brick(),
            ahead: [ahead(0), ahead(1), ahead(2)],
        })
    }

    #[inline(always)]
    fn mark(&self) {
        marks::mark(self.words, self.local[0] | self.local[1] | self.local[2]);
    }

    /// Crosses a border of axis `K`; `None` where it leads out of the grid.
    ///
    /// Counting in the axis's bits alone: the others are ones to carry through
    /// when ascending, and zeros to borrow from when descending.
    #[inline(always)]
    fn step<const K: usize>(&mut self, trace: &Trace<'a>) -> Option<()> {
        let (down, axis, one) = (DOWN >> K & 1 == 1, AXES[K], 1 << (2 * K));
        let at = self.local[K];
        let counted = if down {
            at.wrapping_sub(one)
        } else {
            at.wrapping_add(!axis).wrapping_add(one)
        };
        self.local[K] = counted & axis;
        let first = if down { axis } else { 0 };
        if self.local[K] == first {
            self.next_brick::<K>(trace)
        } else {
            Some(())
        }
    }

    #[inline(always)]
    fn next_brick<const K: usize>(&mut self, trace: &Trace<'a>) -> Option<()> {
        self.ahead[K] = self.ahead[K].checked_sub(1)?;
        let stride = trace.layout.strides[K];
        self.brick = if DOWN >> K & 1 == 1 {
            self.brick - stride
        } else {
            self.brick + stride
        };
        self.words = trace.marks.misses(trace.table, self.brick)?;
        Some(())
    }
}
