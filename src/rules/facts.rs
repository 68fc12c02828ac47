//! Facts: what a test gives and what it expects, resolved and in SI units.
//!
//! They stand beside the rule set and are no part of the artefact: a planner has
//! no use for them. `crate::facts` runs them.

use super::{Expr, FeatureId, Place};
use crate::geometry::{Polygon, Pose};

/// A `test` block.
#[derive(Clone, Debug, PartialEq)]
pub struct Fact {
    /// What it is called.
    pub name: String,
    /// Index of its library in the rule set; `None` where it needs none.
    pub library: Option<usize>,
    /// What is known, in the order of the text.
    pub given: Vec<(FeatureId, Given)>,
    /// What must follow.
    pub expected: Vec<Expectation>,
    /// Where it begins.
    pub place: Place,
}

/// What is known of a feature.
#[derive(Clone, Debug, PartialEq)]
pub enum Given {
    /// It was detected; where, is not said.
    Detected,
    /// It was looked for and is not there.
    Absent,
    /// An instance was measured as this face.
    Face(Polygon),
    /// The marker was measured.
    Marker {
        /// `world_from_marker`.
        pose: Pose,
        /// Edge of the square of modules, metres.
        size: f64,
    },
}

/// One expectation.
#[derive(Clone, Debug, PartialEq)]
pub struct Expectation {
    /// What is expected.
    pub what: Expected,
    /// Where it stands.
    pub place: Place,
}

/// What is expected. `within` is how far what is found may lie from it, in the
/// SI unit of what is compared.
#[derive(Clone, Debug, PartialEq)]
pub enum Expected {
    /// Exactly these classes are still possible (indices, ascending).
    Classes(Vec<usize>),
    /// The probability of a class.
    Class {
        /// Index of the class.
        class: usize,
        /// Its probability.
        share: f64,
        /// Tolerance.
        within: f64,
    },
    /// Whether something holds of the whole status.
    Flag(Flag, bool),
    /// Exactly these features weigh most, and more than nothing (ascending).
    Next(Vec<FeatureId>),
    /// The number of the library's rules.
    Rules(u64),
    /// The number of instances that some rules predict.
    Predicts {
        /// The rules' heads as written: `bottom -> prism_side`.
        head: String,
        /// Indices of the rules that have it.
        rules: Vec<usize>,
        /// Number of instances.
        count: u64,
    },
    /// The state of a feature.
    State(FeatureId, State),
    /// The weight of a feature.
    Weight {
        /// The feature.
        feature: FeatureId,
        /// Its weight, bits.
        bits: f64,
        /// Tolerance, bits.
        within: f64,
    },
    /// The number of predicted instances of a feature.
    Predicted(FeatureId, u64),
    /// One predicted instance lies here.
    Placed {
        /// The feature.
        feature: FeatureId,
        /// Its outline; of a marker, that of its print.
        face: Polygon,
        /// Tolerance, metres.
        within: f64,
    },
    /// Two values are one.
    Equal {
        /// What is looked at.
        found: Expr,
        /// What it should be.
        expected: Expr,
        /// Tolerance.
        within: f64,
    },
    /// The number of parts of a value.
    Count(Expr, u64),
}

/// What can hold of a whole status.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flag {
    /// A class has reached the task's confidence.
    Confident,
    /// No class explains the evidence.
    Contradicted,
}

/// The state of a feature, as facts name it (paper: es_i).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// −1: nothing is known.
    Unknown,
    /// 0: looked for and not there.
    Absent,
    /// 1: detected.
    Detected,
    /// 2: not seen, but every class still possible has it.
    Present,
    /// 3: not looked for, but no class still possible has it.
    Excluded,
}

impl State {
    /// All states with their words.
    pub const ALL: [(State, &'static str); 5] = [
        (Self::Unknown, "unknown"),
        (Self::Absent, "absent"),
        (Self::Detected, "detected"),
        (Self::Present, "present"),
        (Self::Excluded, "excluded"),
    ];

    /// The word for it.
    pub fn word(self) -> &'static str {
        Self::ALL
            .iter()
            .find(|(state, _)| *state == self)
            .map_or("unknown", |(_, word)| word)
    }
}
