//! Colour: textures, soft light and supersampled borders.
//!
//! Textured pixels average a grid of lookups over the pixel's area; pixels on
//! a border between different colours average rays against the triangles that
//! their neighbours show. The light is mostly ambient, so white stays bright.

use rayon::prelude::*;

use super::{Facets, NOTHING, Visibility};
use crate::geometry::{Point, Pose, Vector};
use crate::sense::{ColourImage, Paint};

/// Lookups along each axis of a textured pixel.
const TEXTURE_GRID: u32 = 4;
/// Rays along each axis of a border pixel.
const BORDER_GRID: u32 = 3;
/// Share of the light that does not depend on direction.
const AMBIENT: f64 = 0.8;
/// A difference of two neighbours, summed over channels, that makes a border.
const BORDER: i32 = 12;

/// The sphere behind everything, camera axes.
#[derive(Clone, Copy)]
pub(in crate::sense) struct Backdrop {
    pub(in crate::sense) centre: Point,
    pub(in crate::sense) radius: f64,
    pub(in crate::sense) colour: [u8; 3],
}

impl Backdrop {
    /// z-depth along a ray of z = 1 to the inside of the sphere, and the
    /// cosine of incidence there; `None` where the ray misses it.
    pub(in crate::sense) fn hit(&self, ray: &Vector) -> Option<(f64, f64)> {
        let to = self.centre.coords;
        let (squared, along) = (ray.norm_squared(), ray.dot(&to));
        let root = along * along - squared * (to.norm_squared() - self.radius * self.radius);
        if root < 0.0 {
            return None;
        }
        let depth = (along + root.sqrt()) / squared;
        let out = ray * depth - to;
        let cosine = out.dot(ray) / (self.radius * squared.sqrt());
        (depth > 0.0).then_some((depth, cosine.abs().min(1.0)))
    }
}

/// The colour image of what is visible. Without a backdrop, empty air is black.
pub(in crate::sense) fn shade(seen: &Visibility, backdrop: Option<Backdrop>, world_from_camera: &Pose) -> ColourImage {
    let facets = seen.facets();
    let painter = Painter {
        seen,
        air: backdrop.map_or([0; 3], |b| b.colour),
        bright: facets
            .all
            .par_iter()
            .map(|f| light(&f.normal, world_from_camera))
            .collect(),
        facets,
    };
    let (width, height) = (seen.image.width, seen.image.height);
    let mut pixels = vec![painter.air; seen.image.pixels()];
    pixels
        .par_chunks_mut(width as usize)
        .enumerate()
        .for_each(|(v, row)| painter.paint_row(v, row));
    ColourImage { width, height, pixels }
}

/// Brightness of a facet: half-Lambert under one far light (Valve 2004), on
/// the side of the normal, so both faces of a sheet differ.
fn light(normal_in_camera: &Vector, world_from_camera: &Pose) -> f32 {
    let towards = Vector::new(0.36, -0.48, 0.8);
    let normal = world_from_camera * normal_in_camera;
    (AMBIENT + (1.0 - AMBIENT) * (0.5 + 0.5 * normal.dot(&towards))) as f32
}

struct Painter<'a> {
    seen: &'a Visibility<'a>,
    facets: Facets,
    air: [u8; 3],
    bright: Vec<f32>,
}

