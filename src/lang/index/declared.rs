//! What the trees of a program declare and import.

use std::collections::BTreeMap;

use super::{Entity, Index, Kind, Occurrence};
use crate::lang::names::{Module, Program};
use crate::lang::source::Span;
use crate::lang::syntax::tree::{self, Item, Name};

/// Items and members by kind, the item around them, and name.
type Declared = BTreeMap<(Kind, String, String), Span>;

/// Reads every module.
pub(super) fn read(program: &Program) -> (Index, Declared) {
    let mut reading = Reading::default();
    for module in &program.modules {
        reading.module(module, program);
    }
    (reading.index, reading.declared)
}

#[derive(Default)]
struct Reading {
    index: Index,
    declared: Declared,
}

impl Reading {
    fn module(&mut self, module: &Module, program: &Program) {
        let scope = self.index.scopes.entry(module.file).or_default();
        for (name, id) in &module.scope {
            scope.extend(id.map(|id| (name.clone(), program.definition(id).tree.name.span)));
        }
        let mut imports = module.imports.iter();
        for item in &module.tree.items {
            match item {
                Item::Use(import) => self.import(import, imports.next().copied().flatten(), module, program),
                Item::Let(item) => self.item(Kind::Definition, &item.name),
                Item::Library(library) => self.library(library),
                Item::Task(task) => self.item(Kind::Task, &task.name),
                Item::Test(_) => {}
                Item::Scene(scene) => {
                    self.item(Kind::Scene, &scene.name);
                    for object in &scene.objects {
                        self.member(Kind::Object, &scene.name, &object.name);
                    }
                }
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
            if let Some(Some(id)) = module.scope.get(&name.text) {
                let at = program.definition(*id).tree.name.span;
                self.push(name.span, false, Entity::Declared(Kind::Definition, at));
            }
        }
    }

    fn library(&mut self, library: &tree::Library) {
        self.item(Kind::Library, &library.name);
        for feature in &library.features {
            self.member(Kind::Feature, &library.name, &feature.name.name);
        }
        let rows = library.tables.iter().flat_map(|t| t.rows.iter().map(|r| &r.name));
        for class in library.classes.iter().map(|c| &c.name).chain(rows) {
            self.member(Kind::Class, &library.name, class);
        }
        for layout in &library.layouts {
            self.member(Kind::Layout, &library.name, &layout.name);
        }
    }

    fn item(&mut self, kind: Kind, name: &Name) {
        self.declare(kind, String::new(), name);
    }

    fn member(&mut self, kind: Kind, owner: &Name, name: &Name) {
        self.declare(kind, owner.text.clone(), name);
    }

    fn declare(&mut self, kind: Kind, owner: String, name: &Name) {
        let key = (kind, owner, name.text.clone());
        self.declared.entry(key).or_insert(name.span);
        self.push(name.span, true, Entity::Declared(kind, name.span));
    }

    fn push(&mut self, span: Span, declares: bool, entity: Entity) {
        self.index.occurrences.push(Occurrence { span, declares, entity });
    }
}
