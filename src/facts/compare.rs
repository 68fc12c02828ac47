//! How far two values lie apart; `None` where no distance makes sense.

use super::values::Known;
use super::words::{degrees, metres};
use crate::geometry::{Camera, Edge, Intrinsics, Polygon, Pose};
use crate::rules::Value;

/// The distance of two values in the SI unit of their kind: metres for places.
pub(super) fn apart(a: &Known, b: &Known) -> Option<f64> {
    match (a, b) {
        (Known::Constant(a), Known::Constant(b)) => constants(a, b),
        (Known::Faces(a), Known::Faces(b)) => pairs(a, b, faces_apart),
        (Known::Edges(a), Known::Edges(b)) => pairs(a, b, |a, b| Some(edges(a, b))),
        (Known::Views(a), Known::Views(b)) => pairs(a, b, |a, b| Some(eyes(a, b))),
        (Known::List(a), Known::List(b)) => pairs(a, b, apart),
        (Known::Camera(a), Known::Camera(b)) => cameras(a, b).then_some(0.0),
        (Known::Call(a), Known::Call(b)) => (a == b).then_some(0.0),
        _ => None,
    }
}

/// The distance in words, where it is one in space.
pub(super) fn distance(of: &Known, apart: f64) -> Option<String> {
    match of {
        Known::Faces(_) | Known::Edges(_) | Known::Constant(Value::Point(_)) => {
            Some(format!("they lie {} apart", metres(apart)))
        }
        Known::Views(_) => Some(format!("two of them stand {} apart", metres(apart))),
        Known::Constant(Value::Direction(_)) => Some(format!("they point {} apart", degrees(apart))),
        _ => None,
    }
}

/// The largest distance of corners that belong together, whichever corner comes
/// first; `None` for another number of corners.
pub(super) fn faces_apart(a: &Polygon, b: &Polygon) -> Option<f64> {
    let (a, b) = (a.vertices(), b.vertices());
    let n = a.len();
    let turned = |first: usize| {
        let corners = (0..n).map(|k| (a[k] - b[(k + first) % n]).norm());
        corners.fold(0.0, f64::max)
    };
    (n == b.len()).then(|| (0..n).map(turned).fold(f64::INFINITY, f64::min))
}

fn pairs<T>(a: &[T], b: &[T], apart: impl Fn(&T, &T) -> Option<f64>) -> Option<f64> {
    if a.len() != b.len() {
        return None;
    }
    let distances: Option<Vec<f64>> = a.iter().zip(b).map(|(a, b)| apart(a, b)).collect();
    distances.map(|d| d.into_iter().fold(0.0, f64::max))
}

fn edges(a: &Edge, b: &Edge) -> f64 {
    (a.start - b.start).norm().max((a.end - b.end).norm())
}

fn eyes(a: &Pose, b: &Pose) -> f64 {
    (a.translation.vector - b.translation.vector).norm()
}

fn constants(a: &Value, b: &Value) -> Option<f64> {
    match (a, b) {
        (Value::Length(a), Value::Length(b))
        | (Value::Angle(a), Value::Angle(b))
        | (Value::Share(a), Value::Share(b))
        | (Value::Time(a), Value::Time(b))
        | (Value::Number(a), Value::Number(b)) => Some((a - b).abs()),
        (Value::Count(a), Value::Count(b)) => Some(a.abs_diff(*b) as f64),
        (Value::Point(a), Value::Point(b)) => Some((a - b).norm()),
        (Value::Direction(a), Value::Direction(b)) => Some(a.angle(b)),
        (a, b) => (a == b).then_some(0.0),
    }
}

/// Units convert to the same number up to the last bits.
fn cameras(a: &Camera, b: &Camera) -> bool {
    let image = |i: &Intrinsics| [f64::from(i.width), f64::from(i.height), i.fx, i.fy, i.cx, i.cy];
    let all = |c: &Camera| {
        [image(&c.depth), image(&c.colour)]
            .concat()
            .into_iter()
            .chain([c.range.min, c.range.max])
    };
    let close = |(a, b): (f64, f64)| (a - b).abs() <= 1e-9 * a.abs().max(b.abs());
    all(a).zip(all(b)).all(close)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;

    fn square(x: f64) -> Vec<Point> {
        [(0., 0.), (1., 0.), (1., 1.), (0., 1.)]
            .map(|(u, v)| Point::new(x + u, v, 0.0))
            .to_vec()
    }

    #[test]
    fn a_face_is_the_same_whichever_corner_comes_first_but_not_turned_over() {
        let face = |points| Polygon::new(points).unwrap();
        let one = face(square(0.0));
        let turned = one.clone().beginning_at(2);
        assert_eq!(faces_apart(&one, &turned), Some(0.0));
        let mut over = square(0.0);
        over.reverse();
        assert_eq!(faces_apart(&one, &face(over)), Some(1.0));
        let moved = faces_apart(&one, &face(square(0.25))).unwrap();
        assert!((moved - 0.25).abs() < 1e-12);
        let triangle = face(square(0.0)[..3].to_vec());
        assert_eq!(faces_apart(&one, &triangle), None);
    }

    #[test]
    fn values_of_two_kinds_have_no_distance() {
        let known = |v| Known::Constant(v);
        assert_eq!(apart(&known(Value::Length(1.0)), &known(Value::Angle(1.0))), None);
        assert_eq!(apart(&known(Value::Count(3)), &known(Value::Count(5))), Some(2.0));
        assert_eq!(
            apart(&known(Value::Text("a".into())), &known(Value::Text("b".into()))),
            None
        );
        assert_eq!(
            apart(&Known::Views(vec![]), &Known::Views(vec![Pose::identity()])),
            None
        );
    }
}
