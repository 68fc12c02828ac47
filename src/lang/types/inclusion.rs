//! Taking over a library: `use tagged_box(width: 300 mm)` inside of another.
//!
//! The parts of a checked library are copied, features under new ids. What its
//! parameters stand for is kept beside them as an environment, so that nothing is
//! rewritten and every part keeps the place where it was written.

use std::collections::BTreeMap;
use std::rc::Rc;

use super::Checker;
use super::features::MOST_FEATURES;
use super::scope::Scope;
use super::typed::{
    Binding, Class, Environment, EnvironmentId, Families, Family, Feature, Layout, Library, Members, Rule,
};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::names::{LibraryId, standard_home};
use crate::lang::source::Span;
use crate::lang::syntax::tree;
use crate::rules::FeatureId;

/// Most parts that all libraries of a program take over together.
const MOST_TAKEN: usize = 200_000;

/// A library that another takes over.
pub(super) struct Taken {
    pub library: Rc<Library>,
    /// The `use`.
    pub at: Span,
    bindings: Vec<Binding>,
    /// The id that each of its features has in the library that takes it over.
    ids: Vec<FeatureId>,
}

/// The parts of a library, with the places that order them in its text.
#[derive(Default)]
pub(super) struct Parts {
    pub classes: Vec<(Span, Class)>,
    pub rules: Vec<(Span, Rule)>,
    pub layouts: Vec<(Span, Layout)>,
    pub environments: Vec<Environment>,
}

impl Checker<'_> {
    /// The libraries that some entries take over, as far as they are right.
    pub(super) fn all_taken(&mut self, uses: &[tree::Inclusion], scope: Scope<'_>) -> Vec<Taken> {
        let mut seen: BTreeMap<LibraryId, Span> = BTreeMap::new();
        let mut out = Vec::new();
        for inclusion in uses {
            let Some(id) = self.library_in_scope(&inclusion.call.name, scope) else {
                continue;
            };
            if let Some(first) = seen.insert(id, inclusion.span) {
                let message = format!("`{}` is taken over twice", inclusion.call.name.text);
                self.report(
                    Diagnostic::new(Code::E0202, inclusion.span, message)
                        .related(first, "first here")
                        .help("a library has each feature once: leave one of them out"),
                );
                continue;
            }
            out.extend(self.taken(id, inclusion, scope));
        }
        out
    }

    fn taken(&mut self, id: LibraryId, inclusion: &tree::Inclusion, scope: Scope<'_>) -> Option<Taken> {
        let slots = self.library_signatures[id.0].clone();
        let given = self.arguments(&slots, &inclusion.call, scope)?;
        let library = self.libraries[id.0].clone()?;
        let parameters = library.parameters.as_ref()?;
        let bindings: Option<Vec<Binding>> = parameters
            .iter()
            .zip(given)
            .map(|(parameter, given)| {
                let default = given.is_none();
                Some(Binding {
                    name: parameter.name.clone(),
                    value: given.or_else(|| parameter.default.clone())?,
                    default,
                })
            })
            .collect();
        self.parts_taken += library.size();
        if self.parts_taken > MOST_TAKEN {
            let message = format!("this program takes over more than {MOST_TAKEN} parts of libraries");
            self.report(Diagnostic::new(Code::E0312, inclusion.span, message).help("take over fewer libraries"));
            return None;
        }
        Some(Taken {
            bindings: bindings?,
            at: inclusion.span,
            ids: Vec::new(),
            library,
        })
    }

    /// The library that a `use` names.
    fn library_in_scope(&mut self, name: &tree::Name, scope: Scope<'_>) -> Option<LibraryId> {
        if let Some(known) = scope.module.libraries.get(&name.text) {
            if let Some(id) = known {
                self.uses_library(name, *id);
            }
            return *known;
        }
        if let Some(Some(id)) = scope.module.scope.get(&name.text) {
            let at = self.program.definition(*id).tree.name.span;
            let message = format!("`{}` is a definition, and a library takes over libraries", name.text);
            let out = Diagnostic::new(Code::E0208, name.span, message).related(at, "defined here");
            self.report(out.help("call it in a rule, a layout or a task"));
            return None;
        }
        let known = scope.module.libraries.keys().map(String::as_str);
        match standard_home(&name.text) {
            Some(module) if !scope.lost(&name.text) => {
                let out = Diagnostic::new(Code::E0208, name.span, format!("there is no library `{}`", name.text));
                let out = self.with_import(out, module, &name.text, scope);
                self.report(out);
            }
            _ => self.unknown_item("library", name, known, scope.module),
        }
        None
    }

    /// Joins the features of a library that is taken over; `None` where they clash.
    pub(super) fn take_features(
        &mut self,
        mut taken: Taken,
        families: &mut Families,
        features: &mut Vec<Feature>,
    ) -> Option<Taken> {
        let library = Rc::clone(&taken.library);
        let mut clashes = library.families.by_name.iter().filter_map(|(name, family)| {
            let first = families.by_name.get(name)?;
            Some(taken.brings_again("feature", name, first.span, family.span))
        });
        if let Some(clash) = clashes.next() {
            self.report(clash);
            return None;
        }
        if features.len() + library.features.len() > MOST_FEATURES {
            let message = format!("a library of more than {MOST_FEATURES} features");
            self.report(Diagnostic::new(Code::E0312, taken.at, message));
            return None;
        }
        let first = features.len() as u32;
        taken.ids = (first..).take(library.features.len()).map(FeatureId).collect();
        features.extend(library.features.iter().cloned());
        for (name, family) in &library.families.by_name {
            families.by_name.insert(name.clone(), taken.family(family));
        }
        Some(taken)
    }
}

