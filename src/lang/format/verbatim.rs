//! Which lines stay as they are: those of regions that could not be read, and those
//! that cannot be laid out without touching one.

use std::ops::Range;

use super::spaces::{continues, is_open};
use crate::lang::syntax::{Token, TokenClass};

/// The ranges of bytes that are left alone, in order, each of whole lines without the
/// last line's end. None where brackets do not match outside of them.
pub(super) fn lines(text: &str, tokens: &[Token], bad: &[Range<usize>]) -> Option<Vec<Range<usize>>> {
    let first = if text.starts_with('\u{feff}') {
        '\u{feff}'.len_utf8()
    } else {
        0
    };
    let ends = tokens.iter().filter(|t| t.class == TokenClass::Newline);
    let lines = Lines {
        starts: std::iter::once(first).chain(ends.map(|t| t.end)).collect(),
    };
    let unread = tokens
        .iter()
        .filter(|t| t.class == TokenClass::Bad || is_foreign(t, text))
        .map(|t| t.start..t.end);
    let touched: Vec<Range<usize>> = bad
        .iter()
        .cloned()
        .chain(unread)
        .map(|region| lines.of(&region))
        .collect();
    let good = tokens.iter().filter(|t| !touched_by(bad, t));
    let ties = ties(text, good, &lines)?;
    let kept = close(lines.starts.len(), &touched, &ties);
    Some(ranges(text, &lines, &kept))
}

/// A comment of another language, behind which code may follow on the line.
fn is_foreign(token: &Token, text: &str) -> bool {
    token.class == TokenClass::Comment && token.text(text).starts_with("/*")
}

fn touched_by(bad: &[Range<usize>], token: &Token) -> bool {
    let next = bad.partition_point(|region| region.end <= token.start);
    bad.get(next).is_some_and(|region| region.start < token.end)
}

struct Lines {
    starts: Vec<usize>,
}

impl Lines {
    fn at(&self, offset: usize) -> usize {
        self.starts.partition_point(|start| *start <= offset).saturating_sub(1)
    }

    /// The lines that a region stands on.
    fn of(&self, region: &Range<usize>) -> Range<usize> {
        let last = region.end.max(region.start + 1) - 1;
        self.at(region.start)..self.at(last) + 1
    }
}

/// First and last lines of what can only be laid out as a whole: brackets, the lines
/// inside `( )` and `[ ]`, and statements that go on behind an operator.
fn ties<'t>(text: &str, tokens: impl Iterator<Item = &'t Token>, lines: &Lines) -> Option<Vec<(usize, usize)>> {
    let (mut open, mut out, mut parens) = (Vec::new(), Vec::new(), 0_usize);
    let mut last: Option<(Token, usize)> = None;
    for token in tokens {
        if matches!(token.class, TokenClass::Newline | TokenClass::Comment | TokenClass::Doc) {
            continue;
        }
        let line = lines.at(token.start);
        let written = token.text(text);
        if let Some((before, from)) = last
            && from < line
            && (parens > 0 || continues(&before, text))
        {
            out.extend((from..line).map(|at| (at, at + 1)));
        }
        match written {
            _ if token.class != TokenClass::Punctuation => {}
            _ if is_open(written) => {
                parens += usize::from(written != "{");
                open.push((line, written));
            }
            ")" | "]" | "}" => {
                let (from, opening) = open.pop()?;
                parens -= usize::from(opening != "{");
                out.push((from, line));
            }
            _ => {}
        }
        last = Some((*token, line));
    }
    open.is_empty().then_some(out)
}

/// All lines that must stay: a tie is kept as a whole where its first or last line is.
fn close(count: usize, touched: &[Range<usize>], ties: &[(usize, usize)]) -> Vec<bool> {
    let mut ties_of: Vec<Vec<usize>> = vec![Vec::new(); count];
    for (at, (first, last)) in ties.iter().enumerate() {
        ties_of[*first].push(at);
        ties_of[*last].push(at);
    }
    let mut kept = vec![false; count];
    // The next line from here on that is not kept.
    let mut next: Vec<usize> = (0..=count).collect();
    let mut todo: Vec<Range<usize>> = touched.to_vec();
    while let Some(range) = todo.pop() {
        let mut line = free(&mut next, range.start);
        while line < range.end.min(count) {
            kept[line] = true;
            next[line] = line + 1;
            todo.extend(ties_of[line].iter().map(|tie| ties[*tie].0..ties[*tie].1 + 1));
            line = free(&mut next, line + 1);
        }
    }
    kept
}

/// Follows `next` to its end, and shortens the way for whoever comes later.
fn free(next: &mut [usize], from: usize) -> usize {
    let mut end = from;
    while end < next.len() && next[end] != end {
        end = next[end];
    }
    let mut at = from;
    while at < end {
        at = std::mem::replace(&mut next[at], end);
    }
    end
}

/// Kept lines that follow one another are one range.
fn ranges(text: &str, lines: &Lines, kept: &[bool]) -> Vec<Range<usize>> {
    let mut out: Vec<Range<usize>> = Vec::new();
    let mut last = None;
    for line in (0..kept.len()).filter(|line| kept[*line]) {
        let start = lines.starts[line];
        let end = lines.starts.get(line + 1).copied().unwrap_or(text.len());
        let written = text[start..end].trim_end_matches(['\n', '\r']).len();
        match out.last_mut() {
            Some(range) if last == Some(line - 1) => range.end = start + written,
            _ => out.push(start..start + written),
        }
        last = Some(line);
    }
    out
}
