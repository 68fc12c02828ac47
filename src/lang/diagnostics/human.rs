//! The terminal form: the message, the lines that it is about with marks under
//! them, advice, and what a fix would make of a line.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use unicode_width::UnicodeWidthStr;

use super::paint::{BLUE, BOLD, DIM, GREEN, RED, Style, YELLOW, one_line, paint};
use super::preview::preview;
use super::ruled::Ruled;
use super::{Diagnostic, Label, Severity};
use crate::lang::source::{FileId, SourceFile, SourceMap};
use crate::lang::types::units;

/// Narrower terminals are written as if they had this many columns.
const LEAST_WIDTH: usize = 40;

/// Draws a diagnostic with the source around it.
pub(super) fn one(d: &Diagnostic, sources: &SourceMap, colour: bool, width: usize) -> String {
    let mut drawing = Drawing {
        out: String::new(),
        severity: style(d.severity),
        colour,
        width: width.max(LEAST_WIDTH),
        margin: margin(d, sources),
    };
    drawing.heading(d);
    for (k, (file, labels)) in by_file(d).into_iter().enumerate() {
        if let Some(file) = sources.get(file) {
            drawing.excerpt(file, &labels, k == 0);
        }
    }
    drawing.advice(d, sources);
    drawing.out.push('\n');
    drawing.out
}

fn style(severity: Severity) -> Style {
    match severity {
        Severity::Error => RED,
        Severity::Warning => YELLOW,
        Severity::Note => BLUE,
    }
}

/// The labels of each file, the primary label's first.
fn by_file(d: &Diagnostic) -> Vec<(FileId, Vec<&Label>)> {
    let mut files: Vec<(FileId, Vec<&Label>)> = Vec::new();
    for label in std::iter::once(&d.primary).chain(&d.related) {
        match files.iter_mut().find(|(file, _)| *file == label.span.file) {
            Some((_, labels)) => labels.push(label),
            None => files.push((label.span.file, vec![label])),
        }
    }
    files
}

/// Columns of the largest line number; a fix can add a few lines.
fn margin(d: &Diagnostic, sources: &SourceMap) -> usize {
    let labels = std::iter::once(&d.primary).chain(&d.related);
    let lines = labels.filter_map(|l| Some(sources.get(l.span.file)?.line_column(l.span.start).0 + 1));
    lines.max().unwrap_or(1).to_string().len()
}

struct Drawing {
    out: String,
    severity: Style,
    colour: bool,
    width: usize,
    margin: usize,
}

impl Drawing {
    fn heading(&mut self, d: &Diagnostic) {
        let kind = format!("{}[{}]", d.severity.word(), d.code);
        let message = wrapped(&d.message, kind.len() + 2, 2, self.width);
        let _ = writeln!(
            self.out,
            "{}{}",
            paint(self.colour, self.severity, &kind),
            paint(self.colour, BOLD, &format!(": {message}"))
        );
    }

    /// The lines of one file, each mark on a row of its own.
    fn excerpt(&mut self, file: &SourceFile, labels: &[&Label], first: bool) {
        let Some(primary) = labels.first() else {
            return;
        };
        let (line, column) = file.line_column(primary.span.start);
        let corner = if first { "╭─" } else { "├─" };
        let place = format!("{corner} {}:{line}:{column}", one_line(&file.display));
        self.row("", &place);
        let mut last = None;
        for (number, marks) in shown(file, labels, line, first) {
            if last.is_some_and(|last| number > last + 1) {
                self.row("", "⋮");
            }
            self.line(file, number, &marks, first.then_some(*primary));
            last = Some(number);
        }
    }

    fn line(&mut self, file: &SourceFile, number: usize, marks: &[&Label], primary: Option<&Label>) {
        let text = file.line(number);
        let ruled = Ruled::new(text);
        let start = file.line_start(number);
        let room = self.width.saturating_sub(self.margin + 4);
        let columns = |label: &Label| {
            let from = ruled.column(label.span.start.saturating_sub(start));
            let to = ruled.column(label.span.end.saturating_sub(start).min(text.len()));
            (from, to.max(from + 1))
        };
        let wanted = marks.first().map_or(0, |label| columns(label).0);
        let left = ruled.first_column(wanted, room);
        self.source(number, "│", &ruled.cut(left, room), None);
        for label in marks {
            let (from, to) = columns(label);
            let from = from.clamp(left, left + room - 1) - left;
            let to = to.clamp(left + from + 1, left + room) - left;
            self.mark(from, to, label, primary == Some(*label));
        }
    }

