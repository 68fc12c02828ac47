//! Ranges of the constants that primitives take.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::expand::Expanded;
use super::faces;
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::source::Span;
use crate::primitives::{self, Primitive, Type};
use crate::rules::{Call, Expr, Value};

/// Longest length, metres.
const MOST_METRES: f64 = 1e5;
/// Most views of a task.
const MOST_VIEWS: u64 = primitives::MOST_VIEWS;

/// What is wrong with a constant argument.
pub(super) fn check(primitive: &Primitive, name: &str, given: &Expanded) -> Option<Diagnostic> {
    match &given.expr {
        Expr::List(items) => items.iter().find_map(|item| one(primitive, name, item, given.span)),
        expr => one(primitive, name, expr, given.span),
    }
}

fn one(primitive: &Primitive, name: &str, expr: &Expr, span: Span) -> Option<Diagnostic> {
    let Expr::Value(value) = expr else {
        return None;
    };
    let expected = out_of_range(primitive, name, value)?;
    let message = format!("`{name}` of `{}` is out of range", primitive.name);
    Some(Diagnostic::new(Code::E0309, span, message).help(format!("`{name}` is {expected}")))
}

/// What a constant should be, where it is not.
fn out_of_range(primitive: &Primitive, name: &str, value: &Value) -> Option<String> {
    let right = |right: bool, expected: &str| (!right).then(|| expected.to_owned());
    match (primitive.name, name, value) {
        ("behind", "depth", Value::Length(x)) => right(x.abs() <= MOST_METRES, "at most 100 km"),
        (_, _, Value::Length(x)) => right(0.0 < *x && *x <= MOST_METRES, "above 0 m and at most 100 km"),
        (_, "dihedral", Value::Angle(a)) => right(0.0 < *a && *a < TAU, "above 0 deg and below 360 deg"),
        (_, "within", Value::Angle(a)) => right(0.0 < *a && *a <= FRAC_PI_2, "above 0 deg and at most 90 deg"),
        (_, "elevation" | "lean" | "taper", Value::Angle(a)) => {
            right(a.abs() < FRAC_PI_2, "between -90 deg and 90 deg")
        }
        (_, _, Value::Share(s)) => right((0.0..=1.0).contains(s), "between 0 % and 100 %"),
        (_, "stretch", Value::Number(x)) => right(0.01 <= *x && *x <= 100.0, "between 0.01 and 100"),
        (_, "sides", Value::Count(n)) => right((3..=12).contains(n), "between 3 and 12"),
        (_, "side", Value::Count(n)) => right(*n <= 12, "between 0 (the bottom) and the number of sides"),
        (_, "count", Value::Count(n)) if primitive.result == Type::Views => {
            let expected = format!("between 1 and {MOST_VIEWS}");
            right((1..=MOST_VIEWS).contains(n), &expected)
        }
        (_, _, Value::Text(text)) => right(!text.is_empty(), "a text that is not empty"),
        _ => None,
    }
}

/// What is wrong with the arguments of a call together.
pub(super) fn check_call(primitive: &Primitive, call: &Call, span: Span) -> Option<Diagnostic> {
    let wrong = match (primitive.result, primitive.name) {
        (Type::Camera, _) => primitives::camera(call).err().map(|error| error.to_string()),
        (_, "box_grid") => box_grid(call),
        (_, "positions") => positions(call),
        (_, "polygon") => faces::check_polygon(call),
        (_, "edge_of") => faces::check_edge(call),
        _ => sides_exist(call),
    }?;
    Some(Diagnostic::new(Code::E0309, span, wrong))
}

fn box_grid(call: &Call) -> Option<String> {
    let (size, step) = (call.lengths("size").ok()?, call.length("step").ok()?);
    let &[x, y, z] = size.as_slice() else {
        return Some(format!(
            "`size` of a box has three lengths, and here are {}",
            size.len()
        ));
    };
    let cells = |x: f64| (x / step).ceil().max(1.0);
    let views = 2.0 * (cells(x) + cells(y)) * cells(z) + cells(x) * cells(y);
    (views > MOST_VIEWS as f64).then(|| format!("this grid has {views:.0} views, and a task has at most {MOST_VIEWS}"))
}

fn positions(call: &Call) -> Option<String> {
    match call.arguments.get("points") {
        Some(Expr::List(points)) if points.is_empty() => Some("there are no positions".into()),
        Some(Expr::List(points)) if points.len() as u64 > MOST_VIEWS => {
            Some(format!("more than {MOST_VIEWS} positions"))
        }
        _ => None,
    }
}

/// A deformation of side 7 needs a shape with seven sides.
fn sides_exist(call: &Call) -> Option<String> {
    let (sides, deformations) = (call.count("sides").ok()?, call.calls("deformed").ok()?);
    deformations.iter().find_map(|deformation| {
        let side = deformation.count("side").ok()?;
        let kind = &deformation.primitive;
        (side > sides)
            .then(|| format!("a {kind} of side {side}, and the shape has sides 1 to {sides}, its bottom is 0"))
    })
}
