//! The registry: every primitive of the language, declared once.
//!
//! Name, signature, documentation and, for detectors, the envelope are data
//! here. Checker, compiler, planner and manual read these declarations; the
//! functions behind them live in `sense`, `detect` and `predict`.

mod arguments;
mod attributes;
mod cameras;
pub mod colours;
mod detectors;
mod extents;
mod faces;
mod measures;
mod points;
mod predictors;
mod reference;
mod shapes;
mod views;

pub use arguments::{Arguments, Datum};
pub use attributes::{Attribute, attributes};
pub use cameras::camera;
pub use detectors::{Envelope, ImageKind, QR_SIZE_WITHIN, envelope, printed_edge};
pub use extents::extremes;
pub use faces::MOST_CORNERS;
pub use predictors::{Strength, strength};
pub use reference::{reference, signature, written};
pub use views::{MOST_VIEWS, poses};

use crate::rules::{FeatureKind, Value};

/// The type of a parameter, an attribute or a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type {
    /// Metres inside; `mm`, `cm`, `m` written.
    Length,
    /// Radians inside; `deg`, `rad` written.
    Angle,
    /// 0 to 1 inside; `%` written.
    Share,
    /// Seconds inside; `ms`, `s` written.
    Time,
    /// A bare number.
    Number,
    /// A whole number.
    Count,
    /// A colour, by name or `#rrggbb`.
    Colour,
    /// A text in double quotes.
    Text,
    /// A world direction: `+x`, `-z`, or a list of three numbers.
    Direction,
    /// A point: a list of three lengths, or an attribute.
    Point,
    /// An edge of a measured face.
    Edge,
    /// All edges of a measured face, in order.
    Edges,
    /// A measured face.
    Polygon,
    /// A pose.
    Pose,
    /// One of some words.
    Choice(&'static [&'static str]),
    /// A list.
    List(&'static Type),
    /// A dent, bump or notch of a shape.
    Deformation,
    /// A sensor.
    Camera,
    /// A set of candidate views.
    Views,
    /// An object of a scene.
    Shape,
    /// What proves a rule.
    Detector,
    /// What measures a detected feature.
    Measure,
    /// What predicts a feature's place.
    Predictor,
}

/// A primitive.
#[derive(Clone, Copy, Debug)]
pub struct Primitive {
    /// Its name.
    pub name: &'static str,
    /// What it gives.
    pub result: Type,
    /// Kinds of feature that it detects, measures or predicts; empty where
    /// that has no meaning.
    pub features: &'static [FeatureKind],
    /// Its parameters in order.
    pub parameters: &'static [Parameter],
    /// One sentence, then detail.
    pub doc: &'static str,
}

/// A parameter of a primitive.
#[derive(Clone, Copy, Debug)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// Its type.
    pub ty: Type,
    /// What stands in where it is left out.
    pub default: Default,
    /// One sentence.
    pub doc: &'static str,
}

/// What a left-out argument means.
#[derive(Clone, Copy, Debug)]
pub enum Default {
    /// It may not be left out.
    Required,
    /// No value, which the primitive understands.
    Absent,
    /// This value.
    Value(fn() -> Value),
}

impl Parameter {
    const fn required(name: &'static str, ty: Type, doc: &'static str) -> Self {
        Self {
            name,
            ty,
            default: Default::Required,
            doc,
        }
    }

    const fn optional(name: &'static str, ty: Type, doc: &'static str) -> Self {
        Self {
            name,
            ty,
            default: Default::Absent,
            doc,
        }
    }

    const fn or(name: &'static str, ty: Type, value: fn() -> Value, doc: &'static str) -> Self {
        Self {
            name,
            ty,
            default: Default::Value(value),
            doc,
        }
    }
}

/// All primitives, by kind, in the order of the manual.
pub fn all() -> impl Iterator<Item = &'static Primitive> {
    [
        detectors::ALL,
        measures::ALL,
        predictors::ALL,
        points::ALL,
        faces::ALL,
        views::ALL,
        cameras::ALL,
        shapes::ALL,
    ]
    .into_iter()
    .flatten()
}

/// The primitive of a name.
pub fn find(name: &str) -> Option<&'static Primitive> {
    all().find(|p| p.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn names_are_unique_and_everything_is_documented() {
        let mut seen = BTreeSet::new();
        for p in all() {
            assert!(seen.insert(p.name), "`{}` is registered twice", p.name);
            assert!(!p.doc.is_empty(), "`{}` has no documentation", p.name);
            let mut names = BTreeSet::new();
            for q in p.parameters {
                assert!(
                    names.insert(q.name) && !q.doc.is_empty(),
                    "`{}` of `{}`",
                    q.name,
                    p.name
                );
            }
        }
    }

    #[test]
    fn every_detector_declares_an_envelope() {
        for p in all().filter(|p| p.result == Type::Detector) {
            assert!(detectors::declares_envelope(p.name), "`{}` has no envelope", p.name);
        }
    }
}
