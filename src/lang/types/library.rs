//! Libraries: their own parts, joined with those of the libraries that they take over.

use std::collections::BTreeMap;
use std::rc::Rc;

use super::Checker;
use super::inclusion::{Parts, Taken};
use super::parameters::{Slot, visible};
use super::scope::Scope;
use super::typed::Library;
use crate::lang::diagnostics::{Code, Diagnostic, Severity};
use crate::lang::names::{self, LibraryId, Module};
use crate::lang::source::Span;
use crate::lang::syntax::tree;
use crate::primitives::Type;

/// Names with the places of their first declarations.
type Seen<'n> = BTreeMap<&'n str, Span>;

impl<'a> Checker<'a> {
    /// Checks a library now if it was not before, and those that it takes over first.
    pub(super) fn library(&mut self, id: LibraryId) {
        let Some((tree, module)) = self.program.library(id) else {
            return;
        };
        if self.libraries[id.0].is_some() {
            return;
        }
        // A circle is cut where it was reported.
        let uses = match self.program.libraries[id.0].circular {
            true => &[],
            false => tree.uses.as_slice(),
        };
        for inclusion in uses {
            if let Some(Some(taken)) = module.libraries.get(&inclusion.call.name.text) {
                self.library(*taken);
            }
        }
        let checked = self.library_parts(id, (tree, module), uses);
        self.libraries[id.0] = Some(Rc::new(checked));
    }

    fn library_parts(
        &mut self,
        id: LibraryId,
        (tree, module): (&'a tree::Library, &'a Module),
        uses: &[tree::Inclusion],
    ) -> Library {
        let before = self.errors();
        let signature = self.library_signatures[id.0].clone();
        let parameters = visible(&signature);
        let outside = Scope {
            parameters: tree.parameters.is_some().then_some(&parameters),
            ..Scope::of(module)
        };
        self.unknown.retain(|(_, kind, _)| *kind != "feature");
        let mut taken = self.all_taken(uses, outside);
        let (mut families, features) = self.families(tree, &mut taken);
        let complete = taken.len() == tree.uses.len() && taken.iter().all(|t| t.library.whole);
        families.open |= !complete;
        let scope = Scope {
            families: Some(&families),
            ..outside
        };
        let defaults = self.template_parameters(tree, &signature, scope);
        let mut parts = self.own_parts(tree, scope, features.len());
        let whole = tree.whole && complete && parts.rules.len() == tree.rules.len();
        for taken in &taken {
            parts.adopt(taken, features.len());
        }
        self.each_name_once(tree, &taken);
        let (classes, rules, layouts) = parts.in_order();
        self.all_or_no_priors(&classes);
        if tree.whole && complete {
            self.not_empty(tree, features.is_empty(), classes.is_empty());
        }
        Library {
            name: tree.name.text.clone(),
            whole: whole && self.errors() == before,
            span: tree.head,
            parameters: defaults,
            environments: parts.environments,
            families,
            features,
            classes,
            rules,
            layouts,
        }
    }

    /// The parameters of a template, where they and their defaults are right.
    fn template_parameters(
        &mut self,
        tree: &tree::Library,
        signature: &[Slot],
        scope: Scope<'_>,
    ) -> Option<Vec<super::typed::Parameter>> {
        let parameters = tree.parameters.as_deref().unwrap_or_default();
        for (parameter, slot) in parameters.iter().zip(signature) {
            let outer = Scope {
                parameters: None,
                ..scope
            };
            self.hides_something("parameter", &parameter.name, outer);
            if let Some(ty) = slot.ty.filter(|ty| measured(*ty)) {
                let what = super::units::describe(ty);
                let message = format!("{what} is measured, and no parameter of a library");
                self.report(
                    Diagnostic::new(Code::E0301, parameter.ty.span, message)
                        .help("read it from a feature inside the library's rules"),
                );
            }
        }
        self.defaults(parameters, signature, scope.module)
    }

    fn own_parts(&mut self, tree: &'a tree::Library, scope: Scope<'_>, width: usize) -> Parts {
        let mut parts = Parts::default();
        for class in &tree.classes {
            parts.classes.push((class.span, self.class(class, scope, width)));
        }
        for table in &tree.tables {
            let rows = self.table(table, scope, width);
            parts.classes.extend(rows.into_iter().map(|c| (c.span, c)));
        }
        for rule in &tree.rules {
            let checked = self.rule(rule, scope);
            parts.rules.extend(checked.map(|checked| (rule.head, checked)));
        }
        for layout in &tree.layouts {
            parts.layouts.push((layout.head, self.layout(layout, scope)));
        }
        parts
    }

    /// Classes and layouts, own ones and those that were taken over.
    fn each_name_once(&mut self, tree: &tree::Library, taken: &[Taken]) {
        let rows = tree.tables.iter().flat_map(|t| t.rows.iter().map(|r| &r.name));
        let classes = tree.classes.iter().map(|c| &c.name).chain(rows);
        let mut classes: Seen<'_> = names::unique("class", classes, &mut self.found);
        let mut layouts: Seen<'_> = names::unique("layout", tree.layouts.iter().map(|l| &l.name), &mut self.found);
        for taken in taken {
            for class in &taken.library.classes {
                self.brought_once("class", (&class.name, class.span), taken, &mut classes);
            }
            for layout in &taken.library.layouts {
                self.brought_once("layout", (&layout.name, layout.span), taken, &mut layouts);
            }
        }
    }

    fn brought_once<'n>(&mut self, kind: &str, (name, span): (&'n str, Span), taken: &Taken, seen: &mut Seen<'n>) {
        match seen.get(name) {
            Some(first) => self.report(taken.brings_again(kind, name, *first, span)),
            None => drop(seen.insert(name, span)),
        }
    }

    /// How many errors there are so far.
    pub(super) fn errors(&self) -> usize {
        self.found.iter().filter(|d| d.severity == Severity::Error).count()
    }

    fn not_empty(&mut self, library: &tree::Library, no_features: bool, no_classes: bool) {
        let name = &library.name;
        let lacks = if no_features {
            "features: `feature name : polygon`"
        } else if no_classes && library.tables.is_empty() && library.parameters.is_none() {
            "classes: `class name { feature, … }`"
        } else {
            return;
        };
        let message = format!(
            "library `{}` has no {}",
            name.text,
            lacks.split(':').next().unwrap_or_default()
        );
        self.report(Diagnostic::new(Code::E0308, name.span, message).help(format!("declare some {lacks}")));
    }
}

/// Whether values of a type only come from measured features.
fn measured(ty: Type) -> bool {
    match ty {
        Type::Edge | Type::Edges | Type::Polygon | Type::Pose => true,
        Type::List(element) => measured(*element),
        _ => false,
    }
}
