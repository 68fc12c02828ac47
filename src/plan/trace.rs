//! What the rules did in one measurement, and why what failed did.
//!
//! `reasoning` and `predictions` write it while they decide; nothing decides by
//! it. It goes into the run log, for the question why: so it holds what cannot
//! be seen from the statuses, and a few entries a rule at most.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::instances::Finding;
use super::status::Status;
use crate::detect::{Account, Condition};
use crate::rules::{FeatureId, Library};

/// Most combinations of a rule that are told one by one.
const MOST_TRIES: usize = 12;

/// What the rules did in one measurement.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    rules: BTreeMap<usize, RuleTrace>,
    absent: BTreeMap<FeatureId, Absence>,
}

/// What one rule did in one measurement.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RuleTrace {
    /// Combinations for which its detector ran.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tries: Vec<Try>,
    /// How many more than those there were.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub more: usize,
    /// Rules that asked the same of the same detector: one answer serves them all.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub also: Vec<String>,
    /// Which of its calls (`detect`, `measure`, `predict`) wait for an attribute
    /// that has no value yet.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub waits: Vec<String>,
    /// Combinations whose prediction came to nothing.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub blank: Vec<Blank>,
}

/// One run of a rule's detector.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Try {
    /// Key of the instance that it was after.
    pub key: String,
    /// How many candidates it looked at: regions of the depth image, or voxels of a shell.
    pub looked: usize,
    /// How many instances it found.
    pub found: usize,
    /// The conditions on the surest finding; where nothing was found, on the
    /// candidate that came furthest, up to the one that failed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub conditions: Vec<Condition>,
}

/// A prediction that came to nothing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Blank {
    /// Key of the instance.
    pub key: String,
    /// Why.
    pub why: Nothing,
}

/// Why a prediction came to nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Nothing {
    /// No face has those edges and angles.
    NoFace,
    /// It lies outside the space.
    Outside,
}

/// How a feature came to count as absent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Absence {
    /// Voxels of its predicted places that were inspected.
    pub inspected: usize,
    /// All voxels of its predicted places.
    pub voxels: usize,
    /// The rules whose predictions counted.
    pub rules: Vec<String>,
}

/// What a rule's detector and measure made of a measurement.
#[derive(Clone, Debug, Default)]
pub struct Proof {
    /// Every instance found.
    pub findings: Vec<Finding>,
    /// What was looked at to find them.
    pub account: Account,
}

impl Trace {
    /// What a rule did, by its index; `None` where there is nothing to tell.
    pub fn rule(&self, rule: usize) -> Option<&RuleTrace> {
        self.rules.get(&rule)
    }

    /// Every rule of which there is something to tell, by id, in the library's order.
    pub fn rules(&self, library: &Library) -> Vec<(String, RuleTrace)> {
        let named = |(k, trace): (&usize, &RuleTrace)| Some((library.rules.get(*k)?.id.clone(), trace.clone()));
        self.rules.iter().filter_map(named).collect()
    }

    /// The features that came to count as absent, by name.
    pub fn absent(&self, library: &Library) -> Vec<(String, Absence)> {
        let named = |(id, absence): (&FeatureId, &Absence)| (library.feature(*id).name.clone(), absence.clone());
        self.absent.iter().map(named).collect()
    }

    /// A detector was run. A run after the same instance takes an earlier one's
    /// place unless that one found something.
    pub(super) fn tried(&mut self, rule: usize, key: &str, account: &Account, found: usize) {
        let conditions = if found == 0 { &account.failed } else { &account.met };
        let new = Try {
            key: key.to_owned(),
            looked: account.looked,
            found,
            conditions: conditions.clone(),
        };
        let trace = self.rules.entry(rule).or_default();
        match trace.tries.iter().position(|t| t.key == key) {
            Some(k) if trace.tries[k].found == 0 || found > 0 => trace.tries[k] = new,
            Some(_) => {}
            None if trace.tries.len() < MOST_TRIES => trace.tries.push(new),
            None => trace.more += 1,
        }
    }

    /// A rule would have asked what `first` had asked already.
    pub(super) fn asked_again(&mut self, first: usize, rule: usize, id: &str) {
        if first == rule {
            return;
        }
        if let Some(trace) = self.rules.get_mut(&first)
            && !trace.also.iter().any(|other| other == id)
        {
            trace.also.push(id.to_owned());
        }
    }

    /// A call waits for an attribute.
    pub(super) fn waits(&mut self, rule: usize, call: &str) {
        let waits = &mut self.rules.entry(rule).or_default().waits;
        if !waits.iter().any(|w| w == call) {
            waits.push(call.to_owned());
        }
    }

    /// A rule is run anew: what its detector waited for may be there.
    pub(super) fn runs_anew(&mut self, rule: usize) {
        self.revise(rule, |trace| trace.waits.retain(|w| w == "predict"));
    }

    /// A prediction came to nothing.
    pub(super) fn blank(&mut self, rule: usize, key: &str, why: Nothing) {
        let blank = &mut self.rules.entry(rule).or_default().blank;
        if blank.len() < MOST_TRIES {
            let key = key.to_owned();
            blank.push(Blank { key, why });
        }
    }

    /// The predictions of a rule are made anew.
    pub(super) fn predicts_anew(&mut self, rule: usize) {
        self.revise(rule, |trace| {
            trace.waits.retain(|w| w != "predict");
            trace.blank.clear();
        });
    }

    /// A feature counts as absent from now on; its predictions still stand.
    pub(super) fn ruled_out(&mut self, id: FeatureId, status: &Status, library: &Library) {
        let feature = status.feature(id);
        let (inspected, voxels) = feature.inspected_union();
        let mut rules: Vec<usize> = feature.predicted.values().map(|p| p.rule).collect();
        rules.sort_unstable();
        rules.dedup();
        let absence = Absence {
            inspected,
            voxels,
            rules: rules.into_iter().map(|k| library.rules[k].id.clone()).collect(),
        };
        self.absent.insert(id, absence);
    }

    fn revise(&mut self, rule: usize, change: impl FnOnce(&mut RuleTrace)) {
        if let Some(trace) = self.rules.get_mut(&rule) {
            change(trace);
            if *trace == RuleTrace::default() {
                self.rules.remove(&rule);
            }
        }
    }
}

fn is_zero(n: &usize) -> bool {
    *n == 0
}
