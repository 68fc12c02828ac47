//! Triangles that reach out of the grid or behind the eye (Sutherland and Hodgman 1974).
//!
//! Where an edge is cut depends on the edge alone, since it is always followed
//! from its end inside: both triangles of an edge get the same corner there, and
//! no gap opens between them.

use super::screen::{NEAREST, REACH};

/// A point as (x · z, y · z, z) of the screen.
pub(super) type Homogeneous = [f64; 3];

/// The part of a triangle inside the view; a convex polygon, maybe empty.
pub(super) fn clip(triangle: [Homogeneous; 3]) -> Vec<Homogeneous> {
    let mut polygon = triangle.to_vec();
    let planes: [fn(&Homogeneous) -> f64; 5] = [
        |p| p[2] - NEAREST,
        |p| REACH * p[2] + p[0],
        |p| REACH * p[2] - p[0],
        |p| REACH * p[2] + p[1],
        |p| REACH * p[2] - p[1],
    ];
    for height in planes {
        polygon = above(&polygon, height);
    }
    polygon
}

fn above(polygon: &[Homogeneous], height: impl Fn(&Homogeneous) -> f64) -> Vec<Homogeneous> {
    let mut part = Vec::with_capacity(polygon.len() + 1);
    for (k, p) in polygon.iter().enumerate() {
        let q = &polygon[(k + 1) % polygon.len()];
        let (up, uq) = (height(p), height(q));
        if up >= 0.0 {
            part.push(*p);
        }
        match (up >= 0.0, uq >= 0.0) {
            (true, false) => part.push(between(p, q, up / (up - uq))),
            (false, true) => part.push(between(q, p, uq / (uq - up))),
            _ => {}
        }
    }
    part
}

fn between(inside: &Homogeneous, outside: &Homogeneous, t: f64) -> Homogeneous {
    [0, 1, 2].map(|k| inside[k] + (outside[k] - inside[k]) * t)
}
