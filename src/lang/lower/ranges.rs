//! Ranges of the constants that primitives take.

use super::expand::Expanded;
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::source::Span;
use crate::primitives::{self, Primitive, Type};
use crate::rules::{Call, Expr, Value};

/// Longest length, metres.
const MOST_METRES: f64 = 1e5;
/// Most views of a task.
const MOST_VIEWS: u64 = primitives::MOST_VIEWS;

/// Whether a constant argument is in range.
pub(super) fn check(primitive: &Primitive, name: &str, given: &Expanded) -> Result<(), Diagnostic> {
    match &given.expr {
        Expr::List(items) => items.iter().try_for_each(|item| one(primitive, name, item, given.span)),
        expr => one(primitive, name, expr, given.span),
    }
}

fn one(primitive: &Primitive, name: &str, expr: &Expr, span: Span) -> Result<(), Diagnostic> {
    let Expr::Value(value) = expr else {
        return Ok(());
    };
    let Some(expected) = out_of_range(primitive, name, value) else {
        return Ok(());
    };
    let callee = primitive.name;
    Err(
        Diagnostic::new(Code::E0309, span, format!("`{name}` of `{callee}` is out of range"))
            .label(format!("must be {expected}"))
            .help(format!("`{name}` is {expected}")),
    )
}

/// What a constant should be, where it is not.
fn out_of_range(primitive: &Primitive, name: &str, value: &Value) -> Option<String> {
    let right = |right: bool, expected: &str| (!right).then(|| expected.to_owned());
    match (primitive.name, name, value) {
        ("behind", "depth", Value::Length(x)) => right(x.abs() <= MOST_METRES, "at most 100 km"),
        (_, _, Value::Length(x)) => right(0.0 < *x && *x <= MOST_METRES, "above 0 m and at most 100 km"),
        (_, "dihedral", Value::Angle(a)) => {
            right(0.0 < *a && *a < std::f64::consts::TAU, "above 0 deg and below 360 deg")
        }
        (_, "within", Value::Angle(a)) => right(0.0 < *a && *a <= 1.6, "above 0 deg and at most 90 deg"),
        (_, "elevation" | "lean" | "taper", Value::Angle(a)) => right(a.abs() < 1.5707, "between -90 deg and 90 deg"),
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

/// Whether the arguments of a call fit each other.
pub(super) fn check_call(primitive: &Primitive, call: &Call, span: Span) -> Result<(), Diagnostic> {
    let wrong = |why: String| Err(Diagnostic::new(Code::E0309, span, why));
    if primitive.result == Type::Camera
        && let Err(error) = primitives::camera(call)
    {
        return wrong(error.to_string());
    }
    let length = |name| call.length(name).ok();
    match primitive.name {
        "box_grid" => {
            let (Ok(size), Some(step)) = (call.lengths("size"), length("step")) else {
                return Ok(());
            };
            if size.len() != 3 {
                return wrong(format!(
                    "`size` of a box has three lengths, and here are {}",
                    size.len()
                ));
            }
            let cells = |x: f64| (x / step).ceil().max(1.0);
            let views = 2.0 * (cells(size[0]) + cells(size[1])) * cells(size[2]) + cells(size[0]) * cells(size[1]);
            if views > MOST_VIEWS as f64 {
                return wrong(format!(
                    "this grid has {views:.0} views, at most {MOST_VIEWS} are planned with"
                ));
            }
            Ok(())
        }
        "positions" => match call.arguments.get("points") {
            Some(Expr::List(points)) if points.is_empty() => wrong("there are no positions".into()),
            Some(Expr::List(points)) if points.len() as u64 > MOST_VIEWS => {
                wrong(format!("more than {MOST_VIEWS} positions"))
            }
            _ => Ok(()),
        },
        _ => sides_exist(call, span),
    }
}

/// A deformation of side 7 needs a shape with seven sides.
fn sides_exist(call: &Call, span: Span) -> Result<(), Diagnostic> {
    let (Ok(sides), Ok(deformations)) = (call.count("sides"), call.calls("deformed")) else {
        return Ok(());
    };
    for deformation in deformations {
        if let Ok(side) = deformation.count("side")
            && side > sides
        {
            let message = format!("a {} of side {side}, and the shape has {sides}", deformation.primitive);
            return Err(Diagnostic::new(Code::E0309, span, message).help("sides are numbered from 1; 0 is the bottom"));
        }
    }
    Ok(())
}
