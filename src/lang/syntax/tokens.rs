//! The tokens of a program, for tools that colour, complete or lay out its text.
//!
//! They are the compiler's own reading: a word is a keyword, a type or a unit where
//! the tolerant entry read it as one. What no entry reads (a bad region, a text that
//! the [`super::guard`] refuses) is read plainly, word by word.

use std::ops::Range;

use pest::Parser as _;
use pest::Token as Event;
use pest::iterators::Pairs;

use super::{FileId, Grammar, Rule, guard, limit_calls, recover};

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TokenClass {
    /// A word of the language, where it is one: `views` is a name elsewhere.
    Keyword,
    /// The type of a feature or of a parameter.
    Type,
    /// What is called: `sphere` of `sphere(radius: 1 m)`.
    Callee,
    /// Every other word.
    Name,
    /// A number without its unit; a presence, an index, the edition.
    Number,
    /// `mm`, `%`, `views` after a number.
    Unit,
    /// A text, or a part of one beside its holes; quotes included.
    Text,
    /// `{i}` inside a text.
    Hole,
    /// `#ff8000`.
    Colour,
    /// `+x`.
    Direction,
    /// From `//` to the end of the line.
    Comment,
    /// From `///` to the end of the line.
    Doc,
    /// `->`, `=`, `..`, `+`, `-`, `*`, `/`.
    Operator,
    /// Brackets, `,`, `:`, `.` and `;`.
    Punctuation,
    /// The end of a line, wherever it stands.
    Newline,
    /// No token of the language.
    Bad,
}

/// A piece of a text, as bytes `start..end`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    /// What it is.
    pub class: TokenClass,
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

impl Token {
    /// The token as it is written in its text.
    pub fn text<'t>(&self, text: &'t str) -> &'t str {
        text.get(self.start..self.end).unwrap_or("")
    }
}

/// The tokens of any text, in order, none overlapping. Only spaces, tabs and a byte
/// order mark at the beginning belong to none.
pub fn tokens(text: &str) -> Vec<Token> {
    read(text).tokens
}

/// The tokens of a text, and what of it was parsed.
pub(in crate::lang) struct Reading<'t> {
    text: &'t str,
    done: usize,
    pub(in crate::lang) tokens: Vec<Token>,
    /// Regions that could not be read.
    pub(in crate::lang) bad: Vec<Range<usize>>,
    /// Whether the parser saw the text.
    pub(in crate::lang) parsed: bool,
}

/// Reads any text.
pub(in crate::lang) fn read(text: &str) -> Reading<'_> {
    limit_calls();
    let mut reading = Reading {
        text,
        done: if text.starts_with(BOM) { BOM.len_utf8() } else { 0 },
        tokens: Vec::new(),
        bad: Vec::new(),
        parsed: false,
    };
    if guard::refuse(FileId(0), text).is_none()
        && let Ok(pairs) = Grammar::parse(Rule::tolerant_file, text)
    {
        reading.parsed = true;
        reading.take(pairs, 0);
    }
    reading.plainly_to(text.len());
    reading
}

const BOM: char = '\u{FEFF}';

impl Reading<'_> {
    /// Takes what the parser read in a part that begins at `offset`.
    fn take(&mut self, pairs: Pairs<'_, Rule>, offset: usize) {
        let mut open: Vec<(Rule, usize)> = Vec::new();
        for event in pairs.tokens() {
            match event {
                Event::Start { rule: kind, pos } => {
                    let at = offset + pos.pos();
                    self.open(kind, at);
                    open.push((kind, at));
                }
                Event::End { rule: kind, pos } => {
                    let start = open.pop().map_or(self.done, |(_, start)| start);
                    let parent = open.last().map(|(parent, _)| *parent);
                    self.close(kind, parent, start, offset + pos.pos());
                }
            }
        }
    }

    fn open(&mut self, kind: Rule, at: usize) {
        match kind {
            Rule::text => {
                self.plainly_to(at);
                self.done = at;
            }
            Rule::hole => self.push(TokenClass::Text, self.done, at),
            _ => {}
        }
    }

    fn close(&mut self, kind: Rule, parent: Option<Rule>, start: usize, end: usize) {
        let written = self.text.get(start..end).unwrap_or("");
        match class(kind, parent, written) {
            // The rest of a text behind its last hole.
            Some(TokenClass::Text) => self.push(TokenClass::Text, self.done, end),
            Some(class) => {
                if class != TokenClass::Hole {
                    self.plainly_to(start);
                }
                self.push(class, start, end);
            }
            None if recover::strict_entry(kind).is_some() => self.bad.push(start..end),
            None => {}
        }
    }

    /// Reads what lies before a token and belongs to no rule.
    fn plainly_to(&mut self, end: usize) {
        let part = self.text.get(self.done..end).unwrap_or("");
        let blank = |c: char| matches!(c, ' ' | '\t');
        let start = end - part.trim_start_matches(blank).len();
        if start >= end {
            return;
        }
        self.done = start;
        let text = self.text;
        for line in text[start..end].split_inclusive('\n') {
            let (at, line_end) = (self.done, self.done + line.len());
            match Grammar::parse(Rule::lexemes, line) {
                Ok(pairs) => self.take(pairs, at),
                Err(_) => self.push(TokenClass::Bad, at, line_end),
            }
            self.done = line_end;
        }
    }

    fn push(&mut self, class: TokenClass, start: usize, end: usize) {
        self.done = end;
        if let Some(last) = self.tokens.last_mut()
            && class == TokenClass::Bad
            && (last.class, last.end) == (class, start)
        {
            last.end = end;
        } else if start < end {
            self.tokens.push(Token { class, start, end });
        }
    }
}

