//! What an expression can see: its module, parameters, and the rule around it.

use std::collections::BTreeMap;

use super::typed::{Families, Family, FeatureUse, IndexUse, Members};
use crate::lang::names::Module;
use crate::lang::source::Span;
use crate::lang::syntax::tree;
use crate::primitives::Type;

/// What an expression can see.
#[derive(Clone, Copy)]
pub(super) struct Scope<'a> {
    pub module: &'a Module,
    /// Parameters of the definition or the template around it.
    pub parameters: Option<&'a Parameters>,
    /// The features of the library around it.
    pub families: Option<&'a Families>,
    pub rule: Option<&'a RuleScope>,
}

/// Parameters by name, with their types and places; of unknown type as `None`.
pub(super) type Parameters = BTreeMap<String, (Option<Type>, Span)>;

/// The rule around an expression.
pub(super) struct RuleScope {
    pub antecedents: Vec<FeatureUse>,
    pub consequent: FeatureUse,
    /// `for each` variables with their types; `None` where that is unknown.
    pub each: Vec<(String, Option<Type>)>,
    /// Index variables.
    pub indices: Vec<(String, Vec<u64>)>,
}

/// What a feature is to a rule.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    Antecedent,
    Consequent,
    Neither,
}

impl<'a> Scope<'a> {
    /// The scope of a module's top level.
    pub fn of(module: &'a Module) -> Self {
        Self {
            module,
            parameters: None,
            families: None,
            rule: None,
        }
    }

    /// The type of a parameter; `Some(None)` where it is unknown.
    pub fn parameter(&self, name: &str) -> Option<Option<Type>> {
        self.parameters?.get(name).map(|(ty, _)| *ty)
    }

    /// The type of a `for each` variable; `Some(None)` where it is unknown.
    pub fn variable(&self, name: &str) -> Option<Option<Type>> {
        self.rule?.each.iter().find(|(n, _)| n == name).map(|(_, ty)| *ty)
    }

    /// The family of a feature name.
    pub fn family(&self, name: &str) -> Option<&'a Family> {
        self.families?.by_name.get(name)
    }

    /// Whether expressions are evaluated while the robot moves: in a rule, or in a
    /// definition that a rule may use.
    pub fn in_a_rule(&self) -> bool {
        self.rule.is_some() || (self.parameters.is_some() && self.families.is_none())
    }

    /// Whether a name may be declared in a region that could not be read.
    pub fn lost(&self, name: &str) -> bool {
        self.module.lost.contains(name)
    }
}

impl RuleScope {
    /// What a feature is to this rule.
    pub fn role(&self, feature: &FeatureUse) -> Role {
        let same = |other: &FeatureUse| other.family == feature.family && other.index == feature.index;
        if self.antecedents.iter().any(same) {
            Role::Antecedent
        } else if same(&self.consequent) {
            Role::Consequent
        } else {
            Role::Neither
        }
    }
}

/// An index as a use of it; `None` for a range.
pub(super) fn index_use(index: Option<&tree::Index>) -> Option<IndexUse> {
    Some(match index {
        None => IndexUse::None,
        Some(tree::Index::Literal(n, _)) => IndexUse::Literal(*n),
        Some(tree::Index::Variable(name)) => IndexUse::Variable(name.text.clone()),
        Some(tree::Index::Range(..)) => return None,
    })
}

/// The declared indices of a family; none for a single feature.
pub(super) fn declared(family: &Family) -> Vec<u64> {
    match &family.members {
        Members::One(_) => Vec::new(),
        Members::Indexed(ids) => ids.keys().copied().collect(),
    }
}
