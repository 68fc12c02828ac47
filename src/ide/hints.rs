//! What can be shown between the words: SI values, and how many rules a family gives.

use super::describe::rules_from;
use super::{MAIN, Snapshot, values, walk};
use crate::lang::Span;
use crate::lang::syntax::tree::{ExprKind, Item};

/// A few words behind a byte of the main file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hint {
    /// The byte.
    pub at: usize,
    /// The words.
    pub text: String,
    /// What they are.
    pub kind: HintKind,
}

/// What a hint is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HintKind {
    /// The SI value of a quantity.
    Value,
    /// The rules that a family or a layout stands for.
    Rules,
}

/// The hints between two bytes, in order. Quantities whose SI value is a mere shift of
/// the decimal point get one only where `every` asks for it.
pub fn hints(snapshot: &Snapshot, range: std::ops::Range<usize>, every: bool) -> Vec<Hint> {
    let Some(tree) = snapshot.tree(MAIN) else {
        return Vec::new();
    };
    let mut found = Vec::new();
    let within = |span: Span| range.start <= span.end && span.end <= range.end;
    walk::expressions(tree, &mut |e| {
        if let ExprKind::Quantity(quantity) = &e.kind
            && within(e.span)
            && (every || values::is_converted(quantity))
            && let Some(text) = values::in_si(quantity)
            && text != snapshot.sources().text(e.span)
        {
            found.push(Hint {
                at: e.span.end,
                text: format!("= {text}"),
                kind: HintKind::Value,
            });
        }
    });
    let heads = tree.items.iter().flat_map(|item| match item {
        Item::Library(library) => {
            let rules = library.rules.iter().map(|r| r.head);
            rules.chain(library.layouts.iter().map(|l| l.head)).collect()
        }
        _ => Vec::new(),
    });
    for head in heads.filter(|head| within(*head)) {
        let rules = rules_from(snapshot, head);
        if rules > 1 {
            found.push(Hint {
                at: head.end,
                text: format!("{rules} rules"),
                kind: HintKind::Rules,
            });
        }
    }
    found.sort_by_key(|hint| hint.at);
    found
}
