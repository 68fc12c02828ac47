//! The language's own words, as data: for tools that offer or explain them.

use super::types::{colours, features, forms, studies, task, units};
use super::{names, stdlib};
use crate::primitives::{Primitive, Type};
use crate::rules::{Colour, FeatureKind, Value};

/// Whether a word begins a declaration, so that nothing can be called so.
pub fn is_reserved(word: &str) -> bool {
    names::suggest::RESERVED.contains(&word)
}

/// Units with their type and what one of it is in SI units.
pub fn units() -> impl Iterator<Item = (&'static str, Type, f64)> {
    units::UNITS.iter().copied()
}

/// Nouns that can stand after a whole number.
pub fn nouns() -> &'static [&'static str] {
    units::NOUNS
}

/// A number of a unit.
pub fn quantity(number: f64, unit: &str) -> Option<Value> {
    units::find(unit).map(|(_, ty, si)| units::value(ty, number, si))
}

/// Types of parameters by name.
pub fn types() -> impl Iterator<Item = (&'static str, Type)> {
    units::NAMED.iter().copied()
}

/// A type in words, with its article.
pub fn describe(ty: Type) -> String {
    units::describe(ty)
}

/// How a value of a type is written.
pub fn example(ty: Type) -> Option<&'static str> {
    units::example(ty)
}

/// Kinds of feature by name.
pub fn kinds() -> impl Iterator<Item = (&'static str, FeatureKind)> {
    features::KINDS.iter().copied()
}

/// Colours by name.
pub fn colours() -> impl Iterator<Item = (&'static str, Colour)> {
    colours::all()
}

/// What can stand after `space` or `backdrop`.
pub fn forms(statement: &str) -> &'static [Primitive] {
    match statement {
        "space" => forms::SPACES,
        "backdrop" => forms::BACKDROPS,
        _ => &[],
    }
}

/// The fields of `thresholds` and `sensor_model`.
pub fn fields(statement: &str) -> &'static [(&'static str, Type)] {
    match statement {
        "thresholds" => task::THRESHOLDS,
        "sensor_model" => task::SENSOR_MODEL,
        _ => &[],
    }
}

/// The words that a statement of a task or a study takes.
pub fn words(statement: &str) -> &'static [&'static str] {
    match statement {
        "goal" => task::GOALS,
        "method" | "methods" => crate::rules::METHODS,
        "noise" => studies::NOISES,
        "inspected" => task::INSPECTED,
        "visibility" => task::VISIBILITY,
        "verify" => task::VERIFY,
        "insertion" => task::INSERTION,
        _ => &[],
    }
}

/// The modules of the standard library: name and text.
pub fn modules() -> impl Iterator<Item = (&'static str, &'static str)> {
    stdlib::names().filter_map(|name| Some((name, stdlib::module(name)?)))
}
