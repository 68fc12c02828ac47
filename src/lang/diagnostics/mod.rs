//! Diagnostics about the user's program: one structure, many renderings.
//!
//! A diagnostic is data: a code, a place, what is wrong, what to write instead,
//! and edits that would do so. Stages collect them; nothing here is thrown.

mod codes;
mod edits;
mod human;
mod json;
mod page;
mod paint;
mod plain;
mod preview;
mod render;
mod ruled;
mod sarif;

pub use codes::{Code, UnknownCode, page, title};
pub use edits::edited;
pub(super) use edits::touch;
pub use page::{explain, index as index_of_codes, list as list_of_codes, similar as similar_codes};
pub use render::{Format, render};

use super::source::{FileId, Span};
use crate::rules::Place;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The program has no meaning.
    Error,
    /// It has one that is probably not meant.
    Warning,
    /// Good to know.
    Note,
}

impl Severity {
    /// The word in all renderings.
    pub fn word(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
            Self::Note => "note",
        }
    }
}

/// A place and what it has to do with the matter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// Where.
    pub span: Span,
    /// A few words; may be empty.
    pub text: String,
}

/// A change of the source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// What is replaced.
    pub span: Span,
    /// By what.
    pub text: String,
}

/// Edits that together repair the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fix {
    /// What they do.
    pub message: String,
    /// The edits, none overlapping.
    pub edits: Vec<Edit>,
}

/// Something to say about a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// What kind of thing.
    pub code: Code,
    /// How bad.
    pub severity: Severity,
    /// Lower case, no final period.
    pub message: String,
    /// Where.
    pub primary: Label,
    /// Other places that have to do with it.
    pub related: Vec<Label>,
    /// What to write instead.
    pub help: Option<String>,
    /// Repairs, where one is obvious.
    pub fixes: Vec<Fix>,
}

impl Diagnostic {
    /// A diagnostic at a span, of its code's usual severity.
    pub fn new(code: Code, span: impl Into<Span>, message: impl Into<String>) -> Self {
        let primary = Label {
            span: span.into(),
            text: String::new(),
        };
        Self {
            code,
            severity: code.severity(),
            message: message.into(),
            primary,
            related: Vec::new(),
            help: None,
            fixes: Vec::new(),
        }
    }

    /// A diagnostic at a place of a compiled rule set.
    pub fn at_place(code: Code, place: Place, message: impl Into<String>) -> Self {
        Self::new(code, place, message)
    }

    /// With words under the primary span.
    pub fn label(mut self, text: impl Into<String>) -> Self {
        self.primary.text = text.into();
        self
    }

    /// With another place.
    pub fn related(mut self, span: impl Into<Span>, text: impl Into<String>) -> Self {
        self.related.push(Label {
            span: span.into(),
            text: text.into(),
        });
        self
    }

    /// With advice.
    pub fn help(mut self, text: impl Into<String>) -> Self {
        self.help = Some(text.into());
        self
    }

    /// With advice, where there is some.
    pub fn maybe_help(mut self, text: Option<String>) -> Self {
        self.help = text.or(self.help);
        self
    }

    /// With a repair of one edit.
    pub fn fix(mut self, message: impl Into<String>, span: Span, text: impl Into<String>) -> Self {
        self.fixes.push(Fix {
            message: message.into(),
            edits: vec![Edit {
                span,
                text: text.into(),
            }],
        });
        self
    }

    /// Did you mean: that the primary span should read otherwise.
    pub fn meant(self, near: &str) -> Self {
        let at = self.primary.span;
        self.help(format!("did you mean `{near}`?"))
            .fix(format!("write `{near}`"), at, near)
    }

    /// The same about files whose first has another id ([`SourceMap::append`]).
    ///
    /// [`SourceMap::append`]: crate::lang::SourceMap::append
    pub fn moved(mut self, first: FileId) -> Self {
        let labels = self.related.iter_mut().chain([&mut self.primary]).map(|l| &mut l.span);
        let edits = self.fixes.iter_mut().flat_map(|f| &mut f.edits).map(|e| &mut e.span);
        labels.chain(edits).for_each(|span| span.file.0 += first.0);
        self
    }

    /// Of another severity than its code's.
    pub fn severity(mut self, severity: Severity) -> Self {
        self.severity = severity;
        self
    }
}

/// Sorts by place, and drops what says the same twice.
pub(super) fn in_order(diagnostics: &mut Vec<Diagnostic>) {
    diagnostics.sort_by(|a, b| {
        let key = |d: &Diagnostic| (d.primary.span, d.severity, d.code);
        key(a).cmp(&key(b)).then_with(|| a.message.cmp(&b.message))
    });
    diagnostics.dedup_by(|a, b| a.code == b.code && a.primary.span == b.primary.span && a.message == b.message);
}
