//! What a fix makes of the lines that it touches.

use super::{Diagnostic, Edit, Fix, edited};
use crate::lang::source::{SourceFile, SourceMap, Span};

/// Most lines that are shown.
const MOST: usize = 4;

/// A line as the fix leaves it.
pub(super) struct Line {
    /// Its number in the changed text.
    pub number: usize,
    pub text: String,
    /// Whether the fix writes all of it.
    pub new: bool,
}

/// The lines that the first fix changes, where showing them says more than the
/// advice does: nothing where the advice names the very word to write in place of
/// what is marked.
pub(super) fn preview(d: &Diagnostic, sources: &SourceMap) -> Vec<Line> {
    let Some(fix) = d.fixes.first().filter(|fix| !is_said(d, fix)) else {
        return Vec::new();
    };
    let Some(file) = fix.edits.first().and_then(|edit| sources.get(edit.span.file)) else {
        return Vec::new();
    };
    changed(fix, file)
        .filter(|lines| lines.len() <= MOST)
        .unwrap_or_default()
}

fn is_said(d: &Diagnostic, fix: &Fix) -> bool {
    let [edit] = fix.edits.as_slice() else {
        return false;
    };
    edit.span == d.primary.span && d.help.as_ref().is_some_and(|help| help.contains(&edit.text))
}

fn changed(fix: &Fix, file: &SourceFile) -> Option<Vec<Line>> {
    let home = fix.edits.first()?.span.file;
    let first = fix.edits.iter().map(|e| e.span.start).min()?;
    let last = fix.edits.iter().map(|e| e.span.end).max()?;
    if fix.edits.iter().any(|e| e.span.file != home) {
        return None;
    }
    let start = file.text.get(..first)?.rfind('\n').map_or(0, |at| at + 1);
    let rest = file.text.get(last..)?;
    let end = last + rest.find('\n').unwrap_or(rest.len());
    let edits: Vec<Edit> = fix.edits.iter().map(|e| shifted(e, start)).collect();
    let after = edited(&file.text[start..end], &edits)?;
    let (number, _) = file.line_column(start);
    let written = written(&edits);
    let mut lines = Vec::new();
    let mut at = 0;
    for (k, line) in after.split('\n').enumerate() {
        let end = at + line.len();
        if !line.trim().is_empty() && written.iter().any(|w| touches(*w, at, end)) {
            lines.push(Line {
                number: number + k,
                text: line.trim_end().to_owned(),
                new: written.iter().any(|w| w.0 <= at && end <= w.1),
            });
        }
        at = end + 1;
    }
    Some(lines)
}

/// Whether a line has something of what was written, or lost something.
fn touches((from, to): (usize, usize), start: usize, end: usize) -> bool {
    if from == to {
        (start..=end).contains(&from)
    } else {
        from < end && to > start
    }
}

/// Where the new text of each edit stands in the changed text.
fn written(edits: &[Edit]) -> Vec<(usize, usize)> {
    let mut sorted: Vec<&Edit> = edits.iter().collect();
    sorted.sort_by_key(|e| e.span.start);
    let mut moved = 0_isize;
    let placed = sorted.into_iter().map(|e| {
        let start = e.span.start.saturating_add_signed(moved);
        moved += e.text.len() as isize - (e.span.end - e.span.start) as isize;
        (start, start + e.text.len())
    });
    placed.collect()
}

fn shifted(edit: &Edit, by: usize) -> Edit {
    Edit {
        span: Span::new(edit.span.file, edit.span.start - by, edit.span.end - by),
        text: edit.text.clone(),
    }
}