    /// Marks under columns, with the label behind them, or below where there is no room.
    fn mark(&mut self, from: usize, to: usize, label: &Label, primary: bool) {
        let (stroke, style) = if primary { ("━", self.severity) } else { ("─", BLUE) };
        let text = one_line(&label.text);
        let beside = text.is_empty() || self.margin + 5 + to + text.width() <= self.width;
        let strokes = stroke.repeat(to - from);
        let marks = match beside {
            true => format!("{strokes} {text}").trim_end().to_owned(),
            false => strokes,
        };
        self.row(
            "",
            &format!("· {}{}", " ".repeat(from), paint(self.colour, style, &marks)),
        );
        if !beside {
            let indent = from.min(self.width.saturating_sub(self.margin + 4 + text.width()));
            self.row(
                "",
                &format!("· {}{}", " ".repeat(indent), paint(self.colour, style, &text)),
            );
        }
    }

    /// A row of source, behind its number.
    fn source(&mut self, number: usize, bar: &str, text: &str, style: Option<Style>) {
        let text = style.map_or(text.into(), |style| paint(self.colour, style, text));
        let row = format!("{bar} {text}");
        self.row(&number.to_string(), row.trim_end());
    }

    fn row(&mut self, number: &str, rest: &str) {
        let number = format!(" {number:>margin$}", margin = self.margin);
        let _ = writeln!(self.out, "{} {rest}", paint(self.colour, DIM, &number));
    }

    fn advice(&mut self, d: &Diagnostic, sources: &SourceMap) {
        let lines = preview(d, sources);
        let offered = d.fixes.first().filter(|_| !lines.is_empty()).map(|fix| &fix.message);
        if let Some(advice) = d.help.as_ref().or(offered) {
            let text = wrapped(advice, self.margin + 10, self.margin + 10, self.width);
            let help = paint(self.colour, BOLD, "help:").into_owned();
            self.row("", &format!("= {help} {text}"));
        }
        let room = self.width.saturating_sub(self.margin + 4);
        for line in lines {
            let bar = if line.new { "+" } else { "~" };
            self.source(line.number, bar, &Ruled::new(&line.text).cut(0, room), Some(GREEN));
        }
    }
}

/// The lines to draw: those with labels, and one around the primary label's.
fn shown<'a>(
    file: &SourceFile,
    labels: &[&'a Label],
    line: usize,
    with_context: bool,
) -> BTreeMap<usize, Vec<&'a Label>> {
    let mut lines: BTreeMap<usize, Vec<&Label>> = BTreeMap::new();
    for label in labels {
        let (line, _) = file.line_column(label.span.start);
        lines.entry(line).or_default().push(label);
    }
    if with_context {
        for near in [line.saturating_sub(1), line + 1] {
            if near > 0 && !file.line(near).trim().is_empty() {
                lines.entry(near).or_default();
            }
        }
    }
    lines.retain(|number, labels| {
        labels.sort_by_key(|label| label.span);
        !file.line(*number).is_empty() || labels.iter().any(|label| !label.text.is_empty())
    });
    lines
}

/// Text broken between words, never inside backticks where it can be helped; the
/// first line begins at a column, the others are set in.
fn wrapped(text: &str, first: usize, indent: usize, width: usize) -> String {
    let mut out = String::new();
    let mut column = first;
    for piece in pieces(&one_line(text)) {
        let wide = piece.width();
        if column > indent && column + 1 + wide > width && !out.is_empty() {
            let _ = write!(out, "\n{:indent$}", "");
            column = indent;
        } else if !out.is_empty() {
            out.push(' ');
            column += 1;
        }
        out.push_str(piece);
        column += wide;
    }
    out
}

/// The words of a text; what stands in backticks is one, and a number with its unit.
fn pieces(text: &str) -> Vec<&str> {
    let (mut quoted, mut from) = (false, 0);
    let mut out = Vec::new();
    for (at, c) in text.char_indices() {
        quoted ^= c == '`';
        if c == ' ' && !quoted && !parts_a_quantity(text, at) {
            out.push(&text[from..at]);
            from = at + 1;
        }
    }
    out.push(&text[from..]);
    out.retain(|piece| !piece.is_empty());
    out
}

/// Whether a space stands between a number and its unit.
fn parts_a_quantity(text: &str, at: usize) -> bool {
    let unit = text[at + 1..]
        .split(|c: char| c.is_whitespace() || ",;:)]".contains(c))
        .next();
    let unit = unit.map(|word| word.trim_end_matches('.'));
    text[..at].ends_with(|c: char| c.is_ascii_digit()) && unit.is_some_and(units::is_known)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_broken_between_words_and_not_in_backticks() {
        let text = "add `near: 10 mm` and then some more words";
        assert_eq!(
            wrapped(text, 6, 2, 24),
            "add `near: 10 mm`\n  and then some more\n  words"
        );
        assert_eq!(wrapped("word", 90, 2, 40), "word");
        let text = "at [150 mm, 20 mm] of 3 boxes";
        assert_eq!(wrapped(text, 2, 2, 12), "at\n  [150 mm,\n  20 mm] of\n  3 boxes");
    }
}
