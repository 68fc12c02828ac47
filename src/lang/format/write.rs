//! Pieces written as lines: indentation, blank lines, and brackets broken where a line
//! would be too long.

use std::ops::Range;

use super::WIDTH;
use super::columns::{Shape, Stop, shape};
use super::pieces::{Form, Group, Kind, Piece};
use super::spaces::continues;
use crate::lang::syntax::{Token, TokenClass};

/// A line as it will be written.
#[derive(Debug, Default)]
pub(super) struct Line {
    /// Whether a blank line stands before it.
    pub blank: bool,
    pub indent: usize,
    pub code: String,
    /// Characters of `code`.
    pub width: usize,
    pub comment: Option<Token>,
    /// Where `code` may be padded, in bytes, in order.
    pub stops: Vec<Stop>,
    /// What it may be aligned with.
    pub shape: Option<Shape>,
    /// Lines that stay as they are, instead of all of this.
    pub verbatim: Option<Range<usize>>,
}

/// The lines of a file.
pub(super) fn lines(text: &str, body: &[Piece]) -> Vec<Line> {
    let mut writer = Writer {
        text,
        lines: Vec::new(),
        head: "",
    };
    writer.block(body, None);
    writer.lines
}

struct Writer<'t> {
    text: &'t str,
    lines: Vec<Line>,
    /// The first word of the statement.
    head: &'t str,
}

/// What the last statement of a file was, for the blank line behind it.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Item<'t> {
    Word(&'t str),
    Unread,
}

impl<'t> Writer<'t> {
    /// Statements; those of a block are one step further in than the line that opened it.
    fn block(&mut self, body: &[Piece], outer: Option<usize>) {
        let indent = outer.map_or(0, |outer| outer + 2);
        let head = if outer.is_some() { self.head } else { "" };
        let mut between = Between::default();
        let mut at = 0;
        while at < body.len() {
            match &body[at] {
                Piece::Break { lines } => between.lines = *lines,
                // Behind the bracket that opened the block.
                Piece::Comment(token) if at == 0 && outer.is_some() => self.comment(*token),
                Piece::Comment(token) => {
                    self.fresh(indent, between.blank());
                    self.comment(*token);
                    between.lead.get_or_insert(self.lines.len() - 1);
                }
                Piece::Verbatim(range) => {
                    self.fresh(indent, between.blank());
                    self.last().verbatim = Some(range.clone());
                    between = Between::behind(Item::Unread);
                }
                _ => {
                    let end = statement_end(body, at, self.text);
                    let item = Item::Word(first_word(&body[at], self.text));
                    let blank = between.blank();
                    let line = self.lines.len();
                    self.statement(&body[at..end], indent, blank, head);
                    if outer.is_none() && !between.seen && needs_blank(between.item, item) {
                        self.part(between.lead.unwrap_or(line));
                    }
                    between = Between::behind(item);
                    at = end;
                    continue;
                }
            }
            at += 1;
        }
    }

    /// Puts a blank line before a line, unless that would part documentation from what
    /// it documents.
    fn part(&mut self, line: usize) {
        let before = line.checked_sub(1).and_then(|before| self.lines[before].comment);
        self.lines[line].blank = before.is_none_or(|comment| comment.class != TokenClass::Doc);
    }

    fn statement(&mut self, pieces: &[Piece], indent: usize, blank: bool, block: &str) {
        self.fresh(indent, blank);
        let line = self.lines.len() - 1;
        self.head = first_word(&pieces[0], self.text);
        let shape = shape(pieces, self.text, block);
        let stops = shape.as_ref().map_or(&[][..], |(_, stops)| stops);
        self.sequence(pieces, indent, 0, stops);
        if self.lines.len() - 1 == line {
            self.lines[line].shape = shape.map(|(shape, _)| shape);
        } else {
            self.lines[line].stops.clear();
        }
    }

    /// A statement or an argument. `tail` is the width of what must follow it on its
    /// last line.
    fn sequence(&mut self, pieces: &[Piece], indent: usize, tail: usize, stops: &[Stop]) {
        let broken = self.broken(pieces, indent, tail);
        let mut base = indent;
        for (at, piece) in pieces.iter().enumerate() {
            if let Some(stop) = stops.iter().find(|stop| stop.at == at) {
                let at = self.last().code.len();
                self.last().stops.push(Stop { at, ..*stop });
            }
            match piece {
                Piece::Break { .. } => {
                    base = indent + 2;
                    self.fresh(base, false);
                }
                Piece::Group(group) if broken[at] => self.expanded(group, base),
                Piece::Group(group) => self.in_line(group, base),
                other => self.word(other, base),
            }
        }
    }

