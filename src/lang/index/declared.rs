//! What the trees of a program declare and import.

use std::collections::BTreeMap;

use super::{Entity, Index, Kind, Occurrence};
use crate::lang::names::{Module, Program};
use crate::lang::source::Span;
use crate::lang::syntax::tree::{self, Item, Name};

/// Where members of libraries are declared, by kind and name.
pub(super) type Members = BTreeMap<(Kind, String), Vec<Span>>;

/// Reads every module.
pub(super) fn read(program: &Program) -> (Index, Members) {
    let mut reading = Reading::default();
    for module in &program.modules {
        reading.module(module, program);
    }
    (reading.index, reading.members)
}

#[derive(Default)]
struct Reading {
    index: Index,
    members: Members,
}

impl Reading {
    fn module(&mut self, module: &Module, program: &Program) {
        let scope = self.index.scopes.entry(module.file).or_default();
        for (name, id) in &module.scope {
            scope.extend(id.map(|id| (name.clone(), program.definition(id).tree.name.span)));
        }
        let libraries = self.index.libraries.entry(module.file).or_default();
        for (name, id) in &module.libraries {
            let tree = id.and_then(|id| program.library(id));
            libraries.extend(tree.map(|(tree, _)| (name.clone(), tree.name.span)));
        }
        let mut imports = module.imports.iter();
        for item in &module.tree.items {
            match item {
                Item::Use(import) => self.import(import, imports.next().copied().flatten(), module, program),
                Item::Let(item) => {
                    self.declare(Kind::Definition, &item.name);
                    self.parameters(&item.parameters);
                }
                Item::Library(library) => self.library(library),
                Item::Task(task) => self.declare(Kind::Task, &task.name),
                Item::Scene(scene) => {
                    self.declare(Kind::Scene, &scene.name);
                    scene.objects.iter().for_each(|o| self.declare(Kind::Object, &o.name));
                }
                Item::Test(_) | Item::Study(_) => {}
            }
        }
    }

    fn import(&mut self, import: &tree::Use, target: Option<usize>, module: &Module, program: &Program) {
        let Some(target) = target.and_then(|t| program.modules.get(t)) else {
            return;
        };
        let path = match &import.module {
            tree::Module::Dotted(words) => match (words.first(), words.last()) {
                (Some(first), Some(last)) => first.span.to(last.span),
                _ => return,
            },
            tree::Module::Path(path) => path.span,
        };
        self.push(path, false, Entity::Module(target.file));
        for name in &import.names {
            let definition = module.scope.get(&name.text).copied().flatten();
            let library = module.libraries.get(&name.text).copied().flatten();
            if let Some(id) = definition {
                let at = program.definition(id).tree.name.span;
                self.push(name.span, false, Entity::Declared(Kind::Definition, at));
            } else if let Some((tree, _)) = library.and_then(|id| program.library(id)) {
                self.push(name.span, false, Entity::Declared(Kind::Library, tree.name.span));
            }
        }
    }

    fn library(&mut self, library: &tree::Library) {
        self.declare(Kind::Library, &library.name);
        self.parameters(library.parameters.as_deref().unwrap_or_default());
        for feature in &library.features {
            self.declare(Kind::Feature, &feature.name.name);
        }
        let rows = library.tables.iter().flat_map(|t| t.rows.iter().map(|r| &r.name));
        for class in library.classes.iter().map(|c| &c.name).chain(rows) {
            self.member(Kind::Class, class);
        }
        for layout in &library.layouts {
            self.member(Kind::Layout, &layout.name);
        }
    }

    fn parameters(&mut self, parameters: &[tree::Parameter]) {
        parameters.iter().for_each(|p| self.declare(Kind::Parameter, &p.name));
    }

    fn member(&mut self, kind: Kind, name: &Name) {
        let key = (kind, name.text.clone());
        self.members.entry(key).or_default().push(name.span);
        self.declare(kind, name);
    }

    fn declare(&mut self, kind: Kind, name: &Name) {
        self.push(name.span, true, Entity::Declared(kind, name.span));
    }

    fn push(&mut self, span: Span, declares: bool, entity: Entity) {
        self.index.occurrences.push(Occurrence { span, declares, entity });
    }
}
