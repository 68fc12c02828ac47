//! Tests: what they give and expect, each name resolved and each value typed.

use std::collections::BTreeMap;

use super::Checker;
use super::expressions::Due;
use super::features::feature_use;
use super::scope::Scope;
use super::stated::{Fact, Given, Place};
use super::typed::Library;
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::index::{Entity, Kind};
use crate::lang::names::suggest::closest;
use crate::lang::source::Span;
use crate::lang::syntax::tree;
use crate::primitives::Type;
use crate::rules::{FeatureId, FeatureKind};

/// What can be given of a feature without a place.
const GIVEN: [(&str, Given); 2] = [("detected", Given::Detected), ("absent", Given::Absent)];

impl<'a> Checker<'a> {
    pub(super) fn fact(&mut self, test: &'a tree::Test, libraries: &[Library]) -> Fact {
        let library = self.fact_library(test, libraries);
        let known = library.map(|k| &libraries[k]);
        let given = self.all_given_of(test, known);
        let expected = test
            .expected
            .iter()
            .filter_map(|e| self.expectation(e, known))
            .collect();
        if test.whole && test.expected.is_empty() {
            let message = format!("test \"{}\" expects nothing", test.name.text);
            let help = "say what follows: `expect classes …`, `expect … = …`";
            self.report(Diagnostic::new(Code::E0308, test.head, message).help(help));
        }
        Fact {
            name: test.name.text.clone(),
            library,
            given,
            expected,
            span: test.head,
        }
    }

    /// The library that a test names, or the only one of the file, where it needs one.
    fn fact_library(&mut self, test: &tree::Test, libraries: &[Library]) -> Option<usize> {
        for again in test.libraries.iter().skip(1) {
            self.surplus(again.span, test.libraries[0].span, "library");
        }
        if let Some(name) = test.libraries.first() {
            let found = libraries.iter().position(|l| l.name == name.text);
            if found.is_none() {
                self.no_library(name, libraries);
            }
            if found.is_some() {
                self.uses_listed(name);
            }
            return found;
        }
        let needed = !test.given.is_empty() || test.expected.iter().any(needs_library);
        if !needed {
            return None;
        }
        if libraries.len() != 1 && self.program.main().lost.is_empty() {
            let (message, help) = match libraries.len() {
                0 => (
                    "this test needs a library, and the file has none",
                    "import or write one".to_owned(),
                ),
                _ => (
                    "this test does not say which library it is about",
                    format!("add `library {}`, or another of the file's", libraries[0].name),
                ),
            };
            self.report(Diagnostic::new(Code::E0308, test.head, message).help(help));
        }
        (libraries.len() == 1).then_some(0)
    }

    fn all_given_of(&mut self, test: &'a tree::Test, library: Option<&Library>) -> Vec<(FeatureId, Given, Span)> {
        let mut all: Vec<(FeatureId, Given, Span)> = Vec::new();
        for supposed in &test.given {
            for (id, given) in self.given(supposed, library) {
                if let Some(first) = clash(&all, id, &given, library) {
                    let name = library.map_or("", |l| l.features[id.index()].name.as_str());
                    let out = Diagnostic::new(Code::E0702, supposed.span, format!("`{name}` is given twice"))
                        .related(first, "given first here");
                    self.report(out.help("say one thing of it; only a `many` feature has several places"));
                    continue;
                }
                all.push((id, given, supposed.span));
            }
        }
        all
    }

    fn given(&mut self, supposed: &'a tree::Supposed, library: Option<&Library>) -> Vec<(FeatureId, Given)> {
        match &supposed.what {
            tree::Evidence::State(word) => {
                let given = self.state_of(word, "what is given of a feature", &GIVEN);
                let ids = self.fact_features(&supposed.feature, library);
                let all = given
                    .into_iter()
                    .flat_map(|g| ids.iter().map(move |id| (*id, g.clone())));
                all.collect()
            }
            tree::Evidence::Face(face) => {
                let due = due(Type::Polygon, "a measured face");
                let face = self.check(face, due, Scope::of(self.program.main()));
                let id = self.fact_feature(&supposed.feature, library, Some(FeatureKind::Polygon));
                face.zip(id)
                    .map(|(face, id)| (id, Given::Face(face)))
                    .into_iter()
                    .collect()
            }
            tree::Evidence::Marker { at, facing } => {
                let place = self.fact_place(at, facing);
                let id = self.fact_feature(&supposed.feature, library, Some(FeatureKind::Marker));
                place
                    .zip(id)
                    .map(|(p, id)| (id, Given::Marker(p)))
                    .into_iter()
                    .collect()
            }
        }
    }