/// The class of a grammar rule; none for rules that are made of others.
fn class(kind: Rule, parent: Option<Rule>, written: &str) -> Option<TokenClass> {
    Some(match kind {
        // The grammar lists keywords before punctuation, without a break.
        _ if (Rule::kw_vpl..Rule::comma).contains(&kind) => TokenClass::Keyword,
        Rule::reserved | Rule::state => TokenClass::Keyword,
        Rule::name => return name_class(parent),
        Rule::wrong_name => TokenClass::Name,
        Rule::number | Rule::integer | Rule::cell | Rule::wrong_cell | Rule::edition => TokenClass::Number,
        Rule::unit => TokenClass::Unit,
        Rule::text => TokenClass::Text,
        Rule::hole => TokenClass::Hole,
        Rule::colour => TokenClass::Colour,
        Rule::direction => TokenClass::Direction,
        Rule::COMMENT if written.starts_with("///") => TokenClass::Doc,
        Rule::COMMENT => TokenClass::Comment,
        Rule::line_end if written != ";" => TokenClass::Newline,
        Rule::arrow | Rule::equals | Rule::dots | Rule::wrong_equals | Rule::wrong_arrow => TokenClass::Operator,
        Rule::wrong_colon if written == "=" => TokenClass::Operator,
        Rule::plus | Rule::minus | Rule::times | Rule::slash => TokenClass::Operator,
        _ if (Rule::comma..=Rule::wrong_arrow).contains(&kind) => TokenClass::Punctuation,
        Rule::line_end => TokenClass::Punctuation,
        Rule::unread => TokenClass::Bad,
        _ => return None,
    })
}

/// A word is what its place makes of it.
fn name_class(parent: Option<Rule>) -> Option<TokenClass> {
    match parent {
        Some(Rule::hole) => None,
        Some(Rule::feature | Rule::type_name) => Some(TokenClass::Type),
        Some(Rule::call) => Some(TokenClass::Callee),
        _ => Some(TokenClass::Name),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::lang::syntax::agreement::{mutated, soup};

    /// The tokens of a text in one line each.
    fn said(text: &str) -> String {
        let line = |t: &Token| format!("{:?} {:?}\n", t.class, t.text(text));
        tokens(text).iter().map(line).collect()
    }

    fn classes(text: &str, word: &str) -> Vec<TokenClass> {
        let all = tokens(text).into_iter();
        all.filter(|t| t.text(text) == word).map(|t| t.class).collect()
    }

    fn is_total(text: &str) -> Result<(), TestCaseError> {
        let mut at = if text.starts_with(BOM) { BOM.len_utf8() } else { 0 };
        for token in tokens(text) {
            prop_assert!(at <= token.start && token.start < token.end, "{token:?} at {at}");
            let before = text.get(at..token.start);
            prop_assert!(
                before.is_some_and(|b| b.trim_matches([' ', '\t']).is_empty()),
                "{before:?}"
            );
            let written = text.get(token.start..token.end);
            let blanks = [TokenClass::Text, TokenClass::Comment, TokenClass::Doc].contains(&token.class);
            let bare = written.is_some_and(|w| w.trim_matches([' ', '\t']) == w);
            prop_assert!(blanks || bare, "{token:?}");
            at = token.end;
        }
        prop_assert_eq!(text[at..].trim_matches([' ', '\t']), "");
        Ok(())
    }

    #[test]
    fn every_class_is_told_by_its_place() {
        let text = "vpl 1\n/// doc\nlet at(views: length) = f(near: 10 mm, \"a{i}b\", #ff8000, -z) // end\n";
        insta::assert_snapshot!(said(text));
    }

    #[test]
    fn a_word_is_a_keyword_only_where_it_is_one() {
        let text = "vpl 1\nlet views = at\ntask many {\n  views views(count: 20 views)\n}\n";
        use TokenClass::{Callee, Keyword, Name, Unit};
        assert_eq!(classes(text, "views"), [Name, Keyword, Callee, Unit]);
        assert_eq!(classes(text, "at"), [Name]);
        assert_eq!(classes(text, "many"), [Name]);
        let types = "vpl 1\nlibrary l {\n  feature polygon : polygon many\n}\nlet f(length: [length]) = length\n";
        assert_eq!(classes(types, "polygon"), [Name, TokenClass::Type]);
        assert_eq!(classes(types, "length"), [Name, TokenClass::Type, Name]);
        assert_eq!(classes(types, "many"), [Keyword]);
    }

    #[test]
    fn a_bad_region_is_read_word_by_word() {
        let text = "vpl 1\ntask t {\n  lmit 20 views §§ \"open // end\n  rule {\n}\n";
        insta::assert_snapshot!(said(text));
    }

    #[test]
    fn what_is_not_parsed_is_still_read() {
        let deep = format!("rule {} 10 mm \"t\" // c\r\n", "(".repeat(200));
        assert_eq!(classes(&deep, "rule"), [TokenClass::Keyword]);
        assert_eq!(classes(&deep, "(").len(), 200);
        assert_eq!(classes(&deep, "mm"), [TokenClass::Unit]);
        assert_eq!(classes(&deep, "\"t\""), [TokenClass::Text]);
        assert_eq!(classes(&deep, "// c"), [TokenClass::Comment]);
        assert_eq!(classes(&deep, "\r\n"), [TokenClass::Newline]);
        assert_eq!(classes("let a\0\0 = 1", "\0\0"), [TokenClass::Bad]);
    }

    proptest! {
        #[test]
        fn every_text_has_tokens(text in any::<String>()) {
            is_total(&text)?;
        }

        #[test]
        fn broken_programs_have_tokens(text in prop_oneof![mutated(), soup()]) {
            is_total(&text)?;
        }
    }
}
