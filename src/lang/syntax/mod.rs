//! Text to source tree: the only place that names pest.
//!
//! A file is read by the grammar's tolerant entry. What it could not read is
//! parsed again strictly for an exact message ([`recover`]); what it could read
//! becomes the tree ([`build`]), so that one run finds many mistakes.

#[cfg(test)]
pub(super) mod agreement;
mod block;
mod build;
mod expected;
mod expressions;
mod facts;
mod guard;
mod habits;
mod libraries;
mod recover;
mod same;
mod slips;
mod studies;
mod tasks;
mod tokens;
pub mod tree;
mod usage;

use std::num::NonZeroUsize;
use std::sync::Once;

use pest::Parser as _;
use pest_derive::Parser;

use super::diagnostics::{Code, Diagnostic};
use super::source::{FileId, Span};

pub use block::block;
pub(super) use same::same_program;
pub(super) use tokens::read;
pub use tokens::{Token, TokenClass, tokens};

/// The generated parser.
#[derive(Parser)]
#[grammar = "../grammar/vpl.pest"]
struct Grammar;

/// Most rule calls of one parse, against inputs that are built to take forever.
const MOST_CALLS: usize = 400_000_000;

/// The tree of a text, and what is wrong with it: for tools that read or rewrite programs.
pub fn parse(file: FileId, text: &str) -> (tree::File, Vec<Diagnostic>) {
    limit_calls();
    if let Some(found) = guard::refuse(file, text) {
        return (tree::File::default(), vec![found]);
    }
    match Grammar::parse(Rule::tolerant_file, text) {
        Ok(pairs) => build::file(file, text, pairs),
        Err(error) => (tree::File::default(), vec![recover::too_complex(file, &error)]),
    }
}

/// Pest's call limit is a setting of the whole process.
fn limit_calls() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| pest::set_call_limit(NonZeroUsize::new(MOST_CALLS)));
}

/// Whether the strict entry accepts a text.
#[cfg(any(test, fuzzing))]
pub fn strictly_accepts(text: &str) -> bool {
    limit_calls();
    guard::refuse(FileId(0), text).is_none() && Grammar::parse(Rule::file, text).is_ok()
}

/// Whether the tolerant entry finds nothing bad in a text.
#[cfg(any(test, fuzzing))]
pub fn tolerantly_accepts(text: &str) -> bool {
    limit_calls();
    let pairs = Grammar::parse(Rule::tolerant_file, text);
    guard::refuse(FileId(0), text).is_none()
        && pairs.is_ok_and(|pairs| {
            let mut all = pairs.flatten();
            let bad = all.clone().any(|pair| recover::strict_entry(pair.as_rule()).is_some());
            !bad && all.any(|pair| pair.as_rule() == Rule::header)
        })
}

fn span(file: FileId, pair: &pest::iterators::Pair<'_, Rule>) -> Span {
    let s = pair.as_span();
    Span::new(file, s.start(), s.end())
}

fn syntax_error(span: Span, message: impl Into<String>) -> Diagnostic {
    Diagnostic::new(Code::E0101, span, message)
}
