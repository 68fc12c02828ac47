//! Rendering a list of diagnostics: format, count and summary.

use super::{Diagnostic, Severity, human, json, plain};
use crate::lang::source::SourceMap;

/// Most diagnostics that are shown for people; JSON has all.
const MOST_SHOWN: usize = 50;

/// How diagnostics are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// With the source around, for a terminal.
    Human {
        /// Whether to colour it.
        colour: bool,
        /// Columns of the terminal.
        width: usize,
    },
    /// Without drawing or colour, for logs and screen readers.
    Plain,
    /// `file:line:column: error[E0101]: message`, one a line.
    Short,
    /// One array; offsets in bytes, lines and columns from 1.
    Json,
}

/// Writes diagnostics. Text formats end with a newline and are empty where there are none.
pub fn render(diagnostics: &[Diagnostic], sources: &SourceMap, format: Format) -> String {
    if format == Format::Json {
        return json::array(diagnostics, sources);
    }
    let shown = diagnostics.iter().take(MOST_SHOWN);
    let mut out = String::new();
    for diagnostic in shown {
        match format {
            Format::Human { colour, width } => out.push_str(&human::one(diagnostic, sources, colour, width)),
            Format::Plain => out.push_str(&plain::one(diagnostic, sources)),
            Format::Short | Format::Json => out.push_str(&plain::short(diagnostic, sources)),
        }
    }
    if let Some(more) = diagnostics.len().checked_sub(MOST_SHOWN).filter(|&n| n > 0) {
        let errors = count(&diagnostics[MOST_SHOWN..], Severity::Error);
        out.push_str(&format!("… and {more} more ({errors} of them errors)\n"));
    }
    out
}

fn count(diagnostics: &[Diagnostic], severity: Severity) -> usize {
    diagnostics.iter().filter(|d| d.severity == severity).count()
}
