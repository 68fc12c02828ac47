//! A depth image inserted by projection: a voxel is missed where its centre lies
//! nearer than the reading of the pixel that it falls on.
//!
//! Cubes of voxels are tried against the range of readings in the rectangle that
//! their corners span, from coarse to fine: wholly in front of all, they are
//! missed at once; behind all, or where nothing was read, left alone. So work
//! follows the surface and not the volume. What is decided for a cube is what its
//! voxels one by one would give.
//!
//! Positions are kept as (u·z, v·z, z), linear in the world: one division gives
//! the pixel.

use std::borrow::Cow;

use rayon::prelude::*;

use super::layout::{Bits, Layout, WORDS};
use super::marks::{self, Marks};
use super::pyramid::{Pyramid, Rectangle};
use super::table::Table;
use super::walk::each;
use crate::geometry::Vector;
use crate::sense::Observation;

/// Cubes of this level are shared out to threads; one of level n has 4·2ⁿ voxels
/// an edge.
const TOP: usize = 4;
const BRICK: usize = 1;
/// Rounding of pixels and of relative depths that a whole cube allows for.
const SLACK: f32 = 1e-2;
const DEPTH_SLACK: f32 = 1e-5;
/// Taken from image coordinates: then rounding to the nearest whole number, in
/// [`pixel`], is rounding down. Short of a half, so that no border is a tie.
const HALF: f64 = 0.4999;

/// (u·z, v·z, z), pixels less [`HALF`] and metres.
type Scaled = [f32; 3];

/// Positions of `N` points relative to the centre of what they belong to.
struct Offsets<const N: usize> {
    u: [f32; N],
    v: [f32; N],
    z: [f32; N],
}

/// A depth image in front of the bricks that it changes.
pub(super) struct Projection<'a> {
    layout: &'a Layout,
    table: &'a Table,
    marks: &'a Marks,
    depth: Cow<'a, [f32]>,
    pyramid: Pyramid,
    /// Columns and rows.
    size: [usize; 2],
    /// Scaled position of the grid's corner.
    corner: [f64; 3],
    /// What a voxel along each axis of the world adds to a scaled position.
    axes: [[f64; 3]; 3],
    /// Corners of a cube of each level.
    corners: Vec<Offsets<8>>,
    /// Voxels of a word.
    voxels: Offsets<64>,
}

/// A cube of voxels.
#[derive(Clone, Copy)]
struct Cube {
    first: [usize; 3],
    centre: Scaled,
}

/// Where the corners of eight cubes lie.
struct Spans {
    u: [[f32; 8]; 2],
    v: [[f32; 8]; 2],
    z: [[f32; 8]; 2],
}

/// How a cube lies to the readings.
enum Side {
    /// None of its voxels is missed.
    Beyond,
    /// All are.
    Before,
    /// They have to be tried.
    Across { inside: bool },
}

impl<'a> Projection<'a> {
    /// An observation before a grid.
    pub fn of(layout: &'a Layout, table: &'a Table, marks: &'a Marks, observation: &'a Observation) -> Self {
        let k = &observation.camera.depth;
        let grid = layout.grid();
        let camera_from_world = observation.world_from_camera.rotation.inverse();
        let scaled = |world: Vector| {
            let p = camera_from_world * world;
            [k.fx * p.x + (k.cx - HALF) * p.z, k.fy * p.y + (k.cy - HALF) * p.z, p.z]
        };
        let axes = each(|axis| scaled(Vector::ith(axis, grid.voxel)));
        let width = observation.depth.width as usize;
        let depth = readable(&observation.depth.metres);
        Self {
            pyramid: Pyramid::of(&depth, width),
            size: [width, depth.len() / width.max(1)],
            depth,
            corner: scaled(grid.origin - observation.eye()),
            corners: (0..TOP)
                .map(|level| Offsets::grid(&axes, (4 << level) as f64))
                .collect(),
            voxels: Offsets::grid(&axes, 1.0),
            layout,
            table,
            marks,
            axes,
        }
    }

