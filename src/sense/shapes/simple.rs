//! Whether a mesh crosses itself.

use crate::geometry::{Point, Vector};
use crate::sense::Mesh;

/// The mesh, if no edge of it passes through a triangle that it does not touch.
/// Quadratic: for shapes of hundreds of triangles.
pub(super) fn checked(mesh: Mesh) -> Option<Mesh> {
    let n = mesh.triangles.len();
    let clean = (0..n)
        .all(|j| (0..n).all(|k| j == k || share_a_vertex(&mesh, j, k) || !pierces(mesh.corners(j), mesh.corners(k))));
    clean.then_some(mesh)
}

fn share_a_vertex(mesh: &Mesh, j: usize, k: usize) -> bool {
    mesh.triangles[j].iter().any(|i| mesh.triangles[k].contains(i))
}

/// Whether an edge of the first triangle passes through the second.
fn pierces(edges: [Point; 3], face: [Point; 3]) -> bool {
    (0..3).any(|i| passes(&edges[i], &edges[(i + 1) % 3], face))
}

/// Whether a segment passes through a triangle (Möller and Trumbore 1997).
fn passes(start: &Point, end: &Point, [a, b, c]: [Point; 3]) -> bool {
    let along: Vector = end - start;
    let (ab, ac) = (b - a, c - a);
    let p = along.cross(&ac);
    let scale = ab.dot(&p);
    if scale.abs() < 1e-15 {
        return false;
    }
    let from_a = start - a;
    let u = from_a.dot(&p) / scale;
    let q = from_a.cross(&ab);
    let v = along.dot(&q) / scale;
    let t = ac.dot(&q) / scale;
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && (0.0..=1.0).contains(&t)
}
