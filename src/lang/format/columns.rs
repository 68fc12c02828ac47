//! What stands in columns: the parts of like statements that follow one another, and
//! the comments behind them.

use super::WIDTH;
use super::pieces::{Group, Kind, Piece};
use super::write::Line;
use crate::lang::MOST_BYTES;
use crate::lang::syntax::TokenClass;

/// What kind of statement a line is, for its columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    /// `feature side : polygon many`.
    Feature,
    /// `class box { bottom, side } prior 60 %`.
    Class,
    /// `object tk1 = tank() at … turned … marked … as …`.
    Object,
    /// A place of a layout: `code[1] at … facing …`.
    Place,
    /// A row of a table of classes.
    Row,
    /// A word and its value: `detect qr("a")`, `limit 20 views`.
    Setting,
}

/// Column of the comments behind code, where the code leaves room.
const COMMENTS: usize = 45;

/// Fewest spaces before such a comment.
const GAP: usize = 3;

/// What begins further right is not aligned.
const WIDEST: usize = 120;

/// Where a line may be padded: which of the columns of its shape that is, and what
/// begins there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stop {
    pub column: usize,
    pub at: usize,
}

/// The shape of a statement in a block whose own statement begins with `block`, and
/// the pieces before which it may be padded.
pub(super) fn shape(pieces: &[Piece], text: &str, block: &str) -> Option<(Shape, Vec<Stop>)> {
    let word = |at: usize| match pieces.get(at)? {
        Piece::Word { token, .. } => Some((token.class, token.text(text))),
        _ => None,
    };
    let position = |written: &str| {
        let is_it = |(class, word)| word == written && !matches!(class, TokenClass::Name | TokenClass::Callee);
        (1..pieces.len()).find(|at| word(*at).is_some_and(is_it))
    };
    let stops = |words: &[&str]| -> Vec<Stop> {
        let found = words.iter().enumerate();
        found
            .filter_map(|(column, word)| position(word).map(|at| Stop { column, at }))
            .collect()
    };
    let first = |at: usize| vec![Stop { column: 0, at }];
    match word(0)? {
        (TokenClass::Keyword, "feature") => Some((Shape::Feature, first(position(":")?))),
        (TokenClass::Keyword, "class") => {
            let braces = pieces
                .iter()
                .position(|p| matches!(p, Piece::Group(g) if is_braces(g)))?;
            let prior = position("prior").map(|at| Stop { column: 1, at });
            Some((Shape::Class, first(braces).into_iter().chain(prior).collect()))
        }
        (TokenClass::Keyword, "object") => Some((Shape::Object, stops(&["=", "at", "turned", "marked", "as"]))),
        (TokenClass::Keyword, word) if block.is_empty() || block == "library" || word == "for" => None,
        (TokenClass::Keyword, _) => pieces.get(1)?.has_space().then(|| (Shape::Setting, first(1))),
        _ if block == "layout" => Some((Shape::Place, stops(&["at", "facing"]))),
        _ => (block == "classes" && pieces.len() > 1).then(|| (Shape::Row, first(1))),
    }
}

fn is_braces(group: &Group) -> bool {
    group.kind == Kind::Fields
}

/// Pads lines so that like parts of neighbours stand in columns.
pub(super) fn align(lines: &mut [Line]) {
    let mut run: Vec<usize> = Vec::new();
    for at in 0..lines.len() {
        let line = &lines[at];
        let is_comment = line.code.is_empty() && line.verbatim.is_none();
        let like = |first: &Line| (first.shape, first.indent) == (line.shape, line.indent);
        let joins = line.shape.is_some() && run.first().is_some_and(|first| like(&lines[*first]));
        if line.blank || !(joins || is_comment) {
            pad(lines, &run);
            run.clear();
        }
        if lines[at].shape.is_some() {
            run.push(at);
        }
    }
    pad(lines, &run);
}

/// Pads the lines of a run, column by column.
fn pad(lines: &mut [Line], run: &[usize]) {
    let stops = run.iter().filter_map(|at| lines[*at].stops.last());
    let columns = stops.map(|last| last.column + 1).max().unwrap_or(0);
    // The cells of a table stand a little apart from the names of its rows.
    let apart = usize::from(run.iter().any(|at| lines[*at].shape == Some(Shape::Row)));
    for column in 0..columns {
        let begins: Vec<(usize, usize)> = run
            .iter()
            .filter_map(|at| Some((*at, lines[*at].begin(column)?)))
            .filter(|(_, begin)| *begin <= WIDEST)
            .collect();
        let furthest = begins.iter().map(|(_, begin)| *begin).max().unwrap_or(0);
        for (at, begin) in begins {
            lines[at].pad(column, furthest - begin + apart);
        }
    }
}

impl Line {
    /// Where a column begins, in characters.
    fn begin(&self, column: usize) -> Option<usize> {
        let stop = self.stops.iter().find(|stop| stop.column == column)?;
        Some(self.code[..stop.at].chars().count())
    }

    fn pad(&mut self, column: usize, by: usize) {
        let Some(stop) = self.stops.iter().find(|stop| stop.column == column) else {
            return;
        };
        self.code.insert_str(stop.at, &" ".repeat(by));
        self.width += by;
        let behind = self.stops.iter_mut().filter(|stop| stop.column >= column);
        behind.for_each(|stop| stop.at += by);
    }

    /// The column where its code ends.
    fn end(&self) -> usize {
        self.indent + self.width
    }
}

/// The text of the lines; none where it would be larger than a program may be.
pub(super) fn join(text: &str, lines: &[Line]) -> Option<String> {
    let most = MOST_BYTES.max(text.len());
    let mut out = String::with_capacity(text.len());
    let mut column = 0;
    for (at, line) in lines.iter().enumerate() {
        if at == 0 || !follows(&lines[at - 1], line) {
            column = comment_column(&lines[at..]);
        }
        if line.blank {
            out.push('\n');
        }
        write(&mut out, text, line, column);
        if out.len() > most {
            return None;
        }
    }
    Some(out)
}

fn write(out: &mut String, text: &str, line: &Line, column: usize) {
    if let Some(range) = &line.verbatim {
        out.push_str(text.get(range.clone()).unwrap_or(""));
        out.push('\n');
        return;
    }
    out.extend(std::iter::repeat_n(' ', line.indent));
    out.push_str(&line.code);
    if let Some(comment) = line.comment {
        if !line.code.is_empty() {
            let to = if line.end() > WIDTH { 0 } else { column };
            out.extend(std::iter::repeat_n(' ', to.saturating_sub(line.end()).max(GAP)));
        }
        out.push_str(comment.text(text).trim_end());
    }
    out.push('\n');
}

/// Whether the comments behind two lines stand in one column.
fn follows(before: &Line, line: &Line) -> bool {
    let is_aligned = |line: &Line| line.comment.is_some() && !line.code.is_empty() && line.end() <= WIDTH;
    !line.blank && before.indent == line.indent && is_aligned(before) && is_aligned(line)
}

/// The column of the comments of the first lines: [`COMMENTS`] where all leave room,
/// else the first one on its grid of two that does.
fn comment_column(lines: &[Line]) -> usize {
    let mut widest = 0;
    for (at, line) in lines.iter().enumerate() {
        if at > 0 && !follows(&lines[at - 1], line) {
            break;
        }
        widest = widest.max(line.end());
    }
    let room = widest + GAP;
    COMMENTS.max(room + (room + COMMENTS) % 2)
}
