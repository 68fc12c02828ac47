//! Checked tests: every name resolved, every expression of one type.

use super::typed::Expr;
use crate::lang::source::Span;
use crate::rules::{FeatureId, Flag, State};

#[derive(Debug)]
pub(in crate::lang) struct Fact {
    pub name: String,
    /// Index into the program's libraries.
    pub library: Option<usize>,
    pub given: Vec<(FeatureId, Given, Span)>,
    pub expected: Vec<Expectation>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub(in crate::lang) enum Given {
    Detected,
    Absent,
    Face(Expr),
    Marker(Place),
}

/// Where a marker is and where it looks.
#[derive(Clone, Debug)]
pub(in crate::lang) struct Place {
    pub at: Expr,
    pub facing: Expr,
}

#[derive(Debug)]
pub(in crate::lang) struct Expectation {
    pub kind: ExpectationKind,
    pub span: Span,
}

/// As in [`crate::rules::Expected`]; the last part of several is `within`.
#[derive(Debug)]
pub(in crate::lang) enum ExpectationKind {
    Classes(Vec<usize>),
    Class(usize, Expr, Option<Expr>),
    Flag(Flag, bool),
    Next(Vec<FeatureId>),
    Rules(Expr),
    Predicts {
        /// Ascending.
        antecedents: Vec<FeatureId>,
        consequent: FeatureId,
        count: Expr,
        span: Span,
    },
    State(FeatureId, State),
    Weight(FeatureId, Expr, Option<Expr>),
    Predicted(FeatureId, Expr),
    Placed(FeatureId, Expected, Option<Expr>),
    Equal(Expr, Expr, Option<Expr>),
    Count(Expr, Expr),
}

#[derive(Debug)]
pub(in crate::lang) enum Expected {
    Face(Expr),
    Marker(Place),
}
