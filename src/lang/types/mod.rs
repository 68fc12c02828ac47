//! Types and units: every expression gets one type, every name one meaning.
//!
//! Reads the program with its resolved modules and gives the checked program that
//! lowering expands. What is wrong is left out of it, and said once.

mod calls;
pub(super) mod colours;
mod expressions;
pub(super) mod features;
pub(super) mod forms;
mod library;
mod operators;
mod references;
mod rule;
mod scene;
mod scope;
pub(super) mod task;
pub(super) mod typed;
pub(super) mod units;
mod words;

use std::collections::{BTreeMap, BTreeSet};

use super::diagnostics::{Code, Diagnostic};
use super::index::{self, Entity, Index, Kind, Recorder};
use super::names::{self, DefinitionId, Program, suggest::did_you_mean};
use super::syntax::tree;
use crate::primitives::Type;
use crate::rules::FeatureKind;
use scope::Scope;

/// Checks a program.
pub(super) fn check(program: &Program) -> (typed::Program, Index, Vec<Diagnostic>) {
    let mut checker = Checker {
        program,
        signatures: Vec::new(),
        definitions: (0..program.definitions.len()).map(|_| State::New).collect(),
        unknown: BTreeSet::new(),
        names: Recorder::new(program),
        found: Vec::new(),
    };
    checker.signatures = (0..program.definitions.len())
        .map(|k| checker.signature(DefinitionId(k)))
        .collect();
    for k in 0..program.definitions.len() {
        checker.definition(DefinitionId(k));
    }
    let mut out = checker.items(&program.main().tree);
    checker.record_signatures();
    out.definitions = checker.definitions.into_iter().map(State::done).collect();
    (out, checker.names.index(), checker.found)
}

struct Checker<'a> {
    program: &'a Program,
    /// The parameters of each definition, those of unknown type as `None`.
    signatures: Vec<Vec<(String, Option<Type>)>>,
    definitions: Vec<State>,
    /// Unknown names that were reported, each once.
    unknown: BTreeSet<String>,
    names: Recorder,
    found: Vec<Diagnostic>,
}

/// How far a definition is.
enum State {
    New,
    /// Its body is being checked, or it is wrong.
    Unusable,
    Done(typed::Definition),
}

impl State {
    fn body(&self) -> Option<&typed::Expr> {
        match self {
            Self::Done(definition) => Some(&definition.body),
            Self::New | Self::Unusable => None,
        }
    }

    fn done(self) -> Option<typed::Definition> {
        match self {
            Self::Done(definition) => Some(definition),
            Self::New | Self::Unusable => None,
        }
    }
}

impl<'a> Checker<'a> {
    fn report(&mut self, diagnostic: Diagnostic) {
        self.found.push(diagnostic);
    }

    fn signature(&mut self, id: DefinitionId) -> Vec<(String, Option<Type>)> {
        let definition = self.program.definition(id);
        let parameters = &definition.tree.parameters;
        names::unique("parameter", parameters.iter().map(|p| &p.name), &mut self.found);
        parameters
            .iter()
            .map(|p| (p.name.text.clone(), self.type_name(&p.ty)))
            .collect()
    }

    fn type_name(&mut self, name: &tree::TypeName) -> Option<Type> {
        let element = &name.element;
        let Some((word, mut ty)) = units::named(&element.text) else {
            let known = units::NAMED.iter().map(|(name, _)| *name);
            let help = did_you_mean(&element.text, known.clone())
                .unwrap_or_else(|| format!("types are {}", known.collect::<Vec<_>>().join(", ")));
            self.report(
                Diagnostic::new(
                    Code::E0201,
                    element.span,
                    format!("there is no type `{}`", element.text),
                )
                .help(help),
            );
            return None;
        };
        self.names.uses(element.span, Entity::Type(word));
        for _ in 0..name.depth {
            let Some(list) = units::list_of(ty) else {
                let message = format!("there are no lists of {}", units::describe(ty));
                self.report(Diagnostic::new(Code::E0301, name.span, message));
                return None;
            };
            ty = list;
        }
        Some(ty)
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
        let parameters: BTreeMap<String, Option<Type>> = self.signatures[id.0].iter().cloned().collect();
        let scope = Scope {
            parameters: Some(&parameters),
            ..Scope::of(&program.modules[definition.module])
        };
        let around = self.names.enter();
        for (parameter, (_, ty)) in definition.tree.parameters.iter().zip(&self.signatures[id.0]) {
            self.names.local(Kind::Parameter, &parameter.name, *ty);
        }
        let body = self.infer(&definition.tree.body, scope);
        self.names.leave(around);
        let body = body?;
        let ty = body.ty;
        let parameters = self.signatures[id.0].iter().map(|(name, _)| name.clone()).collect();
        self.definitions[id.0] = State::Done(typed::Definition { parameters, body });
        Some(ty)
    }

    /// The entity of a definition.
    fn entity(&self, id: DefinitionId) -> Entity {
        Entity::Declared(Kind::Definition, self.program.definition(id).tree.name.span)
    }

    fn record_signatures(&mut self) {
        for (k, parameters) in self.signatures.iter().enumerate() {
            let id = DefinitionId(k);
            let parameters = parameters.iter().map(|(name, ty)| index::Parameter {
                name: name.clone(),
                ty: *ty,
            });
            let signature = index::Signature {
                parameters: parameters.collect(),
                result: self.definitions[k].body().map(|body| body.ty),
                features: self.features_of(id),
            };
            self.names
                .signature(self.program.definition(id).tree.name.span, signature);
        }
    }

    /// The kinds of feature that a definition is for: those of its primitive.
    fn features_of(&self, id: DefinitionId) -> &'static [FeatureKind] {
        let mut body = self.definitions[id.0].body();
        // Definitions need no circle: whoever is done was checked after what it names.
        while let Some(expr) = body {
            match &expr.kind {
                typed::ExprKind::Primitive(primitive, _) => return primitive.features,
                typed::ExprKind::Definition(next, _) => body = self.definitions[next.0].body(),
                _ => break,
            }
        }
        &[]
    }

    fn items(&mut self, file: &'a tree::File) -> typed::Program {
        let mut out = typed::Program::default();
        let each = |want: fn(&tree::Item) -> Option<&tree::Name>| file.items.iter().filter_map(want);
        names::unique("library", each(library_name), &mut self.found);
        names::unique("task", each(task_name), &mut self.found);
        names::unique("scene", each(scene_name), &mut self.found);
        for item in &file.items {
            if let tree::Item::Library(library) = item {
                out.libraries.push(self.library(library));
            }
        }
        for item in &file.items {
            match item {
                tree::Item::Task(task) => out.tasks.extend(self.task(task, &out.libraries)),
                tree::Item::Scene(scene) => out.scenes.push(self.scene(scene, &out.libraries)),
                _ => {}
            }
        }
        self.one_object_a_name(file);
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

fn library_name(item: &tree::Item) -> Option<&tree::Name> {
    match item {
        tree::Item::Library(library) => Some(&library.name),
        _ => None,
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
