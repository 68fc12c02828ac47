//! What a session tells after each measurement: all that a run log holds.

use super::completion::{Completion, Outcome, likeliest};
use super::features::{Existence, FeatureStatus};
use super::knowledge::Knowledge;
use super::score::Target;
use super::status::Status;
use super::trace::{Absence, RuleTrace};
use crate::detect::Condition;
use crate::map::Counts;
use crate::rules::{Goal, Library};

/// What changed with a measurement.
#[derive(Clone, Debug, PartialEq)]
pub struct Update {
    /// Number of measurements, this one included.
    pub n: usize,
    /// The view it came from.
    pub view: usize,
    /// Measured points inside the space.
    pub points: usize,
    /// Features in the library's order.
    pub features: Vec<FeatureReport>,
    /// Class names and probabilities in the library's order.
    pub classes: Vec<(String, f64)>,
    /// Voxels by state.
    pub voxels: Counts,
    /// s_cmp.
    pub completion: Completion,
    /// What rules did of which the statuses do not tell, by id in the library's order.
    pub rules: Vec<(String, RuleTrace)>,
    /// How features came to count as absent, by name in the library's order.
    pub absent: Vec<(String, Absence)>,
}

/// A feature's status.
#[derive(Clone, Debug, PartialEq)]
pub struct FeatureReport {
    /// Its name.
    pub name: String,
    /// es_i.
    pub state: Existence,
    /// The mark 4.
    pub predicted: bool,
    /// w_i, bits.
    pub weight: f64,
    /// Measured instances by number, then predicted ones by key.
    pub instances: Vec<InstanceReport>,
}

/// An instance's status.
#[derive(Clone, Debug, PartialEq)]
pub struct InstanceReport {
    /// Its key.
    pub key: String,
    /// 1 where measured, else its feature's state without instances: −1 or 2.
    pub state: Existence,
    /// Inspected share of its predicted voxels; 1 where measured.
    pub inspected: f64,
    /// |PV_ij|; 0 where measured.
    pub predicted_voxels: usize,
    /// Ids of the rules that predict it.
    pub predicted_by: Vec<String>,
    /// Id of the one whose prediction counts.
    pub rule: Option<String>,
}

/// What to do next.
#[derive(Clone, Debug, PartialEq)]
pub enum Decision {
    /// Measure from a view.
    Next(Next),
    /// Stop.
    End(End),
}

/// The next best view.
#[derive(Clone, Debug, PartialEq)]
pub struct Next {
    /// The view.
    pub chosen: Standing,
    /// Whether every view with gain failed the overlap constraint.
    pub relaxed: bool,
    /// A few that it was preferred to, best first.
    pub runners_up: Vec<Standing>,
}

/// How a candidate view stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Standing {
    /// Its index.
    pub view: usize,
    /// Its value (eq. 8); 0 for the first view.
    pub score: f64,
    /// The terms of eq. 8.
    pub terms: Terms,
    /// The share that G_ovlp judges, where the method asks for it.
    pub share: Option<f64>,
    /// From the view before, metres: it breaks ties.
    pub distance: f64,
    /// The instance that G_fd comes from.
    pub target: Option<TargetName>,
}

/// The terms of eq. 8.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Terms {
    /// G_ovlp.
    pub overlap: bool,
    /// G_fd, bits.
    pub feature: f64,
    /// G_so, voxels.
    pub surface: u64,
    /// W.
    pub w: bool,
}

/// A feature instance by name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TargetName {
    /// The feature's name.
    pub feature: String,
    /// The instance's key.
    pub key: String,
    /// Its voxels that the view reaches and that are not yet inspected.
    pub reached: usize,
    /// |PV_ij|.
    pub voxels: usize,
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub struct End {
    /// Why.
    pub outcome: Outcome,
    /// The class, where one is confident.
    pub class: Option<String>,
    /// Probability of the likeliest class; 0 after a contradiction.
    pub confidence: f64,
    /// What the library cannot explain.
    pub contradiction: Option<ContradictionReport>,
    /// What was asked for.
    pub goal: Goal,
    /// What a run can end by, and which of it holds.
    pub because: Vec<Condition>,
}

/// What a library cannot explain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ContradictionReport {
    /// The feature's name.
    pub feature: String,
    /// What was seen, and why it does not fit.
    pub evidence: String,
}

/// The features of a status.
pub fn features(status: &Status, knowledge: &Knowledge) -> Vec<FeatureReport> {
    let library = &knowledge.library;
    let report = |id: crate::rules::FeatureId| {
        let feature = status.feature(id);
        FeatureReport {
            name: library.feature(id).name.clone(),
            state: feature.state,
            predicted: feature.is_predicted(),
            weight: status.weights[id.index()],
            instances: instances(feature, library),
        }
    };
    library.feature_ids().map(report).collect()
}

fn instances(feature: &FeatureStatus, library: &Library) -> Vec<InstanceReport> {
    let measured = feature.found.iter().map(|found| InstanceReport {
        key: found.key.clone(),
        state: Existence::Detected,
        inspected: 1.0,
        predicted_voxels: 0,
        predicted_by: Vec::new(),
        rule: None,
    });
    let open = if feature.state.is_open() {
        feature.state
    } else {
        Existence::Unknown
    };
    let predicted = feature.predicted.iter().map(|(key, p)| InstanceReport {
        key: key.clone(),
        state: open,
        inspected: p.share(),
        predicted_voxels: p.voxels.len(),
        predicted_by: p.by.clone(),
        rule: library.rules.get(p.rule).map(|r| r.id.clone()),
    });
    measured.chain(predicted).collect()
}

/// Class names and probabilities.
pub fn classes(status: &Status, knowledge: &Knowledge) -> Vec<(String, f64)> {
    let names = knowledge.library.classes.iter().map(|c| c.name.clone());
    let excluded = status.contradiction.is_some();
    let probabilities = status.posterior.iter().map(|p| if excluded { 0.0 } else { *p });
    names.zip(probabilities).collect()
}

/// The end of a run.
pub fn end(outcome: Outcome, completion: Completion, status: &Status, knowledge: &Knowledge) -> End {
    let (winner, probability) = likeliest(&status.posterior);
    let library = &knowledge.library;
    End {
        outcome,
        class: completion.confident.then(|| library.classes[winner].name.clone()),
        confidence: if status.contradiction.is_some() {
            0.0
        } else {
            probability
        },
        contradiction: status.contradiction.as_ref().map(|c| ContradictionReport {
            feature: library.feature(c.feature).name.clone(),
            evidence: c.evidence.clone(),
        }),
        goal: knowledge.task.goal,
        because: Vec::new(),
    }
}

/// A target by name.
pub fn named(target: &Target, knowledge: &Knowledge) -> TargetName {
    TargetName {
        feature: knowledge.library.feature(target.feature).name.clone(),
        key: target.key.clone(),
        reached: target.reached,
        voxels: target.voxels,
    }
}
