//! Tokens grouped by brackets: what a line is made of, and whether a bracket is
//! written on one line or over several.

use std::ops::Range;

use super::spaces::{Spacer, continues, goes_on_with, is_open, takes_bracket};
use crate::lang::syntax::{Token, TokenClass};

/// A part of a statement, or what stands between two.
#[derive(Debug)]
pub(super) enum Piece {
    Word {
        token: Token,
        /// Whether a space stands before it.
        space: bool,
    },
    Comma,
    Group(Box<Group>),
    Comment(Token),
    /// Ends of lines, or a `;`.
    Break {
        lines: usize,
    },
    /// Lines that stay as they are.
    Verbatim(Range<usize>),
}

/// What a pair of brackets holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Statements.
    Block,
    /// Names or fields in braces, with commas or line ends between.
    Fields,
    /// The names of a `use`.
    Imports,
    /// Arguments or parameters.
    Call,
    List,
    /// An expression.
    Paren,
    /// An index or a type: never broken.
    Index,
}

/// How a pair of brackets is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// On one line.
    Flat,
    /// On one line but for its last part, which is over several: `f(a, b: [⏎ … ⏎])`.
    Hugging,
    /// Each part on lines of its own.
    Expanded,
}

/// Brackets up to this width stay on the line where they begin.
const SHORT: usize = 24;

/// A pair of brackets.
#[derive(Debug)]
pub(super) struct Group {
    pub open: Token,
    pub close: Token,
    /// Whether a space stands before it.
    pub space: bool,
    pub kind: Kind,
    pub form: Form,
    pub body: Vec<Piece>,
    /// Whether the author wrote commas in it.
    pub commas: bool,
    /// Its width up to where its first line ends, without the space before it.
    pub width: usize,
    /// The width of what it puts on its last line, where that is not its first.
    pub tail: usize,
}

impl Group {
    /// The spaces inside its brackets.
    pub fn padded(&self) -> bool {
        matches!(self.kind, Kind::Block | Kind::Fields) && !self.body.is_empty()
    }

    /// Whether it may be written over several lines. A point reads as one thing, as a
    /// number does.
    pub fn breaks(&self) -> bool {
        self.kind != Kind::Index && !self.body.is_empty() && !self.is_point()
    }

    /// Whether a line that is too long gets much shorter without it.
    pub fn worth_breaking(&self) -> bool {
        self.breaks() && (self.width > SHORT || self.form != Form::Flat)
    }

    /// Three numbers with their units, or fewer, on one line.
    fn is_point(&self) -> bool {
        let commas = self.body.iter().filter(|p| matches!(p, Piece::Comma)).count();
        let plain = |p: &Piece| matches!(p, Piece::Word { .. } | Piece::Comma);
        self.kind == Kind::List && commas <= 2 && self.body.len() <= 3 * 2 + 2 && self.body.iter().all(plain)
    }

    /// The only thing in it, where that is a pair of brackets: to break one is to break
    /// the other, on one line.
    pub fn only(&self) -> Option<&Self> {
        match self.body.as_slice() {
            [Piece::Group(inner)] if self.form != Form::Expanded && inner.breaks() => Some(inner),
            _ => None,
        }
    }

    /// How many brackets open where it is broken.
    pub fn depth(&self) -> usize {
        1 + self.only().map_or(0, Self::depth)
    }

    /// Whether a comma stands behind its last part when it is expanded.
    pub fn trailing_comma(&self) -> bool {
        match self.kind {
            Kind::Call | Kind::List => true,
            Kind::Fields | Kind::Imports => self.commas,
            Kind::Block | Kind::Paren | Kind::Index => false,
        }
    }

    fn measured(mut self, text: &str) -> Self {
        let inner: usize = self.body.iter().map(|p| p.width(text)).sum();
        (self.width, self.tail) = match self.form {
            Form::Flat => (inner + 2 + usize::from(self.padded()), 0),
            Form::Hugging => (inner + 1, 1 + self.body.last().map_or(0, Piece::tail)),
            Form::Expanded => (1, 1),
        };
        self
    }
}

impl Piece {
    /// Its width on the line where it begins, with the space before it.
    pub fn width(&self, text: &str) -> usize {
        match self {
            Self::Word { token, space } => usize::from(*space) + token.text(text).chars().count(),
            Self::Comma => 1,
            Self::Group(group) => usize::from(group.space) + group.width,
            _ => 0,
        }
    }