impl Library {
    /// How much taking it over copies.
    fn size(&self) -> usize {
        let places = self.layouts.iter().map(|l| l.places.len()).sum::<usize>();
        self.features.len() + self.classes.len() + self.rules.len() + places + self.environments.len()
    }
}

impl Taken {
    /// A part whose name is declared already.
    pub(super) fn brings_again(&self, kind: &str, name: &str, first: Span, again: Span) -> Diagnostic {
        let message = format!(
            "`{}` brings {kind} `{name}`, which is declared already",
            self.library.name
        );
        Diagnostic::new(Code::E0202, self.at, message)
            .related(first, "first declared here")
            .related(again, format!("declared again here, in `{}`", self.library.name))
            .help("give one of them another name, or leave the `use` out")
    }

    fn id(&self, id: FeatureId) -> FeatureId {
        self.ids.get(id.index()).copied().unwrap_or(id)
    }

    fn family(&self, family: &Family) -> Family {
        let members = match &family.members {
            Members::One(id) => Members::One(self.id(*id)),
            Members::Indexed(ids) => Members::Indexed(ids.iter().map(|(n, id)| (*n, self.id(*id))).collect()),
        };
        Family {
            members,
            ..family.clone()
        }
    }

    fn presence(&self, presence: &[bool], width: usize) -> Vec<bool> {
        let mut out = vec![false; width];
        for (id, has) in self.ids.iter().zip(presence) {
            out[id.index()] = *has;
        }
        out
    }
}

impl Parts {
    /// Adds the parts of a library that is taken over; there are `width` features.
    pub(super) fn adopt(&mut self, taken: &Taken, width: usize) {
        let own = self.bind(taken);
        let environment = |inner: Option<EnvironmentId>| Some(EnvironmentId(inner.map_or(own, |k| own + 1 + k.0)));
        for class in &taken.library.classes {
            let class = Class {
                environment: environment(class.environment),
                presence: taken.presence(&class.presence, width),
                ..class.clone()
            };
            self.classes.push((taken.at, class));
        }
        for rule in &taken.library.rules {
            let rule = Rule {
                environment: environment(rule.environment),
                ..rule.clone()
            };
            self.rules.push((taken.at, rule));
        }
        for layout in &taken.library.layouts {
            let mut layout = Layout {
                environment: environment(layout.environment),
                ..layout.clone()
            };
            layout.places.iter_mut().for_each(|p| p.feature = taken.id(p.feature));
            self.layouts.push((taken.at, layout));
        }
    }

    /// Adds the environment of a `use` and, behind it, those inside; gives its index.
    fn bind(&mut self, taken: &Taken) -> usize {
        let own = self.environments.len();
        self.environments.push(Environment {
            parent: None,
            bindings: taken.bindings.clone(),
            at: taken.at,
        });
        let inner = taken.library.environments.iter().map(|e| Environment {
            parent: Some(EnvironmentId(e.parent.map_or(own, |k| own + 1 + k.0))),
            ..e.clone()
        });
        self.environments.extend(inner);
        own
    }

    /// Classes, rules and layouts in the order of the text.
    pub(super) fn in_order(&mut self) -> (Vec<Class>, Vec<Rule>, Vec<Layout>) {
        (
            sorted(&mut self.classes),
            sorted(&mut self.rules),
            sorted(&mut self.layouts),
        )
    }
}

fn sorted<T>(parts: &mut Vec<(Span, T)>) -> Vec<T> {
    parts.sort_by_key(|(at, _)| *at);
    parts.drain(..).map(|(_, part)| part).collect()
}