    /// Which groups of a sequence are expanded: those that the author did, and where a
    /// line is too long, the widest that begins on it.
    fn broken(&mut self, pieces: &[Piece], indent: usize, tail: usize) -> Vec<bool> {
        let mut out: Vec<bool> = pieces
            .iter()
            .map(|p| matches!(p, Piece::Group(group) if group.form == Form::Expanded))
            .collect();
        let (mut at, mut column, mut base) = (0, self.column(), indent);
        loop {
            let start = column - space_at_start(&pieces[at..], column, base);
            let line = measure(&pieces[at..], start, tail, self.text);
            match (line.candidate, line.end) {
                (Some((candidate, depth)), _) if line.width > WIDTH => {
                    out[at + candidate] = true;
                    at += candidate + 1;
                    column = base + depth;
                }
                (_, Some((end, tail))) => {
                    if matches!(pieces[at + end], Piece::Break { .. }) {
                        base = indent + 2;
                    }
                    at += end + 1;
                    column = base + tail;
                }
                _ => return out,
            }
        }
    }

    /// Each part on a line of its own, or on the lines that the author chose.
    fn expanded(&mut self, group: &Group, base: usize) {
        self.push(group.open.text(self.text), group.space, base);
        match group.only() {
            Some(inner) => self.expanded(inner, base),
            None => {
                self.parts(group, base);
                self.fresh(base, false);
            }
        }
        self.push(group.close.text(self.text), false, base);
    }

    fn parts(&mut self, group: &Group, base: usize) {
        match group.kind {
            Kind::Block => self.block(&group.body, Some(base)),
            _ => self.items(group, base + 2),
        }
    }

    fn items(&mut self, group: &Group, indent: usize) {
        let chosen = group.body.iter().any(|p| matches!(p, Piece::Break { .. }));
        let one_a_line = !chosen || self.too_long(group, indent);
        let code_end = group.body.iter().rposition(Piece::is_code).map_or(0, |last| last + 1);
        let (mut new_line, mut blank) = (true, false);
        let mut at = 0;
        while at < group.body.len() {
            match &group.body[at] {
                Piece::Break { lines } => {
                    new_line = true;
                    blank = *lines >= 2 && at > 0;
                }
                Piece::Comment(token) => {
                    if new_line && at > 0 {
                        self.fresh(indent, blank);
                    }
                    self.comment(*token);
                    (new_line, blank) = (true, false);
                }
                Piece::Verbatim(range) => {
                    self.fresh(indent, blank);
                    self.last().verbatim = Some(range.clone());
                    (new_line, blank) = (true, false);
                }
                _ => {
                    if new_line || one_a_line {
                        self.fresh(indent, blank);
                    }
                    let end = item_end(group, at, code_end);
                    let written = matches!(group.body.get(end), Some(Piece::Comma));
                    let comma = written || (end == code_end && group.trailing_comma());
                    self.sequence(&group.body[at..end], indent, usize::from(comma), &[]);
                    if comma {
                        self.push(",", false, indent);
                    }
                    at = end + usize::from(written);
                    (new_line, blank) = (false, false);
                    continue;
                }
            }
            at += 1;
        }
    }

    /// Whether a line of several parts, as the author broke them, is too long.
    fn too_long(&self, group: &Group, indent: usize) -> bool {
        let (mut width, mut parts) = (indent, 1);
        for piece in &group.body {
            match piece {
                Piece::Break { .. } => (width, parts) = (indent, 1),
                Piece::Comma => (width, parts) = (width + 1, parts + 1),
                piece => width += piece.width(self.text),
            }
            if width > WIDTH && parts > 1 {
                return true;
            }
        }
        false
    }

    /// A group whose brackets need no lines of their own.
    fn in_line(&mut self, group: &Group, base: usize) {
        self.push(group.open.text(self.text), group.space, base);
        for piece in &group.body {
            match piece {
                Piece::Group(inner) if inner.form == Form::Expanded => self.expanded(inner, base),
                Piece::Group(inner) => self.in_line(inner, base),
                other => self.word(other, base),
            }
        }
        self.push(group.close.text(self.text), group.padded(), base);
    }

    fn word(&mut self, piece: &Piece, base: usize) {
        match piece {
            Piece::Word { token, space } => self.push(token.text(self.text), *space, base),
            Piece::Comma => self.push(",", false, base),
            Piece::Comment(token) => self.comment(*token),
            _ => {}
        }
    }

    /// Writes behind what stands on the last line; a comment ends its line.
    fn push(&mut self, written: &str, space: bool, base: usize) {
        if self.last().comment.is_some() {
            self.fresh(base, false);
        }
        let line = self.last();
        if space && !line.code.is_empty() {
            line.code.push(' ');
            line.width += 1;
        }
        line.code.push_str(written);
        line.width += written.chars().count();
    }

