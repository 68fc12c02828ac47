//! Whether two texts are one program: the same parse up to places, line ends and
//! commas, and the same comments. The formatter holds its output to this.

use pest::iterators::Pairs;
use pest::{Parser as _, Token};

use super::{FileId, Grammar, Rule, guard, limit_calls, recover};

/// Whether two texts have one parse and the same comments in the same order.
/// A text that cannot be parsed is the same as none.
pub(in crate::lang) fn same_program(a: &str, b: &str) -> bool {
    match (parsed(a), parsed(b)) {
        (Some(one), Some(other)) => {
            marks(a, one.clone()).eq(marks(b, other.clone())) && comments(one).eq(comments(other))
        }
        _ => false,
    }
}

fn parsed(text: &str) -> Option<Pairs<'_, Rule>> {
    limit_calls();
    let refused = guard::refuse(FileId(0), text).is_some();
    (!refused)
        .then(|| Grammar::parse(Rule::tolerant_file, text).ok())
        .flatten()
}

/// A step of a walk over a parse.
#[derive(PartialEq, Eq)]
enum Mark<'t> {
    Open(Rule),
    /// With the text where it has no parts.
    Close(Rule, &'t str),
}

/// The parse as a walk, bad regions whole.
fn marks<'t>(text: &'t str, pairs: Pairs<'t, Rule>) -> impl Iterator<Item = Mark<'t>> {
    let mut last_start = None;
    let mut bad: Option<(Rule, usize)> = None;
    pairs.tokens().filter_map(move |token| match token {
        Token::Start { rule: kind, pos } => {
            let whole = bad.is_some() || is_trivia(kind);
            if bad.is_none() && recover::strict_entry(kind).is_some() {
                bad = Some((kind, pos.pos()));
            }
            last_start = Some(pos.pos());
            (!whole).then_some(Mark::Open(kind))
        }
        Token::End { rule: kind, pos } => {
            let start = last_start.take();
            match bad {
                Some((region, start)) if region == kind => {
                    bad = None;
                    Some(Mark::Close(kind, text.get(start..pos.pos())?.trim()))
                }
                Some(_) => None,
                None if is_trivia(kind) => None,
                None => Some(Mark::Close(
                    kind,
                    start.and_then(|s| text.get(s..pos.pos())).unwrap_or(""),
                )),
            }
        }
    })
}

fn is_trivia(kind: Rule) -> bool {
    matches!(kind, Rule::COMMENT | Rule::line_end | Rule::comma | Rule::EOI)
}

fn comments(pairs: Pairs<'_, Rule>) -> impl Iterator<Item = &str> {
    let all = pairs.flatten().filter(|p| p.as_rule() == Rule::COMMENT);
    all.map(|p| p.as_str().trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_line_ends_and_commas_do_not_count() {
        let one = "vpl 1\nlibrary l { class a { x, y }; feature x : marker }\nlet a = f(1 mm,\n 2, )\n";
        let other = "\n\nvpl 1\nlibrary l {\nclass a{\nx\ny\n}\nfeature x: marker\n}\r\nlet a=f(1mm,2)";
        assert!(same_program(one, other));
    }

    #[test]
    fn words_values_structure_and_comments_count() {
        let text = "vpl 1\nlet a = f(1 mm, x - 2) // why\n";
        for other in [
            "vpl 1\nlet a = f(1 mm, x - 2)\n",
            "vpl 1\nlet a = f(1 mm, x - 2) // what\n",
            "vpl 1\nlet a = f(2 mm, x - 2) // why\n",
            "vpl 1\nlet a = f(1 mm, (x - 2)) // why\n",
            "vpl 1\nlet a = f(1 mm, x, -2) // why\n",
            "vpl 1\nlet a = f(1 mm, x - 2 // why\n",
        ] {
            assert!(!same_program(text, other), "{other}");
        }
        assert!(same_program("vpl 1\nwhat is this", "vpl 1\n\nwhat is this\n"));
        assert!(!same_program("vpl 1\nwhat is this", "vpl 1\nwhat is  this"));
    }
}