impl Painter<'_> {
    /// Paints a row that holds air alone: only what lies at or beside the
    /// object differs.
    fn paint_row(&self, v: usize, row: &mut [[u8; 3]]) {
        let (width, height) = (row.len(), self.seen.image.height as usize);
        let rows = v.saturating_sub(1)..(v + 2).min(height);
        let (mut first, mut last) = (width, 0);
        for slots in rows.map(|r| &self.facets.slots[r * width..(r + 1) * width]) {
            if let Some(u) = slots.iter().position(|&s| s != NOTHING) {
                first = first.min(u.saturating_sub(1));
            }
            if let Some(u) = slots.iter().rposition(|&s| s != NOTHING) {
                last = last.max((u + 2).min(width));
            }
        }
        for (u, pixel) in row.iter_mut().enumerate().take(last).skip(first) {
            *pixel = self.pixel(u, v);
        }
    }

    fn pixel(&self, u: usize, v: usize) -> [u8; 3] {
        let width = self.seen.image.width as usize;
        let slot = self.facets.slots[v * width + u];
        let around = self.neighbours(u, v);
        if around.iter().all(|&s| s == slot) {
            return self.plain_pixel(slot, u, v);
        }
        let mut distinct = vec![slot];
        for s in around {
            if !distinct.contains(&s) {
                distinct.push(s);
            }
        }
        if self.is_border(&distinct) {
            self.average(u, v, BORDER_GRID, |ray| self.nearest(&distinct, ray))
        } else {
            self.plain_pixel(slot, u, v)
        }
    }

    /// Slots of the eight pixels around, clamped to the image.
    fn neighbours(&self, u: usize, v: usize) -> [u32; 8] {
        let (width, height) = (self.seen.image.width as usize, self.seen.image.height as usize);
        let (left, right) = (u.saturating_sub(1), (u + 1).min(width - 1));
        let (above, below) = (v.saturating_sub(1) * width, (v + 1).min(height - 1) * width);
        let here = v * width;
        let at = |k: usize| self.facets.slots[k];
        [
            at(above + left),
            at(above + u),
            at(above + right),
            at(here + left),
            at(here + right),
            at(below + left),
            at(below + u),
            at(below + right),
        ]
    }

    /// Whether the first of some slots differs in look from any other.
    fn is_border(&self, distinct: &[u32]) -> bool {
        let look = |s: u32| self.flat_colour(s);
        let first = look(distinct[0]);
        distinct[1..].iter().any(|&s| match (first, look(s)) {
            (Some(a), Some(b)) => (0..3).map(|k| (i32::from(a[k]) - i32::from(b[k])).abs()).sum::<i32>() > BORDER,
            (None, None) => false,
            _ => true,
        })
    }

    /// The one colour of a slot; `None` where it has several.
    fn flat_colour(&self, slot: u32) -> Option<[u8; 3]> {
        if slot == NOTHING {
            return Some(self.air);
        }
        match self.paint(slot) {
            Paint::Flat(colour) => Some(lit(colour.map(f32::from), self.bright[slot as usize])),
            _ => None,
        }
    }

    fn paint(&self, slot: u32) -> &Paint {
        &self.seen.mesh.paints[self.facets.all[slot as usize].triangle as usize]
    }

    fn plain_pixel(&self, slot: u32, u: usize, v: usize) -> [u8; 3] {
        if let Some(colour) = self.flat_colour(slot) {
            return colour;
        }
        let grid = match self.paint(slot) {
            Paint::Image { .. } => TEXTURE_GRID,
            _ => 1,
        };
        self.average(u, v, grid, |ray| self.look(slot, ray))
    }

    /// Mean over a grid of rays through one pixel.
    fn average(&self, u: usize, v: usize, grid: u32, look: impl Fn(&Vector) -> [u8; 3]) -> [u8; 3] {
        let mut sum = [0_u32; 3];
        for k in 0..grid * grid {
            let offset = |i: u32| (f64::from(i) + 0.5) / f64::from(grid);
            let ray = self
                .seen
                .image
                .ray(u as f64 + offset(k % grid), v as f64 + offset(k / grid));
            let colour = look(&ray);
            for c in 0..3 {
                sum[c] += u32::from(colour[c]);
            }
        }
        let n = grid * grid;
        sum.map(|s| ((s + n / 2) / n) as u8)
    }

    /// What a ray shows, of some slots.
    fn nearest(&self, slots: &[u32], ray: &Vector) -> [u8; 3] {
        let mut best = (0.0, NOTHING);
        for &slot in slots.iter().filter(|&&s| s != NOTHING) {
            if let Some(inverse) = self.facets.all[slot as usize].hit(ray)
                && inverse > best.0
            {
                best = (inverse, slot);
            }
        }
        // Where no neighbour's triangle is hit a thin one hides between pixels:
        // the pixel's own colour stands in.
        let missed = best.1 == NOTHING && !slots.contains(&NOTHING);
        self.look(if missed { slots[0] } else { best.1 }, ray)
    }

    /// Colour of a slot where a ray meets its plane.
    fn look(&self, slot: u32, ray: &Vector) -> [u8; 3] {
        if slot == NOTHING {
            return self.air;
        }
        let bright = self.bright[slot as usize];
        match self.paint(slot) {
            Paint::Flat(colour) => lit(colour.map(f32::from), bright),
            Paint::Corners(colours) => {
                let w = self.facets.all[slot as usize].weights(ray);
                let blend = |c: usize| (0..3).map(|k| w[k] as f32 * f32::from(colours[k][c])).sum();
                lit([blend(0), blend(1), blend(2)], bright)
            }
            Paint::Image { texture, uv, tint } => {
                let w = self.facets.all[slot as usize].weights(ray);
                let at = |c: usize| (0..3).map(|k| w[k] * uv[k][c]).sum::<f64>();
                let texel = self.seen.mesh.textures[*texture as usize].at(at(0), at(1));
                let tinted = [0, 1, 2].map(|c| f32::from(texel[c]) * f32::from(tint[c]) / 255.0);
                lit(tinted, bright)
            }
        }
    }
}

fn lit(colour: [f32; 3], bright: f32) -> [u8; 3] {
    colour.map(|c| (c * bright + 0.5).clamp(0.0, 255.0) as u8)
}
