//! What is looked at before parsing: how deep brackets nest, and NUL bytes.
//!
//! The parser recurses with the nesting, so its depth is bounded here.

use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::source::{FileId, Span};

/// Deepest nesting of brackets.
const MOST_NESTED: usize = 128;

/// Why a text is not shown to the parser.
pub(super) fn refuse(file: FileId, text: &str) -> Option<Diagnostic> {
    if let Some(at) = text.bytes().position(|b| b == 0) {
        let out = Diagnostic::new(
            Code::E0107,
            Span::new(file, at, at + 1),
            format!("a NUL byte at offset {at}: this is no text file"),
        );
        return Some(out.help("save the program as UTF-8 text"));
    }
    let at = too_deep(text)?;
    let message = format!("brackets are nested more than {MOST_NESTED} deep");
    Some(
        Diagnostic::new(Code::E0108, Span::new(file, at, at + 1), message)
            .label("the innermost one that is read")
            .help("close brackets that were left open, or name parts of the expression with `let`"),
    )
}

/// The offset of the bracket that goes too deep.
fn too_deep(text: &str) -> Option<usize> {
    let bytes = text.as_bytes();
    let mut open: Vec<u8> = Vec::new();
    let (mut at, mut quoted) = (0, false);
    while at < bytes.len() {
        match bytes[at] {
            b'\n' => quoted = false,
            b'\\' if quoted => at += 1,
            b'"' => quoted = !quoted,
            b'/' if !quoted && bytes.get(at + 1) == Some(&b'/') => {
                at += bytes[at..].iter().take_while(|b| **b != b'\n').count();
                continue;
            }
            b @ (b'(' | b'[' | b'{') if !quoted => {
                open.push(b);
                if open.len() > MOST_NESTED {
                    return Some(at);
                }
            }
            b @ (b')' | b']' | b'}') if !quoted => close(&mut open, b),
            _ => {}
        }
        at += 1;
    }
    None
}

/// A closing bracket closes what was left open inside its own pair, too.
fn close(open: &mut Vec<u8>, closing: u8) {
    let opening = match closing {
        b')' => b'(',
        b']' => b'[',
        _ => b'{',
    };
    if let Some(at) = open.iter().rposition(|b| *b == opening) {
        open.truncate(at);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depth_is_counted_outside_texts_and_comments() {
        let deep = |n: usize| format!("{}{}", "(".repeat(n), ")".repeat(n));
        assert_eq!(too_deep(&deep(MOST_NESTED)), None);
        assert_eq!(too_deep(&deep(MOST_NESTED + 1)), Some(MOST_NESTED));
        assert_eq!(too_deep(&format!("// {}\n\"{}\"", deep(200), "(".repeat(200))), None);
    }

    #[test]
    fn an_unclosed_bracket_ends_with_the_pair_around_it() {
        assert_eq!(too_deep(&"{ ( }".repeat(200)), None);
    }
}
