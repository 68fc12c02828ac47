//! Weak: the missing edges of a face are completed to a square (paper, Fig. 4).
//!
//! The known edges are chained end to end. The square stands on the line that
//! joins the chain's free ends; chain and square together are the face. With
//! one edge the chain is that line.

use super::{Prediction, positive};
use crate::geometry::{Edge, Point, Polygon, Vector};
use crate::primitives::Arguments;
use crate::rules::BadArgument;

/// Ends of neighbouring edges meet within this share of the shorter edge.
const GAP: f64 = 0.25;

pub(super) fn predict(arguments: &Arguments) -> Result<Option<Prediction>, BadArgument> {
    let (edges, facing) = (arguments.edges("edges")?, arguments.direction("facing")?);
    Ok(Prediction::of(completed(&edges, &facing)))
}

fn completed(edges: &[Edge], facing: &Vector) -> Option<Polygon> {
    let facing = facing.try_normalize(1e-9).filter(|f| f.norm().is_finite())?;
    let chain = chained(edges)?;
    let (first, last) = (*chain.first()?, *chain.last()?);
    let base = last - first;
    if !positive(base.norm()) {
        return (chain.len() > 3).then(|| Polygon::new(chain).map(|p| p.facing(&facing)))?;
    }
    let aside = away_from_chain(&chain, &facing).or_else(|| into_object(edges.first()?, &facing))? * base.norm();
    let corners = chain.into_iter().chain([last + aside, first + aside]).collect();
    Polygon::new(corners).map(|p| p.facing(&facing))
}

/// Unit direction at right angles to the joining line, in the plane of a bent
/// chain, away from it. `None` for a straight one.
fn away_from_chain(chain: &[Point], facing: &Vector) -> Option<Vector> {
    let (first, last) = (*chain.first()?, *chain.last()?);
    let line = (last - first).try_normalize(1e-9)?;
    let middle = chain.iter().map(|p| p - first).sum::<Vector>() / chain.len() as f64;
    let bend = middle - line * middle.dot(&line);
    let plane_faces = line.cross(&bend).dot(facing).abs();
    (bend.norm() > 0.01 * (last - first).norm() && positive(plane_faces)).then(|| -bend.normalize())
}

/// Unit direction at right angles to an edge and to `facing`, against the
/// measured face's normal: where the object is.
fn into_object(edge: &Edge, facing: &Vector) -> Option<Vector> {
    let aside = facing.cross(&edge.direction()).try_normalize(1e-6)?;
    let outward = aside.dot(&edge.face_normal);
    positive(outward.abs()).then(|| if outward > 0.0 { -aside } else { aside })
}

/// The edges' points in order, joined where ends meet; `None` where they do not.
fn chained(edges: &[Edge]) -> Option<Vec<Point>> {
    let (first, rest) = edges.split_first()?;
    if !edges.iter().all(|e| positive(e.length())) {
        return None;
    }
    let mut chain = vec![first.start, first.end];
    let mut rest: Vec<Edge> = rest.to_vec();
    while !rest.is_empty() {
        let found = rest.iter().position(|e| attach(&mut chain, e))?;
        rest.remove(found);
    }
    Some(chain)
}

/// Puts an edge at either end of the chain, if one of its ends meets it there.
fn attach(chain: &mut Vec<Point>, edge: &Edge) -> bool {
    let (Some(&first), Some(&last)) = (chain.first(), chain.last()) else {
        return false;
    };
    let gap = GAP * edge.length().min((chain[1] - first).norm());
    let meets = |a: &Point, b: &Point| (a - b).norm() <= gap;
    if meets(&last, &edge.start) {
        chain.push(edge.end);
    } else if meets(&last, &edge.end) {
        chain.push(edge.start);
    } else if meets(&first, &edge.end) {
        chain.insert(0, edge.start);
    } else if meets(&first, &edge.start) {
        chain.insert(0, edge.end);
    } else {
        return false;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edge(start: [f64; 3], end: [f64; 3], face_normal: Vector) -> Edge {
        Edge {
            start: Point::from(start),
            end: Point::from(end),
            face_normal,
        }
    }

    #[test]
    fn under_one_side_the_bottom_reaches_into_the_object() {
        // The foot of a side that faces +y.
        let foot = edge([1., 1., 0.], [0., 1., 0.], Vector::y());
        let square = completed(&[foot], &-Vector::z()).unwrap();
        assert!((square.centre() - Point::new(0.5, 0.5, 0.0)).norm() < 1e-12);
        assert!((square.area() - 1.0).abs() < 1e-12);
        assert!((square.normal() + Vector::z()).norm() < 1e-12);
    }

    #[test]
    fn on_two_edges_the_square_stands_on_the_line_of_their_free_ends() {
        // Fig. 4: v3 = (1,0,0), v2 = (0,0,0), v8 = (0,1,0): the triangle
        // (area ½) and the square on its diagonal (area 2), away from v2.
        let up = Vector::z();
        let known = [
            edge([1., 0., 0.], [0., 0., 0.], up),
            edge([0., 0., 0.], [0., 1., 0.], up),
        ];
        let face = completed(&known, &up).unwrap();
        assert_eq!(face.vertices().len(), 5);
        assert!((face.area() - 2.5).abs() < 1e-12);
        let has = |p: [f64; 3]| face.vertices().iter().any(|v| (v - Point::from(p)).norm() < 1e-12);
        assert!(has([2., 1., 0.]) && has([1., 2., 0.]));
        assert!((face.normal() - up).norm() < 1e-12);
    }

    #[test]
    fn the_order_and_direction_of_the_known_edges_do_not_matter() {
        let up = Vector::z();
        let (a, b) = (
            edge([1., 0., 0.], [0., 0., 0.], up),
            edge([0., 1., 0.], [0., 0., 0.], up),
        );
        let one = completed(&[a, b], &up).unwrap();
        let other = completed(&[b, a], &up).unwrap();
        assert!((one.area() - other.area()).abs() < 1e-12);
        assert!((one.centre() - other.centre()).norm() < 1e-12);
    }

    #[test]
    fn edges_that_do_not_meet_or_face_along_themselves_predict_nothing() {
        let (a, b) = (
            edge([0., 0., 0.], [1., 0., 0.], Vector::y()),
            edge([5., 0., 0.], [6., 0., 0.], Vector::y()),
        );
        assert_eq!(completed(&[a, b], &Vector::z()), None);
        assert_eq!(completed(&[a], &Vector::x()), None);
        assert_eq!(completed(&[], &Vector::z()), None);
        assert_eq!(completed(&[a], &Vector::new(f64::NAN, 0., 0.)), None);
        // Facing as the measured face does: the object's side is not known.
        assert_eq!(completed(&[a], &Vector::y()), None);
    }
}
