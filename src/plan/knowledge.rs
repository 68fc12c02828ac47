//! What stays fixed during a run: library, task, and what follows from both.

use super::error::PlanError;
use super::inspection::Criteria;
use crate::primitives::{Envelope, envelope};
use crate::rules::{FeatureId, Library, RuleSet, Task};

/// Library and task of a run. The scenes of a rule set are never read.
#[derive(Clone, Debug)]
pub struct Knowledge {
    /// The library.
    pub library: Library,
    /// The task.
    pub task: Task,
    /// ξ, ξ_ned and the reading of eq. 3.
    pub criteria: Criteria,
    /// The detector's envelope of each rule.
    envelopes: Vec<Envelope>,
    /// The key of the one instance of each feature that is not `many`.
    keys: Vec<String>,
}

impl Knowledge {
    /// The named task of a rule set, with its library.
    ///
    /// # Errors
    /// No such task or library, or a rule whose detector has no envelope.
    pub fn new(rules: &RuleSet, task: &str) -> Result<Self, PlanError> {
        let Some(task) = rules.tasks.iter().find(|t| t.name == task) else {
            let known = rules.tasks.iter().map(|t| format!("`{}`", t.name)).collect::<Vec<_>>();
            return Err(PlanError::UnknownTask {
                name: task.to_owned(),
                known: known.join(", "),
            });
        };
        let library = rules.library(task).ok_or_else(|| PlanError::NoLibrary {
            task: task.name.clone(),
            library: task.library.clone(),
        })?;
        Self::of(library.clone(), task.clone())
    }

    /// A library and a task that belong together.
    ///
    /// # Errors
    /// A rule whose detector has no envelope.
    pub fn of(library: Library, task: Task) -> Result<Self, PlanError> {
        let envelopes = library.rules.iter().map(|rule| {
            envelope(&rule.detect).map_err(|source| PlanError::Rule {
                rule: rule.id.clone(),
                source,
            })
        });
        Ok(Self {
            criteria: Criteria::from(&task),
            envelopes: envelopes.collect::<Result<_, _>>()?,
            keys: library.features.iter().map(|f| single_key(&f.name)).collect(),
            library,
            task,
        })
    }

    /// Whether a definite rule can detect a feature.
    pub fn has_definite_rule(&self, feature: FeatureId) -> bool {
        self.definite_rule(feature).is_some()
    }

    /// Which looks count for an instance that `rule` predicted: by the
    /// feature's definite detector, else by the detector of that rule.
    pub fn envelope(&self, feature: FeatureId, rule: usize) -> Envelope {
        self.envelopes[self.definite_rule(feature).unwrap_or(rule)]
    }

    /// The key of the instance of a feature that is not `many`: its index in a
    /// family (`3` of `code[3]`), else `1`.
    pub fn key(&self, feature: FeatureId) -> &str {
        &self.keys[feature.index()]
    }

    fn definite_rule(&self, feature: FeatureId) -> Option<usize> {
        let definite = |r: &crate::rules::Rule| r.antecedents.is_empty() && r.consequent == feature;
        self.library.rules.iter().position(definite)
    }
}

fn single_key(feature: &str) -> String {
    let index = feature.strip_suffix(']').and_then(|f| f.rsplit_once('['));
    index.map_or_else(|| "1".to_owned(), |(_, index)| index.to_owned())
}
