//! What the expressions of facts stand for, and how that is said.

use super::words::{degrees, metres, number, percent};
use crate::geometry::{Camera, Edge, Intrinsics, Point, Polygon, Pose, Vector, axis_word};
use crate::plan::{constant, constant_arguments};
use crate::predict;
use crate::primitives::{self, Datum, Type};
use crate::rules::{Call, Expr, Space, Value};

/// A value that two sides of a fact are compared by.
#[derive(Debug)]
pub(super) enum Known {
    /// A constant: a quantity, a point, a direction, a text, …
    Constant(Value),
    /// A face, or the faces that a predictor gives.
    Faces(Vec<Polygon>),
    /// Edges.
    Edges(Vec<Edge>),
    /// Candidate views about a space at the origin.
    Views(Vec<Pose>),
    Camera(Box<Camera>),
    List(Vec<Known>),
    /// What only a measurement gives a meaning: a detector, a measure, a shape.
    Call(Call),
}

/// What an expression stands for, or why it stands for nothing.
pub(super) fn known(expr: &Expr) -> Result<Known, String> {
    let Expr::Call(call) = expr else {
        let datum = constant(expr).map_err(|e| e.to_string())?;
        return datum.map(of_datum).ok_or_else(|| "this has no value".to_owned());
    };
    let result = primitives::find(&call.primitive).map(|p| p.result);
    match result {
        Some(Type::Predictor) => predicted(call),
        Some(Type::Views) => primitives::poses(call, &SPACE)
            .map(Known::Views)
            .map_err(|e| e.to_string()),
        Some(Type::Camera) => primitives::camera(call)
            .map(|c| Known::Camera(Box::new(c)))
            .map_err(|e| e.to_string()),
        Some(Type::Point | Type::Polygon | Type::Edge) => match constant(expr).map_err(|e| e.to_string())? {
            Some(datum) => Ok(of_datum(datum)),
            None => Err(format!("`{}` has no value for these arguments", call.primitive)),
        },
        _ => Ok(Known::Call(call.clone())),
    }
}

/// Views stand about the centre of a space: here, the origin.
const SPACE: Space = Space {
    centre: Point::new(0.0, 0.0, 0.0),
    size: Vector::new(1.0, 1.0, 1.0),
    voxel: 0.01,
};

fn predicted(call: &Call) -> Result<Known, String> {
    let arguments = constant_arguments(call).map_err(|e| e.to_string())?;
    let prediction = match arguments {
        Some(arguments) => predict::predict(&call.primitive, &arguments).map_err(|e| e.to_string())?,
        None => None,
    };
    let nothing = || format!("`{}` predicts nothing from these arguments", call.primitive);
    prediction.map(|p| Known::Faces(p.polygons)).ok_or_else(nothing)
}

fn of_datum(datum: Datum) -> Known {
    match datum {
        Datum::Constant(value) => Known::Constant(value),
        Datum::Edge(edge) => Known::Edges(vec![edge]),
        Datum::Edges(edges) => Known::Edges(edges),
        Datum::Polygon(face) => Known::Faces(vec![face]),
        Datum::List(items) => Known::List(items.into_iter().map(of_datum).collect()),
    }
}

/// The number of parts: views, faces (of a single face: corners), edges, elements.
pub(super) fn count(known: &Known) -> u64 {
    let n = match known {
        Known::Faces(faces) => match faces.as_slice() {
            [one] => one.vertices().len(),
            faces => faces.len(),
        },
        Known::Edges(edges) => edges.len(),
        Known::Views(poses) => poses.len(),
        Known::List(items) => items.len(),
        Known::Constant(_) | Known::Camera(_) | Known::Call(_) => 1,
    };
    n as u64
}

/// A value in words.
pub(super) fn describe(known: &Known) -> String {
    match known {
        Known::Constant(value) => constant_in_words(value),
        Known::Faces(faces) => match faces.as_slice() {
            [one] => face(one),
            faces => format!("{} faces", faces.len()),
        },
        Known::Edges(edges) => match edges.as_slice() {
            [one] => format!("the edge from {} to {}", point(&one.start), point(&one.end)),
            edges => format!("{} edges", edges.len()),
        },
        Known::Views(poses) => format!("{} views", poses.len()),
        Known::Camera(camera) => camera_in_words(camera),
        Known::List(items) => format!("a list of {}", items.len()),
        Known::Call(call) => call_in_words(call),
    }
}

/// A face by its corners.
pub(super) fn face(face: &Polygon) -> String {
    const MOST: usize = 8;
    let corners: Vec<String> = face.vertices().iter().take(MOST).map(point).collect();
    let more = if face.vertices().len() > MOST { ", …" } else { "" };
    format!("polygon([{}{more}])", corners.join(", "))
}

/// A print by its place, as facts write it.
pub(super) fn print(face: &Polygon) -> String {
    format!("at {} facing {}", point(&face.centre()), direction(&face.normal()))
}

fn direction(v: &Vector) -> String {
    let numbers = || format!("[{}, {}, {}]", number(v.x), number(v.y), number(v.z));
    axis_word(v).map_or_else(numbers, str::to_owned)
}

fn point(p: &Point) -> String {
    format!("[{}, {}, {}]", metres(p.x), metres(p.y), metres(p.z))
}

fn constant_in_words(value: &Value) -> String {
    match value {
        Value::Length(x) => metres(*x),
        Value::Angle(x) => degrees(*x),
        Value::Share(x) => percent(*x),
        Value::Time(x) => format!("{} s", number(*x)),
        Value::Number(x) => number(*x),
        Value::Count(n) => n.to_string(),
        Value::Colour(colour) => colour.to_string(),
        Value::Text(text) => format!("\"{text}\""),
        Value::Direction(v) => direction(v),
        Value::Point(p) => point(p),
        Value::Pose(pose) => format!("a pose at {}", point(&pose.translation.vector.into())),
        Value::Choice(word) => word.clone(),
    }
}

fn camera_in_words(camera: &Camera) -> String {
    let image = |i: &Intrinsics| {
        let field = |side: u32, focal: f64| degrees(2.0 * (f64::from(side) / 2.0 / focal).atan());
        let (across, up) = (field(i.width, i.fx), field(i.height, i.fy));
        format!("{} × {} of {across} × {up}", i.width, i.height)
    };
    format!(
        "a camera with depth {} and colour {}, {} to {}",
        image(&camera.depth),
        image(&camera.colour),
        metres(camera.range.min),
        metres(camera.range.max)
    )
}

fn call_in_words(call: &Call) -> String {
    let argument = |(name, value): (&String, &Expr)| match value {
        Expr::Value(value) => format!("{name}: {}", constant_in_words(value)),
        _ => format!("{name}: …"),
    };
    let arguments: Vec<String> = call.arguments.iter().map(argument).collect();
    format!("{}({})", call.primitive, arguments.join(", "))
}
