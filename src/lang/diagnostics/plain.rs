//! Text without drawing or colour: the full form and the one-line form.

use std::fmt::Write;

use super::{Diagnostic, Label};
use crate::lang::source::SourceMap;

/// The full form.
pub(super) fn one(d: &Diagnostic, sources: &SourceMap) -> String {
    let mut out = format!("{}[{}]: {}\n", d.severity.word(), d.code, d.message);
    excerpt(&mut out, &d.primary, sources);
    for label in &d.related {
        excerpt(&mut out, label, sources);
    }
    if let Some(help) = &d.help {
        let _ = writeln!(out, "  help: {help}");
    }
    for fix in &d.fixes {
        let _ = writeln!(out, "  fix: {}", fix.message);
    }
    out.push('\n');
    out
}

/// `file:line:column: error[E0101]: message`.
pub(super) fn short(d: &Diagnostic, sources: &SourceMap) -> String {
    let help = d.help.as_deref().map(|h| format!(" ({h})")).unwrap_or_default();
    let message = format!("{}{help}", d.message).replace('\n', " ");
    format!(
        "{}: {}[{}]: {message}\n",
        place(&d.primary, sources),
        d.severity.word(),
        d.code
    )
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
    let shown: String = text
        .chars()
        .skip(skipped)
        .take(160)
        .collect::<String>()
        .replace('\t', " ");
    let room = shown.chars().count().saturating_sub(column - 1 - skipped);
    let marks = sources.text(label.span).lines().next().unwrap_or("").chars().count();
    let marks = "^".repeat(marks.clamp(1, room.max(1)));
    let _ = writeln!(out, "    {line} | {shown}");
    let margin = " ".repeat(line.to_string().len());
    let _ = writeln!(
        out,
        "    {margin} | {}{marks} {}",
        " ".repeat(column - 1 - skipped),
        label.text
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
