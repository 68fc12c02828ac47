//! Names: which files make up a program, and what their definitions are called.
//!
//! Gives a [`Program`]: modules with trees, and every `let` and library that each of
//! them can see. Names inside expressions are resolved later, where their types are
//! known.

mod cycles;
mod definitions;
mod modules;
pub(super) mod suggest;

use std::collections::{BTreeMap, BTreeSet};

use super::diagnostics::Diagnostic;
use super::source::{FileId, SourceMap, Span};
use super::syntax::tree;
use super::world::World;

/// A program: the main file and what it imports.
#[derive(Debug)]
pub(super) struct Program {
    /// The modules; the first is the main file.
    pub modules: Vec<Module>,
    /// Every `let` of every module.
    pub definitions: Vec<Definition>,
    /// The definitions, each after those that it needs.
    pub order: Vec<DefinitionId>,
    /// Every library of every module.
    pub libraries: Vec<LibraryItem>,
}

/// A file with what it can see.
#[derive(Debug)]
pub(super) struct Module {
    pub file: FileId,
    pub tree: tree::File,
    /// The module behind each `use` in order; `None` where it failed.
    pub imports: Vec<Option<usize>>,
    /// Definitions in scope by name: its own and imported ones. `None` stands for
    /// a name whose import failed, which was reported.
    pub scope: BTreeMap<String, Option<DefinitionId>>,
    /// Libraries in scope by name, likewise.
    pub libraries: BTreeMap<String, Option<LibraryId>>,
    /// Words in regions that could not be read: a name among them may well be declared there.
    pub lost: BTreeSet<String>,
}

/// Index into [`Program::definitions`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct DefinitionId(pub usize);

/// A `let` and the module it stands in.
#[derive(Debug)]
pub(super) struct Definition {
    pub module: usize,
    pub tree: tree::Let,
    /// Whether it needs itself, which was reported.
    pub circular: bool,
}

/// Index into [`Program::libraries`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct LibraryId(pub usize);

/// A library and the module it stands in.
#[derive(Debug)]
pub(super) struct LibraryItem {
    pub module: usize,
    /// Its place among the module's items.
    item: usize,
    /// Whether it takes itself over, which was reported.
    pub circular: bool,
}

impl Program {
    /// The main file's module.
    pub fn main(&self) -> &Module {
        &self.modules[0]
    }

    /// A library with its module.
    pub fn library(&self, id: LibraryId) -> Option<(&tree::Library, &Module)> {
        let item = self.libraries.get(id.0)?;
        let module = self.modules.get(item.module)?;
        match module.tree.items.get(item.item)? {
            tree::Item::Library(library) => Some((library, module)),
            _ => None,
        }
    }

    /// The definition of an id.
    pub fn definition(&self, id: DefinitionId) -> &Definition {
        &self.definitions[id.0]
    }
}

/// Reads the main file and everything that it imports. `None` where the main file
/// cannot be read at all.
pub(super) fn load(path: &str, world: &dyn World, sources: &mut SourceMap) -> (Option<Program>, Vec<Diagnostic>) {
    let (loaded, mut found) = modules::load(path, world, sources);
    if loaded.is_empty() {
        return (None, found);
    }
    let (mut program, more) = definitions::resolve(loaded, sources);
    found.extend(more);
    found.extend(cycles::mark(&mut program));
    (Some(program), found)
}

/// The names of the standard library that define something, with their modules.
pub(super) fn standard_home(name: &str) -> Option<&'static str> {
    super::stdlib::names().find(|module| {
        super::stdlib::module(module).is_some_and(|text| {
            text.lines().any(|line| {
                line.strip_prefix("let ")
                    .or_else(|| line.strip_prefix("library "))
                    .and_then(|rest| rest.strip_prefix(name))
                    .is_some_and(|rest| rest.starts_with(['(', ' ']))
            })
        })
    })
}

pub(super) use cycles::mentioned;
pub(super) use modules::refused_path;

/// Reports a name that is declared twice; `kind` is empty where the two are of
/// different kinds.
pub(super) fn declared_twice(kind: &str, name: &tree::Name, first: Span) -> Diagnostic {
    let message = format!("{kind} `{}` is declared twice", name.text);
    Diagnostic::new(super::diagnostics::Code::E0202, name.span, message.trim_start())
        .label("declared again")
        .related(first, "first declared here")
        .help("give one of them another name")
}

/// The first declaration of each name; later ones are reported.
pub(super) fn unique<'a>(
    kind: &str,
    names: impl IntoIterator<Item = &'a tree::Name>,
    found: &mut Vec<Diagnostic>,
) -> BTreeMap<&'a str, Span> {
    let mut seen = BTreeMap::new();
    for name in names {
        match seen.get(name.text.as_str()) {
            Some(first) => found.push(declared_twice(kind, name, *first)),
            None => drop(seen.insert(name.text.as_str(), name.span)),
        }
    }
    seen
}
