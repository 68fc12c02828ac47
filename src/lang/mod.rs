//! The language: source text to a checked, compiled rule set.
//!
//! A pipeline of stages, each a folder that can be read alone: `syntax` (text to
//! source tree) → `names` (modules, definitions, symbols) → `types` (types and
//! units) → `lower` (families and definitions expanded) → `checks` (what can be
//! known about a task before the robot moves). Stages collect diagnostics and go
//! on. Nothing here does I/O: files come through a [`World`].

mod checks;
mod diagnostics;
mod format;
mod lower;
mod names;
mod repair;
mod source;
mod stdlib;
pub mod syntax;
mod types;
mod world;

pub use diagnostics::{
    Code, Diagnostic, Edit, Fix, Format, Label, Severity, UnknownCode, edited, explain, index_of_codes, list_of_codes,
    page, render, similar_codes, title,
};
pub use format::{Formatted, edits, format};
pub(crate) use names::suggest::closest;
pub use repair::{Applied, Repaired, repair};
pub use source::{FileId, SourceFile, SourceMap, Span};
pub use syntax::{Token, TokenClass, tokens};
pub use world::{MOST_BYTES, Memory, ReadFailure, World};

use crate::rules::{Fact, RuleSet};

/// The language edition that this build reads.
pub const EDITION: u32 = crate::rules::LANGUAGE;

/// What compiling a program gave.
#[derive(Debug)]
pub struct Compilation {
    /// The compiled program; `Some` exactly when no diagnostic is an error.
    pub rules: Option<RuleSet>,
    /// The tests of the main file; none where some diagnostic is an error.
    pub facts: Vec<Fact>,
    /// Everything there is to say about it, in the order of the text.
    pub diagnostics: Vec<Diagnostic>,
    /// The files that were read. [`crate::rules::Place::file`] is a [`FileId`] here.
    pub sources: SourceMap,
}

impl Compilation {
    /// The same without notes: what a verb that goes on with the program has to say.
    pub fn without_notes(mut self) -> Self {
        self.diagnostics.retain(|d| d.severity != Severity::Note);
        self
    }

    /// Whether some diagnostic is an error.
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(|d| d.severity == Severity::Error)
    }
}

/// Compiles the program at `path`. Never panics, whatever the input.
pub fn compile(path: &str, world: &dyn World) -> Compilation {
    let mut sources = SourceMap::default();
    let (program, mut diagnostics) = names::load(path, world, &mut sources);
    let rules = program.map(|program| {
        let (typed, found) = types::check(&program);
        diagnostics.extend(found);
        let (lowered, found) = lower::lower(&program, &typed, &sources);
        diagnostics.extend(found);
        diagnostics.extend(checks::check(&lowered));
        (lowered.rules, lowered.facts)
    });
    diagnostics::in_order(&mut diagnostics);
    let failed = diagnostics.iter().any(|d| d.severity == Severity::Error);
    if failed {
        // What a task costs is of interest once it is one.
        diagnostics.retain(|d| d.severity != Severity::Note);
    }
    let (rules, facts) = rules.filter(|_| !failed).unzip();
    Compilation {
        rules,
        facts: facts.unwrap_or_default(),
        diagnostics,
        sources,
    }
}
