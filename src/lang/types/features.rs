//! Features: their declaration as families, and their use.

use std::collections::BTreeMap;

use super::Checker;
use super::inclusion::Taken;
use super::scope::{Scope, declared, index_use};
use super::typed::{Families, Family, Feature, FeatureUse, IndexUse, Members};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::index::{Entity, Kind};
use crate::lang::names::{
    self,
    suggest::{closest, one_of},
};
use crate::lang::source::Span;
use crate::lang::syntax::tree::{self, Index};
use crate::rules::{FeatureId, FeatureKind};

/// Most features of a library.
pub(super) const MOST_FEATURES: usize = 4_096;

/// The kinds of feature by name.
pub(in crate::lang) const KINDS: &[(&str, FeatureKind)] = &[
    ("polygon", FeatureKind::Polygon),
    ("marker", FeatureKind::Marker),
    ("shell", FeatureKind::Shell),
];

impl Checker<'_> {
    /// The features of a library in order, and the families that they form.
    pub(super) fn families(&mut self, library: &tree::Library, taken: &mut Vec<Taken>) -> (Families, Vec<Feature>) {
        let mut families = Families::default();
        let mut features: Vec<Feature> = Vec::new();
        let before = taken.len();
        let mut waiting = std::mem::take(taken).into_iter().peekable();
        for declared in &library.features {
            while let Some(next) = waiting.next_if(|t| t.at < declared.span) {
                taken.extend(self.take_features(next, &mut families, &mut features));
            }
            self.declare(declared, &mut families, &mut features);
        }
        for next in waiting {
            taken.extend(self.take_features(next, &mut families, &mut features));
        }
        families.open |= taken.len() < before;
        self.confusable(&families);
        (families, features)
    }

    fn declare(&mut self, declared: &tree::Feature, families: &mut Families, features: &mut Vec<Feature>) {
        let name = &declared.name.name;
        if let Some(first) = families.by_name.get(&name.text) {
            self.report(names::declared_twice("feature", name, first.span));
            return;
        }
        let family = self.feature_kind(&declared.kind).and_then(|kind| {
            let members = self.members(declared, kind, features)?;
            Some(Family {
                kind,
                members,
                span: name.span,
            })
        });
        match family {
            Some(family) => drop(families.by_name.insert(name.text.clone(), family)),
            None => drop(families.lost.insert(name.text.clone())),
        }
    }

    fn feature_kind(&mut self, word: &tree::Name) -> Option<FeatureKind> {
        let Some((name, kind)) = KINDS.iter().find(|(name, _)| *name == word.text) else {
            let names: Vec<&str> = KINDS.iter().map(|(name, _)| *name).collect();
            self.unknown_word(word, "the kind of a feature", &names);
            return None;
        };
        self.names.uses(word.span, Entity::Type(name));
        Some(*kind)
    }

    fn members(&mut self, declared: &tree::Feature, kind: FeatureKind, features: &mut Vec<Feature>) -> Option<Members> {
        let feature = |name: String| Feature {
            name,
            kind,
            many: declared.many,
            span: declared.span,
        };
        let name = &declared.name.name.text;
        let (first, last) = match &declared.name.index {
            None => {
                features.push(feature(name.clone()));
                return Some(Members::One(FeatureId(features.len() as u32 - 1)));
            }
            Some(Index::Literal(n, _)) => (*n, *n),
            Some(Index::Range(first, last, _)) => (*first, *last),
            Some(Index::Variable(variable)) => {
                self.report(
                    Diagnostic::new(Code::E0210, variable.span, "a family is declared with its indices")
                        .help(format!("write a range: `{name}[1..7]`")),
                );
                return None;
            }
        };
        let at = declared.name.span;
        if last < first {
            self.report(
                Diagnostic::new(Code::E0210, at, format!("the range `{first}..{last}` is empty"))
                    .help("a range goes from the smaller to the larger index, both included"),
            );
            return None;
        }
        if last - first >= (MOST_FEATURES - features.len().min(MOST_FEATURES)) as u64 {
            let message = format!("a library of more than {MOST_FEATURES} features");
            self.report(Diagnostic::new(Code::E0312, at, message));
            return None;
        }
        let mut ids = BTreeMap::new();
        for n in first..=last {
            features.push(feature(format!("{name}[{n}]")));
            ids.insert(n, FeatureId(features.len() as u32 - 1));
        }
        Some(Members::Indexed(ids))
    }

    /// `code[1..7]` beside `code1`: one of them is a slip, or will be read as one.
    fn confusable(&mut self, families: &Families) {
        for (name, family) in &families.by_name {
            let base = name.trim_end_matches(|c: char| c.is_ascii_digit());
            let index = name[base.len()..].parse::<u64>().ok();
            let (Some(other), Some(n)) = (families.by_name.get(base), index) else {
                continue;
            };
            if declared(other).contains(&n) && matches!(family.members, Members::One(_)) {
                self.report(
                    Diagnostic::new(
                        Code::E0202,
                        family.span,
                        format!("`{name}` and `{base}[{n}]` are too alike"),
                    )
                    .related(other.span, format!("`{base}[{n}]` is declared here"))
                    .help("give one of them another name"),
                );
            }
        }
    }

    /// The features that a name with an index, a range or none stands for, in order.
    pub(super) fn members_of(&mut self, feature: &tree::FeatureRef, scope: Scope<'_>) -> Option<Vec<FeatureId>> {
        let family = self.family(&feature.name, scope)?;
        match (&feature.index, &family.members) {
            (None, Members::One(id)) => Some(vec![*id]),
            (None, Members::Indexed(ids)) => Some(ids.values().copied().collect()),
            (Some(Index::Range(first, last, span)), Members::Indexed(ids)) => {
                let within = *first <= *last && ids.contains_key(first) && ids.contains_key(last);
                if within {
                    return Some(ids.range(*first..=*last).map(|(_, id)| *id).collect());
                }
                self.outside(&feature.name.text, *span, family);
                None
            }
            _ => {
                let used = feature_use(self, &feature.name, feature.index.as_ref(), feature.span, scope)?;
                scope.families?.resolve(&used, &BTreeMap::new()).map(|id| vec![id])
            }
        }
    }

    fn family<'f>(&mut self, name: &tree::Name, scope: Scope<'f>) -> Option<&'f Family> {
        let families = scope.families?;
        let found = families.by_name.get(&name.text);
        if let Some(family) = found {
            self.names.uses(name.span, Entity::Declared(Kind::Feature, family.span));
        }
        let lost = families.open || families.lost.contains(&name.text) || scope.lost(&name.text);
        if found.is_none() && !lost && self.first_time("feature", name) {
            let known = || families.by_name.keys().map(String::as_str);
            let out = Diagnostic::new(Code::E0207, name.span, format!("there is no feature `{}`", name.text));
            let near = member_of(&name.text, families).or_else(|| closest(&name.text, known()).map(str::to_owned));
            self.report(match near {
                Some(near) => out.meant(&near),
                None if families.by_name.is_empty() => out.help("declare it: `feature name : polygon`"),
                None => out.help(format!("the library has {}", one_of(known()).replace(" or ", " and "))),
            });
        }
        found
    }

    fn outside(&mut self, name: &str, span: Span, family: &Family) {
        let indices = declared(family);
        let (first, last) = (indices.first().copied(), indices.last().copied());
        let help = match (first, last) {
            (Some(first), Some(last)) => format!("`{name}` is declared for {first} to {last}"),
            _ => format!("`{name}` is a single feature: leave the index out"),
        };
        self.report(
            Diagnostic::new(Code::E0210, span, format!("`{name}` has no such index"))
                .related(family.span, "declared here")
                .help(help),
        );
    }
}

