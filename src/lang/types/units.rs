//! Units, and types in words.

use std::f64::consts::PI;

use crate::primitives::Type;
use crate::rules::Value;

pub(in crate::lang) const UNITS: &[(&str, Type, f64)] = &[
    ("mm", Type::Length, 1e-3),
    ("cm", Type::Length, 1e-2),
    ("m", Type::Length, 1.0),
    ("in", Type::Length, 0.0254),
    ("deg", Type::Angle, PI / 180.0),
    ("rad", Type::Angle, 1.0),
    ("%", Type::Share, 1e-2),
    ("ms", Type::Time, 1e-3),
    ("s", Type::Time, 1.0),
];

/// Nouns after whole numbers.
pub(in crate::lang) const NOUNS: &[&str] = &["views", "voxels"];

/// The units and nouns that can follow a number.
pub(super) fn all() -> impl Iterator<Item = &'static str> {
    UNITS.iter().map(|(name, ..)| *name).chain(NOUNS.iter().copied())
}

/// Whether a word is a unit or such a noun.
pub(in crate::lang) fn is_known(word: &str) -> bool {
    all().any(|known| known == word)
}

/// A unit: its name, its type, and what one of it is in SI units.
pub(in crate::lang) fn find(unit: &str) -> Option<(&'static str, Type, f64)> {
    UNITS.iter().find(|(name, ..)| *name == unit).copied()
}

/// What the last digit of a written number stands for in SI units: 0.001 of
/// `8.3 %`; `None` of a whole number and of anything but a number.
pub(in crate::lang) fn last_digit(written: &str) -> Option<f64> {
    let (whole, rest) = written.split_once('.')?;
    let digits = rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    let unit = rest[digits..].trim();
    let si = if unit.is_empty() { 1.0 } else { find(unit)?.2 };
    let number = !whole.is_empty() && whole.bytes().all(|b| b.is_ascii_digit()) && digits > 0;
    number.then(|| si * 0.1_f64.powi(digits as i32))
}

/// The units of a type, the usual one first.
pub(in crate::lang) fn of(ty: Type) -> Vec<&'static str> {
    UNITS
        .iter()
        .filter(|(_, t, _)| *t == ty)
        .map(|(name, ..)| *name)
        .collect()
}

/// A number of a unit as a constant. A factor below one divides by its whole
/// inverse, so that `10 mm` is the same number as `0.01 m`.
pub(in crate::lang) fn value(ty: Type, number: f64, si: f64) -> Value {
    let inverse = (1.0 / si).round();
    let whole = si < 1.0 && (1.0 / inverse - si).abs() < 1e-15;
    let x = if whole { number / inverse } else { number * si };
    constant(ty, x)
}

/// A number in SI units as a constant of a type.
pub(in crate::lang) fn constant(ty: Type, x: f64) -> Value {
    match ty {
        Type::Length => Value::Length(x),
        Type::Angle => Value::Angle(x),
        Type::Share => Value::Share(x),
        Type::Time => Value::Time(x),
        _ => Value::Number(x),
    }
}

/// Whether values of a type are added, compared and scaled.
pub(super) fn is_quantity(ty: Type) -> bool {
    matches!(
        ty,
        Type::Length | Type::Angle | Type::Share | Type::Time | Type::Number | Type::Count
    )
}

/// A type with its article.
pub(in crate::lang) fn describe(ty: Type) -> String {
    match ty {
        Type::Length => "a length".into(),
        Type::Angle => "an angle".into(),
        Type::Share => "a share".into(),
        Type::Time => "a time".into(),
        Type::Number => "a number".into(),
        Type::Count => "a whole number".into(),
        Type::Colour => "a colour".into(),
        Type::Text => "a text".into(),
        Type::Direction => "a direction".into(),
        Type::Point => "a point".into(),
        Type::Edge => "an edge".into(),
        Type::Edges => "the edges of a face".into(),
        Type::Polygon => "a face".into(),
        Type::Pose => "a pose".into(),
        Type::Choice(words) => format!("one of {}", crate::lang::names::suggest::one_of(words.iter().copied())),
        Type::List(element) => format!("a list of {}", plural(*element)),
        Type::Deformation => "a deformation".into(),
        Type::Camera => "a camera".into(),
        Type::Views => "a set of views".into(),
        Type::Shape => "a shape".into(),
        Type::Detector => "a detector".into(),
        Type::Measure => "a measure".into(),
        Type::Predictor => "a predictor".into(),
    }
}

