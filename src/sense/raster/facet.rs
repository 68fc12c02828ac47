//! One triangle ready to be drawn: edge functions, plane and extent on the image.

use crate::geometry::{Intrinsics, Point, Vector};

/// A mesh corner in camera axes and, where it lies in front, on the image.
#[derive(Clone, Copy)]
pub(super) struct Corner {
    p: Point,
    at: [f64; 2],
}

impl Corner {
    pub(super) fn new(p: Point, image: &Intrinsics) -> Self {
        let at = [image.fx * p.x / p.z + image.cx, image.fy * p.y / p.z + image.cy];
        Self { p, at }
    }
}

/// A triangle in camera axes.
pub(super) struct Facet {
    /// Index in the mesh.
    pub(super) triangle: u32,
    /// Rows that it may cover: first, one past the last.
    pub(super) rows: (u32, u32),
    columns: (u32, u32),
    /// d · edges[i] ≥ 0 for all i where the ray d hits the triangle; edge i
    /// faces corner i.
    edges: [Vector; 3],
    /// d · plane is 1 / depth.
    plane: Vector,
    /// Bounds of 1 / depth over the triangle.
    inverse: (f64, f64),
    /// Whether its front faces the eye.
    pub(super) front: bool,
}

impl Facet {
    /// `None` where the triangle is behind, beside the image, between pixel
    /// centres or edge-on.
    pub(super) fn new(triangle: u32, corners: [Corner; 3], image: &Intrinsics) -> Option<Self> {
        let (columns, rows) = extent(&corners, image)?;
        let [a, b, c] = corners.map(|corner| corner.p);
        let normal = (b - a).cross(&(c - a));
        let offset = normal.dot(&a.coords);
        if offset == 0.0 || !offset.is_finite() {
            return None;
        }
        let sign = offset.signum();
        let edge = |p: Point, q: Point| p.coords.cross(&q.coords) * sign;
        let near = a.z.min(b.z).min(c.z);
        let far = a.z.max(b.z).max(c.z);
        Some(Self {
            triangle,
            rows,
            columns,
            edges: [edge(b, c), edge(c, a), edge(a, b)],
            plane: normal / offset,
            inverse: if near > 0.0 {
                (1.0 / far, 1.0 / near)
            } else {
                (f64::MIN_POSITIVE, f64::INFINITY)
            },
            front: offset < 0.0,
        })
    }

    /// Outward normal, camera axes, not of unit length.
    pub(super) fn normal(&self) -> Vector {
        if self.front { -self.plane } else { self.plane }
    }

    /// Cosine of the angle between a ray and the normal, without its sign.
    pub(super) fn cosine(&self, ray: &Vector) -> f64 {
        (self.plane.dot(ray) / (self.plane.norm_squared() * ray.norm_squared()).sqrt()).abs()
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
        parts.map(|p| p / total)
    }

    /// Draws one row at ray slope `dy` into 1 / depth and slots.
    #[inline]
    pub(super) fn draw_row(
        &self,
        slot: u32,
        dy: f64,
        columns: &[f64],
        image: &Intrinsics,
        (inverse, slots): (&mut [f32], &mut [u32]),
    ) {
        let rest = [0, 1, 2].map(|i| self.edges[i].y * dy + self.edges[i].z);
        let plane_rest = self.plane.y * dy + self.plane.z;
        let (first, last) = self.span(&rest, image);
        for u in first..last {
            let dx = columns[u];
            let side = |i: usize| self.edges[i].x * dx + rest[i];
            if side(0) >= 0.0 && side(1) >= 0.0 && side(2) >= 0.0 {
                let near = (self.plane.x * dx + plane_rest).clamp(self.inverse.0, self.inverse.1) as f32;
                if near > inverse[u] {
                    inverse[u] = near;
                    slots[u] = slot;
                }
            }
        }
    }

    /// Columns of a row that may be inside, a pixel of slack on both ends; the
    /// exact test decides.
    fn span(&self, rest: &[f64; 3], image: &Intrinsics) -> (usize, usize) {
        let (mut first, mut last) = (f64::from(self.columns.0), f64::from(self.columns.1));
        if last - first > 6.0 {
            for (edge, rest) in self.edges.iter().zip(rest) {
                let column = -rest / edge.x * image.fx + image.cx;
                if edge.x > 0.0 {
                    first = first.max(column - 1.5);
                } else if edge.x < 0.0 {
                    last = last.min(column + 1.5);
                }
            }
        }
        let last = last.max(0.0).ceil() as usize;
        (first.max(0.0) as usize, last.min(image.width as usize))
    }
}

/// (first, one past last) columns and rows.
type Extent = ((u32, u32), (u32, u32));

/// Pixels whose centres the triangle may cover; `None` where there are none.
fn extent(corners: &[Corner; 3], image: &Intrinsics) -> Option<Extent> {
    let in_front = corners.iter().filter(|c| c.p.z > 0.0).count();
    match in_front {
        0 => None,
        3 => around(&corners.map(|c| c.at), image),
        _ => around(&across_the_eye(corners, image), image),
    }
}

/// Image outline of the part in front of a plane close before the eye.
fn across_the_eye(corners: &[Corner; 3], image: &Intrinsics) -> Vec<[f64; 2]> {
    let nearest = 1e-6_f64;
    let mut part = Vec::with_capacity(4);
    for k in 0..3 {
        let (p, q) = (corners[k].p, corners[(k + 1) % 3].p);
        if p.z >= nearest {
            part.push(corners[k].at);
        }
        if (p.z >= nearest) != (q.z >= nearest) {
            let t = (nearest - p.z) / (q.z - p.z);
            let cut = Point::new(p.x + (q.x - p.x) * t, p.y + (q.y - p.y) * t, nearest);
            part.push(Corner::new(cut, image).at);
        }
    }
    part
}

fn around(points: &[[f64; 2]], image: &Intrinsics) -> Option<Extent> {
    let range = |k: usize, size: u32| {
        let low = points.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min);
        let high = points.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max);
        centres(low, high, size)
    };
    Some((range(0, image.width)?, range(1, image.height)?))
}

/// Pixels of an axis whose centres lie between two coordinates; a hair of
/// slack covers the rounding of the projection.
fn centres(low: f64, high: f64, size: u32) -> Option<(u32, u32)> {
    let low = (low - 0.5 - 1e-6).max(0.0);
    let high = (high - 0.5 + 1e-6).min(f64::from(size) - 1.0);
    if high < low {
        return None;
    }
    // Casts instead of `ceil`, which is a call on the baseline processor.
    let below = low as u32;
    let first = below + u32::from(f64::from(below) < low);
    let end = high as u32 + 1;
    (first < end).then_some((first, end))
}
