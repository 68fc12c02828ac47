//! Voxel-centre visibility: occupied voxels are drawn into a depth image of a view,
//! and a voxel is hidden where something nearer was drawn at its centre.
//!
//! Coarser than sight lines and much faster: cost follows the surface, whatever the
//! image. An occupied voxel is drawn as a square of half a face's diagonal to every
//! side, in all pixels that it touches, so that no roll of the camera leaves a hole
//! between neighbours; where it errs, it errs towards hidden.

use super::clearance::Clearance;
use super::grid::{Grid, Voxel};
use super::layout::ones;
use super::voxel_set::{Cube, VoxelSet};
use super::walk::each;
use crate::geometry::{DepthRange, Intrinsics, Pose};

/// Most columns of the image: a larger one is drawn smaller.
const MOST_COLUMNS: u32 = 640;
/// Edge of a tile of pixels.
const TILE: usize = 8;
/// What a rounded depth may be off by, relative.
const SLACK: f32 = 1e-5;

/// What a depth camera would see of the occupied voxels.
#[derive(Clone, Debug)]
pub struct CentreView {
    grid: Grid,
    projection: Projection,
    /// z-depth of the nearest centre, metres; infinite where nothing was drawn.
    depth: Vec<f32>,
    /// Nearest and farthest depth of every tile.
    tiles: Vec<(f32, f32)>,
    tiles_across: usize,
}

/// From cells of a grid to an image.
#[derive(Clone, Debug)]
struct Projection {
    /// Camera coordinates of the centre of cell 0, metres.
    base: [f64; 3],
    /// Camera coordinates of a step along each axis of the grid, metres.
    steps: [[f64; 3]; 3],
    /// Camera coordinates of the cells of a block from its first one.
    offsets: Vec<[f32; 3]>,
    focal: [f32; 2],
    principal: [f32; 2],
    width: usize,
    height: usize,
    /// The nearest and the farthest depth.
    range: [f32; 2],
}

/// Pixels from (left, top) to (right, bottom), all inside the image.
struct Pixels {
    left: usize,
    top: usize,
    right: usize,
    bottom: usize,
}

impl CentreView {
    /// Draws the occupied voxels that a clearance was made of.
    pub(super) fn of(
        grid: &Grid,
        clearance: &Clearance,
        image: &Intrinsics,
        range: DepthRange,
        world_from_camera: &Pose,
    ) -> Self {
        let projection = Projection::of(grid, image, range, world_from_camera);
        let tiles_across = projection.width.div_ceil(TILE);
        let mut view = Self {
            grid: *grid,
            depth: vec![f32::INFINITY; projection.width * projection.height],
            tiles: vec![(f32::INFINITY, 0.0); tiles_across * projection.height.div_ceil(TILE)],
            tiles_across,
            projection,
        };
        let half = (grid.voxel * std::f64::consts::FRAC_1_SQRT_2) as f32;
        for (corner, word) in clearance.occupied() {
            let base = view.projection.place(corner);
            for bit in ones(word) {
                view.draw(view.projection.offset(base, bit), half);
            }
        }
        view.gather_tiles();
        view
    }

    /// Whether nothing hides a voxel; what was drawn within `tolerance` metres in
    /// front of it does not. Outside the image nothing is hidden.
    #[inline]
    pub fn sees(&self, voxel: Voxel, tolerance: f64) -> bool {
        let cell = self.grid.cell(voxel).map(|c| c as i32);
        let base = self.projection.place(cell.map(|c| c & !3));
        let bit = (cell[0] & 3) | (cell[1] & 3) << 2 | (cell[2] & 3) << 4;
        let p = self.projection.offset(base, bit as usize);
        let Some(pixel) = self.projection.pixel(p) else {
            return true;
        };
        let behind = p[2] - self.depth[pixel];
        if tolerance <= 0.0 {
            return behind <= 0.0;
        }
        let slant = (1.0 + (p[0] * p[0] + p[1] * p[1]) / (p[2] * p[2])).sqrt();
        behind * slant <= tolerance as f32 * (1.0 + SLACK)
    }

