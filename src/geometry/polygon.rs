//! Planar polygons with an outward normal: the shape of every local surface.

use serde::{Deserialize, Serialize};

use super::frame::{Point, Pose, Vector};

/// A planar polygon.
///
/// INVARIANT: at least three finite vertices, counter-clockwise as seen from
/// outside (about `normal`), `normal` of length one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Polygon {
    vertices: Vec<Point>,
    normal: Vector,
}

/// A directed edge of a face: the face lies to its left as seen from outside.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Edge {
    /// First end.
    pub start: Point,
    /// Second end.
    pub end: Point,
    /// Outward normal of the face that the edge bounds.
    pub face_normal: Vector,
}

impl Edge {
    /// Length, metres.
    pub fn length(&self) -> f64 {
        (self.end - self.start).norm()
    }

    /// Unit direction from start to end.
    pub fn direction(&self) -> Vector {
        (self.end - self.start)
            .try_normalize(1e-12)
            .unwrap_or_else(Vector::zeros)
    }

    /// Unit direction within the face, at right angles to the edge, into the face.
    pub fn inward(&self) -> Vector {
        self.face_normal.cross(&self.direction())
    }

    /// Halfway between the ends.
    pub fn midpoint(&self) -> Point {
        nalgebra::center(&self.start, &self.end)
    }

    /// Distance of a point to the segment, metres.
    pub fn distance(&self, p: &Point) -> f64 {
        let along = self.end - self.start;
        let squared = along.norm_squared();
        let t = if squared > 0.0 {
            ((p - self.start).dot(&along) / squared).clamp(0.0, 1.0)
        } else {
            0.0
        };
        (p - (self.start + along * t)).norm()
    }
}

impl Polygon {
    /// A polygon from vertices counter-clockwise about its outward normal,
    /// which follows from them (Newell). `None` where there are fewer than
    /// three, one is not finite, or they span no area.
    pub fn new(vertices: Vec<Point>) -> Option<Self> {
        let finite = vertices.iter().all(|p| p.coords.iter().all(|c| c.is_finite()));
        if vertices.len() < 3 || !finite {
            return None;
        }
        let normal = newell(&vertices).try_normalize(1e-14)?;
        Some(Self { vertices, normal })
    }

    /// The square of edge `size` about a place's origin, facing its +z: lower left,
    /// lower right, upper right, upper left as one looks at it.
    pub fn square(world_from_place: &Pose, size: f64) -> Option<Self> {
        let half = size / 2.0;
        let corners = [(-half, -half), (half, -half), (half, half), (-half, half)];
        Self::new(corners.map(|(x, y)| world_from_place * Point::new(x, y, 0.0)).to_vec())
    }

    /// The same polygon with its vertices ordered so that it faces `outward`.
    pub fn facing(mut self, outward: &Vector) -> Self {
        if self.normal.dot(outward) < 0.0 {
            self.vertices.reverse();
            self.normal = -self.normal;
        }
        self
    }

    /// The same polygon beginning with vertex `first` (modulo their number).
    pub fn beginning_at(mut self, first: usize) -> Self {
        let n = self.vertices.len();
        self.vertices.rotate_left(first % n);
        self
    }

    /// Vertices, counter-clockwise seen from outside.
    pub fn vertices(&self) -> &[Point] {
        &self.vertices
    }

    /// Outward unit normal.
    pub fn normal(&self) -> Vector {
        self.normal
    }

    /// Edges in order; edge k runs from vertex k to vertex k + 1.
    pub fn edges(&self) -> Vec<Edge> {
        (0..self.vertices.len()).map(|k| self.edge(k)).collect()
    }

    /// Edge `k` (modulo their number).
    pub fn edge(&self, k: usize) -> Edge {
        let n = self.vertices.len();
        Edge {
            start: self.vertices[k % n],
            end: self.vertices[(k + 1) % n],
            face_normal: self.normal,
        }
    }

    /// The vertex farthest from the line of the first edge, and that distance.
    pub fn apex(&self) -> (Point, f64) {
        let base = self.edge(0);
        let from_line = |p: &Point| (p - base.start).cross(&base.direction()).norm();
        let first = (base.start, 0.0);
        self.vertices.iter().fold(first, |best, vertex| {
            let distance = from_line(vertex);
            if distance > best.1 { (*vertex, distance) } else { best }
        })
    }

    /// Area, square metres.
    pub fn area(&self) -> f64 {
        newell(&self.vertices).norm() / 2.0
    }

    /// Centre of area.
    pub fn centre(&self) -> Point {
        let origin = self.vertices[0];
        let (mut weighted, mut total) = (Vector::zeros(), 0.0);
        for pair in self.vertices[1..].windows(2) {
            let (a, b) = (pair[0] - origin, pair[1] - origin);
            let signed = a.cross(&b).dot(&self.normal);
            weighted += (a + b) / 3.0 * signed;
            total += signed;
        }
        if total.abs() < 1e-18 {
            origin
        } else {
            origin + weighted / total
        }
    }

