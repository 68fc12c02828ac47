//! What the checker says while it resolves names.

use std::collections::BTreeMap;

use super::{Entity, Index, Kind, Occurrence, Signature, declared};
use crate::lang::names::Program;
use crate::lang::source::Span;
use crate::lang::syntax::tree::Name;
use crate::primitives::Type;

/// Names that stand for something in one rule or one definition only.
pub(in crate::lang) type Locals = BTreeMap<String, Entity>;

/// Collects names as they are resolved.
pub(in crate::lang) struct Recorder {
    index: Index,
    /// Items and members: kind, the item around it, name.
    declared: BTreeMap<(Kind, String, String), Span>,
    locals: Locals,
}

impl Recorder {
    /// Begins with everything that the trees of a program declare.
    pub fn new(program: &Program) -> Self {
        let (index, declared) = declared::read(program);
        Self {
            index,
            declared,
            locals: Locals::new(),
        }
    }

    /// A name that denotes something.
    pub fn uses(&mut self, at: Span, entity: Entity) {
        self.index.occurrences.push(Occurrence {
            span: at,
            declares: false,
            entity,
        });
    }

    /// The name of a library, or of a class or a layout in one.
    pub fn member(&mut self, kind: Kind, owner: &str, name: &Name) {
        let key = (kind, owner.to_owned(), name.text.clone());
        if let Some(at) = self.declared.get(&key).copied() {
            self.uses(name.span, Entity::Declared(kind, at));
        }
    }

    /// Begins a rule or a definition; gives the local names of what is around it.
    pub fn enter(&mut self) -> Locals {
        std::mem::take(&mut self.locals)
    }

    /// Ends what [`Self::enter`] began.
    pub fn leave(&mut self, around: Locals) {
        self.locals = around;
    }

    /// Declares a local name, where it is not.
    pub fn local(&mut self, kind: Kind, name: &Name, ty: Option<Type>) {
        if self.locals.contains_key(&name.text) {
            return self.uses_local(name);
        }
        let entity = Entity::Declared(kind, name.span);
        self.locals.insert(name.text.clone(), entity);
        self.index.types.extend(ty.map(|ty| (name.span, ty)));
        self.index.occurrences.push(Occurrence {
            span: name.span,
            declares: true,
            entity,
        });
    }

    /// A local name that is used.
    pub fn uses_local(&mut self, name: &Name) {
        if let Some(entity) = self.locals.get(&name.text).copied() {
            self.uses(name.span, entity);
        }
    }

    /// How a definition is called.
    pub fn signature(&mut self, name: Span, signature: Signature) {
        self.index.signatures.insert(name, signature);
    }

    /// The index. A template that is checked several times says the same several
    /// times: the first word holds.
    pub fn index(mut self) -> Index {
        let names = &mut self.index.occurrences;
        names.sort_by_key(|o| (o.span, !o.declares));
        names.dedup_by_key(|o| o.span);
        self.index
    }
}
