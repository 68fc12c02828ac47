//! A candidate view and which samples it shows.
//!
//! Most of the time goes to samples that no view shows. Whole tiles of pixels
//! are passed over, large ones and then small ones: by their range of depths,
//! and by their side where all of one shows one triangle. The answer is that of
//! testing every pixel near the sample.

use std::ops::Range;

use super::samples::Sample;
use crate::geometry::{Camera, Point, Pose};
use crate::sense::Simulator;
use crate::sense::raster::{Facets, Visibility};

/// Pixels along the edge of tiles, large and small.
const EDGES: [usize; 2] = [16, SMALL];
const SMALL: usize = 4;

/// A candidate view and what it shows.
pub(super) struct View<'a> {
    drawn: Visibility<'a>,
    facets: Facets,
    camera: &'a Camera,
    world_from_camera: Pose,
    /// By size of their edges, each by rows.
    tiles: [Vec<Tile>; 2],
}

/// The front faces that a square of pixels shows.
#[derive(Clone, Copy)]
struct Tile {
    /// An empty range where it shows none.
    nearest: f64,
    farthest: f64,
    shows: Shows,
}

#[derive(Clone, Copy, PartialEq)]
enum Shows {
    Nothing,
    Triangle(u32),
    Several,
}

/// A place that a view may show.
struct Sought<'a> {
    sample: &'a Sample,
    /// In camera axes.
    at: Point,
    near: f64,
}

impl<'a> View<'a> {
    pub(super) fn of(simulator: &'a Simulator, camera: &'a Camera, world_from_camera: &Pose) -> Self {
        let drawn = simulator.visibility(camera, world_from_camera);
        let facets = drawn.facets();
        let small = small_tiles(&drawn, &facets);
        Self {
            tiles: [large_tiles(&small, camera), small],
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
        self.any_shows(0, &columns, &rows, &Sought { sample, at, near })
    }

    /// Whether a pixel of a window does, tile by tile of a size and all smaller ones.
    fn any_shows(&self, size: usize, columns: &Range<usize>, rows: &Range<usize>, sought: &Sought) -> bool {
        let Some(&edge) = EDGES.get(size) else {
            let mut pixels = rows.clone().flat_map(|v| columns.clone().map(move |u| (u, v)));
            return pixels.any(|(u, v)| self.pixel_shows(u, v, sought));
        };
        let across = (self.camera.depth.width as usize).div_ceil(edge);
        parts(rows, edge).any(|rows| {
            parts(columns, edge).any(|columns| {
                let tile = &self.tiles[size][rows.start / edge * across + columns.start / edge];
                self.tile_may_show(tile, sought) && self.any_shows(size + 1, &columns, &rows, sought)
            })
        })
    }

    fn tile_may_show(&self, tile: &Tile, sought: &Sought) -> bool {
        // A nanometre, for rounding.
        let reach = sought.near + 1e-9;
        tile.nearest - reach <= sought.at.z
            && sought.at.z <= tile.farthest + reach
            && match tile.shows {
                Shows::Nothing => false,
                Shows::Triangle(triangle) => self.same_side(triangle, sought.sample),
                Shows::Several => true,
            }
    }

    fn same_side(&self, triangle: u32, sample: &Sample) -> bool {
        self.drawn.mesh.vector_area(triangle as usize).dot(&sample.normal) > 0.0
    }

    /// Whether a pixel reads near a place, on a front face of the same side.
    fn pixel_shows(&self, u: usize, v: usize, sought: &Sought) -> bool {
        let k = v * self.camera.depth.width as usize + u;
        let Some(depth) = self.drawn.depth(k).map(f64::from) else {
            return false;
        };
        let ray = self.camera.depth.ray(u as f64 + 0.5, v as f64 + 0.5);
        self.camera.range.contains(depth)
            && (ray * depth - sought.at.coords).norm_squared() <= sought.near * sought.near
            && self
                .facets
                .at(k)
                .is_some_and(|facet| facet.front && self.same_side(facet.triangle, sought.sample))
    }
}

fn small_tiles(drawn: &Visibility, facets: &Facets) -> Vec<Tile> {
    let [width, height] = [drawn.image.width, drawn.image.height].map(|size| size as usize);
    let mut tiles = Vec::with_capacity(width.div_ceil(SMALL) * height.div_ceil(SMALL));
    for rows in parts(&(0..height), SMALL) {
        for columns in parts(&(0..width), SMALL) {
            let mut tile = Tile::EMPTY;
            for k in rows.clone().flat_map(|v| columns.clone().map(move |u| v * width + u)) {
                let front = facets.at(k).filter(|facet| facet.front);
                if let (Some(facet), Some(depth)) = (front, drawn.depth(k).map(f64::from)) {
                    tile.add(depth, depth, Shows::Triangle(facet.triangle));
                }
            }
            tiles.push(tile);
        }
    }
    tiles
}

fn large_tiles(small: &[Tile], camera: &Camera) -> Vec<Tile> {
    let [width, height] = [camera.depth.width, camera.depth.height].map(|size| size as usize);
    let [across, many] = [SMALL, EDGES[0]].map(|edge| width.div_ceil(edge));
    let mut tiles = vec![Tile::EMPTY; many * height.div_ceil(EDGES[0])];
    for (k, tile) in small.iter().enumerate() {
        let [u, v] = [k % across, k / across].map(|at| at * SMALL / EDGES[0]);
        tiles[v * many + u].add(tile.nearest, tile.farthest, tile.shows);
    }
    tiles
}

impl Tile {
    const EMPTY: Self = Self {
        nearest: f64::INFINITY,
        farthest: f64::NEG_INFINITY,
        shows: Shows::Nothing,
    };

    fn add(&mut self, nearest: f64, farthest: f64, shows: Shows) {
        self.nearest = self.nearest.min(nearest);
        self.farthest = self.farthest.max(farthest);
        self.shows = match (self.shows, shows) {
            (Shows::Nothing, other) | (other, Shows::Nothing) => other,
            (one, other) if one == other => one,
            _ => Shows::Several,
        };
    }
}

/// A range of pixels, cut where tiles of an edge meet.
fn parts(pixels: &Range<usize>, edge: usize) -> impl Iterator<Item = Range<usize>> + use<> {
    let Range { start, end } = *pixels;
    (start / edge..end.div_ceil(edge)).map(move |tile| start.max(tile * edge)..end.min((tile + 1) * edge))
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