fn plural(ty: Type) -> String {
    let one = describe(ty);
    let noun = one.split_once(' ').map_or(one.as_str(), |(_, noun)| noun);
    format!("{noun}s")
}

/// How a value of a type is written, as an example.
pub(in crate::lang) fn example(ty: Type) -> Option<&'static str> {
    Some(match ty {
        Type::Length => "like `10 mm`",
        Type::Angle => "like `30 deg`",
        Type::Share => "like `99 %`",
        Type::Time => "like `100 ms`",
        Type::Number => "like `0.5`",
        Type::Count => "like `64`",
        Type::Colour => "like `red` or `#ff8000`",
        Type::Text => "in double quotes",
        Type::Direction => "like `+x`, `-z` or `[0, 0.7, 0.7]`",
        Type::Point => "like `[0 mm, 0 mm, 300 mm]`",
        Type::Edge => "like `bottom.base`, or the variable of a `for each`",
        Type::Polygon => "by the name of a polygon feature",
        _ => return None,
    })
}

/// A name of a type in a parameter list.
pub(super) fn named(word: &str) -> Option<(&'static str, Type)> {
    NAMED.iter().find(|(name, _)| *name == word).copied()
}

/// Names of types in parameter lists.
pub(in crate::lang) const NAMED: &[(&str, Type)] = &[
    ("length", Type::Length),
    ("angle", Type::Angle),
    ("share", Type::Share),
    ("time", Type::Time),
    ("number", Type::Number),
    ("count", Type::Count),
    ("colour", Type::Colour),
    ("text", Type::Text),
    ("direction", Type::Direction),
    ("point", Type::Point),
    ("edge", Type::Edge),
    ("edges", Type::Edges),
    ("polygon", Type::Polygon),
    ("pose", Type::Pose),
    ("deformation", Type::Deformation),
    ("camera", Type::Camera),
    ("views", Type::Views),
    ("shape", Type::Shape),
    ("detector", Type::Detector),
    ("measure", Type::Measure),
    ("predictor", Type::Predictor),
];

/// The type of a list of a type; lists of lists have no use here.
pub(super) fn list_of(element: Type) -> Option<Type> {
    let element: &'static Type = match element {
        Type::Length => &Type::Length,
        Type::Angle => &Type::Angle,
        Type::Share => &Type::Share,
        Type::Time => &Type::Time,
        Type::Number => &Type::Number,
        Type::Count => &Type::Count,
        Type::Colour => &Type::Colour,
        Type::Text => &Type::Text,
        Type::Direction => &Type::Direction,
        Type::Point => &Type::Point,
        Type::Edge => &Type::Edge,
        Type::Polygon => &Type::Polygon,
        Type::Pose => &Type::Pose,
        Type::Deformation => &Type::Deformation,
        _ => return None,
    };
    Some(Type::List(element))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_millimetres_are_exactly_a_hundredth() {
        let of = |n: f64, unit: &str| {
            let (_, ty, si) = find(unit).unwrap();
            value(ty, n, si)
        };
        assert_eq!(of(10.0, "mm"), Value::Length(0.01));
        assert_eq!(of(99.0, "%"), Value::Share(0.99));
        assert_eq!(of(1.0, "in"), Value::Length(0.0254));
        assert_eq!(of(180.0, "deg"), Value::Angle(PI));
        assert_eq!(of(300.0, "mm"), Value::Length(0.3));
    }

    #[test]
    fn the_last_digit_is_that_of_a_fraction() {
        let close = |written: &str, si: f64| (last_digit(written).unwrap() - si).abs() < 1e-15;
        assert!(close("8.3 %", 0.001) && close("0.92", 0.01) && close("1.50mm", 1e-5));
        for other in ["50 %", "1", "x.height", "0.5 + 0.1", "[0.5]", "1.5e3"] {
            assert_eq!(last_digit(other), None, "{other}");
        }
    }

    #[test]
    fn every_listed_type_has_a_name_back() {
        assert!(NAMED.iter().all(|(name, ty)| named(name) == Some((*name, *ty))));
    }
}
