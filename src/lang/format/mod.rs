//! How programs are laid out: one form for spaces, indentation, columns and breaks.
//!
//! Works on the compiler's tokens ([`verbatim`]: which lines are left alone, because
//! they could not be read) grouped by brackets ([`pieces`]), written line by line
//! ([`write`]) and put into columns ([`columns`]). It knows brackets and where
//! statements end, and next to nothing of what they say. Its result is read again
//! and must be the same program. `vpl fmt` and the language server call it.

mod columns;
mod edits;
mod pieces;
mod spaces;
#[cfg(test)]
mod tests;
mod verbatim;
mod write;

use super::EDITION;
use super::source::{FileId, Span};
use super::syntax::{self, Token, TokenClass};

pub use edits::edits;

/// Longest line that is not broken, in characters without its comment.
const WIDTH: usize = 100;

/// A text as it should be laid out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Formatted {
    /// The whole text.
    pub text: String,
    /// Parts of the given text that could not be read, and stand as they were written.
    pub untouched: Vec<Span>,
    /// Whether the layout was thrown away because it would not have been the same
    /// program. That is a mistake of the formatter; the text is the given one.
    pub refused: bool,
}

/// Lays out a text. Comments stay, and so does the meaning.
///
/// Lines end with `\n` and a byte order mark is dropped. A text that the parser does
/// not take at all, or that is of a newer edition, is untouched as a whole.
///
/// # Example
/// ```
/// let formatted = vpl::lang::format("vpl 1\nlet a=f( 1mm,2 )");
/// assert_eq!(formatted.text, "vpl 1\n\nlet a = f(1 mm, 2)\n");
/// ```
pub fn format(text: &str) -> Formatted {
    let mut reading = syntax::read(text);
    let header = header(&reading.tokens, text);
    // Space would make an edition line of `vpl1`, which is none.
    if let [word, edition, ..] = header[..]
        && edition.class == TokenClass::Number
        && word.end == edition.start
    {
        reading.bad.insert(0, word.start..edition.end);
    }
    let verbatim = (reading.parsed && !is_newer(&header, text))
        .then(|| verbatim::lines(text, &reading.tokens, &reading.bad))
        .flatten();
    let Some(verbatim) = verbatim else {
        return kept(text, false);
    };
    let written = pieces::pieces(text, &reading.tokens, &verbatim).map(|body| write::lines(text, &body));
    let Some(out) = written.and_then(|mut lines| {
        columns::align(&mut lines);
        columns::join(text, &lines)
    }) else {
        return kept(text, false);
    };
    if out != text && !syntax::same_program(text, &out) {
        return kept(text, true);
    }
    Formatted {
        text: out,
        untouched: verbatim.iter().map(|v| Span::new(FileId(0), v.start, v.end)).collect(),
        refused: false,
    }
}

/// The text as it is.
fn kept(text: &str, refused: bool) -> Formatted {
    Formatted {
        text: text.to_owned(),
        untouched: vec![Span::new(FileId(0), 0, text.len())],
        refused,
    }
}

/// What may be the edition line: `vpl` and the two tokens behind it, or nothing.
fn header(tokens: &[Token], text: &str) -> Vec<Token> {
    let trivia = [TokenClass::Newline, TokenClass::Comment, TokenClass::Doc];
    let mut code = tokens.iter().filter(|t| !trivia.contains(&t.class)).peekable();
    match code.peek() {
        Some(t) if t.text(text).eq_ignore_ascii_case("vpl") => code.take(3).copied().collect(),
        _ => Vec::new(),
    }
}

fn is_newer(header: &[Token], text: &str) -> bool {
    // Behind a `:` that has no place there, perhaps.
    let edition = header.iter().find(|t| t.class == TokenClass::Number);
    edition
        .and_then(|t| t.text(text).parse::<u64>().ok())
        .is_some_and(|e| e > u64::from(EDITION))
}
