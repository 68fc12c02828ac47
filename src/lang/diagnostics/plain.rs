//! Text without drawing or colour: the full form and the one-line form.

use std::fmt::Write;

use super::paint::{one_line, visible};
use super::{Diagnostic, Label};
use crate::lang::source::SourceMap;

/// The full form.
pub(super) fn one(d: &Diagnostic, sources: &SourceMap) -> String {
    let mut out = format!("{}[{}]: {}\n", d.severity.word(), d.code, one_line(&d.message));
    excerpt(&mut out, &d.primary, sources);
    for label in &d.related {
        excerpt(&mut out, label, sources);
    }
    if let Some(help) = &d.help {
        let _ = writeln!(out, "  help: {}", one_line(help));
    }
    for fix in &d.fixes {
        let _ = writeln!(out, "  fix: {}", one_line(&fix.message));
    }
    out.push('\n');
    out
}

/// `file:line:column: error[E0101]: message`.
pub(super) fn short(d: &Diagnostic, sources: &SourceMap) -> String {
    let place = place(&d.primary, sources);
    let (severity, message) = (d.severity.word(), one_line(&d.message));
    format!("{place}: {severity}[{}]: {message}\n", d.code)
}

/// The line of a label with marks under it.
fn excerpt(out: &mut String, label: &Label, sources: &SourceMap) {
    let _ = writeln!(out, "  at {}", place(label, sources));
    let Some(file) = sources.get(label.span.file) else {
        return;
    };
    let (line, column) = file.line_column(label.span.start);
    let text = file.line(line);
    if text.is_empty() && label.text.is_empty() {
        return;
    }
    // A line of a generated file can be very long: show what surrounds the place.
    let skipped = column.saturating_sub(80);
    let plain = |c| if c == '\t' { ' ' } else { visible(c) };
    let shown: String = text.chars().skip(skipped).take(160).map(plain).collect();
    let room = shown.chars().count().saturating_sub(column - 1 - skipped);
    let marks = sources.text(label.span).lines().next().unwrap_or("").chars().count();
    let marks = "^".repeat(marks.clamp(1, room.max(1)));
    let _ = writeln!(out, "    {line} | {shown}");
    let margin = " ".repeat(line.to_string().len());
    let _ = writeln!(
        out,
        "    {margin} | {}{marks} {}",
        " ".repeat(column - 1 - skipped),
        one_line(&label.text)
    );
    let trimmed = out.trim_end().len();
    out.truncate(trimmed);
    out.push('\n');
}

fn place(label: &Label, sources: &SourceMap) -> String {
    match sources.get(label.span.file) {
        None => "?".into(),
        Some(file) => {
            let (line, column) = file.line_column(label.span.start);
            format!("{}:{line}:{column}", file.display)
        }
    }
}
