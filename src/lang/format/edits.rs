//! The changes between a text and its layout, each as small as it can be.

use crate::lang::diagnostics::Edit;
use crate::lang::source::{FileId, Span};
use crate::lang::syntax::{Token, TokenClass, tokens};

/// Edits that turn a text into its layout, in order, none overlapping. They touch only
/// what stands between tokens.
pub fn edits(text: &str, laid_out: &str) -> Vec<Edit> {
    let (old, new) = (words(text), words(laid_out));
    let mut out = Vec::new();
    if old.len() != new.len() {
        return vec![edit(0, text.len(), laid_out)];
    }
    let (mut from, mut to) = (0, 0);
    let ends = [(text.len(), laid_out.len())];
    let starts = old.iter().zip(&new).map(|(a, b)| (a.0, b.0)).chain(ends);
    let behind = old.iter().zip(&new).map(|(a, b)| (a.1, b.1)).chain(ends);
    for ((start, new_start), (end, new_end)) in starts.zip(behind) {
        let (was, is) = (text.get(from..start), laid_out.get(to..new_start));
        if was != is {
            out.push(edit(from, start, is.unwrap_or("")));
        }
        (from, to) = (end, new_end);
    }
    out
}

fn edit(start: usize, end: usize, text: &str) -> Edit {
    Edit {
        span: Span::new(FileId(0), start, end),
        text: text.to_owned(),
    }
}

/// Where the tokens stand that a layout keeps as they are.
fn words(text: &str) -> Vec<(usize, usize)> {
    let kept = |t: &Token| t.class != TokenClass::Newline && !matches!(t.text(text), "," | ";");
    let end = |t: &Token| match t.class {
        TokenClass::Comment | TokenClass::Doc => t.start + t.text(text).trim_end().len(),
        _ => t.end,
    };
    tokens(text)
        .iter()
        .filter(|t| kept(t))
        .map(|t| (t.start, end(t)))
        .collect()
}
