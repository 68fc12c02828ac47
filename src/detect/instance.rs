//! Measured attributes, and when two measurements are of one instance.

use crate::geometry::{Edge, Point, Polygon, Pose};

/// The attributes of a measured instance.
#[derive(Clone, Debug, PartialEq)]
pub enum Measurement {
    /// A planar face.
    Face(Polygon),
    /// A marker.
    Marker {
        /// `world_from_marker`: x right, y up on the print, z out of it.
        pose: Pose,
        /// Edge of the square of modules, metres.
        size: f64,
    },
    /// The faces of a rough shape.
    Shell(Vec<Polygon>),
}

/// Most angle between the normals of one instance.
const TURNED_COSINE: f64 = 0.9659; // 15°
/// Share of the smaller polygon that must be common.
const OVERLAP: f64 = 0.5;
/// Samples along the shorter extent of a polygon when overlap is measured.
const SAMPLES: f64 = 24.0;
/// Most samples along the longest edge, for a face that is no more than a line.
const MOST_SAMPLES: f64 = 4096.0;

impl Measurement {
    /// Whether two measurements are of one instance: the polygons overlap by
    /// half of the smaller within 2 ξ (`near`, metres) and 15°. A marker
    /// counts as its square; shells pair their faces in order.
    pub fn same_instance(&self, other: &Measurement, near: f64) -> bool {
        let (mine, theirs) = (self.faces(), other.faces());
        let one_kind = std::mem::discriminant(self) == std::mem::discriminant(other);
        one_kind && mine.len() == theirs.len() && mine.iter().zip(&theirs).all(|(a, b)| same_face(a, b, near))
    }

    /// Whether an antecedent moved so far that predictions from it must be
    /// made anew: an outline (of the marker: its square) by more than
    /// `distance` metres anywhere.
    pub fn moved(&self, from: &Measurement, distance: f64) -> bool {
        if let (Self::Marker { pose, .. }, Self::Marker { pose: before, .. }) = (self, from) {
            return (pose.translation.vector - before.translation.vector).norm() > distance;
        }
        let (now, before) = (self.faces(), from.faces());
        let same = now.len() == before.len()
            && now
                .iter()
                .zip(&before)
                .all(|(a, b)| strays(a, b) <= distance && strays(b, a) <= distance);
        !same
    }

    /// Its faces; of a marker the square of modules.
    pub fn faces(&self) -> Vec<Polygon> {
        match self {
            Self::Face(polygon) => vec![polygon.clone()],
            Self::Shell(faces) => faces.clone(),
            Self::Marker { pose, size } => Polygon::square(pose, *size).into_iter().collect(),
        }
    }
}

fn same_face(a: &Polygon, b: &Polygon, near: f64) -> bool {
    let (small, large) = if a.area() <= b.area() { (a, b) } else { (b, a) };
    if small.normal().dot(&large.normal()) < TURNED_COSINE {
        return false;
    }
    let longest = small.edges().iter().map(Edge::length).fold(0.0, f64::max);
    let spacing = (small.area().sqrt() / SAMPLES).max(longest / MOST_SAMPLES);
    let samples = small.samples(spacing);
    let common = samples
        .iter()
        .filter(|p| large.height_of(p).abs() <= 2.0 * near && large.contains_projection(p));
    common.count() as f64 >= OVERLAP * samples.len() as f64
}

/// Largest distance of a vertex of `a` to the outline of `b`, metres.
fn strays(a: &Polygon, b: &Polygon) -> f64 {
    let edges = b.edges();
    let distance = |p: &Point| edges.iter().map(|e| e.distance(p)).fold(f64::INFINITY, f64::min);
    a.vertices().iter().map(distance).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;

    fn rectangle(x: f64, width: f64, z: f64) -> Measurement {
        let at = |u: f64, v: f64| Point::new(u, v, z);
        let corners = vec![at(x, 0.0), at(x + width, 0.0), at(x + width, 0.2), at(x, 0.2)];
        Measurement::Face(Polygon::new(corners).unwrap())
    }

    #[test]
    fn an_instance_overlaps_by_half_of_the_smaller() {
        let face = rectangle(0.0, 0.3, 0.0);
        assert!(face.same_instance(&rectangle(0.25, 0.09, 0.005), 0.01));
        assert!(!face.same_instance(&rectangle(0.25, 0.2, 0.0), 0.01));
        assert!(!face.same_instance(&rectangle(0.0, 0.3, 0.025), 0.01));
        let marker = Measurement::Marker {
            pose: Pose::identity(),
            size: 0.2,
        };
        assert!(!face.same_instance(&marker, 0.01));
    }

    #[test]
    fn a_vertex_more_on_a_straight_edge_is_no_move() {
        let at = |u: f64, v: f64| Point::new(u, v, 0.0);
        let split = vec![at(0.0, 0.0), at(0.1, 0.0), at(0.3, 0.0), at(0.3, 0.2), at(0.0, 0.2)];
        let split = Measurement::Face(Polygon::new(split).unwrap());
        assert!(!split.moved(&rectangle(0.0, 0.3, 0.0), 0.001));
        assert!(rectangle(0.0, 0.31, 0.0).moved(&split, 0.005));
    }

    #[test]
    fn a_marker_moves_with_its_centre() {
        let at = |x: f64| Measurement::Marker {
            pose: Pose::new(Vector::new(x, 0.0, 0.0), Vector::zeros()),
            size: 0.2,
        };
        assert!(at(0.02).moved(&at(0.0), 0.01));
        assert!(!at(0.005).moved(&at(0.0), 0.01));
        assert!(at(0.02).same_instance(&at(0.0), 0.01));
    }
}
