//! A candidate view and which samples it shows.
//!
//! Most of the time goes to samples that no view shows. Whole tiles of pixels
//! are passed over by their range of depths; the answer is that of testing
//! every pixel near the sample.

use std::ops::Range;

use super::samples::Sample;
use crate::geometry::{Camera, Point, Pose};
use crate::sense::Simulator;
use crate::sense::raster::{Facets, Visibility};

/// Pixels along the edge of a tile.
const TILE: usize = 4;

/// A candidate view and what it shows.
pub(super) struct View<'a> {
    drawn: Visibility<'a>,
    facets: Facets,
    camera: &'a Camera,
    world_from_camera: Pose,
    /// Nearest and farthest depth in each tile, by rows of tiles; an empty
    /// range where a tile shows no front face.
    tiles: Vec<(f64, f64)>,
}

impl<'a> View<'a> {
    pub(super) fn of(simulator: &'a Simulator, camera: &'a Camera, world_from_camera: &Pose) -> Self {
        let drawn = simulator.visibility(camera, world_from_camera);
        let facets = drawn.facets();
        Self {
            tiles: tiles(&drawn, &facets, camera),
            drawn,
            facets,
            camera,
            world_from_camera: *world_from_camera,
        }
    }

    /// Whether the sample faces the view, and a pixel reads within `near` of it
    /// on a triangle that faces the same side.
    pub(super) fn shows(&self, sample: &Sample, near: f64) -> bool {
        let eye = Point::from(self.world_from_camera.translation.vector);
        if (eye - sample.at).dot(&sample.normal) <= 0.0 {
            return false;
        }
        let at = self.world_from_camera.inverse_transform_point(&sample.at);
        let image = &self.camera.depth;
        if at.z <= near {
            return false;
        }
        let (u, v) = (image.fx * at.x / at.z + image.cx, image.fy * at.y / at.z + image.cy);
        let (du, dv) = (image.fx * near / (at.z - near), image.fy * near / (at.z - near));
        let (columns, rows) = (window(u, du, image.width), window(v, dv, image.height));
        parts(&rows).any(|rows| {
            parts(&columns).any(|columns| {
                self.reads_about(columns.start, rows.start, at.z, near)
                    && rows
                        .clone()
                        .any(|v| columns.clone().any(|u| self.pixel_shows(u, v, &at, sample, near)))
            })
        })
    }

    /// Whether the tile of a pixel may hold a depth within `near` of another.
    fn reads_about(&self, u: usize, v: usize, depth: f64, near: f64) -> bool {
        let across = (self.camera.depth.width as usize).div_ceil(TILE);
        let (nearest, farthest) = self.tiles[v / TILE * across + u / TILE];
        // A nanometre, for rounding.
        let reach = near + 1e-9;
        nearest - reach <= depth && depth <= farthest + reach
    }

    /// Whether a pixel reads within `near` of a sample at `at` in camera axes.
    fn pixel_shows(&self, u: usize, v: usize, at: &Point, sample: &Sample, near: f64) -> bool {
        let k = v * self.camera.depth.width as usize + u;
        let Some(depth) = self.drawn.depth(k).map(f64::from) else {
            return false;
        };
        let ray = self.camera.depth.ray(u as f64 + 0.5, v as f64 + 0.5);
        self.camera.range.contains(depth)
            && (ray * depth - at.coords).norm_squared() <= near * near
            && self.facets.at(k).is_some_and(|facet| {
                let normal = self.drawn.mesh.vector_area(facet.triangle as usize);
                facet.front && normal.dot(&sample.normal) > 0.0
            })
    }
}

/// The range of depths on front faces in each tile of an image.
fn tiles(drawn: &Visibility<'_>, facets: &Facets, camera: &Camera) -> Vec<(f64, f64)> {
    let (width, height) = (camera.depth.width as usize, camera.depth.height as usize);
    let across = width.div_ceil(TILE);
    let mut tiles = vec![(f64::INFINITY, f64::NEG_INFINITY); across * height.div_ceil(TILE)];
    for k in 0..width * height {
        let front = facets.at(k).is_some_and(|facet| facet.front);
        if let Some(depth) = drawn.depth(k).filter(|_| front).map(f64::from) {
            let (nearest, farthest) = &mut tiles[k / width / TILE * across + k % width / TILE];
            *nearest = nearest.min(depth);
            *farthest = farthest.max(depth);
        }
    }
    tiles
}

/// A range of pixels, cut where tiles meet.
fn parts(pixels: &Range<usize>) -> impl Iterator<Item = Range<usize>> + use<> {
    let Range { start, end } = *pixels;
    (start / TILE..end.div_ceil(TILE)).map(move |tile| start.max(tile * TILE)..end.min((tile + 1) * TILE))
}

/// Pixels whose centres lie within `reach` of an image coordinate.
fn window(middle: f64, reach: f64, size: u32) -> Range<usize> {
    let first = (middle - 0.5 - reach).ceil().max(0.0);
    let last = (middle - 0.5 + reach).floor().min(f64::from(size) - 1.0);
    if first <= last {
        first as usize..last as usize + 1
    } else {
        0..0
    }
}
