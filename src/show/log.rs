//! The run log: JSON Lines, one object a line, as `docs/cli.md` describes.
//!
//! Plain records with a fixed key order. What they say comes from the
//! session's updates and decisions; writing them is the caller's job.

use serde::{Deserialize, Serialize};

use crate::geometry::Pose;
use crate::plan::{self, Decision, Outcome, Session, Step};

/// A map whose entries keep the library's order.
#[derive(Clone, Debug, PartialEq)]
pub struct Ordered<T>(pub Vec<(String, T)>);

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
    /// Most measurements.
    pub limit: u32,
    /// Number of candidate views.
    pub candidates: usize,
    /// SHA-256 of the compiled rule set.
    pub rules: String,
    /// Weight of each feature before anything is seen, bits.
    pub weights: Ordered<f64>,
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
    /// The next best view; `None` exactly at the last view.
    pub next: Option<Next>,
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
    /// Ids of the rules that predict it, the one that counts first.
    pub predicted_by: Vec<String>,
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
    /// Index of the candidate view.
    pub view: usize,
    /// Eq. 8.
    pub score: f64,
    /// What the score is made of.
    pub terms: Terms,
    /// Whether no view with gain met the overlap constraint.
    pub relaxed: bool,
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

    /// Reads one line.
    ///
    /// # Errors
    /// It is no record of a run log.
    pub fn from_line(line: &str) -> Result<Self, serde_json::Error> {
        serde_json::from_str(line)
    }
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
            limit: session.limit(),
            candidates: session.views().len(),
            rules,
            weights: Ordered(features.zip(session.weights()).collect()),
        }
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
            next: match &step.decision {
                Decision::Next(next) => Some(Next::from(next)),
                Decision::End(_) => None,
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
            view: next.view,
            score: next.score,
            terms: Terms {
                overlap: next.terms.overlap.into(),
                feature: next.terms.feature,
                surface: next.terms.surface,
                w: next.terms.w.into(),
            },
            relaxed: next.relaxed,
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

impl<T: Serialize> Serialize for Ordered<T> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(k, v)| (k, v)))
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Ordered<T> {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Entries<T>(std::marker::PhantomData<T>);
        impl<'de, T: Deserialize<'de>> serde::de::Visitor<'de> for Entries<T> {
            type Value = Ordered<T>;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<A: serde::de::MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
                let mut entries = Vec::new();
                while let Some(entry) = map.next_entry()? {
                    entries.push(entry);
                }
                Ok(Ordered(entries))
            }
        }
        deserializer.deserialize_map(Entries(std::marker::PhantomData))
    }
}
