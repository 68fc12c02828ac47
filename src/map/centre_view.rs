//! Voxel-centre visibility: occupied voxels are drawn into a depth image of a view,
//! and a voxel is hidden where something nearer was drawn at its centre.
//!
//! Coarser than sight lines and faster: cost follows the surface, whatever the image.
//! An occupied voxel is drawn as a square of half a face's diagonal to every side, less
//! half a pixel, in all pixels that it touches: so no roll of the camera leaves a pixel
//! between neighbours. Where it errs, it errs towards hidden.

use super::cell_projection::{Projection, SLACK};
use super::clearance::Clearance;
use super::depth_window::DepthWindow;
use super::grid::{Grid, Voxel};
use super::layout::ones;
use super::voxel_set::{Cube, VoxelSet};
use crate::geometry::{DepthRange, Intrinsics, Point, Pose, Vector};

/// What a depth camera would see of the occupied voxels.
#[derive(Clone, Debug)]
pub struct CentreView {
    grid: Grid,
    projection: Projection,
    drawn: DepthWindow,
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
        let middle = middle(grid, clearance);
        let projection = Projection::of(grid, &middle, image, range, world_from_camera);
        let mut view = Self {
            grid: *grid,
            drawn: window(&projection, clearance),
            projection,
        };
        let half = (grid.voxel * std::f64::consts::FRAC_1_SQRT_2) as f32;
        for (corner, word) in clearance.occupied() {
            let base = view.projection.place(corner);
            for bit in ones(word) {
                let centre = view.projection.in_block(base, bit);
                if let Some(pixels) = view.projection.square(centre, half) {
                    view.drawn.draw(pixels, centre[2]);
                }
            }
        }
        view.drawn.finish();
        view
    }

    /// Whether nothing hides a voxel; what was drawn within `tolerance` metres in
    /// front of it does not. Outside the image nothing is hidden.
    #[inline]
    pub fn sees(&self, voxel: Voxel, tolerance: f64) -> bool {
        let cell = self.grid.cell(voxel).map(|c| c as i32);
        let base = self.projection.place(cell.map(|c| c & !3));
        let bit = (cell[0] & 3) | (cell[1] & 3) << 2 | (cell[2] & 3) << 4;
        let p = self.projection.in_block(base, bit as usize);
        let Some((u, v)) = self.projection.pixel(p) else {
            return true;
        };
        let behind = p[2] - self.drawn.at(u, v);
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

    /// All or none of a cube at once where that is plain, else its parts.
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
        let seen = |bit: usize| {
            let p = self.projection.in_block(base, bit);
            let pixel = self.projection.pixel(p);
            pixel.is_some_and(|(u, v)| p[2] <= self.drawn.at(u, v) && self.projection.reads(p[2]))
        };
        ones(word).map(|bit| u64::from(seen(bit))).sum()
    }

    /// Whether all voxels of a cube are seen, or none; `None` where that is not plain.
    fn judge(&self, cube: &Cube<'_>) -> Option<bool> {
        let bound = self.projection.bound(cube.corner, [cube.size; 3])?;
        let Some(pixels) = bound.pixels else {
            return Some(false);
        };
        let (nearest, farthest) = self.drawn.extremes(pixels);
        if bound.near > farthest {
            Some(false)
        } else if bound.whole && bound.far <= nearest {
            Some(true)
        } else {
            None
        }
    }
}

/// The middle of the box of occupied blocks, metres.
fn middle(grid: &Grid, clearance: &Clearance) -> Point {
    let (first, sides) = clearance.extent();
    let cells = [0, 1, 2].map(|k| f64::from(first[k]) + f64::from(sides[k]) / 2.0);
    grid.origin + Vector::from(cells) * grid.voxel
}

/// The window that all occupied voxels are drawn in.
fn window(projection: &Projection, clearance: &Clearance) -> DepthWindow {
    let (first, sides) = clearance.extent();
    if sides.contains(&0) {
        return DepthWindow::default();
    }
    // A voxel more to every side, for squares reach beyond centres.
    match projection.bound(first.map(|c| c - 1), sides.map(|n| n + 2)) {
        None => DepthWindow::over(projection.image()),
        Some(bound) => bound.pixels.map_or_else(DepthWindow::default, DepthWindow::over),
    }
}
