//! A face of known place, and an edge of a face.

use crate::geometry::{Edge, Point, Polygon};
use crate::primitives::{Arguments, Datum};
use crate::rules::{BadArgument, Value};

pub(super) fn polygon(arguments: &Arguments) -> Result<Option<Polygon>, BadArgument> {
    Ok(Polygon::new(corners(arguments)?))
}

fn corners(arguments: &Arguments) -> Result<Vec<Point>, BadArgument> {
    let point = |datum: &Datum| match datum {
        Datum::Constant(Value::Point(p)) => Some(*p),
        _ => None,
    };
    match arguments.0.get("corners") {
        Some(Datum::List(items)) => items.iter().map(point).collect(),
        _ => None,
    }
    .ok_or_else(|| BadArgument::new("corners", "a list of points"))
}

/// `None` where the face has no such edge.
pub(super) fn edge(arguments: &Arguments) -> Result<Option<Edge>, BadArgument> {
    let (face, number) = (arguments.polygon("face")?, arguments.count("number")?);
    let known = 1..=face.vertices().len() as u64;
    Ok(known.contains(&number).then(|| face.edge(number as usize - 1)))
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::{arguments, bottom};
    use super::*;

    #[test]
    fn the_first_edge_runs_from_the_first_corner_to_the_second() {
        let number = |n| Datum::Constant(Value::Count(n));
        let of = |n| edge(&arguments([("face", Datum::Polygon(bottom())), ("number", number(n))])).unwrap();
        let first = of(1).unwrap();
        assert_eq!(
            (first.start, first.end),
            (bottom().vertices()[0], bottom().vertices()[1])
        );
        assert!(of(4).is_some());
        assert_eq!((of(0), of(5)), (None, None));
    }

    #[test]
    fn corners_on_a_line_are_no_face() {
        let at = |x: f64| Datum::Constant(Value::Point(Point::new(x, 0.0, 0.0)));
        let line = Datum::List(vec![at(0.0), at(1.0), at(2.0)]);
        assert_eq!(polygon(&arguments([("corners", line)])), Ok(None));
    }
}
