//! The first line of a run log: what is run, and by which library.

use serde::{Deserialize, Serialize};

use super::Ordered;
use crate::plan::Session;
use crate::rules::{self, Visibility};

/// What is run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Start {
    /// Version of the program.
    pub vpl: String,
    /// The task file, as given.
    pub file: String,
    /// Name of the task.
    pub task: String,
    /// Name of the object, or the mesh file.
    pub object: String,
    /// Name of the method.
    pub method: String,
    /// Seed of the run.
    pub seed: u64,
    /// Name of the depth noise.
    pub noise: String,
    /// How measurements entered the map.
    #[serde(default)]
    pub insertion: rules::Insertion,
    /// Most measurements.
    pub limit: u32,
    /// Number of candidate views.
    pub candidates: usize,
    /// SHA-256 of the compiled rule set.
    pub rules: String,
    /// Weight of each feature before anything is seen, bits.
    pub weights: Ordered<f64>,
    /// What the task asks for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub criteria: Option<Criteria>,
    /// The library, as far as a log needs it to be understood alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub library: Option<Library>,
}

/// Goal and thresholds of a task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Criteria {
    /// Whether a class must be certain.
    pub confident: bool,
    /// Whether no view may be able to gain anything.
    pub exhausted: bool,
    /// ξ, metres.
    pub near: f64,
    /// ξ_ned, a share.
    pub absent: f64,
    /// ξ_cfd, a probability.
    pub confidence: f64,
    /// Least share of the overlap constraint.
    pub overlap: f64,
    /// Voxels below which a gain does not count.
    pub gain_floor: u32,
    /// How it is decided what hides a voxel; older logs do not say.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub visibility: Option<Visibility>,
}

/// A library in a log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Library {
    /// Its name.
    pub name: String,
    /// Its classes.
    pub classes: Ordered<Class>,
    /// Its rules by id.
    pub rules: Ordered<Rule>,
}

/// A class in a log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Class {
    /// P(class) before anything is seen.
    pub prior: f64,
    /// A 1 or a 0 a feature, in the order of [`Start::weights`].
    pub presence: String,
}

/// A rule in a log.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Rule {
    /// Names of its antecedents.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub antecedents: Vec<String>,
    /// Name of its consequent.
    pub consequent: String,
    /// What it is repeated for: `bottom.edges`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub each: Vec<String>,
    /// Its detector.
    pub detect: String,
    /// Its predictor.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub predict: Option<String>,
    /// Line in its file.
    pub line: u32,
    /// [`rules::Rule::digest`]; empty in logs that were written without.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub digest: String,
}

impl Start {
    /// The start of a session's run.
    pub fn of(session: &Session, file: &str, object: &str, noise: &str, seed: u64, rules: String) -> Self {
        let features = session.library().features.iter().map(|f| f.name.clone());
        Self {
            vpl: env!("CARGO_PKG_VERSION").to_owned(),
            file: file.to_owned(),
            task: session.task().name.clone(),
            object: object.to_owned(),
            method: session.method().to_owned(),
            seed,
            noise: noise.to_owned(),
            insertion: session.task().insertion,
            limit: session.limit(),
            candidates: session.views().len(),
            rules,
            weights: Ordered(features.zip(session.weights()).collect()),
            criteria: Some(Criteria::from(session.task())),
            library: Some(Library::from(session.library())),
        }
    }
}

impl From<&rules::Task> for Criteria {
    fn from(task: &rules::Task) -> Self {
        Self {
            confident: task.goal.confident,
            exhausted: task.goal.exhausted,
            near: task.thresholds.near,
            absent: task.thresholds.absent,
            confidence: task.thresholds.confidence,
            overlap: task.overlap,
            gain_floor: task.gain_floor,
            visibility: Some(task.visibility),
        }
    }
}

impl From<&rules::Library> for Library {
    fn from(library: &rules::Library) -> Self {
        let class = |class: &rules::Class| {
            let presence = String::from(class.presence.clone());
            let prior = class.prior;
            (class.name.clone(), Class { prior, presence })
        };
        let rule = |rule: &rules::Rule| (rule.id.clone(), Rule::of(rule, library));
        Self {
            name: library.name.clone(),
            classes: Ordered(library.classes.iter().map(class).collect()),
            rules: Ordered(library.rules.iter().map(rule).collect()),
        }
    }
}

impl Rule {
    /// A rule of a library.
    pub fn of(rule: &rules::Rule, library: &rules::Library) -> Self {
        let name = |id: &rules::FeatureId| library.feature(*id).name.clone();
        Self {
            antecedents: rule.antecedents.iter().map(name).collect(),
            consequent: name(&rule.consequent),
            each: rule
                .each
                .iter()
                .map(|e| format!("{}.{}", name(&e.feature), e.attribute))
                .collect(),
            detect: rule.detect.primitive.clone(),
            predict: rule.predict.as_ref().map(|p| p.primitive.clone()),
            line: rule.place.line,
            digest: rule.digest(library),
        }
    }
}