    fn tail(&self) -> usize {
        match self {
            Self::Group(group) => group.tail,
            _ => 0,
        }
    }

    /// Whether a space stands before it.
    pub fn has_space(&self) -> bool {
        match self {
            Self::Word { space, .. } => *space,
            Self::Group(group) => group.space,
            _ => false,
        }
    }

    /// Whether it says something.
    pub fn is_code(&self) -> bool {
        matches!(self, Self::Word { .. } | Self::Comma | Self::Group(_))
    }

    fn is_broken(&self) -> bool {
        matches!(self, Self::Group(group) if group.form != Form::Flat)
    }
}

/// The pieces of a file; none where brackets do not match.
pub(super) fn pieces(text: &str, tokens: &[Token], verbatim: &[Range<usize>]) -> Option<Vec<Piece>> {
    let mut builder = Builder {
        text,
        spacer: Spacer::default(),
        last: None,
        head: None,
        open: Vec::new(),
        body: Vec::new(),
    };
    let mut kept = verbatim.iter().peekable();
    let mut done = 0;
    for token in tokens {
        while let Some(range) = kept.next_if(|range| range.end <= token.start || range.start <= token.start) {
            builder.verbatim(range);
            done = range.end;
        }
        if token.start >= done {
            builder.take(*token)?;
        }
    }
    builder.open.is_empty().then_some(builder.body)
}

/// A bracket that is not closed yet, and what stood before it.
struct Open {
    token: Token,
    space: bool,
    kind: Kind,
    head: Option<Token>,
    before: Vec<Piece>,
}

struct Builder<'t> {
    text: &'t str,
    spacer: Spacer,
    /// The last token of the statement.
    last: Option<Token>,
    /// The first one.
    head: Option<Token>,
    open: Vec<Open>,
    body: Vec<Piece>,
}

