//! What each module defines and imports.

use std::collections::{BTreeMap, BTreeSet};

use super::modules::Loaded;
use super::suggest::{closest, one_of};
use super::{Definition, DefinitionId, Module, Program, declared_twice};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::source::{SourceMap, Span};
use crate::lang::syntax::tree;
use crate::primitives;

/// Ties modules together.
pub(super) fn resolve(loaded: Vec<Loaded>, sources: &SourceMap) -> (Program, Vec<Diagnostic>) {
    let mut found = Vec::new();
    let mut definitions = Vec::new();
    let own: Vec<Own> = loaded
        .iter()
        .enumerate()
        .map(|(k, module)| define(k, module, &mut definitions, &mut found))
        .collect();
    let lost: Vec<BTreeSet<String>> = loaded.iter().map(|m| words(&m.tree.bad, sources)).collect();
    let modules = (0..loaded.len())
        .map(|k| {
            let scope = import(k, &loaded, &own, &lost, &mut found);
            (scope, lost[k].clone())
        })
        .collect::<Vec<_>>();
    let modules = modules
        .into_iter()
        .zip(loaded)
        .map(|((scope, lost), module)| Module {
            file: module.file,
            tree: module.tree,
            imports: module.imports,
            scope,
            lost,
        })
        .collect();
    (Program { modules, definitions }, found)
}

/// A module's own definitions and where they stand.
type Own = BTreeMap<String, (DefinitionId, Span)>;

fn define(module: usize, loaded: &Loaded, all: &mut Vec<Definition>, found: &mut Vec<Diagnostic>) -> Own {
    let mut own = Own::new();
    for item in &loaded.tree.items {
        let tree::Item::Let(item) = item else { continue };
        if let Some((_, first)) = own.get(&item.name.text) {
            found.push(declared_twice("definition", &item.name, *first));
            continue;
        }
        if primitives::find(&item.name.text).is_some() {
            found.push(
                Diagnostic::new(
                    Code::E0202,
                    item.name.span,
                    format!("`{}` is a primitive and cannot be defined anew", item.name.text),
                )
                .help("give the definition another name"),
            );
        }
        own.insert(item.name.text.clone(), (DefinitionId(all.len()), item.name.span));
        all.push(Definition {
            module,
            tree: item.clone(),
            circular: false,
        });
    }
    own
}

/// The scope of a module: what it defines and what it imports.
fn import(
    module: usize,
    loaded: &[Loaded],
    own: &[Own],
    lost: &[BTreeSet<String>],
    found: &mut Vec<Diagnostic>,
) -> BTreeMap<String, Option<DefinitionId>> {
    let mut places: BTreeMap<String, Span> = own[module].iter().map(|(n, (_, at))| (n.clone(), *at)).collect();
    let mut scope: BTreeMap<_, _> = own[module].iter().map(|(n, (id, _))| (n.clone(), Some(*id))).collect();
    let uses = loaded[module].tree.items.iter().filter_map(|item| match item {
        tree::Item::Use(import) => Some(import),
        _ => None,
    });
    for (import, target) in uses.zip(&loaded[module].imports) {
        if import.names.is_empty() && target.is_some() {
            found.push(nothing_named(import, target.map(|t| &own[t])));
        }
        for name in &import.names {
            if let Some(first) = places.get(&name.text) {
                // Of an import that failed, one report is enough.
                if target.is_some() {
                    found.push(declared_twice("definition", name, *first));
                }
                continue;
            }
            let id = target.and_then(|t| own[t].get(&name.text)).map(|(id, _)| *id);
            if let Some(t) = target.filter(|t| id.is_none() && !lost[*t].contains(&name.text)) {
                found.push(not_there(name, &loaded[t].title, &own[t]));
            }
            places.insert(name.text.clone(), name.span);
            scope.insert(name.text.clone(), id);
        }
    }
    scope
}

fn nothing_named(import: &tree::Use, own: Option<&Own>) -> Diagnostic {
    let names = own.map_or(String::new(), |own| one_of(own.keys().map(String::as_str)));
    Diagnostic::new(Code::E0204, import.span, "this import names no definition").help(format!(
        "say what to bring into scope, of {names}: `use module.name` or `use module.{{a, b}}`"
    ))
}

fn not_there(name: &tree::Name, title: &str, own: &Own) -> Diagnostic {
    let text = &name.text;
    let out = Diagnostic::new(Code::E0204, name.span, format!("`{title}` defines no `{text}`"));
    if primitives::find(text).is_some() {
        return out.help(format!(
            "`{text}` is a primitive, in scope everywhere: leave it out of the import"
        ));
    }
    match closest(text, own.keys().map(String::as_str)) {
        Some(near) => out
            .help(format!("did you mean `{near}`?"))
            .fix(format!("write `{near}`"), name.span, near),
        None => out.help(format!("it defines {}", one_of(own.keys().map(String::as_str)))),
    }
}

/// The words in some regions.
fn words(regions: &[Span], sources: &SourceMap) -> BTreeSet<String> {
    regions
        .iter()
        .flat_map(|region| {
            sources
                .text(*region)
                .split(|c: char| !c.is_ascii_alphanumeric() && c != '_')
        })
        .filter(|word| word.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_'))
        .map(str::to_owned)
        .collect()
}