    fn comment(&mut self, token: Token) {
        self.last().comment = Some(token);
    }

    fn fresh(&mut self, indent: usize, blank: bool) {
        let blank = blank && !self.lines.is_empty();
        self.lines.push(Line {
            blank,
            indent,
            ..Line::default()
        });
    }

    fn column(&mut self) -> usize {
        let line = self.last();
        line.indent + line.width
    }

    fn last(&mut self) -> &mut Line {
        if self.lines.is_empty() {
            self.fresh(0, false);
        }
        let last = self.lines.len() - 1;
        &mut self.lines[last]
    }
}

/// What stands between two statements.
#[derive(Default)]
struct Between<'t> {
    /// The statement before.
    item: Option<Item<'t>>,
    /// Line ends since the last line.
    lines: usize,
    /// Whether there was a blank line.
    seen: bool,
    /// The first comment.
    lead: Option<usize>,
}

impl<'t> Between<'t> {
    fn behind(item: Item<'t>) -> Self {
        Self {
            item: Some(item),
            ..Self::default()
        }
    }

    /// Whether a blank line comes next. None begins a block.
    fn blank(&mut self) -> bool {
        let first = self.item.is_none() && self.lead.is_none();
        let blank = std::mem::take(&mut self.lines) >= 2 && !first;
        self.seen |= blank;
        blank
    }
}

/// Items of a file stand apart, but for runs of imports and of definitions.
fn needs_blank(before: Option<Item<'_>>, item: Item<'_>) -> bool {
    match before {
        None | Some(Item::Unread) => false,
        Some(before) => before != item || !matches!(item, Item::Word("use" | "let")),
    }
}

fn first_word<'t>(piece: &Piece, text: &'t str) -> &'t str {
    match piece {
        Piece::Word { token, .. } => token.text(text),
        Piece::Group(group) => group.open.text(text),
        _ => "",
    }
}

/// A statement ends with its line, unless an operator or a comma stands there.
fn statement_end(body: &[Piece], start: usize, text: &str) -> usize {
    let mut goes_on = false;
    for (at, piece) in body.iter().enumerate().skip(start) {
        match piece {
            Piece::Break { .. } | Piece::Verbatim(_) if !goes_on => return at,
            Piece::Word { token, .. } => goes_on = continues(token, text),
            Piece::Comma => goes_on = true,
            Piece::Group(_) => goes_on = false,
            _ => {}
        }
    }
    body.len()
}

/// A part ends at its comma, in braces with its line, and before what follows the last.
fn item_end(group: &Group, start: usize, code_end: usize) -> usize {
    let braces = matches!(group.kind, Kind::Fields | Kind::Imports);
    let ends = |piece: &Piece| matches!(piece, Piece::Comma) || (braces && !piece.is_code());
    // A comma without a part is a part.
    let found = group.body[start..code_end].iter().skip(1).position(ends);
    found.map_or(code_end, |found| start + found + 1)
}

/// The space before a piece is not written where it begins a line.
fn space_at_start(pieces: &[Piece], column: usize, base: usize) -> usize {
    usize::from(column == base && column > 0 && pieces.first().is_some_and(Piece::has_space))
}

/// A line of a sequence before it is written.
struct Measured {
    /// Its width, as far as it matters.
    width: usize,
    /// The group to expand, should the line be too long, and how many brackets that are.
    candidate: Option<(usize, usize)>,
    /// What ends the line, and the width of that on the next.
    end: Option<(usize, usize)>,
}

/// Measures up to where a line ends, or up to where it is known to be too long.
fn measure(pieces: &[Piece], column: usize, tail: usize, text: &str) -> Measured {
    let mut out = Measured {
        width: column,
        candidate: None,
        end: None,
    };
    let mut widest = 0;
    for (at, piece) in pieces.iter().enumerate() {
        let before = out.width;
        out.width += piece.width(text);
        match piece {
            Piece::Break { .. } => {
                out.end = Some((at, 0));
                return out;
            }
            Piece::Group(group) if group.form == Form::Expanded => {
                out.end = Some((at, group.tail));
                return out;
            }
            Piece::Group(group) => {
                let opens = before + usize::from(group.space) + group.depth() <= WIDTH;
                if group.worth_breaking() && group.width > widest && (opens || out.candidate.is_none()) {
                    (out.candidate, widest) = (Some((at, group.depth())), group.width);
                }
                if group.form == Form::Hugging {
                    out.end = Some((at, group.tail));
                    return out;
                }
            }
            _ => {}
        }
        if before > WIDTH && out.candidate.is_some() {
            return out;
        }
    }
    out.width += tail;
    out
}