    /// Number of voxels of a set inside the image and the depth range that nothing
    /// hides.
    pub fn count(&self, set: &VoxelSet) -> u64 {
        set.bricks().map(|brick| self.count_cube(&brick)).sum()
    }

    fn count_cube(&self, cube: &Cube<'_>) -> u64 {
        match self.judge(cube) {
            Some(true) => cube.len(),
            Some(false) => 0,
            None => match cube.parts() {
                Ok(parts) => parts.map(|part| self.count_cube(&part)).sum(),
                Err(word) => self.count_word(cube.corner, word),
            },
        }
    }

    fn count_word(&self, corner: [i32; 3], word: u64) -> u64 {
        let base = self.projection.place(corner);
        let seen = |bit: &usize| {
            let p = self.projection.offset(base, *bit);
            let [near, far] = self.projection.range;
            let inside = near <= p[2] && p[2] <= far;
            inside && self.projection.pixel(p).is_some_and(|pixel| p[2] <= self.depth[pixel])
        };
        ones(word).filter(seen).count() as u64
    }

    /// Whether all voxels of a cube are seen, or none; `None` where that is not plain.
    fn judge(&self, cube: &Cube<'_>) -> Option<bool> {
        let bound = self.projection.bound(cube)?;
        let Some(pixels) = bound.pixels else {
            return Some(false);
        };
        let (rows, columns) = (
            pixels.top / TILE..=pixels.bottom / TILE,
            pixels.left / TILE..=pixels.right / TILE,
        );
        let (mut nearest, mut farthest) = (f32::INFINITY, 0.0_f32);
        for row in rows {
            let tiles = &self.tiles[row * self.tiles_across..][columns.clone()];
            for (near, far) in tiles {
                (nearest, farthest) = (nearest.min(*near), farthest.max(*far));
            }
        }
        if bound.near > farthest {
            Some(false)
        } else if bound.whole && bound.far <= nearest {
            Some(true)
        } else {
            None
        }
    }

    /// Draws a voxel with its centre at `p`, camera axes.
    #[inline(always)]
    fn draw(&mut self, p: [f32; 3], half: f32) {
        let Some(square) = self.projection.square(p, half) else {
            return;
        };
        for row in square.top..=square.bottom {
            let start = row * self.projection.width;
            for depth in &mut self.depth[start + square.left..=start + square.right] {
                *depth = depth.min(p[2]);
            }
        }
    }

    fn gather_tiles(&mut self) {
        let rows = self.depth.chunks_exact(self.projection.width).enumerate();
        for (v, row) in rows {
            let tiles = &mut self.tiles[v / TILE * self.tiles_across..][..self.tiles_across];
            for ((near, far), pixels) in tiles.iter_mut().zip(row.chunks(TILE)) {
                *near = pixels.iter().copied().fold(*near, f32::min);
                *far = pixels.iter().copied().fold(*far, f32::max);
            }
        }
    }
}

/// Where a cube's centres lie.
struct Bound {
    near: f32,
    far: f32,
    /// Whether all of them lie inside image and range.
    whole: bool,
    /// `None` where none does.
    pixels: Option<Pixels>,
}

