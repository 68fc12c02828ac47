//! Rendering a list of diagnostics: format, count and summary.

use super::{Diagnostic, Severity, human, json, plain, sarif};
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
    /// A log of the Static Analysis Results Interchange Format, 2.1.0.
    Sarif,
}

/// Writes diagnostics. Text formats end with a newline and are empty where there are none.
pub fn render(diagnostics: &[Diagnostic], sources: &SourceMap, format: Format) -> String {
    let one: &dyn Fn(&Diagnostic) -> String = match format {
        Format::Json => return json::array(diagnostics, sources),
        Format::Sarif => return sarif::log(diagnostics, sources),
        Format::Human { colour, width } => &move |d| human::one(d, sources, colour, width),
        Format::Plain => &|d| plain::one(d, sources),
        Format::Short => &|d| plain::short(d, sources),
    };
    let mut out: String = diagnostics.iter().take(MOST_SHOWN).map(one).collect();
    if let Some(more) = diagnostics.len().checked_sub(MOST_SHOWN).filter(|&n| n > 0) {
        let errors = count(&diagnostics[MOST_SHOWN..], Severity::Error);
        out.push_str(&format!("… and {more} more ({errors} of them errors)\n"));
    }
    out
}

fn count(diagnostics: &[Diagnostic], severity: Severity) -> usize {
    diagnostics.iter().filter(|d| d.severity == severity).count()
}
