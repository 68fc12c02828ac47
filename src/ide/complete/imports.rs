//! What can stand in a `use`: modules, files, and what they define.

use super::{Completion, CompletionKind, Context, standard};
use crate::ide::describe::call;
use crate::ide::{MAIN, Snapshot, docs};
use crate::lang::index::Signature;
use crate::lang::{World, analyse, vocabulary};

/// What fits behind the words of an import.
pub(super) fn offers(snapshot: &Snapshot, world: &dyn World, context: &Context<'_>) -> Vec<Completion> {
    // Of `use std.solids.{a, ` the words before the brace are the head.
    let words = if context.head.is_empty() {
        &context.statement
    } else {
        &context.head
    };
    let path: Vec<&str> = words.iter().skip(1).map(|w| w.text).filter(|t| *t != ".").collect();
    match path.as_slice() {
        [] => vec![
            Completion::new("std", CompletionKind::Module)
                .docs("The standard library.")
                .snippet("std.$0"),
        ],
        ["std"] => vocabulary::modules()
            .map(|(name, _)| Completion::new(name, CompletionKind::Module).detail(format!("std.{name}")))
            .collect(),
        ["std", module, ..] => standard::all()
            .iter()
            .filter(|d| d.module == *module)
            .map(|d| defined(&d.name, &d.signature, &d.docs))
            .collect(),
        [file, ..] => of_file(snapshot, world, file.trim_matches('"')),
    }
}

fn of_file(snapshot: &Snapshot, world: &dyn World, relative: &str) -> Vec<Completion> {
    let folder = snapshot.path().rfind('/').map_or("", |at| &snapshot.path()[..=at]);
    let analysis = analyse(&format!("{folder}{relative}"), world);
    let text = analysis.sources().get(MAIN).map_or("", |f| &f.text);
    let own = analysis.index().scope(MAIN).filter(|(_, at)| at.file == MAIN);
    own.filter_map(|(name, at)| {
        let signature = analysis.index().signature(at)?;
        Some(defined(name, signature, &docs::above(text, at.start)))
    })
    .collect()
}

pub(super) fn defined(name: &str, signature: &Signature, docs: &str) -> Completion {
    let kind = match signature.parameters.is_empty() {
        true => CompletionKind::Constant,
        false => CompletionKind::Function,
    };
    Completion::new(name, kind).detail(call(name, signature)).docs(docs)
}
