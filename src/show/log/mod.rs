//! The run log: JSON Lines, one object a line, as `docs/cli.md` describes.
//!
//! Plain records with a fixed key order. What they say comes from the
//! session's updates and decisions; writing them is the caller's job. Keys that
//! came later are optional, so that older logs are still read.

mod ordered;
mod read;
mod start;

use serde::{Deserialize, Serialize};

use crate::detect::Condition;
use crate::geometry::Pose;
use crate::plan::{self, Absence, Decision, Outcome, RuleTrace, Step};

pub use ordered::Ordered;
pub use read::{BadLog, MOST_LINE, Run};
pub use start::{Class, Criteria, Library, Rule, Start};

/// One line of a run log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "event", rename_all = "snake_case")]
pub enum Record {
    /// Before anything is seen.
    Start(Start),
    /// After a measurement.
    View(Box<View>),
    /// The outcome.
    End(End),
}

/// What a measurement changed, and what comes next.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct View {
    /// Number of the measurement, from 1.
    pub n: u32,
    /// Index of the candidate view.
    pub view: usize,
    /// `world_from_camera`.
    pub pose: LoggedPose,
    /// Measured points inside the space.
    pub points: usize,
    /// Feature status.
    pub features: Ordered<Feature>,
    /// Posterior of each class.
    pub classes: Ordered<f64>,
    /// Voxels by state.
    pub voxels: Voxels,
    /// Completion status.
    pub completion: Completion,
    /// What rules did of which the statuses do not tell.
    #[serde(default, skip_serializing_if = "Ordered::is_empty")]
    pub rules: Ordered<RuleTrace>,
    /// How features came to count as absent.
    #[serde(default, skip_serializing_if = "Ordered::is_empty")]
    pub absent: Ordered<Absence>,
    /// The next best view; `None` exactly at the last view.
    pub next: Option<Next>,
    /// Why the run stops here.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stop: Option<Stop>,
    /// Milliseconds by phase.
    pub ms: Milliseconds,
}

/// A pose as position and unit quaternion.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LoggedPose {
    /// x, y, z in metres.
    pub position: [f64; 3],
    /// w, x, y, z.
    pub rotation: [f64; 4],
}

/// Status of a feature.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Feature {
    /// es_i: −1, 0, 1, 2 or 3.
    pub state: i8,
    /// Whether it carries the mark 4.
    pub predicted: bool,
    /// w_i, bits.
    pub weight: f64,
    /// Its instances.
    pub instances: Vec<Instance>,
}

/// Status of an instance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Instance {
    /// Its key.
    pub key: String,
    /// 1 when measured, else the state of its feature.
    pub state: i8,
    /// Share of its predicted voxels that were inspected.
    pub inspected: f64,
    /// |PV_ij|.
    pub predicted_voxels: usize,
    /// Ids of the rules that predict it, in the library's order.
    pub predicted_by: Vec<String>,
    /// Id of the rule whose prediction counts.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rule: Option<String>,
}

/// Voxels by state.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Voxels {
    /// Unknown.
    pub unknown: u64,
    /// Free.
    pub free: u64,
    /// Occupied.
    pub occupied: u64,
    /// Pre-occupied.
    pub preoccupied: u64,
}

/// Completion status.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Completion {
    /// s_cfd.
    pub confident: bool,
    /// s_ail.
    pub exhausted: bool,
}

/// The next best view.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Next {
    /// The view.
    #[serde(flatten)]
    pub chosen: Standing,
    /// Whether no view with gain met the overlap constraint.
    pub relaxed: bool,
    /// A few views that it was preferred to, best first.
    #[serde(default)]
    pub runners_up: Vec<Standing>,
}

/// How a candidate view stands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Standing {
    /// Index of the candidate view.
    pub view: usize,
    /// Eq. 8.
    pub score: f64,
    /// What the score is made of.
    pub terms: Terms,
    /// The share that the overlap constraint judges, where the method asks for it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub share: Option<f64>,
    /// From the view before, metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub distance: Option<f64>,
    /// The instance that the feature term comes from.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub target: Option<Target>,
}

/// The instance that a view goes for.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Target {
    /// Its feature.
    pub feature: String,
    /// Its key.
    pub key: String,
    /// Its voxels that the view reaches and that are not yet inspected.
    pub reached: usize,
    /// All voxels of its place.
    pub voxels: usize,
}

/// Why a run stops.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stop {
    /// As [`End::outcome`].
    pub outcome: String,
    /// What the task asks for: a certain class.
    pub confident: bool,
    /// What the task asks for: that no view can gain anything.
    pub exhausted: bool,
    /// What a run can end by, and which of it holds.
    pub because: Vec<Condition>,
}

/// The terms of eq. 8.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Terms {
    /// G_ovlp, 0 or 1.
    pub overlap: u8,
    /// G_fd, bits.
    pub feature: f64,
    /// G_so, voxels.
    pub surface: u64,
    /// W, 0 or 1.
    pub w: u8,
}

