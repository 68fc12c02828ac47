//! Triangle meshes with a colour or texture per triangle.
//!
//! Reads STL, OBJ, PLY, glTF and GLB into metres, z up. Degenerate faces are
//! dropped and open meshes accepted, both with a warning. One file a format
//! under `mesh/`; nothing outside them knows a reader crate.

mod base64;
mod error;
mod gltf;
mod image;
mod obj;
mod options;
mod ply;
mod read;
mod stl;

pub use error::{MeshError, MeshWarning};
pub(super) use image::decode as decode_image;
pub use options::{Axis, MeshOptions, Units};
pub use read::read;

use std::collections::HashMap;

use crate::geometry::{Bounds, Point, Pose, Vector};

/// A triangle mesh.
///
/// INVARIANT: every index is in range, every vertex is finite, and `paints`
/// has one entry a triangle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Corner positions, metres.
    pub vertices: Vec<Point>,
    /// Corner indices, counter-clockwise as seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// What each triangle looks like.
    pub paints: Vec<Paint>,
    /// Images that paints refer to.
    pub textures: Vec<Texture>,
    /// What was amiss in the file.
    pub warnings: Vec<MeshWarning>,
}

/// What a triangle looks like.
#[derive(Clone, Debug, PartialEq)]
pub enum Paint {
    /// One colour.
    Flat([u8; 3]),
    /// A colour a corner, blended between.
    Corners([[u8; 3]; 3]),
    /// An image, multiplied by a tint.
    Image {
        /// Index into [`Mesh::textures`].
        texture: u32,
        /// Image coordinates of the corners; (0, 0) is the image's top left, 1 its far edge.
        uv: [[f64; 2]; 3],
        /// Factor on the image, 255 = 1.
        tint: [u8; 3],
    },
}

/// An sRGB image; it repeats outside 0..1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Texture {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width · height` pixels, row by row from the top.
    pub pixels: Vec<[u8; 3]>,
}

impl Texture {
    /// The texel that contains image coordinates (u, v).
    pub fn at(&self, u: f64, v: f64) -> [u8; 3] {
        let cell = |x: f64, n: u32| {
            // The remainder is a slow call and seldom needed.
            let x = if (0.0..1.0).contains(&x) { x } else { x.rem_euclid(1.0) };
            ((x * f64::from(n)) as u32).min(n - 1)
        };
        self.pixels[cell(v, self.height) as usize * self.width as usize + cell(u, self.width) as usize]
    }
}

impl Mesh {
    /// Smallest box around the vertices; a point at the origin where there are none.
    pub fn bounds(&self) -> Bounds {
        Bounds::around(&self.vertices).unwrap_or(Bounds {
            min: Point::origin(),
            max: Point::origin(),
        })
    }

    /// The corners of triangle `k`.
    pub fn corners(&self, k: usize) -> [Point; 3] {
        self.triangles[k].map(|i| self.vertices[i as usize])
    }

    /// Twice the vector area of triangle `k`: its outward normal, unscaled.
    pub fn vector_area(&self, k: usize) -> Vector {
        let [a, b, c] = self.corners(k);
        (b - a).cross(&(c - a))
    }

    /// The mesh in another frame.
    pub fn moved(mut self, to_from_mesh: &Pose) -> Self {
        for p in &mut self.vertices {
            *p = to_from_mesh * *p;
        }
        self
    }

    /// Adds the triangles of another mesh.
    pub fn append(&mut self, other: Mesh) {
        let (vertex, image) = (self.vertices.len() as u32, self.textures.len() as u32);
        self.vertices.extend(other.vertices);
        self.triangles
            .extend(other.triangles.iter().map(|t| t.map(|i| i + vertex)));
        self.textures.extend(other.textures);
        self.paints.extend(other.paints.into_iter().map(|p| match p {
            Paint::Image { texture, uv, tint } => Paint::Image {
                texture: texture + image,
                uv,
                tint,
            },
            plain => plain,
        }));
        self.warnings.extend(other.warnings);
    }

    /// How many times the surface winds about a point (Jacobson et al. 2013):
    /// 1 inside a closed mesh, 0 outside, between them near holes.
    pub fn winding_number(&self, p: &Point) -> f64 {
        let total: f64 = (0..self.triangles.len()).map(|k| solid_angle(self.corners(k), p)).sum();
        total / (4.0 * std::f64::consts::PI)
    }

    /// Number of directed edges whose reverse is missing: 0 for a closed mesh
    /// of consistent winding. Corners within a millionth of the largest extent
    /// count as one, since files round.
    pub fn open_edges(&self) -> usize {
        open_edges((0..self.triangles.len()).map(|k| self.corners(k)), &self.bounds())
    }
}

/// As [`Mesh::open_edges`], of triangles within some bounds. Those without area
/// count: they may be what joins their neighbours.
fn open_edges(triangles: impl Iterator<Item = [Point; 3]>, bounds: &Bounds) -> usize {
    let grain = (bounds.size().max() * 1e-6).max(f64::MIN_POSITIVE);
    let mut welded: HashMap<[i64; 3], u32> = HashMap::new();
    let mut name = |p: &Point| {
        let next = welded.len() as u32;
        let cell = (p - bounds.min) / grain;
        *welded
            .entry([cell.x, cell.y, cell.z].map(|c| c.round() as i64))
            .or_insert(next)
    };
    let mut balance: HashMap<(u32, u32), i64> = HashMap::new();
    for corners in triangles {
        let ids = corners.map(|p| name(&p));
        for (a, b) in [(ids[0], ids[1]), (ids[1], ids[2]), (ids[2], ids[0])] {
            if a == b {
                continue;
            }
            let (key, sign) = if a < b { ((a, b), 1) } else { ((b, a), -1) };
            *balance.entry(key).or_insert(0) += sign;
        }
    }
    balance.values().filter(|&&n| n != 0).count()
}

/// Signed solid angle of a triangle seen from `p` (Van Oosterom and Strackee 1983).
fn solid_angle(corners: [Point; 3], p: &Point) -> f64 {
    let [a, b, c] = corners.map(|q| q - p);
    let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
    let over = a.dot(&b.cross(&c));
    let under = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
    2.0 * over.atan2(under)
}
