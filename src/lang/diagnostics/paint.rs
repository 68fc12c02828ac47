//! Colour on a terminal, and text that no terminal takes for a command.

use std::borrow::Cow;

/// The codes of a style, as `ESC [ … m` wants them.
pub(super) type Style = &'static str;

pub(super) const BOLD: Style = "1";
pub(super) const CODE: Style = "36";
pub(super) const DIM: Style = "2";
pub(super) const RED: Style = "1;31";
pub(super) const YELLOW: Style = "1;33";
pub(super) const BLUE: Style = "1;34";
pub(super) const GREEN: Style = "32";

/// The text in a style, where colour is wanted.
pub(super) fn paint(colour: bool, style: Style, text: &str) -> Cow<'_, str> {
    if !colour || text.is_empty() {
        return Cow::Borrowed(text);
    }
    Cow::Owned(format!("\u{1b}[{style}m{text}\u{1b}[0m"))
}

/// A character as it may stand on a terminal: what would move the cursor, change
/// colours or turn the direction of the text around is replaced.
pub(super) fn visible(c: char) -> char {
    match c {
        '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' => char::REPLACEMENT_CHARACTER,
        c if c.is_control() => char::REPLACEMENT_CHARACTER,
        c => c,
    }
}

/// Most characters of a message; a name can be as long as a file.
const MOST_CHARS: usize = 2_000;

/// A message as it may stand on a terminal, on one line.
pub(super) fn one_line(text: &str) -> String {
    let shown = text.chars().map(|c| if c == '\n' { ' ' } else { visible(c) });
    let mut out: String = shown.clone().take(MOST_CHARS).collect();
    if shown.count() > MOST_CHARS {
        out.push('…');
    }
    out
}
