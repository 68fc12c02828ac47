//! What the checker says while it resolves names.

use std::collections::BTreeMap;

use super::{Entity, Index, Kind, Occurrence, Signature, declared};
use crate::lang::names::Program;
use crate::lang::source::Span;
use crate::lang::syntax::tree::Name;
use crate::primitives::Type;

/// Collects names as they are resolved.
pub(in crate::lang) struct Recorder {
    index: Index,
    /// Where members of libraries are declared, by kind and name.
    members: declared::Members,
    /// The variables of the rule that is being checked.
    variables: BTreeMap<String, Entity>,
}

impl Recorder {
    /// Begins with everything that the trees of a program declare.
    pub fn new(program: &Program) -> Self {
        let (index, members) = declared::read(program);
        Self {
            index,
            members,
            variables: BTreeMap::new(),
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

    /// The name of a class or a layout that is declared inside of a span.
    pub fn member(&mut self, kind: Kind, inside: Span, name: &Name) {
        let declared = self.members.get(&(kind, name.text.clone()));
        let within = |at: &&Span| at.file == inside.file && inside.start <= at.start && at.end <= inside.end;
        if let Some(at) = declared.and_then(|all| all.iter().find(within)).copied() {
            self.uses(name.span, Entity::Declared(kind, at));
        }
    }

    /// Begins a rule, which has variables of its own.
    pub fn begin_rule(&mut self) {
        self.variables.clear();
    }

    /// Declares a variable of the rule, where it is not.
    pub fn local(&mut self, kind: Kind, name: &Name, ty: Option<Type>) {
        if self.variables.contains_key(&name.text) {
            return self.uses_local(name);
        }
        let entity = Entity::Declared(kind, name.span);
        self.variables.insert(name.text.clone(), entity);
        self.index.types.extend(ty.map(|ty| (name.span, ty)));
        self.index.occurrences.push(Occurrence {
            span: name.span,
            declares: true,
            entity,
        });
    }

    /// A variable of the rule that is used; other names are passed over.
    pub fn uses_local(&mut self, name: &Name) {
        if let Some(entity) = self.variables.get(&name.text).copied() {
            self.uses(name.span, entity);
        }
    }

    /// How a definition or a template is called.
    pub fn signature(&mut self, name: Span, signature: Signature) {
        let types = signature.parameters.iter().filter_map(|p| Some((p.at, p.ty?)));
        self.index.types.extend(types);
        self.index.signatures.insert(name, signature);
    }

    /// The index. What is checked several times says the same several times: the first
    /// word holds.
    pub fn index(mut self) -> Index {
        let names = &mut self.index.occurrences;
        names.sort_by_key(|o| (o.span, !o.declares));
        names.dedup_by_key(|o| o.span);
        self.index
    }
}