/// Milliseconds by phase of one measurement.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Milliseconds {
    /// Rendering, or waiting for the sensor.
    pub sense: f64,
    /// Detectors, measures, and what follows from them: statuses, predictions, inspection.
    pub detect: f64,
    /// Insertion into the map.
    pub map: f64,
    /// Scoring of the candidate views.
    pub score: f64,
}

/// The outcome of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct End {
    /// `goal`, `exhausted`, `contradiction` or `view_limit`.
    pub outcome: String,
    /// Measurements taken.
    pub views: u32,
    /// The winning class; none after a contradiction.
    pub class: Option<String>,
    /// Its posterior.
    pub confidence: f64,
    /// Share of the object's observable surface that was measured.
    pub coverage: Option<f64>,
    /// What contradicted the library.
    pub contradiction: Option<Contradiction>,
}

/// What contradicted the library.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Contradiction {
    /// The feature.
    pub feature: String,
    /// What was seen of it.
    pub evidence: String,
}

impl Record {
    /// The record as one line, without the line's end.
    pub fn to_line(&self) -> String {
        serde_json::to_string(self).unwrap_or_else(|error| unreachable!("a record is plain data: {error}"))
    }
}

impl View {
    /// A step of the closed loop.
    pub fn of(step: &Step, ms: Milliseconds) -> Self {
        let update = &step.update;
        Self {
            n: update.n as u32,
            view: update.view,
            pose: LoggedPose::from(&step.observation.world_from_camera),
            points: update.points,
            features: Ordered(
                update
                    .features
                    .iter()
                    .map(|f| (f.name.clone(), Feature::from(f)))
                    .collect(),
            ),
            classes: Ordered(update.classes.clone()),
            voxels: Voxels {
                unknown: update.voxels.unknown,
                free: update.voxels.free,
                occupied: update.voxels.occupied,
                preoccupied: update.voxels.preoccupied,
            },
            completion: Completion {
                confident: update.completion.confident,
                exhausted: update.completion.exhausted,
            },
            rules: Ordered(update.rules.clone()),
            absent: Ordered(update.absent.clone()),
            next: match &step.decision {
                Decision::Next(next) => Some(Next::from(next)),
                Decision::End(_) => None,
            },
            stop: match &step.decision {
                Decision::Next(_) => None,
                Decision::End(end) => Some(Stop {
                    outcome: end.outcome.name().to_owned(),
                    confident: end.goal.confident,
                    exhausted: end.goal.exhausted,
                    because: end.because.clone(),
                }),
            },
            ms,
        }
    }
}

impl End {
    /// The end of a run of `views` measurements.
    pub fn of(end: &plan::End, views: u32, coverage: Option<f64>) -> Self {
        let contradicted = end.outcome == Outcome::Contradiction;
        Self {
            outcome: end.outcome.name().to_owned(),
            views,
            class: end.class.clone().filter(|_| !contradicted),
            confidence: end.confidence,
            coverage,
            contradiction: end.contradiction.as_ref().map(|c| Contradiction {
                feature: c.feature.clone(),
                evidence: c.evidence.clone(),
            }),
        }
    }
}

impl From<&plan::FeatureReport> for Feature {
    fn from(report: &plan::FeatureReport) -> Self {
        let instance = |i: &plan::InstanceReport| Instance {
            key: i.key.clone(),
            state: i.state.code(),
            inspected: i.inspected,
            predicted_voxels: i.predicted_voxels,
            predicted_by: i.predicted_by.clone(),
            rule: i.rule.clone(),
        };
        Self {
            state: report.state.code(),
            predicted: report.predicted,
            weight: report.weight,
            instances: report.instances.iter().map(instance).collect(),
        }
    }
}

impl From<&plan::Next> for Next {
    fn from(next: &plan::Next) -> Self {
        Self {
            chosen: Standing::from(&next.chosen),
            relaxed: next.relaxed,
            runners_up: next.runners_up.iter().map(Standing::from).collect(),
        }
    }
}

impl From<&plan::Standing> for Standing {
    fn from(standing: &plan::Standing) -> Self {
        Self {
            view: standing.view,
            score: standing.score,
            terms: Terms {
                overlap: standing.terms.overlap.into(),
                feature: standing.terms.feature,
                surface: standing.terms.surface,
                w: standing.terms.w.into(),
            },
            share: standing.share,
            distance: Some(standing.distance),
            target: standing.target.as_ref().map(|t| Target {
                feature: t.feature.clone(),
                key: t.key.clone(),
                reached: t.reached,
                voxels: t.voxels,
            }),
        }
    }
}

impl From<&Pose> for LoggedPose {
    fn from(pose: &Pose) -> Self {
        let (t, q) = (&pose.translation.vector, &pose.rotation);
        Self {
            position: [t.x, t.y, t.z],
            rotation: [q.w, q.i, q.j, q.k],
        }
    }
}
