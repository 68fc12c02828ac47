//! The triangles that show, ready to be asked about rays.

use rayon::prelude::*;

use super::canvas::{Pixel, triangle};
use super::{NOTHING, Visibility};
use crate::geometry::{Point, Vector};

/// The triangles that an image shows, each once.
pub(in crate::sense) struct Facets {
    pub(super) all: Vec<Facet>,
    /// A pixel's index into `all`; `NOTHING` where nothing is hit.
    pub(super) slots: Vec<u32>,
}

impl Facets {
    pub(super) fn of(seen: &Visibility) -> Self {
        let mut slot_of = vec![NOTHING; seen.mesh.triangles.len()];
        let mut shown = Vec::new();
        let slot = |&pixel: &Pixel| {
            let Some(slot) = slot_of.get_mut(triangle(pixel) as usize) else {
                return NOTHING;
            };
            if *slot == NOTHING {
                *slot = shown.len() as u32;
                shown.push(triangle(pixel));
            }
            *slot
        };
        let slots = seen.pixels.iter().map(slot).collect();
        let facet = |&triangle: &u32| {
            let corners = seen.mesh.corners(triangle as usize);
            Facet::new(triangle, corners.map(|p| seen.camera_from_world * p))
        };
        Self {
            all: shown.par_iter().map(facet).collect(),
            slots,
        }
    }

    /// The triangle that pixel `k` shows; `None` where it shows none.
    pub(in crate::sense) fn at(&self, k: usize) -> Option<&Facet> {
        self.all.get(self.slots[k] as usize)
    }
}

/// A triangle in camera axes. Rays and edges are compared in homogeneous form:
/// the ray d and the edge a→b turn left when d · (a × b) ≥ 0 (Olano and Greer 1997).
pub(in crate::sense) struct Facet {
    /// Index in the mesh.
    pub(in crate::sense) triangle: u32,
    /// Outward, of unit length.
    pub(super) normal: Vector,
    /// d · edges[i] ≥ 0 for all i where the ray d hits the triangle; edge i
    /// faces corner i.
    edges: [Vector; 3],
    /// d · plane is 1 / depth.
    plane: Vector,
    /// Bounds of 1 / depth over the triangle.
    inverse: (f64, f64),
    /// Whether its front faces the eye.
    pub(in crate::sense) front: bool,
}

impl Facet {
    fn new(triangle: u32, [a, b, c]: [Point; 3]) -> Self {
        let normal = (b - a).cross(&(c - a));
        let offset = normal.dot(&a.coords);
        let edge = |p: Point, q: Point| p.coords.cross(&q.coords) * offset.signum();
        let near = a.z.min(b.z).min(c.z);
        let far = a.z.max(b.z).max(c.z);
        Self {
            triangle,
            normal: normal.try_normalize(0.0).unwrap_or_else(Vector::z),
            edges: [edge(b, c), edge(c, a), edge(a, b)],
            // Seen from the edge, it is as far as its corners are.
            plane: if offset == 0.0 {
                Vector::zeros()
            } else {
                normal / offset
            },
            inverse: if near > 0.0 {
                (1.0 / far, 1.0 / near)
            } else {
                (f64::MIN_POSITIVE, f64::INFINITY)
            },
            front: offset < 0.0,
        }
    }

    /// Cosine of the angle between a ray and the normal, without its sign.
    pub(in crate::sense) fn cosine(&self, ray: &Vector) -> f64 {
        (self.normal.dot(ray) / ray.norm()).abs()
    }

    /// 1 / depth along a ray of z = 1; `None` where it misses.
    pub(super) fn hit(&self, ray: &Vector) -> Option<f64> {
        let inside = self.edges.iter().all(|e| e.dot(ray) >= 0.0);
        inside.then(|| self.plane.dot(ray).clamp(self.inverse.0, self.inverse.1))
    }

    /// Weights of the corners where a ray meets the triangle's plane.
    pub(super) fn weights(&self, ray: &Vector) -> [f64; 3] {
        let parts = [0, 1, 2].map(|i| self.edges[i].dot(ray));
        let total = parts[0] + parts[1] + parts[2];
        if total == 0.0 {
            return [1.0 / 3.0; 3];
        }
        parts.map(|p| p / total)
    }
}
