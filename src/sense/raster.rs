//! A watertight z-buffer rasteriser of primary rays.
//!
//! A pixel is covered by a triangle when the ray through its centre meets it.
//! Corners are projected once and rounded to a grid of some 2⁻²⁰ pixels
//! (`screen`); from there on, which pixels a triangle covers is decided in whole
//! numbers, without rounding, and borders count to both sides (`canvas`). So no
//! ray slips between triangles that share an edge or a corner. Triangles that
//! reach behind the eye are clipped by edges (`clip`). Both faces are drawn.
//!
//! What a pixel looks like is found afterwards, for the triangles that show
//! (`facet`, `colour`). Parts of the mesh are drawn side by side and merged in
//! order, so the result does not depend on the number of threads.

mod canvas;
mod clip;
mod colour;
mod facet;
mod screen;

pub(super) use colour::{Backdrop, shade};
pub(super) use facet::Facets;

use canvas::Canvas;
use clip::clip;
use rayon::prelude::*;
use screen::{Corner, Screen};

use crate::geometry::{Intrinsics, Pose, Vector};
use crate::sense::Mesh;

/// Fewest triangles that are worth a canvas of their own.
const PART: usize = 16_384;
/// Triangles sorted out at a time; their numbers stay in the nearest cache.
const BATCH: usize = 1_024;

/// What every pixel of an image shows.
pub(super) struct Visibility<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) image: Intrinsics,
    camera_from_world: Pose,
    /// 1 / z-depth; 0 where nothing is hit.
    inverse: Vec<f32>,
    /// Index in the mesh; `NOTHING` where nothing is hit.
    triangles: Vec<u32>,
}

const NOTHING: u32 = u32::MAX;

impl<'a> Visibility<'a> {
    /// Draws a world mesh as seen by a camera.
    pub(super) fn of(mesh: &'a Mesh, image: &Intrinsics, world_from_camera: &Pose) -> Self {
        let camera_from_world = world_from_camera.inverse();
        let drawn = Drawing::of(mesh, Screen::new(image, &camera_from_world)).canvas();
        Self {
            mesh,
            image: *image,
            camera_from_world,
            inverse: drawn.inverse,
            triangles: drawn.triangles,
        }
    }

    /// z-depths, metres; 0 where nothing is hit.
    pub(super) fn depths(&self) -> Vec<f32> {
        let depth = |&inverse: &f32| if inverse > 0.0 { 1.0 / inverse } else { 0.0 };
        self.inverse.iter().map(depth).collect()
    }

    /// z-depth of pixel `k`, metres; `None` where nothing is hit.
    pub(super) fn depth(&self, k: usize) -> Option<f32> {
        (self.triangles[k] != NOTHING).then(|| 1.0 / self.inverse[k])
    }

    /// The triangles that show, in camera axes.
    pub(super) fn facets(&self) -> Facets {
        Facets::of(self)
    }

    /// The ray of pixel `k`, z = 1.
    pub(super) fn ray(&self, k: usize) -> Vector {
        let width = self.image.width as usize;
        self.image.ray((k % width) as f64 + 0.5, (k / width) as f64 + 0.5)
    }
}

/// A mesh on a screen.
struct Drawing<'a> {
    mesh: &'a Mesh,
    screen: Screen,
    corners: Vec<Corner>,
}

impl<'a> Drawing<'a> {
    fn of(mesh: &'a Mesh, screen: Screen) -> Self {
        let corners = mesh.vertices.par_iter().with_min_len(BATCH).map(|p| screen.corner(p));
        Self {
            corners: corners.collect(),
            mesh,
            screen,
        }
    }

    fn canvas(&self) -> Canvas {
        let most = self.mesh.triangles.len().div_ceil(rayon::current_num_threads());
        let drawn = self.mesh.triangles.par_chunks(most.max(PART)).enumerate().map(|(k, part)| {
            let mut canvas = Canvas::new(&self.screen);
            self.draw(k * most.max(PART), part, &mut canvas);
            canvas
        });
        let parts = drawn.collect::<Vec<_>>().into_iter();
        let merged = parts.reduce(|mut all, part| {
            all.merge(&part);
            all
        });
        merged.unwrap_or_else(|| Canvas::new(&self.screen))
    }

    /// Draws consecutive triangles, of which `first` is the first. Most triangles
    /// of a fine mesh lie between pixel centres; they are sorted out before, so
    /// that the processor need not guess which.
    fn draw(&self, first: usize, triangles: &[[u32; 3]], canvas: &mut Canvas) {
        let mut kept = [0; BATCH];
        for (batch, triangles) in triangles.chunks(BATCH).enumerate() {
            let mut count = 0;
            for (k, triangle) in triangles.iter().enumerate() {
                kept[count] = k as u32;
                count += usize::from(self.may_show(triangle, canvas));
            }
            for &k in &kept[..count] {
                let index = first + batch * BATCH + k as usize;
                self.draw_one(index as u32, &triangles[k as usize], canvas);
            }
        }
    }

    #[inline]
    fn corners(&self, triangle: &[u32; 3]) -> [&Corner; 3] {
        triangle.map(|i| &self.corners[i as usize])
    }

    #[inline]
    fn may_show(&self, triangle: &[u32; 3], canvas: &Canvas) -> bool {
        let corners = self.corners(triangle);
        let [a, b, c] = corners.map(|corner| corner.outside);
        let beside = a & b & c != 0;
        let cut = a | b | c != 0;
        !beside & (cut | canvas.may_show(corners))
    }

    #[inline]
    fn draw_one(&self, index: u32, triangle: &[u32; 3], canvas: &mut Canvas) {
        let corners = self.corners(triangle);
        if corners.iter().all(|corner| corner.outside == 0) {
            canvas.draw(index, corners);
        } else {
            self.draw_clipped(index, triangle, canvas);
        }
    }

    #[cold]
    fn draw_clipped(&self, index: u32, triangle: &[u32; 3], canvas: &mut Canvas) {
        let polygon = clip(triangle.map(|i| self.screen.homogeneous(&self.mesh.vertices[i as usize])));
        let corners: Vec<Corner> = polygon.into_iter().map(Corner::clipped).collect();
        for k in 2..corners.len() {
            let fan = [&corners[0], &corners[k - 1], &corners[k]];
            if canvas.may_show(fan) {
                canvas.draw(index, fan);
            }
        }
    }
}

#[cfg(test)]
mod tests;
