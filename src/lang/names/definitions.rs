//! What each module defines and imports.

use std::collections::{BTreeMap, BTreeSet};

use super::modules::Loaded;
use super::suggest::{closest, one_of};
use super::{Definition, DefinitionId, LibraryId, LibraryItem, Module, Program, declared_twice};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::source::{SourceMap, Span};
use crate::lang::syntax::tree;
use crate::primitives;

/// Ties modules together.
pub(super) fn resolve(loaded: Vec<Loaded>, sources: &SourceMap) -> (Program, Vec<Diagnostic>) {
    let mut found = Vec::new();
    let mut all = All::default();
    let own: Vec<Own> = loaded
        .iter()
        .enumerate()
        .map(|(k, module)| define(k, module, &mut all, &mut found))
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
        .map(|(((scope, libraries), lost), module)| Module {
            file: module.file,
            tree: module.tree,
            imports: module.imports,
            scope,
            libraries,
            lost,
        })
        .collect();
    let program = Program {
        modules,
        definitions: all.definitions,
        order: Vec::new(),
        libraries: all.libraries,
    };
    (program, found)
}

/// The definitions and libraries of all modules.
#[derive(Default)]
struct All {
    definitions: Vec<Definition>,
    libraries: Vec<LibraryItem>,
}

/// What a name of a module's one namespace means.
#[derive(Clone, Copy)]
enum Symbol {
    Definition(DefinitionId),
    Library(LibraryId),
}

/// A module's own definitions and libraries, and where they stand.
type Own = BTreeMap<String, (Symbol, Span)>;

fn define(module: usize, loaded: &Loaded, all: &mut All, found: &mut Vec<Diagnostic>) -> Own {
    let mut own = Own::new();
    for (k, item) in loaded.tree.items.iter().enumerate() {
        let (name, symbol) = match item {
            tree::Item::Let(item) => {
                found.extend(redefined(&item.name));
                (&item.name, all.definition(module, item))
            }
            tree::Item::Library(item) => (&item.name, all.library(module, k)),
            _ => continue,
        };
        match own.get(&name.text) {
            Some((other, first)) => found.push(declared_twice(kind(symbol, *other), name, *first)),
            None => drop(own.insert(name.text.clone(), (symbol, name.span))),
        }
    }
    own
}

impl All {
    fn definition(&mut self, module: usize, item: &tree::Let) -> Symbol {
        self.definitions.push(Definition {
            module,
            tree: item.clone(),
            circular: false,
        });
        Symbol::Definition(DefinitionId(self.definitions.len() - 1))
    }

    fn library(&mut self, module: usize, item: usize) -> Symbol {
        self.libraries.push(LibraryItem {
            module,
            item,
            circular: false,
        });
        Symbol::Library(LibraryId(self.libraries.len() - 1))
    }
}

/// What to call two things of one name.
fn kind(a: Symbol, b: Symbol) -> &'static str {
    match (a, b) {
        (Symbol::Definition(_), Symbol::Definition(_)) => "definition",
        (Symbol::Library(_), Symbol::Library(_)) => "library",
        _ => "",
    }
}

/// A definition that has the name of a primitive.
fn redefined(name: &tree::Name) -> Option<Diagnostic> {
    primitives::find(&name.text)?;
    let message = format!("`{}` is a primitive and cannot be defined anew", name.text);
    Some(Diagnostic::new(Code::E0202, name.span, message).help("give the definition another name"))
}

/// Definitions and libraries in scope.
type InScope = (
    BTreeMap<String, Option<DefinitionId>>,
    BTreeMap<String, Option<LibraryId>>,
);

/// The scope of a module: what it defines and what it imports.
fn import(
    module: usize,
    loaded: &[Loaded],
    own: &[Own],
    lost: &[BTreeSet<String>],
    found: &mut Vec<Diagnostic>,
) -> InScope {
    let mut places: BTreeMap<String, Span> = own[module].iter().map(|(n, (_, at))| (n.clone(), *at)).collect();
    let mut scope = InScope::default();
    for (name, (symbol, _)) in &own[module] {
        bind(&mut scope, name, Some(*symbol));
    }
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
                    found.push(declared_twice("", name, *first));
                }
                continue;
            }
            let symbol = target.and_then(|t| own[t].get(&name.text)).map(|(symbol, _)| *symbol);
            if let Some(t) = target.filter(|t| symbol.is_none() && !lost[*t].contains(&name.text)) {
                found.push(not_there(name, &loaded[t].title, &own[t]));
            }
            places.insert(name.text.clone(), name.span);
            bind(&mut scope, &name.text, symbol);
        }
    }
    scope
}

/// A name whose import failed may have been either.
fn bind((definitions, libraries): &mut InScope, name: &str, symbol: Option<Symbol>) {
    if !matches!(symbol, Some(Symbol::Library(_))) {
        let id = match symbol {
            Some(Symbol::Definition(id)) => Some(id),
            _ => None,
        };
        definitions.insert(name.to_owned(), id);
    }
    if !matches!(symbol, Some(Symbol::Definition(_))) {
        let id = match symbol {
            Some(Symbol::Library(id)) => Some(id),
            _ => None,
        };
        libraries.insert(name.to_owned(), id);
    }
}

fn nothing_named(import: &tree::Use, own: Option<&Own>) -> Diagnostic {
    let names = own.map_or(String::new(), |own| one_of(own.keys().map(String::as_str)));
    let module = match &import.module {
        tree::Module::Dotted(_) => "module".to_owned(),
        tree::Module::Path(path) => format!("\"{}\"", path.text),
    };
    Diagnostic::new(Code::E0204, import.span, "this import names nothing").help(format!(
        "say what to bring into scope, of {names}: `use {module}.name` or `use {module}.{{a, b}}`"
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
        Some(near) => out.meant(near),
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