    pub(super) fn fact_place(&mut self, at: &tree::Expr, facing: &tree::Expr) -> Option<Place> {
        let scope = Scope::of(self.program.main());
        let at = self.check(at, due(Type::Point, "the place of a marker"), scope);
        let facing = self.check(facing, due(Type::Direction, "`facing`"), scope);
        Some(Place {
            at: at?,
            facing: facing?,
        })
    }

    pub(super) fn fact_class(&mut self, name: &tree::Name, library: Option<&Library>) -> Option<usize> {
        let library = library?;
        let found = library.classes.iter().position(|c| c.name == name.text);
        if found.is_none() {
            let known = library.classes.iter().map(|c| c.name.as_str());
            self.unknown_item("class", name, known, self.program.main());
        }
        if let Some(k) = found {
            self.names.member(Kind::Class, library.classes[k].span, name);
        }
        found
    }

    /// The features that a name stands for, a family all of them.
    pub(super) fn fact_features(&mut self, feature: &tree::FeatureRef, library: Option<&Library>) -> Vec<FeatureId> {
        let ids = library.and_then(|l| self.members_of(feature, self.library_scope(l)));
        ids.unwrap_or_default()
    }

    fn library_scope<'l>(&self, library: &'l Library) -> Scope<'l>
    where
        'a: 'l,
    {
        Scope {
            families: Some(&library.families),
            ..Scope::of(self.program.main())
        }
    }

    /// One feature, of a kind where one is due.
    pub(super) fn fact_feature(
        &mut self,
        feature: &tree::FeatureRef,
        library: Option<&Library>,
        due: Option<FeatureKind>,
    ) -> Option<FeatureId> {
        let library = library?;
        let (families, scope) = (&library.families, self.library_scope(library));
        let (name, index) = (&feature.name, feature.index.as_ref());
        let used = feature_use(self, name, index, feature.span, scope)?;
        let family = families.by_name.get(&name.text)?;
        if let Some(due) = due.filter(|due| *due != family.kind) {
            let message = format!("`{}` is a {}, and this is the place of a {due}", name.text, family.kind);
            let help = match family.kind {
                FeatureKind::Polygon => format!("write `{} = polygon([…])`", name.text),
                FeatureKind::Marker => format!("write `{} at [0 mm, 0 mm, 0 mm] facing +x`", name.text),
                FeatureKind::Shell => format!("write `{} detected`", name.text),
            };
            let out = Diagnostic::new(Code::E0703, feature.span, message).related(family.span, "declared here");
            self.report(out.help(help));
            return None;
        }
        families.resolve(&used, &BTreeMap::new())
    }

    /// One of some words with what it means.
    pub(super) fn state_of<T: Clone>(
        &mut self,
        word: &tree::Name,
        what: &str,
        words: &[(&'static str, T)],
    ) -> Option<T> {
        let known = words.iter().find(|(name, _)| *name == word.text);
        if let Some((name, _)) = known {
            self.names.uses(word.span, Entity::Word(name));
        }
        if known.is_none() {
            let names: Vec<&str> = words.iter().map(|(name, _)| *name).collect();
            let habit = HABITS
                .iter()
                .find(|(theirs, _)| *theirs == word.text)
                .map(|(_, ours)| *ours);
            match habit.filter(|ours| names.contains(ours) && closest(&word.text, names.iter().copied()).is_none()) {
                Some(ours) => {
                    let message = format!("{what} cannot be `{}`", word.text);
                    let out = Diagnostic::new(Code::E0306, word.span, message);
                    self.report(out.meant(ours));
                }
                None => self.unknown_word(word, what, &names),
            }
        }
        known.map(|(_, meaning)| meaning.clone())
    }
}

/// What a state of a feature is called elsewhere.
const HABITS: &[(&str, &str)] = &[
    ("present", "detected"),
    ("seen", "detected"),
    ("found", "detected"),
    ("true", "detected"),
    ("missing", "absent"),
    ("unseen", "unknown"),
    ("gone", "absent"),
    ("false", "absent"),
    ("impossible", "excluded"),
    ("certain", "present"),
];

pub(super) fn due(ty: Type, what: &str) -> Due<'_> {
    Due { ty, what }
}

/// Whether an expectation is about a library's status.
fn needs_library(expectation: &tree::Expectation) -> bool {
    use tree::ExpectationKind as Kind;
    !matches!(expectation.kind, Kind::Equal(..) | Kind::Count(..))
}

/// Where a feature was given what cannot be given together with this.
fn clash(all: &[(FeatureId, Given, Span)], id: FeatureId, given: &Given, library: Option<&Library>) -> Option<Span> {
    let many = library.is_some_and(|l| l.features[id.index()].many);
    let placed = |g: &Given| matches!(g, Given::Face(_) | Given::Marker(_));
    let first = all
        .iter()
        .find(|(other, held, _)| *other == id && !(many && placed(held) && placed(given)));
    first.map(|(.., span)| *span)
}