impl Projection {
    fn of(grid: &Grid, image: &Intrinsics, range: DepthRange, world_from_camera: &Pose) -> Self {
        let scale = f64::from(image.width.min(MOST_COLUMNS)) / f64::from(image.width.max(1));
        let camera_from_world = world_from_camera.inverse();
        let first = grid.centre(Voxel(0));
        let base = camera_from_world * first;
        let rotation = camera_from_world.rotation.to_rotation_matrix();
        let steps = each(|axis| each(|k| rotation[(k, axis)] * grid.voxel));
        let offset = |bit: usize| {
            let cells = [bit & 3, bit >> 2 & 3, bit >> 4].map(|c| c as f64);
            each(|k| (0..3).map(|axis| steps[axis][k] * cells[axis]).sum::<f64>() as f32)
        };
        let size = |n: u32| (f64::from(n) * scale).round().max(1.0) as usize;
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
    fn place(&self, cell: [i32; 3]) -> [f32; 3] {
        let cell = cell.map(f64::from);
        each(|k| {
            (self.base[k] + self.steps[0][k] * cell[0] + self.steps[1][k] * cell[1] + self.steps[2][k] * cell[2]) as f32
        })
    }

    #[inline(always)]
    fn offset(&self, base: [f32; 3], bit: usize) -> [f32; 3] {
        let offset = &self.offsets[bit & 63];
        each(|k| base[k] + offset[k])
    }

    /// The pixel of a point; `None` outside the image or behind the camera.
    #[inline(always)]
    fn pixel(&self, p: [f32; 3]) -> Option<usize> {
        let scale = 1.0 / p[2];
        let u = p[0] * scale * self.focal[0] + self.principal[0];
        let v = p[1] * scale * self.focal[1] + self.principal[1];
        let inside = p[2] > 0.0 && u >= 0.0 && v >= 0.0 && u < self.width as f32 && v < self.height as f32;
        inside.then(|| v as u32 as usize * self.width + u as u32 as usize)
    }

    /// The pixels that a square across the optical axis touches.
    #[inline(always)]
    fn square(&self, p: [f32; 3], half: f32) -> Option<Pixels> {
        let scale = 1.0 / p[2];
        if !(p[2] > 0.0 && scale.is_finite()) {
            return None;
        }
        let (u, v) = (p[0] * scale * self.focal[0], p[1] * scale * self.focal[1]);
        let (du, dv) = (half * scale * self.focal[0], half * scale * self.focal[1]);
        let (u, v) = (u + self.principal[0], v + self.principal[1]);
        self.clipped([u - du, v - dv], [u + du, v + dv])
    }

    #[inline(always)]
    fn clipped(&self, low: [f32; 2], high: [f32; 2]) -> Option<Pixels> {
        let (width, height) = (self.width as f32, self.height as f32);
        let meets = high[0] >= 0.0 && high[1] >= 0.0 && low[0] < width && low[1] < height;
        meets.then(|| Pixels {
            left: low[0].max(0.0) as u32 as usize,
            top: low[1].max(0.0) as u32 as usize,
            right: high[0].min(width - 1.0) as u32 as usize,
            bottom: high[1].min(height - 1.0) as u32 as usize,
        })
    }

    /// Bounds the centres of a cube's voxels; `None` where some may lie beside or
    /// behind the eye.
    fn bound(&self, cube: &Cube<'_>) -> Option<Bound> {
        let first = self.place(cube.corner);
        let reach = cube.size as f32 - 1.0;
        let (mut low, mut high) = (first, first);
        for axis in 0..3 {
            for k in 0..3 {
                let step = self.steps[axis][k] as f32 * reach;
                (low[k], high[k]) = (low[k] + step.min(0.0), high[k] + step.max(0.0));
            }
        }
        let slack = SLACK * (high[2].abs() + high[0].abs().max(low[0].abs()) + high[1].abs().max(low[1].abs()));
        (low, high) = (low.map(|c| c - slack), high.map(|c| c + slack));
        if low[2] <= 0.0 {
            return None;
        }
        let (near, far) = (1.0 / low[2], 1.0 / high[2]);
        let lowest = |k: usize| low[k] * if low[k] < 0.0 { near } else { far } * self.focal[k] + self.principal[k];
        let highest = |k: usize| high[k] * if high[k] > 0.0 { near } else { far } * self.focal[k] + self.principal[k];
        let (from, to) = ([lowest(0), lowest(1)], [highest(0), highest(1)]);
        let inside = from[0] >= 0.0 && from[1] >= 0.0 && to[0] < self.width as f32 && to[1] < self.height as f32;
        let out = high[2] < self.range[0] || low[2] > self.range[1];
        Some(Bound {
            near: low[2],
            far: high[2],
            whole: inside && low[2] >= self.range[0] && high[2] <= self.range[1],
            pixels: if out { None } else { self.clipped(from, to) },
        })
    }
}