impl Builder<'_> {
    fn take(&mut self, token: Token) -> Option<()> {
        let written = token.text(self.text);
        match token.class {
            TokenClass::Newline => self.line_end(1),
            TokenClass::Comment | TokenClass::Doc => self.body.push(Piece::Comment(token)),
            TokenClass::Punctuation if written == ";" => self.line_end(0),
            TokenClass::Punctuation if written == "," => self.comma(token),
            TokenClass::Punctuation if is_open(written) => self.opened(token),
            TokenClass::Punctuation if matches!(written, ")" | "]" | "}") => self.closed(token)?,
            _ => {
                let space = self.space(token);
                self.body.push(Piece::Word { token, space });
            }
        }
        Some(())
    }

    fn space(&mut self, token: Token) -> bool {
        let imports = self.last.is_some_and(|last| last.text(self.text) == "{") && self.kind() == Some(Kind::Imports);
        self.last = Some(token);
        self.head = self.head.or(Some(token));
        self.spacer.before(token, self.text) && !imports
    }

    fn kind(&self) -> Option<Kind> {
        self.open.last().map(|open| open.kind)
    }

    fn restart(&mut self) {
        self.spacer.restart();
        self.last = None;
        self.head = None;
    }

    fn verbatim(&mut self, range: &Range<usize>) {
        self.restart();
        self.body.push(Piece::Verbatim(range.clone()));
    }

    fn line_end(&mut self, count: usize) {
        if let Some(Piece::Break { lines }) = self.body.last_mut() {
            *lines += count;
        } else {
            self.body.push(Piece::Break { lines: count });
        }
        let statements = matches!(self.kind(), None | Some(Kind::Block | Kind::Fields | Kind::Imports));
        if statements && !self.last.is_some_and(|last| continues(&last, self.text)) {
            self.restart();
        }
    }

    /// A comma stands right behind what it follows, before comments and line ends.
    fn comma(&mut self, token: Token) {
        self.space(token);
        let at = self.body.iter().rposition(Piece::is_code).map_or(0, |at| at + 1);
        self.body.insert(at, Piece::Comma);
    }

    fn opened(&mut self, token: Token) {
        let kind = self.kind_of(token);
        let space = self.space(token);
        self.open.push(Open {
            token,
            space,
            kind,
            head: self.head.take(),
            before: std::mem::take(&mut self.body),
        });
    }

    fn kind_of(&self, token: Token) -> Kind {
        let glued = self.last.is_some_and(|last| takes_bracket(last.class));
        match token.text(self.text) {
            "(" if glued => Kind::Call,
            "(" => Kind::Paren,
            "[" if glued => Kind::Index,
            "[" => Kind::List,
            _ if self.last.is_some_and(|last| last.text(self.text) == ".") => Kind::Imports,
            _ if self.last.is_some_and(|last| last.class == TokenClass::Keyword) => Kind::Fields,
            _ if self.head.is_some_and(|head| head.text(self.text) == "class") => Kind::Fields,
            _ => Kind::Block,
        }
    }

    fn closed(&mut self, token: Token) -> Option<()> {
        let open = self.open.pop()?;
        let matching = matches!(
            (open.token.text(self.text), token.text(self.text)),
            ("(", ")") | ("[", "]") | ("{", "}")
        );
        self.space(token);
        self.head = open.head;
        let body = std::mem::replace(&mut self.body, open.before);
        let mut group = Group {
            open: open.token,
            close: token,
            space: open.space,
            kind: open.kind,
            form: Form::Flat,
            commas: body.iter().any(|p| matches!(p, Piece::Comma)),
            body,
            width: 0,
            tail: 0,
        };
        self.settle(&mut group);
        self.body.push(Piece::Group(Box::new(group.measured(self.text))));
        matching.then_some(())
    }

    /// Takes out what says nothing, and finds the form that the author chose.
    fn settle(&self, group: &mut Group) {
        while matches!(group.body.last(), Some(Piece::Break { .. })) {
            group.body.pop();
        }
        let last = group.body.iter().rposition(Piece::is_code);
        if let Some(last) = last.filter(|last| matches!(group.body[*last], Piece::Comma))
            && group.kind != Kind::Block
        {
            group.body.remove(last);
        }
        let statements = matches!(group.kind, Kind::Block | Kind::Fields | Kind::Imports);
        if !statements {
            if is_type(&group.body) {
                group.kind = Kind::Index;
            }
            self.join_lines(&mut group.body);
        }
        let top = self.open.is_empty() && group.kind == Kind::Block && !group.body.is_empty();
        let breaks = group.body.iter().any(|p| !p.is_code());
        let broken = group.body.iter().filter(|p| p.is_broken()).count();
        let hugs = !statements && broken == 1 && group.body.last().is_some_and(Piece::is_broken);
        group.form = match broken {
            _ if top || breaks => Form::Expanded,
            0 => Form::Flat,
            _ if hugs => Form::Hugging,
            _ => Form::Expanded,
        };
    }

    /// Drops the line ends that count for nothing. A list or call is expanded where a
    /// line ends behind its open bracket, at an operator or with a comment; then lines
    /// that end with a comma stay, too.
    fn join_lines(&self, body: &mut Vec<Piece>) {
        let is_comment = |at: usize| matches!(body.get(at), Some(Piece::Comment(_)));
        let expanded = matches!(body.first(), Some(Piece::Break { .. }))
            || (0..body.len()).any(|at| is_comment(at) || self.goes_on(body, at));
        let stays = |at: usize| match body[at] {
            Piece::Break { .. } if !expanded => false,
            Piece::Break { .. } if at == 0 || is_comment(at - 1) || is_comment(at + 1) => true,
            Piece::Break { .. } => matches!(body[at - 1], Piece::Comma) || self.goes_on(body, at),
            _ => true,
        };
        let stays: Vec<bool> = (0..body.len()).map(stays).collect();
        let mut stays = stays.into_iter();
        body.retain(|_| stays.next().unwrap_or(true));
    }

    /// Whether a line ends behind or before an operator.
    fn goes_on(&self, body: &[Piece], at: usize) -> bool {
        let word = |at: Option<usize>| match body.get(at?) {
            Some(Piece::Word { token, .. }) => Some(*token),
            _ => None,
        };
        matches!(body[at], Piece::Break { .. })
            && (word(at.checked_sub(1)).is_some_and(|t| continues(&t, self.text))
                || word(Some(at + 1)).is_some_and(|t| goes_on_with(&t, self.text)))
    }
}

/// Whether brackets hold a type, as in `[length]`.
fn is_type(body: &[Piece]) -> bool {
    match body {
        [Piece::Word { token, .. }] => token.class == TokenClass::Type,
        [Piece::Group(group)] => group.kind == Kind::Index,
        _ => false,
    }
}
