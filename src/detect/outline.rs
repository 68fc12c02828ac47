//! `outline`: from the points of a face to its ordered vertices and normal.

use nalgebra::Point2;

use super::contour::{Coarseness, corners};
use super::evidence::FaceEvidence;
use super::join::WIDEST_GAP;
use super::mask::Mask;
use super::plane_fit::robust_plane;
use crate::geometry::{Edge, Point, Polygon, Vector, frame_facing};

/// What the order of vertices begins with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Begin {
    /// A vertex that depends on nothing but the outline.
    Any,
    /// The base: the edge with the lowest midpoint, or the one nearest to a given edge.
    Base,
    /// The vertex farthest from the base.
    Apex,
}

/// Fewest points of a face that has an outline.
const LEAST_POINTS: usize = 12;
/// Edge of a raster cell in units of the spacing of points.
const CELL: f64 = 1.5;
/// Most cells along a side of the raster.
const MOST_CELLS: f64 = 1500.0;
/// No coordinate axis of a usual object is perpendicular to this direction, so
/// the vertex farthest along it is the same one in every view.
const GENERIC: [f64; 3] = [0.79, 0.43, 0.29];

/// The outline of a face, counter-clockwise about its outward normal; `None`
/// where the evidence spans no polygon.
///
/// `first` is the edge of another face: the base is then the edge nearest to it.
pub fn outline(evidence: &FaceEvidence, begin: Begin, first: Option<&Edge>) -> Option<Polygon> {
    if evidence.points.len() < LEAST_POINTS {
        return None;
    }
    let fit = robust_plane(evidence.points.iter())?;
    let outward = if fit.plane.normal.dot(&evidence.outward) < 0.0 {
        -fit.plane.normal
    } else {
        fit.plane.normal
    };
    let middle = middle(&evidence.points);
    let foot = middle - fit.plane.normal * fit.plane.distance(&middle);
    let world_from_face = frame_facing(foot, outward);
    let flat: Vec<Point2<f64>> = evidence
        .points
        .iter()
        .map(|p| world_from_face.inverse_transform_point(p).xy())
        .collect();
    let cell = evidence.spacing * CELL;
    let contour = traced(&flat, cell, evidence.grain)?;
    let coarseness = Coarseness {
        tolerance: 1.2 * evidence.grain + 0.5 * cell,
        shortest: 3.0 * evidence.grain + cell,
    };
    let found = corners(&contour, coarseness);
    let vertices = found
        .iter()
        .map(|p| world_from_face * Point::new(p.x, p.y, 0.0))
        .collect();
    let polygon = Polygon::new(vertices)?.facing(&outward);
    Some(ordered(polygon, begin, first))
}

fn middle(points: &[Point]) -> Point {
    Point::from(points.iter().map(|p| p.coords).sum::<Vector>() / points.len().max(1) as f64)
}

/// The outer contour of the cover, metres in the face's axes.
fn traced(flat: &[Point2<f64>], cell: f64, grain: f64) -> Option<Vec<Point2<f64>>> {
    let low = flat
        .iter()
        .fold(Point2::new(f64::INFINITY, f64::INFINITY), |a, p| a.inf(p));
    let high = flat
        .iter()
        .fold(Point2::new(f64::NEG_INFINITY, f64::NEG_INFINITY), |a, p| a.sup(p));
    let margin = (WIDEST_GAP / cell).ceil() + 2.0;
    let size = (high - low) / cell + nalgebra::Vector2::repeat(2.0 * margin + 1.0);
    if !(size.x < MOST_CELLS && size.y < MOST_CELLS) {
        return None;
    }
    let mut mask = Mask::new(size.x as usize + 1, size.y as usize + 1);
    for p in flat {
        let at = (p - low) / cell;
        mask.set((at.x + margin) as usize, (at.y + margin) as usize);
    }
    let closing = (0.75 * grain / cell).max(1.5);
    let face = mask.closed(closing).bridged(WIDEST_GAP / cell).largest();
    let corners = face.contour();
    let metres = |(x, y): &(f64, f64)| low + nalgebra::Vector2::new(x - margin, y - margin) * cell;
    // Midpoints of cell sides lie closer to the true border than their ends.
    let points: Vec<Point2<f64>> = corners.iter().map(metres).collect();
    Some(
        (0..points.len())
            .map(|k| nalgebra::center(&points[k], &points[(k + 1) % points.len()]))
            .collect(),
    )
}

/// The polygon with its vertices rotated as asked.
fn ordered(polygon: Polygon, begin: Begin, first: Option<&Edge>) -> Polygon {
    let base = base_edge(&polygon, first);
    let start = match (begin, first) {
        (Begin::Any, None) => farthest(&polygon, |p| p.coords.dot(&Vector::from(GENERIC))),
        (Begin::Base, _) | (Begin::Any, Some(_)) => base,
        (Begin::Apex, _) => {
            let edge = polygon.edge(base);
            farthest(&polygon, |p| (p - edge.start).cross(&edge.direction()).norm())
        }
    };
    polygon.beginning_at(start)
}

fn farthest(polygon: &Polygon, measure: impl Fn(&Point) -> f64) -> usize {
    let v = polygon.vertices();
    (0..v.len())
        .max_by(|&a, &b| measure(&v[a]).total_cmp(&measure(&v[b])))
        .unwrap_or(0)
}

fn base_edge(polygon: &Polygon, first: Option<&Edge>) -> usize {
    let edges = polygon.edges();
    let cost = |edge: &Edge| match first {
        Some(f) => f.distance(&edge.midpoint()) + f.distance(&edge.start) + f.distance(&edge.end),
        None => edge.midpoint().z,
    };
    (0..edges.len())
        .min_by(|&a, &b| cost(&edges[a]).total_cmp(&cost(&edges[b])))
        .unwrap_or(0)
}
