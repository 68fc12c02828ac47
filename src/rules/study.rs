//! Studies: many objects × methods × starts × noise × variants of one task.
//!
//! A study is no part of the artefact that a session reads; it holds one.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{Backdrop, Call, Inspected, RuleSet, SceneObject, Task};
use crate::geometry::Camera;

/// An experiment, whole: what is run does not depend on any other file but meshes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Study {
    /// Name.
    pub name: String,
    /// The program whose task is studied.
    pub rules: RuleSet,
    /// The name of the task.
    pub task: String,
    /// The objects, in the order of the suite.
    pub objects: Vec<Subject>,
    /// Methods, lower case; the first is the one that others are held against.
    pub methods: Vec<String>,
    /// Number of start views: indices ⌊k · count / starts⌋.
    pub starts: u32,
    /// How often a run that chance decides is repeated.
    pub seeds: u32,
    /// Noise models by name.
    pub noises: Vec<String>,
    /// Path of a table of published numbers.
    #[serde(skip)]
    pub published: Option<String>,
    /// Settings that are run; at least one.
    pub variants: Vec<Variant>,
}

/// An object of a study.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Subject {
    /// The object. Its pose counts for nothing where it is `centred`.
    pub object: SceneObject,
    /// What stands behind it.
    pub backdrop: Option<Backdrop>,
    /// Whether the middle of its box is brought to the centre of the space.
    pub centred: bool,
    /// The folder that its mesh file is relative to; empty, or with a `/` at its end.
    #[serde(skip)]
    pub folder: String,
}

/// A name and what it changes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Variant {
    /// Empty for the study's own settings.
    pub name: String,
    /// What is changed.
    pub settings: Settings,
}

/// Values that take the place of a task's; SI units.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// The sensor.
    pub camera: Option<Camera>,
    /// S_v.
    pub views: Option<Call>,
    /// Edge of a voxel, metres.
    pub voxel: Option<f64>,
    /// Shares of the overlap constraint.
    pub overlap: Option<f64>,
    /// Most measurements.
    pub limit: Option<u32>,
    /// Voxels.
    pub gain_floor: Option<u32>,
    /// How eq. 3 counts a voxel.
    pub inspected: Option<Inspected>,
    /// Whether every predicted feature of the winning class must be inspected.
    pub verify: bool,
    /// Fields of the thresholds by name: metres and shares.
    pub thresholds: BTreeMap<String, f64>,
    /// Fields of the sensor model by name.
    pub sensor_model: BTreeMap<String, f64>,
    /// The backdrop; `Some(None)` is empty air.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub backdrop: Option<Option<Backdrop>>,
}

impl Settings {
    /// These settings, and where they say nothing, others.
    pub fn or(mut self, other: &Self) -> Self {
        self.camera = self.camera.or(other.camera);
        self.views = self.views.or_else(|| other.views.clone());
        self.voxel = self.voxel.or(other.voxel);
        self.overlap = self.overlap.or(other.overlap);
        self.limit = self.limit.or(other.limit);
        self.gain_floor = self.gain_floor.or(other.gain_floor);
        self.inspected = self.inspected.or(other.inspected);
        self.verify |= other.verify;
        for (name, value) in &other.thresholds {
            self.thresholds.entry(name.clone()).or_insert(*value);
        }
        for (name, value) in &other.sensor_model {
            self.sensor_model.entry(name.clone()).or_insert(*value);
        }
        self.backdrop = self.backdrop.or(other.backdrop);
        self
    }

    /// Changes a task.
    pub fn apply(&self, task: &mut Task) {
        task.camera = self.camera.unwrap_or(task.camera);
        task.views = self.views.clone().unwrap_or_else(|| task.views.clone());
        task.space.voxel = self.voxel.unwrap_or(task.space.voxel);
        task.overlap = self.overlap.unwrap_or(task.overlap);
        task.limit = self.limit.unwrap_or(task.limit);
        task.gain_floor = self.gain_floor.unwrap_or(task.gain_floor);
        task.inspected = self.inspected.unwrap_or(task.inspected);
        task.verify |= self.verify;
        for (name, value) in &self.thresholds {
            match name.as_str() {
                "near" => task.thresholds.near = *value,
                "absent" => task.thresholds.absent = *value,
                _ => task.thresholds.confidence = *value,
            }
        }
        let model = &mut task.sensor_model;
        for (name, value) in &self.sensor_model {
            match name.as_str() {
                "hit" => model.hit = *value,
                "miss" => model.miss = *value,
                "clamp_min" => model.clamp_min = *value,
                "clamp_max" => model.clamp_max = *value,
                _ => model.occupied = *value,
            }
        }
    }
}
