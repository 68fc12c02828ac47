//! Area-uniform samples of a mesh.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

use crate::geometry::{Bounds, Point, Vector};
use crate::sense::Mesh;

/// Square metres a sample.
const AREA: f64 = 4e-6;
/// Most samples; larger objects are sampled more thinly.
const MOST: f64 = 4e6;
/// All runs see the same samples.
const SEED: u64 = 0x5a_3e1e5;

/// A point of the surface and its outward normal (not of unit length).
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    pub(super) at: Point,
    pub(super) normal: Vector,
}

/// Samples of the mesh inside a box: one for every 4 mm², in triangle order.
/// Triangles smaller than that share: the running area decides which get one.
pub(super) fn on(mesh: &Mesh, space: &Bounds) -> Vec<Sample> {
    let areas: Vec<Vector> = (0..mesh.triangles.len()).map(|k| mesh.vector_area(k)).collect();
    let total: f64 = areas.iter().map(|a| a.norm() / 2.0).sum();
    let each = AREA.max(total / MOST);
    let mut random = Pcg64::seed_from_u64(SEED);
    let (mut samples, mut due) = (Vec::new(), 0.5);
    for (k, normal) in areas.iter().enumerate() {
        due += normal.norm() / 2.0 / each;
        while due >= 1.0 {
            due -= 1.0;
            let at = inside(mesh.corners(k), random.random(), random.random());
            if space.contains(&at) {
                samples.push(Sample { at, normal: *normal });
            }
        }
    }
    samples
}

/// A point of a triangle, uniform where `s` and `t` are (Osada et al. 2002).
fn inside([a, b, c]: [Point; 3], s: f64, t: f64) -> Point {
    let root = s.sqrt();
    a + (b - a) * (root * (1.0 - t)) + (c - a) * (root * t)
}
