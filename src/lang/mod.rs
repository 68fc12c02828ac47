//! The language: source text to a checked, compiled rule set.
//!
//! A pipeline of stages, each a folder that can be read alone: `syntax` (text to
//! source tree) → `names` (modules, definitions, symbols) → `types` (types and
//! units) → `lower` (families and definitions expanded) → `checks` (what can be
//! known about a task before the robot moves). Stages collect diagnostics and go
//! on. Nothing here does I/O: files come through a [`World`].

mod analysis;
mod checks;
mod diagnostics;
mod format;
pub mod index;
mod lower;
mod names;
mod reading;
mod repair;
mod source;
mod stdlib;
mod studies;
pub mod syntax;
mod types;
pub mod vocabulary;
mod world;

pub use analysis::{Analysis, Compilation, Expansion, analyse};
pub use diagnostics::{
    Code, Diagnostic, Edit, Fix, Format, Label, Severity, UnknownCode, edited, explain, index_of_codes, list_of_codes,
    page, render, similar_codes, title,
};
pub use format::{Formatted, edits, format};
pub(crate) use names::suggest::closest;
pub use reading::read;
pub use repair::{Applied, Repaired, repair};
pub use source::{FileId, SourceFile, SourceMap, Span};
pub use syntax::{Token, TokenClass, tokens};
pub use world::{MOST_BYTES, Memory, ReadFailure, World, normal};

use crate::primitives::Primitive;

/// The language edition that this build reads.
pub const EDITION: u32 = crate::rules::LANGUAGE;

/// Compiles the program at `path`. Never panics, whatever the input.
pub fn compile(path: &str, world: &dyn World) -> Compilation {
    analyse(path, world).compile()
}

/// The primitive of a name, or the form of a statement that looks like a call of one:
/// the `cube` of `space cube(1 m)`.
pub fn callable(name: &str) -> Option<&'static Primitive> {
    crate::primitives::find(name).or_else(|| types::forms::form(name))
}
