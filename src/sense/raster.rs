//! A watertight z-buffer rasteriser of primary rays.
//!
//! A pixel is covered by a triangle when the ray through its centre meets it.
//! Rays and triangles are compared in homogeneous form: the ray d and the edge
//! a→b turn left when d · (a × b) ≥ 0 (Olano and Greer 1997). a × b and b × a
//! are exact negatives of each other in floating point, so a ray that leaves
//! one triangle by an edge enters its neighbour, and no near plane is needed.
//! Both faces of a triangle are drawn. Bands of rows are independent, so the
//! result does not depend on the number of threads.

mod colour;
mod facet;

pub(super) use colour::{Backdrop, shade};

use facet::{Corner, Facet};
use rayon::prelude::*;

use crate::geometry::{Intrinsics, Pose, Vector};
use crate::sense::Mesh;

/// Rows a band.
const BAND: usize = 16;

/// What every pixel of an image shows.
pub(super) struct Visibility<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) image: Intrinsics,
    facets: Vec<Facet>,
    /// 1 / z-depth; 0 where nothing is hit.
    inverse: Vec<f32>,
    /// Index into `facets`; `NOTHING` where nothing is hit.
    slots: Vec<u32>,
}

const NOTHING: u32 = u32::MAX;

impl<'a> Visibility<'a> {
    /// Draws a world mesh as seen by a camera.
    pub(super) fn of(mesh: &'a Mesh, image: &Intrinsics, world_from_camera: &Pose) -> Self {
        let camera_from_world = world_from_camera.inverse();
        let corners: Vec<Corner> = mesh
            .vertices
            .par_iter()
            .map(|p| Corner::new(camera_from_world * p, image))
            .collect();
        let facets: Vec<Facet> = mesh
            .triangles
            .par_iter()
            .enumerate()
            .filter_map(|(k, t)| Facet::new(k as u32, t.map(|i| corners[i as usize]), image))
            .collect();
        let mut drawn = Self {
            mesh,
            image: *image,
            facets,
            inverse: vec![0.0; image.pixels()],
            slots: vec![NOTHING; image.pixels()],
        };
        drawn.draw();
        drawn
    }

    fn draw(&mut self) {
        let width = self.image.width as usize;
        let columns: Vec<f64> = (0..width).map(|u| self.image.ray(u as f64 + 0.5, 0.5).x).collect();
        let bins = self.bins();
        let (facets, image) = (&self.facets, &self.image);
        self.inverse
            .par_chunks_mut(width * BAND)
            .zip(self.slots.par_chunks_mut(width * BAND))
            .zip(bins)
            .enumerate()
            .for_each(|(band, ((inverse, slots), bin))| {
                for slot in bin {
                    let facet = &facets[slot as usize];
                    let first = (facet.rows.0 as usize).max(band * BAND);
                    let last = (facet.rows.1 as usize).min((band + 1) * BAND);
                    for row in first..last {
                        let at = (row - band * BAND) * width;
                        let dy = image.ray(0.5, row as f64 + 0.5).y;
                        let line = (&mut inverse[at..at + width], &mut slots[at..at + width]);
                        facet.draw_row(slot, dy, &columns, image, line);
                    }
                }
            });
    }

    /// Facets by band, in order.
    fn bins(&self) -> Vec<Vec<u32>> {
        let mut bins = vec![Vec::new(); (self.image.height as usize).div_ceil(BAND)];
        for (slot, facet) in self.facets.iter().enumerate() {
            let (first, last) = (facet.rows.0 as usize / BAND, (facet.rows.1 as usize).div_ceil(BAND));
            for bin in &mut bins[first..last] {
                bin.push(slot as u32);
            }
        }
        bins
    }

    /// Cosine between the ray of pixel `k` and the normal of what it hits;
    /// `None` where nothing is hit.
    pub(super) fn cosine(&self, k: usize) -> Option<f64> {
        let facet = self.facets.get(self.slots[k] as usize)?;
        Some(facet.cosine(&self.ray(k)))
    }

    /// z-depth of pixel `k`, metres; `None` where nothing is hit.
    pub(super) fn depth(&self, k: usize) -> Option<f32> {
        (self.slots[k] != NOTHING).then(|| 1.0 / self.inverse[k])
    }

    /// The triangle that pixel `k` shows, and whether its front face.
    pub(super) fn triangle(&self, k: usize) -> Option<(u32, bool)> {
        let facet = self.facets.get(self.slots[k] as usize)?;
        Some((facet.triangle, facet.front))
    }

    /// The ray of pixel `k`, z = 1.
    pub(super) fn ray(&self, k: usize) -> Vector {
        let width = self.image.width as usize;
        self.image.ray((k % width) as f64 + 0.5, (k / width) as f64 + 0.5)
    }
}

#[cfg(test)]
mod tests;
