//! Types and units: every expression gets one type, every name one meaning.
//!
//! Reads the program with its resolved modules and gives the checked program that
//! lowering expands. What is wrong is left out of it, and said once.

mod calls;
mod classes;
pub(super) mod colours;
mod expectations;
mod expressions;
mod facts;
mod fallbacks;
pub(super) mod features;
pub(super) mod forms;
mod inclusion;
mod layouts;
mod library;
mod mismatch;
mod operators;
mod parameters;
mod references;
mod rule;
mod scene;
mod scope;
mod shadowing;
pub(super) mod stated;
pub(super) mod studies;
pub(super) mod task;
pub(super) mod typed;
pub(super) mod units;
mod words;

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use super::diagnostics::Diagnostic;
use super::index::{self, Entity, Index, Kind, Recorder};
use super::names::{self, DefinitionId, LibraryId, Program};
use super::source::FileId;
use super::syntax::tree;
use crate::primitives::Type;
use crate::rules::FeatureKind;
use parameters::{Slot, visible};
use scope::Scope;

/// Checks a program.
pub(super) fn check(program: &Program) -> (typed::Program, Index, Vec<Diagnostic>) {
    let mut checker = Checker {
        program,
        signatures: Vec::new(),
        library_signatures: Vec::new(),
        definitions: (0..program.definitions.len()).map(|_| State::New).collect(),
        libraries: vec![None; program.libraries.len()],
        parts_taken: 0,
        known_coverage: BTreeMap::new(),
        unknown: BTreeSet::new(),
        names: Recorder::new(program),
        unknown_arguments: BTreeMap::new(),
        found: Vec::new(),
    };
    checker.all_signatures();
    for id in &program.order {
        checker.definition(*id);
        checker.coverage(*id);
    }
    for k in 0..program.libraries.len() {
        checker.library(LibraryId(k));
    }
    let mut out = checker.items(&program.main().tree);
    checker.record_signatures();
    out.definitions = checker.definitions.into_iter().map(State::done).collect();
    (out, checker.names.index(), checker.found)
}

struct Checker<'a> {
    program: &'a Program,
    /// The parameters of each definition.
    signatures: Vec<Vec<Slot>>,
    /// The parameters of each library; none for one that is no template.
    library_signatures: Vec<Vec<Slot>>,
    definitions: Vec<State>,
    /// By library; `None` until it is checked.
    libraries: Vec<Option<Rc<typed::Library>>>,
    /// How many parts of libraries were taken over so far.
    parts_taken: usize,
    /// By definition and parameter: whether all its uses stand before an `else`.
    known_coverage: BTreeMap<(DefinitionId, usize), bool>,
    /// Unknown names that were reported, each once a file.
    unknown: BTreeSet<(FileId, &'static str, String)>,
    names: Recorder,
    /// Unknown arguments by callee and name: which of `found` says so.
    unknown_arguments: BTreeMap<(FileId, String, String), usize>,
    found: Vec<Diagnostic>,
}

/// How far a definition is.
enum State {
    New,
    /// Its body is being checked, or it is wrong.
    Unusable,
    Done(Rc<typed::Definition>),
}

impl State {
    fn checked(&self) -> Option<Rc<typed::Definition>> {
        match self {
            Self::Done(definition) => Some(Rc::clone(definition)),
            Self::New | Self::Unusable => None,
        }
    }

    fn done(self) -> Option<typed::Definition> {
        match self {
            Self::Done(definition) => Some(owned(definition)),
            Self::New | Self::Unusable => None,
        }
    }
}

impl<'a> Checker<'a> {
    fn report(&mut self, diagnostic: Diagnostic) {
        self.found.push(diagnostic);
    }

    /// Whether an unknown name of a kind is met for the first time in its file.
    fn first_time(&mut self, kind: &'static str, name: &tree::Name) -> bool {
        self.unknown.insert((name.span.file, kind, name.text.clone()))
    }

    fn all_signatures(&mut self) {
        let program = self.program;
        for definition in &program.definitions {
            let signature = self.signature(&definition.tree.parameters);
            self.signatures.push(signature);
        }
        for k in 0..program.libraries.len() {
            let parameters = program
                .library(LibraryId(k))
                .and_then(|(tree, _)| tree.parameters.as_deref());
            let signature = self.signature(parameters.unwrap_or_default());
            self.library_signatures.push(signature);
        }
    }

    /// Checks a definition now if it was not before; its type, where it has one.
    fn definition(&mut self, id: DefinitionId) -> Option<Type> {
        let program = self.program;
        let definition = program.definition(id);
        match &self.definitions[id.0] {
            State::Done(done) => return Some(done.body.ty),
            State::Unusable => return None,
            State::New => self.definitions[id.0] = State::Unusable,
        }
        if definition.circular {
            return None;
        }
        let signature = self.signatures[id.0].clone();
        let module = &program.modules[definition.module];
        for parameter in &definition.tree.parameters {
            self.hides_something("parameter", &parameter.name, Scope::of(module));
        }
        let defaults = self.defaults(&definition.tree.parameters, &signature, module);
        let parameters = visible(&signature);
        let scope = Scope {
            parameters: Some(&parameters),
            ..Scope::of(module)
        };
        let body = self.infer(&definition.tree.body, scope)?;
        let ty = body.ty;
        let parameters = defaults?;
        self.definitions[id.0] = State::Done(Rc::new(typed::Definition { parameters, body }));
        Some(ty)
    }

