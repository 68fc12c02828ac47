//! The visual representation status: features, candidates, and where they clash.

use super::candidates::{posterior, presence};
use super::features::{self, Existence, FeatureStatus};
use super::knowledge::Knowledge;
use super::viewpoint::Viewpoint;
use super::weights::weights;
use crate::map::Tag;
use crate::rules::FeatureId;

/// A run's status between two measurements.
#[derive(Clone, Debug)]
pub struct Status {
    /// Feature status, in the library's order.
    pub features: Vec<FeatureStatus>,
    /// P(class_m | S_es), in the library's order.
    pub posterior: Vec<f64>,
    /// w_i, bits, in the library's order.
    pub weights: Vec<f64>,
    /// Why no class is left, or how the library contradicts itself.
    pub contradiction: Option<Contradiction>,
    /// The views visited, in order.
    pub visited: Vec<Viewpoint>,
    /// Features in the order in which they became 0 or 1.
    pub decided: Vec<FeatureId>,
    pub(super) next_tag: Tag,
    pub(super) next_revision: u32,
}

/// What a library cannot explain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Contradiction {
    /// The feature.
    pub feature: FeatureId,
    /// What was seen, and why it does not fit.
    pub evidence: String,
}

impl Status {
    /// Before perception: every feature in state −1, every class possible.
    pub fn new(knowledge: &Knowledge) -> Self {
        let features = features::unknown(&knowledge.library);
        let mut status = Self {
            posterior: posterior(&knowledge.library, &vec![Existence::Unknown; features.len()]),
            weights: Vec::new(),
            contradiction: None,
            visited: Vec::new(),
            decided: Vec::new(),
            features,
            next_tag: 0,
            next_revision: 0,
        };
        status.weigh(knowledge);
        status
    }

    /// es_i of all features.
    pub fn states(&self) -> Vec<Existence> {
        self.features.iter().map(|f| f.state).collect()
    }

    /// The status of a feature.
    pub fn feature(&self, id: FeatureId) -> &FeatureStatus {
        &self.features[id.index()]
    }

    /// Computes the weights from states, posterior and inspection.
    pub fn weigh(&mut self, knowledge: &Knowledge) {
        let library = &knowledge.library;
        let existence: Vec<f64> = library
            .feature_ids()
            .map(|id| presence(library, &self.posterior, id))
            .collect();
        let spent: Vec<bool> = library.feature_ids().map(|id| self.is_spent(id, knowledge)).collect();
        self.weights = weights(&self.states(), &existence, &spent);
    }

    /// Must exist, was inspected, and no definite rule could have found it.
    fn is_spent(&self, id: FeatureId, knowledge: &Knowledge) -> bool {
        let feature = self.feature(id);
        let (done, all) = feature.inspected_union();
        feature.state == Existence::Present
            && !knowledge.has_definite_rule(id)
            && super::inspection::reaches(done, all, knowledge.criteria.absent)
    }
}