    /// Marks the missed voxels.
    pub fn carve(&self) {
        let edge = 4 << TOP;
        let cubes = self.layout.bricks.map(|bricks| (bricks * 8).div_ceil(edge));
        (0..cubes.iter().product()).into_par_iter().for_each(|i: usize| {
            let first = [i % cubes[0], i / cubes[0] % cubes[1], i / cubes[0] / cubes[1]].map(|c| c * edge);
            self.descend(&self.cube(first, edge), TOP);
        });
    }

    fn cube(&self, first: [usize; 3], edge: usize) -> Cube {
        let middle = first.map(|c| c as f64 + edge as f64 / 2.0);
        let along = |k: usize| (0..3).map(|axis| middle[axis] * self.axes[axis][k]).sum::<f64>();
        Cube {
            first,
            centre: each(|k| (self.corner[k] + along(k)) as f32),
        }
    }

    /// Marks what is missed of a cube larger than a brick.
    fn descend(&self, cube: &Cube, level: usize) {
        let (spans, half) = (self.spans(cube, level - 1), 2 << level);
        for i in 0..8 {
            let first = each(|k| cube.first[k] + (i >> k & 1) * half);
            if (0..3).any(|k| first[k] >= self.layout.bricks[k] * 8) {
                continue;
            }
            let child = Cube {
                first,
                centre: self.corners[level - 1].beside(cube.centre, i),
            };
            match self.side(&spans, i) {
                Side::Beyond => {}
                Side::Before => self.fill(&child, half),
                Side::Across { .. } if level - 1 > BRICK => self.descend(&child, level - 1),
                Side::Across { .. } => self.brick(&child),
            }
        }
    }

    fn fill(&self, cube: &Cube, edge: usize) {
        let ends = each(|k| (cube.first[k] + edge).min(self.layout.bricks[k] * 8));
        let [xs, ys, zs] = each(|k| (cube.first[k]..ends[k]).step_by(8));
        for z in zs {
            for y in ys.clone() {
                xs.clone().for_each(|x| self.mark([x, y, z], &[u64::MAX; WORDS]));
            }
        }
    }

    fn brick(&self, cube: &Cube) {
        let spans = self.spans(cube, 0);
        let misses = std::array::from_fn(|word| match self.side(&spans, word) {
            Side::Beyond => 0,
            Side::Before => u64::MAX,
            Side::Across { inside: true } => self.word::<true>(self.corners[0].beside(cube.centre, word)),
            Side::Across { inside: false } => self.word::<false>(self.corners[0].beside(cube.centre, word)),
        });
        if misses != [0; WORDS] {
            self.mark(cube.first, &misses);
        }
    }

    fn mark(&self, first: [usize; 3], misses: &Bits) {
        let [x, y, z] = first.map(|c| c / 8);
        let [dx, dy, dz] = self.layout.strides;
        if let Some(words) = self.marks.misses(self.table, x * dx + y * dy + z * dz) {
            marks::mark_all(words, misses);
        }
    }

    /// Where the eight parts of a cube lie that are of a level.
    #[inline(always)]
    fn spans(&self, cube: &Cube, level: usize) -> Spans {
        let (at, [u, v, z]) = (&self.corners[level], cube.centre);
        let mut spans = Spans {
            u: [[f32::INFINITY; 8], [f32::NEG_INFINITY; 8]],
            v: [[f32::INFINITY; 8], [f32::NEG_INFINITY; 8]],
            z: [[f32::INFINITY; 8], [f32::NEG_INFINITY; 8]],
        };
        for corner in 0..8 {
            let (du, dv, dz) = (at.u[corner], at.v[corner], at.z[corner]);
            for i in 0..8 {
                let depth = z + at.z[i] + dz;
                let inverse = 1.0 / depth;
                widen(&mut spans.u, i, (u + at.u[i] + du) * inverse);
                widen(&mut spans.v, i, (v + at.v[i] + dv) * inverse);
                widen(&mut spans.z, i, depth);
            }
        }
        spans
    }

