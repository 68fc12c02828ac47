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

use canvas::{Canvas, Pixel, inverse};
use clip::clip;
use rayon::prelude::*;
use screen::{Cells, Corner, Screen, anywhere, around, common, holds_any};

use crate::geometry::{Intrinsics, Pose, Vector};
use crate::sense::Mesh;

/// Fewest triangles that are worth a canvas of their own.
const PART: usize = 16_384;
/// Triangles sorted out at a time: what is kept of them stays in the nearest cache.
const BATCH: usize = 256;

/// What every pixel of an image shows.
pub(super) struct Visibility<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) image: Intrinsics,
    camera_from_world: Pose,
    pixels: Vec<Pixel>,
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
            pixels: drawn.pixels,
        }
    }

    /// z-depths, metres; 0 where nothing is hit.
    pub(super) fn depths(&self) -> Vec<f32> {
        let depth = |inverse: f32| if inverse > 0.0 { 1.0 / inverse } else { 0.0 };
        self.pixels.iter().map(|p| depth(inverse(*p))).collect()
    }

    /// z-depth of pixel `k`, metres; `None` where nothing is hit.
    pub(super) fn depth(&self, k: usize) -> Option<f32> {
        (self.pixels[k] != 0).then(|| 1.0 / inverse(self.pixels[k]))
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
    /// Of each corner.
    cells: Vec<Cells>,
    image: Cells,
}

/// Triangles by how many pixels they may cover: one, two beside or above one
/// another, four, more or not known, none.
struct Sorted {
    heaps: [[(u32, Cells); BATCH]; 6],
    counts: [usize; 6],
}

const MORE: usize = 4;
const NONE: usize = 5;

impl Default for Sorted {
    fn default() -> Self {
        Self {
            heaps: [[(0, Cells::default()); BATCH]; 6],
            counts: [0; 6],
        }
    }
}

impl Sorted {
    #[inline]
    fn add(&mut self, k: u32, all: Cells, image: &Cells) {
        let cells = common(&all, image);
        let [left, top, right, bottom] = cells;
        let (wide, high) = (-left - right, -top - bottom);
        let few = usize::from(wide > 0.0) + 2 * usize::from(high > 0.0);
        let some = if (wide > 1.0) | (high > 1.0) | anywhere(&all) {
            MORE
        } else {
            few
        };
        let heap = if (wide < 0.0) | (high < 0.0) { NONE } else { some };
        let count = &mut self.counts[heap];
        self.heaps[heap][*count % BATCH] = (k, cells);
        *count += 1;
    }

    #[inline]
    fn take(&mut self, heap: usize, mut each: impl FnMut(u32, &Cells)) {
        for (k, cells) in &self.heaps[heap][..self.counts[heap]] {
            each(*k, cells);
        }
        self.counts[heap] = 0;
    }
}

impl<'a> Drawing<'a> {
    fn of(mesh: &'a Mesh, screen: Screen) -> Self {
        let corner = |p| {
            let corner = screen.corner(p);
            (corner, screen.cells(&corner))
        };
        let (corners, cells) = mesh.vertices.par_iter().with_min_len(BATCH).map(corner).unzip();
        Self {
            mesh,
            corners,
            cells,
            image: screen.image(),
            screen,
        }
    }

    fn canvas(&self) -> Canvas {
        let threads = rayon::current_num_threads();
        let part = self.mesh.triangles.len().div_ceil(threads).max(PART);
        let drawn = self.mesh.triangles.par_chunks(part).enumerate().map(|(k, triangles)| {
            let mut canvas = Canvas::new(&self.screen);
            self.draw(k * part, triangles, &mut canvas);
            canvas
        });
        let merged = drawn.reduce_with(|mut one, other| {
            one.merge(&other);
            one
        });
        merged.unwrap_or_else(|| Canvas::new(&self.screen))
    }

    /// Draws consecutive triangles, of which `first` is the first. They are sorted
    /// before by how many pixels they may cover, most often none, one or two: so
    /// the processor need not guess what to do with the next.
    fn draw(&self, first: usize, triangles: &[[u32; 3]], canvas: &mut Canvas) {
        let mut sorted = Sorted::default();
        for (batch, triangles) in triangles.chunks(BATCH).enumerate() {
            let first = (first + batch * BATCH) as u32;
            for (k, triangle) in (first..).zip(triangles) {
                sorted.add(k, around(triangle.map(|i| &self.cells[i as usize])), &self.image);
            }
            sorted.take(0, |k, cells| self.draw_few::<1, 1>(k, cells, canvas));
            sorted.take(1, |k, cells| self.draw_few::<2, 1>(k, cells, canvas));
            sorted.take(2, |k, cells| self.draw_few::<1, 2>(k, cells, canvas));
            sorted.take(3, |k, cells| self.draw_few::<2, 2>(k, cells, canvas));
            sorted.take(MORE, |k, cells| self.draw_any(k, cells, canvas));
            sorted.take(NONE, |_, _| {});
        }
    }

    #[inline]
    fn corners(&self, k: u32) -> [&Corner; 3] {
        let [a, b, c] = self.mesh.triangles[k as usize];
        [
            &self.corners[a as usize],
            &self.corners[b as usize],
            &self.corners[c as usize],
        ]
    }

    #[inline]
    fn draw_few<const W: usize, const H: usize>(&self, k: u32, cells: &Cells, canvas: &mut Canvas) {
        canvas.draw_few::<W, H>(k, cells, self.corners(k));
    }

    fn draw_any(&self, k: u32, cells: &Cells, canvas: &mut Canvas) {
        let corners = self.corners(k);
        let [a, b, c] = corners.map(|corner| corner.outside);
        if a | b | c == 0 {
            canvas.draw(k, cells, corners);
        } else if a & b & c == 0 {
            self.draw_clipped(k, &self.mesh.triangles[k as usize], canvas);
        }
    }

    fn draw_clipped(&self, index: u32, triangle: &[u32; 3], canvas: &mut Canvas) {
        let polygon = clip(triangle.map(|i| self.screen.homogeneous(&self.mesh.vertices[i as usize])));
        let corners: Vec<Corner> = polygon.into_iter().map(Corner::clipped).collect();
        for k in 2..corners.len() {
            let fan = [&corners[0], &corners[k - 1], &corners[k]];
            let [a, b, c] = fan.map(|corner| self.screen.cells(corner));
            let cells = common(&around([&a, &b, &c]), &self.image);
            if holds_any(cells) {
                canvas.draw(index, &cells, fan);
            }
        }
    }
}

#[cfg(test)]
mod tests;
