//! What the pointer rests on: a name, a quantity, a rule's first line, a keyword.

use super::describe::{describe, rule};
use super::{MAIN, Snapshot, docs, values, walk};
use crate::lang::syntax::TokenClass;
use crate::lang::syntax::tree::{Expr, ExprKind, Item, Quantity};
use crate::lang::{Span, vocabulary};

/// Text about a part of the main file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hover {
    /// What it is about.
    pub span: Span,
    /// In Markdown.
    pub markdown: String,
}

/// What there is to say about a byte of the main file.
pub fn hover(snapshot: &Snapshot, offset: usize) -> Option<Hover> {
    on_quantity(snapshot, offset)
        .or_else(|| on_name(snapshot, offset))
        .or_else(|| on_rule(snapshot, offset))
        .or_else(|| on_keyword(snapshot, offset))
}

fn on_name(snapshot: &Snapshot, offset: usize) -> Option<Hover> {
    let name = snapshot.index().at(MAIN, offset)?;
    Some(Hover {
        span: name.span,
        markdown: describe(snapshot, name.entity)?.markdown(),
    })
}

fn on_quantity(snapshot: &Snapshot, offset: usize) -> Option<Hover> {
    let mut found: Option<(&Expr, &Quantity)> = None;
    walk::expressions(snapshot.tree(MAIN)?, &mut |e| {
        if let ExprKind::Quantity(q) = &e.kind
            && e.span.start <= offset
            && offset < e.span.end
        {
            found = Some((e, q));
        }
    });
    let (e, quantity) = found?;
    let unit = quantity.unit.as_ref()?;
    let (_, ty, _) = vocabulary::units().find(|(name, ..)| *name == unit.text)?;
    let written = snapshot.sources().text(e.span);
    let (kind, value) = (vocabulary::describe(ty), values::in_si(quantity)?);
    Some(Hover {
        span: e.span,
        markdown: format!("```vpl\n{written}\n```\n\n{kind}: {value}"),
    })
}

fn on_rule(snapshot: &Snapshot, offset: usize) -> Option<Hover> {
    let items = snapshot.tree(MAIN)?.items.iter();
    let rules = items.flat_map(|item| match item {
        Item::Library(library) => library.rules.as_slice(),
        _ => &[],
    });
    let mut on = rules.filter(|r| r.head.start <= offset && offset <= r.head.end);
    let found = on.next()?;
    Some(Hover {
        span: found.head,
        markdown: rule(snapshot, found).markdown(),
    })
}

fn on_keyword(snapshot: &Snapshot, offset: usize) -> Option<Hover> {
    let tokens = snapshot.tokens();
    let before = tokens.partition_point(|t| t.start <= offset);
    let token = tokens.get(before.checked_sub(1)?)?;
    if token.class != TokenClass::Keyword || offset > token.end {
        return None;
    }
    let word = token.text(snapshot.text());
    Some(Hover {
        span: Span::new(MAIN, token.start, token.end),
        markdown: format!("```vpl\n{word}\n```\n\n{}", docs::keyword(word)?),
    })
}