    #[inline(always)]
    fn side(&self, spans: &Spans, i: usize) -> Side {
        let [near, far] = spans.z.map(|z| z[i]);
        if far <= 0.0 {
            return Side::Beyond;
        }
        if near <= SLACK * far {
            return Side::Across { inside: false };
        }
        let half = HALF as f32;
        let [left, right] = [spans.u[0][i] + half - SLACK, spans.u[1][i] + half + SLACK];
        let [top, bottom] = [spans.v[0][i] + half - SLACK, spans.v[1][i] + half + SLACK];
        let [width, height] = self.size.map(|n| n as f32);
        if !(right >= 0.0 && bottom >= 0.0 && left < width && top < height) {
            return Side::Beyond;
        }
        let inside = left >= 0.0 && top >= 0.0 && right < width && bottom < height;
        // From floats at least 0 to whole numbers that are in the image.
        let ends = |low: f32, high: f32, n: usize| [(low.max(0.0) as usize).min(n - 1), (high as usize).min(n - 1)];
        let [least, most] = self.pyramid.range(&Rectangle {
            u: ends(left, right, self.size[0]),
            v: ends(top, bottom, self.size[1]),
        });
        if near * (1.0 - DEPTH_SLACK) > most {
            Side::Beyond
        } else if inside && far * (1.0 + DEPTH_SLACK) < least {
            Side::Before
        } else {
            Side::Across { inside }
        }
    }

    /// Missed voxels of a word, one by one; all fall on the image where it is `INSIDE`.
    fn word<const INSIDE: bool>(&self, [u, v, z]: Scaled) -> u64 {
        let (mut pixels, mut depths) = ([0_u32; 64], [0.0_f32; 64]);
        let (at, width) = (&self.voxels, self.size[0] as u32);
        for i in 0..64 {
            let depth = z + at.z[i];
            let inverse = 1.0 / depth;
            let column = pixel((u + at.u[i]) * inverse);
            let row = pixel((v + at.v[i]) * inverse);
            let seen = INSIDE || (column < width && row < self.size[1] as u32 && depth > 0.0);
            pixels[i] = row.wrapping_mul(width).wrapping_add(column);
            depths[i] = if seen { depth } else { f32::INFINITY };
        }
        let mut missed = 0;
        for i in 0..64 {
            let read = self.depth.get(pixels[i] as usize).copied().unwrap_or(0.0);
            missed |= u64::from(depths[i] < read) << i;
        }
        missed
    }
}

impl<const N: usize> Offsets<N> {
    /// A cube of `N` points, x fastest, so many voxels apart.
    fn grid(axes: &[[f64; 3]; 3], apart: f64) -> Self {
        let side = (N as f64).cbrt().round() as usize;
        let position = |i: usize, k: usize| {
            let cell = [i % side, i / side % side, i / side / side];
            let from_middle = |axis: usize| (cell[axis] as f64 - (side as f64 - 1.0) / 2.0) * apart;
            (0..3).map(|axis| from_middle(axis) * axes[axis][k]).sum::<f64>() as f32
        };
        let [u, v, z] = each(|k| std::array::from_fn(|i| position(i, k)));
        Self { u, v, z }
    }

    #[inline(always)]
    fn beside(&self, centre: Scaled, i: usize) -> Scaled {
        [centre[0] + self.u[i], centre[1] + self.v[i], centre[2] + self.z[i]]
    }
}

#[inline(always)]
fn widen(span: &mut [[f32; 8]; 2], i: usize, value: f32) {
    span[0][i] = if value < span[0][i] { value } else { span[0][i] };
    span[1][i] = if value > span[1][i] { value } else { span[1][i] };
}

/// The nearest whole number, of one that lies within 2²²: adding 1.5 · 2²³ leaves it in
/// the mantissa. A large number for any other and for a negative one. (`as` is
/// several instructions.)
#[inline(always)]
fn pixel(coordinate: f32) -> u32 {
    (coordinate + 12_582_912.0).to_bits().wrapping_sub(0x4b40_0000)
}

/// A depth image in which a pixel without a reading is 0.
fn readable(metres: &[f32]) -> Cow<'_, [f32]> {
    let odd = metres.iter().fold(false, |any, z| any | !z.is_finite());
    if !odd {
        return Cow::Borrowed(metres);
    }
    let readings = metres.iter().map(|&z| if z.is_finite() { z } else { 0.0 });
    Cow::Owned(readings.collect())
}
