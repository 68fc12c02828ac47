//! One triangle ready to be drawn: edge functions, plane and extent on the image.

use crate::geometry::{Intrinsics, Point, Vector};

/// A triangle in camera axes.
pub(super) struct Facet {
    /// Index in the mesh.
    pub(super) triangle: u32,
    /// (b − a) × (c − a), camera axes.
    pub(super) normal: Vector,
    /// Rows that it may cover: first, one past the last.
    pub(super) rows: (u32, u32),
    columns: (u32, u32),
    /// d · edges[i] ≥ 0 for all i where the ray d hits the triangle; edge i
    /// faces corner i.
    pub(super) edges: [Vector; 3],
    /// d · plane is 1 / depth.
    plane: Vector,
    /// Bounds of 1 / depth over the triangle.
    inverse: (f64, f64),
}

impl Facet {
    /// `None` where the triangle is behind, beside the image or edge-on.
    pub(super) fn new(triangle: u32, corners: [Point; 3], image: &Intrinsics) -> Option<Self> {
        let [a, b, c] = corners;
        let normal = (b - a).cross(&(c - a));
        let offset = normal.dot(&a.coords);
        if offset == 0.0 || !offset.is_finite() {
            return None;
        }
        let (columns, rows) = extent(&corners, image)?;
        let sign = offset.signum();
        let edge = |p: Point, q: Point| p.coords.cross(&q.coords) * sign;
        let depths = corners.map(|p| p.z);
        let (near, far) = (min3(depths), -min3(depths.map(|z| -z)));
        Some(Self {
            triangle,
            normal,
            rows,
            columns,
            edges: [edge(b, c), edge(c, a), edge(a, b)],
            plane: normal / offset,
            inverse: if near > 0.0 {
                (1.0 / far, 1.0 / near)
            } else {
                (f64::MIN_POSITIVE, f64::INFINITY)
            },
        })
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
fn extent(corners: &[Point; 3], image: &Intrinsics) -> Option<Extent> {
    let in_front = corners.iter().filter(|p| p.z > 0.0).count();
    if in_front == 0 {
        return None;
    }
    if in_front < 3 {
        return across_the_eye(corners, image);
    }
    around(corners.iter().copied(), image)
}

/// The extent of the part in front of a plane close before the eye.
fn across_the_eye(corners: &[Point; 3], image: &Intrinsics) -> Option<Extent> {
    let nearest = 1e-6_f64;
    let mut part = Vec::with_capacity(4);
    for k in 0..3 {
        let (p, q) = (corners[k], corners[(k + 1) % 3]);
        if p.z >= nearest {
            part.push(p);
        }
        if (p.z >= nearest) != (q.z >= nearest) {
            let t = (nearest - p.z) / (q.z - p.z);
            part.push(Point::new(p.x + (q.x - p.x) * t, p.y + (q.y - p.y) * t, nearest));
        }
    }
    if part.is_empty() {
        None
    } else {
        around(part.into_iter(), image)
    }
}

fn around(points: impl Iterator<Item = Point>, image: &Intrinsics) -> Option<Extent> {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for p in points {
        let at = [image.fx * p.x / p.z + image.cx, image.fy * p.y / p.z + image.cy];
        for k in 0..2 {
            low[k] = low[k].min(at[k]);
            high[k] = high[k].max(at[k]);
        }
    }
    // Half a pixel in from the corner lies the first centre; a hair of slack
    // covers the rounding of the projection.
    let range = |k: usize, size: u32| {
        let first = (low[k] - 0.5 - 1e-6).ceil().max(0.0);
        let last = (high[k] - 0.5 + 1e-6).floor().min(f64::from(size) - 1.0);
        (first <= last).then(|| (first as u32, last as u32 + 1))
    };
    Some((range(0, image.width)?, range(1, image.height)?))
}

fn min3([a, b, c]: [f64; 3]) -> f64 {
    a.min(b).min(c)
}