/// A feature where one is meant; its index must fit its family and, in a rule, be a
/// literal or one of the rule's variables.
pub(super) fn feature_use(
    checker: &mut Checker<'_>,
    name: &tree::Name,
    index: Option<&Index>,
    span: Span,
    scope: Scope<'_>,
) -> Option<FeatureUse> {
    let family = checker.family(name, scope)?;
    let at = index.map_or(span, Index::span);
    let Some(used) = index_use(index) else {
        checker.report(
            Diagnostic::new(Code::E0210, at, "a range has no place here")
                .help(format!("name one index, or a variable: `{}[i]`", name.text)),
        );
        return None;
    };
    match (&used, &family.members) {
        (IndexUse::None, Members::One(_)) => {}
        (IndexUse::None, Members::Indexed(_)) => {
            checker.report(
                Diagnostic::new(
                    Code::E0210,
                    span,
                    format!("`{}` is a family and needs an index", name.text),
                )
                .related(family.span, "declared here")
                .help(format!(
                    "write `{0}[i]` in a rule for all of them, or `{0}[1]` for one",
                    name.text
                )),
            );
            return None;
        }
        (IndexUse::Literal(n), Members::Indexed(ids)) if ids.contains_key(n) => {}
        (IndexUse::Variable(v), Members::Indexed(_)) => {
            if let Some(Index::Variable(name)) = index {
                checker.names.uses_local(name);
            }
            let known = scope.rule.is_some_and(|r| r.indices.iter().any(|(name, _)| name == v));
            if !known {
                checker.report(
                    Diagnostic::new(Code::E0210, at, format!("`{v}` is no index variable here"))
                        .help("an index is a whole number, or a variable of the rule's `->` line"),
                );
                return None;
            }
        }
        _ => {
            checker.outside(&name.text, at, family);
            return None;
        }
    }
    Some(FeatureUse {
        family: name.text.clone(),
        index: used,
        span,
    })
}
/// `code[2]` for `code_2` and `code2`.
fn member_of(name: &str, families: &Families) -> Option<String> {
    let family = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let index: u64 = name[family.len()..].parse().ok()?;
    let family = family.trim_end_matches('_');
    let is_one = families
        .by_name
        .get(family)
        .is_some_and(|f| declared(f).contains(&index));
    is_one.then(|| format!("{family}[{index}]"))
}
