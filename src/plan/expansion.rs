//! A rule stands for one rule a combination of antecedent instances and, with
//! `for each`, of their edges.

use std::collections::BTreeMap;

use super::evaluate::Context;
use super::features::FeatureStatus;
use super::knowledge::Knowledge;
use crate::geometry::Edge;
use crate::primitives::{Arguments, Datum};
use crate::rules::{BadArgument, Call, FeatureId};

/// One combination.
#[derive(Clone, Debug)]
pub struct Expansion {
    /// Index of the rule.
    pub rule: usize,
    /// Key of the consequent's instance.
    pub key: String,
    /// The antecedent instances, as positions in [`FeatureStatus::found`].
    pub antecedents: Vec<(FeatureId, usize)>,
    /// The `for each` variables.
    pub variables: BTreeMap<String, Edge>,
    /// Revisions of the antecedents' anchors.
    pub revisions: Vec<u32>,
    /// The parts of the key that the combination adds.
    path: Vec<String>,
}

impl Expansion {
    /// The arguments of one of the rule's calls; `None` where one has no value yet.
    ///
    /// # Errors
    /// An argument does not fit together.
    pub fn arguments(&self, call: &Call, features: &[FeatureStatus]) -> Result<Option<Arguments>, BadArgument> {
        let found = |(id, k): &(FeatureId, usize)| Some((*id, &features[id.index()].found.get(*k)?.anchor));
        let context = Context {
            antecedents: self.antecedents.iter().filter_map(found).collect(),
            variables: &self.variables,
            measured: &|id| match features.get(id.index()) {
                Some(feature) => feature.found.iter().map(|f| &f.anchor).collect(),
                None => Vec::new(),
            },
        };
        context.arguments(call)
    }
}

/// All combinations of a rule: none unless every antecedent is measured, one
/// for a definite rule. Outermost first.
///
/// # Errors
/// A `for each` over something that is no list of edges.
pub fn expansions(
    rule: usize,
    knowledge: &Knowledge,
    features: &[FeatureStatus],
) -> Result<Vec<Expansion>, BadArgument> {
    let declared = &knowledge.library.rules[rule];
    let mut all = vec![Expansion {
        rule,
        key: String::new(),
        antecedents: Vec::new(),
        variables: BTreeMap::new(),
        revisions: Vec::new(),
        path: Vec::new(),
    }];
    for &antecedent in &declared.antecedents {
        all = all
            .iter()
            .flat_map(|e| with_instances(e, antecedent, features))
            .collect();
    }
    for each in &declared.each {
        let mut expanded = Vec::new();
        for expansion in &all {
            let name = &knowledge.library.feature(each.feature).name;
            expanded.extend(with_edges(expansion, each, name, features)?);
        }
        all = expanded;
    }
    for expansion in &mut all {
        expansion.key = key(expansion, knowledge, features);
    }
    Ok(all)
}

fn with_instances(from: &Expansion, antecedent: FeatureId, features: &[FeatureStatus]) -> Vec<Expansion> {
    let instances = features[antecedent.index()].found.iter().enumerate();
    let one = |(k, found): (usize, &super::features::Found)| {
        let mut expansion = from.clone();
        expansion.antecedents.push((antecedent, k));
        expansion.revisions.push(found.revision);
        expansion
    };
    instances.map(one).collect()
}

fn with_edges(
    from: &Expansion,
    each: &crate::rules::Each,
    feature: &str,
    features: &[FeatureStatus],
) -> Result<Vec<Expansion>, BadArgument> {
    let antecedent = from.antecedents.iter().find(|(id, _)| *id == each.feature);
    let Some((id, k)) = antecedent else {
        return Err(BadArgument::new(
            &each.variable,
            "a part of one of the rule's antecedents",
        ));
    };
    let found = &features[id.index()].found[*k];
    let Datum::Edges(edges) = super::attributes::attribute(&found.anchor, &each.attribute)? else {
        return Err(BadArgument::new(&each.attribute, "a list of edges"));
    };
    let one = |(n, edge): (usize, Edge)| {
        let mut expansion = from.clone();
        expansion.variables.insert(each.variable.clone(), edge);
        expansion
            .path
            .push(format!("{feature}.{}/edge.{}", found.number, n + 1));
        expansion
    };
    Ok(edges.into_iter().enumerate().map(one).collect())
}

/// The one key of a feature that is not `many`; else the edges, or without
/// `for each` the antecedent instances, that the combination is made of.
fn key(expansion: &Expansion, knowledge: &Knowledge, features: &[FeatureStatus]) -> String {
    let library = &knowledge.library;
    let consequent = library.rules[expansion.rule].consequent;
    if !library.feature(consequent).many {
        return knowledge.key(consequent).to_owned();
    }
    if !expansion.path.is_empty() {
        return expansion.path.join("+");
    }
    let instance = |(id, k): &(FeatureId, usize)| {
        let number = features[id.index()].found[*k].number;
        format!("{}.{number}", library.feature(*id).name)
    };
    expansion.antecedents.iter().map(instance).collect::<Vec<_>>().join("+")
}
