//! View Planning Language: say what to perceive, get the next best view.
//!
//! Two halves meet at the compiled rule set ([`rules`]). Left of it a text is
//! parsed, checked and lowered; right of it a planner runs the rule set on
//! observations. See `ARCHITECTURE.md`.

#![forbid(unsafe_code)]
#![warn(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::todo)]

pub mod cli;
pub mod detect;
pub mod facts;
pub mod geometry;
pub mod ide;
pub mod lang;
pub mod lsp;
pub mod map;
pub mod plan;
pub mod predict;
pub mod primitives;
pub mod recognition;
pub mod rules;
pub mod sense;
pub mod show;
pub mod study;