    /// The entity of a definition.
    fn entity(&self, id: DefinitionId) -> Entity {
        Entity::Declared(Kind::Definition, self.program.definition(id).tree.name.span)
    }

    /// Records the name of a library.
    fn uses_library(&mut self, name: &tree::Name, id: LibraryId) {
        if let Some((library, _)) = self.program.library(id) {
            self.names
                .uses(name.span, Entity::Declared(Kind::Library, library.name.span));
        }
    }

    fn record_signatures(&mut self) {
        for (k, slots) in self.signatures.iter().enumerate() {
            let id = DefinitionId(k);
            let body = self.definitions[k].checked();
            let signature = index::Signature {
                parameters: slots.iter().map(parameter).collect(),
                result: body.map(|definition| definition.body.ty),
                features: self.features_of(id),
            };
            self.names
                .signature(self.program.definition(id).tree.name.span, signature);
        }
        for (k, slots) in self.library_signatures.iter().enumerate() {
            if let Some((library, _)) = self.program.library(LibraryId(k)) {
                let signature = index::Signature {
                    parameters: slots.iter().map(parameter).collect(),
                    ..index::Signature::default()
                };
                self.names.signature(library.name.span, signature);
            }
        }
    }

    /// The kinds of feature that a definition is for: those of its primitive.
    fn features_of(&self, id: DefinitionId) -> &'static [FeatureKind] {
        let mut next = self.definitions[id.0].checked();
        // Definitions need no circle: whoever is done was checked after what it names.
        while let Some(definition) = next {
            match &definition.body.kind {
                typed::ExprKind::Primitive(primitive, _) => return primitive.features,
                typed::ExprKind::Definition(inner, _) => next = self.definitions[inner.0].checked(),
                _ => break,
            }
        }
        &[]
    }

    fn items(&mut self, file: &'a tree::File) -> typed::Program {
        let mut out = typed::Program::default();
        let each = |want: fn(&tree::Item) -> Option<&tree::Name>| file.items.iter().filter_map(want);
        names::unique("task", each(task_name), &mut self.found);
        names::unique("scene", each(scene_name), &mut self.found);
        names::unique("test", each(test_name), &mut self.found);
        names::unique("study", each(study_name), &mut self.found);
        out.libraries = self.listed(file);
        for item in &file.items {
            match item {
                tree::Item::Task(task) => out.tasks.extend(self.task(task, &out.libraries)),
                tree::Item::Scene(scene) => out.scenes.push(self.scene(scene, &out.libraries)),
                tree::Item::Test(test) => out.facts.push(self.fact(test, &out.libraries)),
                tree::Item::Study(study) => out.studies.push(self.study(study)),
                _ => {}
            }
        }
        self.one_object_a_name(file);
        out
    }

    /// The libraries that a task can name: those in the main file's scope that are no
    /// templates, in the order of its text.
    fn listed(&mut self, file: &tree::File) -> Vec<typed::Library> {
        let main = self.program.main();
        let mut seen = BTreeSet::new();
        let mut out = Vec::new();
        for name in file.items.iter().flat_map(names_of) {
            let Some(Some(id)) = main.libraries.get(&name.text) else {
                continue;
            };
            let template = self
                .program
                .library(*id)
                .is_none_or(|(tree, _)| tree.parameters.is_some());
            if template || !seen.insert(*id) {
                continue;
            }
            let library = self.libraries[id.0].take();
            out.extend(library.map(owned));
        }
        out
    }

    /// `--object NAME` must mean one object, whatever its scene.
    fn one_object_a_name(&mut self, file: &tree::File) {
        let objects = file.items.iter().filter_map(|item| match item {
            tree::Item::Scene(scene) => Some(&scene.objects),
            _ => None,
        });
        names::unique("object", objects.flatten().map(|o| &o.name), &mut self.found);
    }
}

fn parameter(slot: &Slot) -> index::Parameter {
    index::Parameter {
        name: slot.name.clone(),
        ty: slot.ty,
        optional: slot.optional,
        at: slot.span,
    }
}

fn task_name(item: &tree::Item) -> Option<&tree::Name> {
    match item {
        tree::Item::Task(task) => Some(&task.name),
        _ => None,
    }
}

fn scene_name(item: &tree::Item) -> Option<&tree::Name> {
    match item {
        tree::Item::Scene(scene) => Some(&scene.name),
        _ => None,
    }
}

fn test_name(item: &tree::Item) -> Option<&tree::Name> {
    match item {
        tree::Item::Test(test) => Some(&test.name),
        _ => None,
    }
}

fn study_name(item: &tree::Item) -> Option<&tree::Name> {
    match item {
        tree::Item::Study(study) => Some(&study.name),
        _ => None,
    }
}

/// The libraries that an item may bring into scope.
fn names_of(item: &tree::Item) -> &[tree::Name] {
    match item {
        tree::Item::Use(import) => &import.names,
        tree::Item::Library(library) => std::slice::from_ref(&library.name),
        _ => &[],
    }
}

/// What is shared with nobody any more.
fn owned<T: Clone>(shared: Rc<T>) -> T {
    Rc::try_unwrap(shared).unwrap_or_else(|shared| (*shared).clone())
}
