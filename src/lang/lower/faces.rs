//! Written faces: their corners, and what is wrong with them.

use crate::geometry::{Point, Polygon, Vector};
use crate::predict;
use crate::primitives::{Arguments, Datum, MOST_CORNERS};
use crate::rules::{Call, Expr, Value};

/// How far a corner may lie off the plane of the others, over the face's extent.
const UNEVEN: f64 = 0.01;

/// Least area of a face, over its extent squared.
const NEEDLE: f64 = 1e-6;

/// The corners of a `polygon` call; `None` where some are not known before the robot moves.
pub(super) fn corners(call: &Call) -> Option<Vec<Point>> {
    let Some(Expr::List(items)) = call.arguments.get("corners") else {
        return None;
    };
    let point = |e: &Expr| match e {
        Expr::Value(Value::Point(p)) => Some(*p),
        _ => None,
    };
    items.iter().map(point).collect()
}

/// Whether a call is a face whose corners are all known.
pub(super) fn is_written(call: &Call) -> bool {
    call.primitive == "polygon" && corners(call).is_some()
}

/// An attribute of a written face.
pub(super) fn attribute(call: &Call, name: &str) -> Option<Expr> {
    let face = Polygon::new(corners(call)?)?;
    let edge = |number: usize| {
        let arguments = [
            ("face".to_owned(), Expr::Call(call.clone())),
            ("number".to_owned(), Expr::Value(Value::Count(number as u64))),
        ];
        Expr::Call(Call {
            primitive: "edge_of".to_owned(),
            arguments: arguments.into(),
        })
    };
    Some(match name {
        "edges" => Expr::List((1..=face.vertices().len()).map(edge).collect()),
        "base" => edge(1),
        "apex" => Expr::Value(Value::Point(face.apex().0)),
        "height" => Expr::Value(Value::Length(face.apex().1)),
        "centre" => Expr::Value(Value::Point(face.centre())),
        "normal" => Expr::Value(Value::Direction(face.normal())),
        _ => return None,
    })
}

/// The face that a predictor gives; `None` where it gives none or several, or one of its
/// arguments is not known.
pub(super) fn predicted(call: &Call) -> Option<Polygon> {
    let prediction = predict::predict(&call.primitive, &arguments(call)?).ok()??;
    match <[Polygon; 1]>::try_from(prediction.polygons) {
        Ok([face]) => Some(face),
        Err(_) => None,
    }
}

fn arguments(call: &Call) -> Option<Arguments> {
    let known = call.arguments.iter().map(|(name, e)| Some((name.clone(), datum(e)?)));
    known.collect::<Option<_>>().map(Arguments)
}

/// What an expression of constants stands for.
fn datum(e: &Expr) -> Option<Datum> {
    match e {
        Expr::Value(value) => Some(Datum::Constant(value.clone())),
        Expr::List(items) => items.iter().map(datum).collect::<Option<_>>().map(Datum::List),
        Expr::Call(call) => predict::value(&call.primitive, &arguments(call)?).ok()?,
        _ => None,
    }
}

/// What is wrong with a `polygon` call.
pub(super) fn check_polygon(call: &Call) -> Option<String> {
    let Some(Expr::List(items)) = call.arguments.get("corners") else {
        return None;
    };
    if !(3..=MOST_CORNERS).contains(&items.len()) {
        return Some(format!(
            "a face has 3 to {MOST_CORNERS} corners, and here are {}",
            items.len()
        ));
    }
    let corners = corners(call)?;
    let Some(face) = Polygon::new(corners) else {
        return Some("these corners span no face: they lie on one line".into());
    };
    let (middle, extent) = middle_and_extent(face.vertices());
    if face.area() < NEEDLE * extent * extent {
        return Some("these corners span no face: they lie almost on one line".into());
    }
    let off = |p: &Point| (p - middle).dot(&face.normal()).abs();
    let (number, worst) =
        (1..).zip(face.vertices()).fold(
            (0, 0.0),
            |(n, most), (k, p)| {
                if off(p) > most { (k, off(p)) } else { (n, most) }
            },
        );
    (worst > UNEVEN * extent).then(|| {
        let millimetres = (worst * 1e4).round() / 10.0;
        format!("this face is not planar: corner {number} lies {millimetres} mm off the plane of all")
    })
}

/// The mean of the corners, and the farthest that one lies from it.
fn middle_and_extent(corners: &[Point]) -> (Point, f64) {
    let sum: Vector = corners.iter().map(|p| p.coords).sum();
    let middle = Point::from(sum / corners.len().max(1) as f64);
    let extent = corners.iter().map(|p| (p - middle).norm()).fold(0.0, f64::max);
    (middle, extent)
}

/// What is wrong with an `edge_of` call.
pub(super) fn check_edge(call: &Call) -> Option<String> {
    let number = call.count("number").ok()?;
    let edges = match call.arguments.get("face") {
        Some(Expr::Call(face)) if face.primitive == "polygon" => corners(face)?.len() as u64,
        _ => u64::MAX,
    };
    match number {
        0 => Some("edges are numbered from 1".into()),
        n if n > edges => Some(format!("edge {n} of a face that has {edges}")),
        _ => None,
    }
}