    /// Signed distance of a point to the plane, positive outside.
    pub fn height_of(&self, p: &Point) -> f64 {
        (p - self.vertices[0]).dot(&self.normal)
    }

    /// The axes of the polygon's plane: u along its first edge, v = normal × u.
    pub fn plane_axes(&self) -> (Vector, Vector) {
        let u = self.edge(0).direction();
        (u, self.normal.cross(&u))
    }

    /// Whether the projection of a point to the plane lies inside (even-odd).
    pub fn contains_projection(&self, p: &Point) -> bool {
        let (u, v) = self.plane_axes();
        let flat = |q: &Point| {
            let d = q - self.vertices[0];
            (d.dot(&u), d.dot(&v))
        };
        let (x, y) = flat(p);
        let mut inside = false;
        for edge in self.edges() {
            let (ax, ay) = flat(&edge.start);
            let (bx, by) = flat(&edge.end);
            if (ay > y) != (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax) {
                inside = !inside;
            }
        }
        inside
    }

    /// Points that cover the polygon, border included, at most `spacing`
    /// metres from each other along both plane axes (`pred_k()`: "uniform
    /// sampling of the polygon"). Concave outlines are respected.
    pub fn samples(&self, spacing: f64) -> Vec<Point> {
        let (u, v) = self.plane_axes();
        let origin = self.vertices[0];
        let flat: Vec<(f64, f64)> = self
            .vertices
            .iter()
            .map(|q| ((q - origin).dot(&u), (q - origin).dot(&v)))
            .collect();
        let low = |f: fn(&(f64, f64)) -> f64| flat.iter().map(f).fold(f64::INFINITY, f64::min);
        let high = |f: fn(&(f64, f64)) -> f64| flat.iter().map(f).fold(f64::NEG_INFINITY, f64::max);
        let (x0, x1, y0, y1) = (low(|c| c.0), high(|c| c.0), low(|c| c.1), high(|c| c.1));
        let steps = |extent: f64| (extent / spacing).ceil().max(1.0) as usize;
        let (nx, ny) = (steps(x1 - x0), steps(y1 - y0));
        let mut points = Vec::new();
        for iy in 0..=ny {
            for ix in 0..=nx {
                let x = x0 + (x1 - x0) * ix as f64 / nx as f64;
                let y = y0 + (y1 - y0) * iy as f64 / ny as f64;
                let p = origin + u * x + v * y;
                if self.contains_projection(&p) {
                    points.push(p);
                }
            }
        }
        for edge in self.edges() {
            let n = steps(edge.length());
            points.extend((0..n).map(|k| edge.start + (edge.end - edge.start) * (k as f64 / n as f64)));
        }
        points
    }
}

/// Twice the vector area of a closed outline.
fn newell(vertices: &[Point]) -> Vector {
    let origin = vertices[0];
    (1..vertices.len().saturating_sub(1))
        .map(|k| (vertices[k] - origin).cross(&(vertices[k + 1] - origin)))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn l_shape() -> Polygon {
        let at = |x: f64, y: f64| Point::new(x, y, 0.0);
        Polygon::new(vec![
            at(0., 0.),
            at(2., 0.),
            at(2., 1.),
            at(1., 1.),
            at(1., 2.),
            at(0., 2.),
        ])
        .unwrap()
    }

    #[test]
    fn a_concave_outline_has_its_area_centre_and_samples() {
        let l = l_shape();
        assert!((l.area() - 3.0).abs() < 1e-12);
        let centre = l.centre();
        assert!((centre - Point::new(2.5 / 3.0, 2.5 / 3.0, 0.0)).norm() < 1e-12);
        let samples = l.samples(0.1);
        assert!(samples.iter().all(|p| p.x <= 1.0 + 1e-9 || p.y <= 1.0 + 1e-9));
        assert!(samples.len() > 300);
    }

    #[test]
    fn winding_follows_the_side_it_faces() {
        let l = l_shape();
        assert_eq!(l.normal(), Vector::z());
        let flipped = l.clone().facing(&-Vector::z());
        assert_eq!(flipped.normal(), -Vector::z());
        assert!(l.edge(0).inward().dot(&Vector::y()) > 0.99);
        assert!(flipped.edges().iter().any(|e| e.inward().dot(&Vector::y()) > 0.99));
    }

    #[test]
    fn what_spans_no_area_is_no_polygon() {
        let line = (0..4).map(|k| Point::new(f64::from(k), 0.0, 0.0)).collect();
        assert!(Polygon::new(line).is_none());
        let bad = vec![Point::origin(), Point::new(1., 0., 0.), Point::new(f64::NAN, 1., 0.)];
        assert!(Polygon::new(bad).is_none());
    }
}
