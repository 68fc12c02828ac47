//! From the cells of a grid to the pixels of a view, in single precision.
//!
//! A voxel's centre is projected in one way only, from the first cell of its block of
//! 4³, so that whoever asks for it gets the same bits.

use super::depth_window::Pixels;
use super::grid::{Grid, Voxel};
use super::walk::each;
use crate::geometry::{DepthRange, Intrinsics, Point, Pose};

/// Most pixels along an edge of a voxel in the middle of what is drawn: an image of more
/// is made smaller, for finer ones tell no more of the voxels.
const MOST_PIXELS: f64 = 2.0;
/// What a rounded coordinate may be off by, relative.
pub(super) const SLACK: f32 = 1e-5;

/// From cells of a grid to an image.
#[derive(Clone, Debug)]
pub(super) struct Projection {
    /// Camera coordinates of the centre of cell 0, metres.
    base: [f64; 3],
    /// Camera coordinates of a step along each axis of the grid, metres.
    steps: [[f64; 3]; 3],
    /// Camera coordinates of the cells of a block from its first one.
    offsets: Vec<[f32; 3]>,
    focal: [f32; 2],
    principal: [f32; 2],
    width: f32,
    height: f32,
    /// The nearest and the farthest depth.
    range: [f32; 2],
}

/// Bounds of the centres of a box of cells.
pub(super) struct Bound {
    /// z-depths, metres.
    pub near: f32,
    pub far: f32,
    /// Whether all of them lie inside image and range.
    pub whole: bool,
    /// `None` where none does.
    pub pixels: Option<Pixels>,
}

impl Projection {
    /// An image of a view, small enough for the voxels around `middle`.
    pub fn of(grid: &Grid, middle: &Point, image: &Intrinsics, range: DepthRange, world_from_camera: &Pose) -> Self {
        let camera_from_world = world_from_camera.inverse();
        let pixels = image.fx.max(image.fy) * grid.voxel / (camera_from_world * middle).z.abs();
        let scale = if pixels > MOST_PIXELS {
            MOST_PIXELS / pixels
        } else {
            1.0
        };
        let base = camera_from_world * grid.centre(Voxel(0));
        let rotation = camera_from_world.rotation.to_rotation_matrix();
        let steps = each(|axis| each(|k| rotation[(k, axis)] * grid.voxel));
        let offset = |bit: usize| {
            let cells = [bit & 3, bit >> 2 & 3, bit >> 4].map(|c| c as f64);
            each(|k| (0..3).map(|axis| steps[axis][k] * cells[axis]).sum::<f64>() as f32)
        };
        let size = |n: u32| (f64::from(n) * scale).round().max(1.0) as f32;
        Self {
            base: each(|k| base[k]),
            steps,
            offsets: (0..64).map(offset).collect(),
            focal: [image.fx, image.fy].map(|f| (f * scale) as f32),
            principal: [image.cx, image.cy].map(|c| (c * scale) as f32),
            width: size(image.width),
            height: size(image.height),
            range: [range.min.max(1e-6), range.max].map(|z| z as f32),
        }
    }

    /// Camera coordinates of the centre of a cell.
    #[inline(always)]
    pub fn place(&self, cell: [i32; 3]) -> [f32; 3] {
        let [x, y, z] = cell.map(f64::from);
        each(|k| (self.base[k] + self.steps[0][k] * x + self.steps[1][k] * y + self.steps[2][k] * z) as f32)
    }

    /// Camera coordinates of a cell of the block whose first one is at `base`.
    #[inline(always)]
    pub fn in_block(&self, base: [f32; 3], bit: usize) -> [f32; 3] {
        let offset = &self.offsets[bit & 63];
        each(|k| base[k] + offset[k])
    }

    /// Whether a depth can be read.
    #[inline(always)]
    pub fn reads(&self, depth: f32) -> bool {
        self.range[0] <= depth && depth <= self.range[1]
    }

    /// Column and row of a point; `None` outside the image or behind the camera.
    #[inline(always)]
    pub fn pixel(&self, p: [f32; 3]) -> Option<(usize, usize)> {
        let scale = 1.0 / p[2];
        let u = p[0] * scale * self.focal[0] + self.principal[0];
        let v = p[1] * scale * self.focal[1] + self.principal[1];
        let inside = p[2] > 0.0 && u >= 0.0 && v >= 0.0 && u < self.width && v < self.height;
        inside.then_some((u as u32 as usize, v as u32 as usize))
    }

    /// The pixels that a square across the optical axis touches, less half a pixel to
    /// every side, which touching adds on the average.
    #[inline(always)]
    pub fn square(&self, p: [f32; 3], half: f32) -> Option<Pixels> {
        let scale = 1.0 / p[2];
        if !(p[2] > 0.0 && scale.is_finite()) {
            return None;
        }
        let [u, v] = [0, 1].map(|k| p[k] * scale * self.focal[k] + self.principal[k]);
        let [du, dv] = [0, 1].map(|k| (half * scale * self.focal[k] - 0.5).max(0.0));
        self.clipped([u - du, v - dv], [u + du, v + dv])
    }

    /// Bounds the centres of `sides` cells along each axis, from the first on; `None`
    /// where some may lie beside or behind the eye.
    pub fn bound(&self, first: [i32; 3], sides: [i32; 3]) -> Option<Bound> {
        let first = self.place(first);
        let (mut low, mut high) = (first, first);
        for (along, side) in self.steps.iter().zip(sides) {
            for k in 0..3 {
                let step = (along[k] * f64::from(side - 1)) as f32;
                (low[k], high[k]) = (low[k] + step.min(0.0), high[k] + step.max(0.0));
            }
        }
        let slack = SLACK * (0..3).map(|k| high[k].abs().max(low[k].abs())).sum::<f32>();
        (low, high) = (low.map(|c| c - slack), high.map(|c| c + slack));
        if !(low[2] > 0.0 && high.iter().chain(&low).all(|c| c.is_finite())) {
            return None;
        }
        let (near, far) = (1.0 / low[2], 1.0 / high[2]);
        let from = [0, 1].map(|k| low[k] * if low[k] < 0.0 { near } else { far } * self.focal[k] + self.principal[k]);
        let to = [0, 1].map(|k| high[k] * if high[k] > 0.0 { near } else { far } * self.focal[k] + self.principal[k]);
        let inside = from[0] >= 0.0 && from[1] >= 0.0 && to[0] < self.width && to[1] < self.height;
        let beyond = high[2] < self.range[0] || low[2] > self.range[1];
        Some(Bound {
            near: low[2],
            far: high[2],
            whole: inside && self.reads(low[2]) && self.reads(high[2]),
            pixels: if beyond { None } else { self.clipped(from, to) },
        })
    }

    /// All pixels.
    pub fn image(&self) -> Pixels {
        Pixels {
            left: 0,
            top: 0,
            right: self.width as usize - 1,
            bottom: self.height as usize - 1,
        }
    }

    #[inline(always)]
    fn clipped(&self, low: [f32; 2], high: [f32; 2]) -> Option<Pixels> {
        let meets = high[0] >= 0.0 && high[1] >= 0.0 && low[0] < self.width && low[1] < self.height;
        meets.then(|| Pixels {
            left: low[0].max(0.0) as u32 as usize,
            top: low[1].max(0.0) as u32 as usize,
            right: high[0].min(self.width - 1.0) as u32 as usize,
            bottom: high[1].min(self.height - 1.0) as u32 as usize,
        })
    }
}
