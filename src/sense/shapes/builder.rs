//! Builds meshes from planar faces.

use std::collections::HashMap;

use super::triangulate::{Flat, triangulate};
use crate::geometry::{Point, Polygon, Vector};
use crate::sense::mesh::{Mesh, Paint};

/// Collects faces; corners at equal positions become one vertex.
#[derive(Default)]
pub(super) struct Builder {
    mesh: Mesh,
    index: HashMap<[u64; 3], u32>,
}

impl Builder {
    /// Adds a planar face with holes, counter-clockwise seen from outside (the
    /// holes too). `None` where it cannot be triangulated.
    pub(super) fn face(&mut self, outline: &[Point], holes: &[[Point; 4]], colour: [u8; 3]) -> Option<()> {
        let (u, v) = Polygon::new(outline.to_vec())?.plane_axes();
        let origin = outline[0];
        let flat = |p: &Point| -> Flat { [(p - origin).dot(&u), (p - origin).dot(&v)] };
        let corners: Vec<Point> = outline.iter().chain(holes.iter().flatten()).copied().collect();
        let points: Vec<Flat> = corners.iter().map(flat).collect();
        let ring: Vec<usize> = (0..outline.len()).collect();
        let rims: Vec<Vec<usize>> = (0..holes.len())
            .map(|k| (0..4).map(|j| outline.len() + 4 * k + (4 - j) % 4).collect())
            .collect();
        for t in triangulate(&points, &ring, &rims)? {
            self.triangle(t.map(|i| corners[i]), colour);
        }
        Some(())
    }

    /// Adds a face without holes that is convex.
    pub(super) fn convex(&mut self, outline: &[Point], colour: [u8; 3]) {
        for k in 1..outline.len().saturating_sub(1) {
            self.triangle([outline[0], outline[k], outline[k + 1]], colour);
        }
    }

    /// Adds the closed solid swept from a convex outline (counter-clockwise
    /// about `sweep`) along `sweep`.
    pub(super) fn swept(&mut self, outline: &[Point], sweep: Vector, colour: [u8; 3]) {
        let far: Vec<Point> = outline.iter().map(|p| p + sweep).collect();
        let near: Vec<Point> = outline.iter().rev().copied().collect();
        self.convex(&near, colour);
        self.convex(&far, colour);
        for k in 0..outline.len() {
            let next = (k + 1) % outline.len();
            self.convex(&[outline[k], outline[next], far[next], far[k]], colour);
        }
    }

    /// The mesh.
    pub(super) fn finish(self) -> Mesh {
        self.mesh
    }

    fn triangle(&mut self, corners: [Point; 3], colour: [u8; 3]) {
        let ids = corners.map(|p| self.vertex(p));
        self.mesh.triangles.push(ids);
        self.mesh.paints.push(Paint::Flat(colour));
    }

    fn vertex(&mut self, p: Point) -> u32 {
        let next = self.mesh.vertices.len() as u32;
        let id = *self
            .index
            .entry([p.x, p.y, p.z].map(|c| (c + 0.0).to_bits()))
            .or_insert(next);
        if id == next {
            self.mesh.vertices.push(p);
        }
        id
    }
}
