//! Edits applied to a text.

use super::Edit;

/// The text after some edits of it, whatever their order; `None` where two of them
/// overlap, two insert at one place, or one lies outside the text.
pub fn edited(text: &str, edits: &[Edit]) -> Option<String> {
    let mut sorted: Vec<&Edit> = edits.iter().collect();
    sorted.sort_by_key(|edit| (edit.span.start, edit.span.end));
    let mut out = String::with_capacity(text.len() + edits.iter().map(|e| e.text.len()).sum::<usize>());
    let mut done = 0;
    for (k, edit) in sorted.iter().enumerate() {
        if k > 0 && touch(sorted[k - 1], edit) {
            return None;
        }
        out.push_str(text.get(done..edit.span.start)?);
        text.get(edit.span.start..edit.span.end)?;
        out.push_str(&edit.text);
        done = edit.span.end;
    }
    out.push_str(text.get(done..)?);
    Some(out)
}

/// Whether two edits of one file cannot both be made: they overlap, or what they
/// insert would stand in an order that nobody chose.
pub(in crate::lang) fn touch(a: &Edit, b: &Edit) -> bool {
    let (first, second) = if a.span <= b.span { (a, b) } else { (b, a) };
    second.span.start < first.span.end || second.span.start == first.span.start
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lang::source::{FileId, Span};

    fn edit(start: usize, end: usize, text: &str) -> Edit {
        Edit {
            span: Span::new(FileId(0), start, end),
            text: text.into(),
        }
    }

    #[test]
    fn edits_are_made_in_the_order_of_the_text() {
        let edits = [edit(4, 5, "E"), edit(0, 1, ""), edit(2, 2, "++")];
        assert_eq!(edited("abcdef", &edits).as_deref(), Some("b++cdEf"));
    }

    #[test]
    fn what_cannot_be_made_is_refused() {
        assert_eq!(edited("abc", &[edit(0, 2, "x"), edit(1, 3, "y")]), None);
        assert_eq!(edited("abc", &[edit(1, 1, "x"), edit(1, 1, "y")]), None);
        assert_eq!(edited("abc", &[edit(2, 9, "x")]), None);
        assert_eq!(edited("ä", &[edit(1, 1, "x")]), None);
    }
}
