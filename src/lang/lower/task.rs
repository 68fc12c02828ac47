//! Tasks: values in SI units, and spans for the task checks.

use std::collections::BTreeMap;

use super::Lowering;
use super::expand::Env;
use crate::geometry::Vector;
use crate::lang::source::Span;
use crate::lang::types::typed;
use crate::primitives;
use crate::rules::{SensorModel, Space, Task, Thresholds, Value};

/// Share that the overlap constraint asks for where a task does not say.
const USUAL_OVERLAP: f64 = 0.2;
/// Most measurements where a task does not say: the paper's.
const USUAL_LIMIT: u32 = 20;
/// Gain floor where a task does not say, voxels.
const USUAL_GAIN_FLOOR: u32 = 5;

/// Where the values of a task stand.
#[derive(Clone, Debug, Default)]
pub(in crate::lang) struct TaskSpans {
    /// The task's line.
    pub head: Span,
    pub goal: Span,
    pub views: Span,
    pub voxel: Span,
    pub space: Span,
    pub limit: Span,
    pub overlap: Span,
    pub near: Span,
    pub absent: Span,
    pub confidence: Span,
    /// Fields of `sensor_model` that were given.
    pub sensor_model: BTreeMap<&'static str, Span>,
}

impl<'a> Lowering<'a> {
    pub(super) fn task(&mut self, task: &'a typed::Task) -> Option<(Task, TaskSpans)> {
        let camera = self.primitive(&task.camera, &Env::default());
        let views = self.primitive(&task.views, &Env::default());
        let space = self.space(task);
        let thresholds = self.thresholds(task);
        let overlap = self.share(task.overlap.as_ref(), USUAL_OVERLAP);
        let limit = self.count(task.limit.as_ref(), USUAL_LIMIT);
        let gain_floor = self.count(task.gain_floor.as_ref(), USUAL_GAIN_FLOOR);
        let sensor_model = self.sensor_model(&task.sensor_model);
        let lowered = Task {
            name: task.name.clone(),
            library: task.library.clone(),
            goal: task.goal,
            camera: primitives::camera(&camera?).ok()?,
            space: space?,
            views: views?,
            thresholds: thresholds?,
            overlap: overlap?,
            method: task.method.clone(),
            limit: limit?,
            gain_floor: gain_floor?,
            inspected: task.inspected,
            visibility: task.visibility,
            verify: task.verify,
            insertion: task.insertion,
            sensor_model: sensor_model?,
            place: self.place(task.span),
        };
        Some((lowered, spans(task)))
    }

    fn space(&mut self, task: &'a typed::Task) -> Option<Space> {
        let shape = self.primitive(&task.shape, &Env::default());
        let (centre, voxel) = (
            self.value(&task.at, &Env::default()),
            self.value(&task.voxel, &Env::default()),
        );
        let shape = shape?;
        let side = |name| shape.length(name).ok();
        let size = match side("edge") {
            Some(edge) => Vector::repeat(edge),
            None => Vector::new(side("x")?, side("y")?, side("z")?),
        };
        match (centre?, voxel?) {
            (Value::Point(centre), Value::Length(voxel)) => Some(Space { centre, size, voxel }),
            _ => None,
        }
    }

    fn thresholds(&mut self, task: &'a typed::Task) -> Option<Thresholds> {
        let (near, absent, confidence) = (
            self.value(&task.near, &Env::default()),
            self.value(&task.absent, &Env::default()),
            self.value(&task.confidence, &Env::default()),
        );
        match (near?, absent?, confidence?) {
            (Value::Length(near), Value::Share(absent), Value::Share(confidence)) => Some(Thresholds {
                near,
                absent,
                confidence,
            }),
            _ => None,
        }
    }

    fn share(&mut self, given: Option<&'a typed::Expr>, usual: f64) -> Option<f64> {
        match given.map(|e| self.value(e, &Env::default())) {
            None => Some(usual),
            Some(Some(Value::Share(share))) => Some(share),
            Some(_) => None,
        }
    }

    fn count(&mut self, given: Option<&'a typed::Expr>, usual: u32) -> Option<u32> {
        match given.map(|e| self.value(e, &Env::default())) {
            None => Some(usual),
            // More than any run can count is the same as all.
            Some(Some(Value::Count(n))) => Some(u32::try_from(n).unwrap_or(u32::MAX)),
            Some(_) => None,
        }
    }

    fn sensor_model(&mut self, given: &'a BTreeMap<&'static str, typed::Expr>) -> Option<SensorModel> {
        let usual = SensorModel::default();
        let mut read = |name: &str, usual: f64| self.share(given.get(name), usual);
        let (hit, miss) = (read("hit", usual.hit), read("miss", usual.miss));
        let clamps = (read("clamp_min", usual.clamp_min), read("clamp_max", usual.clamp_max));
        let occupied = read("occupied", usual.occupied);
        Some(SensorModel {
            hit: hit?,
            miss: miss?,
            clamp_min: clamps.0?,
            clamp_max: clamps.1?,
            occupied: occupied?,
        })
    }
}

fn spans(task: &typed::Task) -> TaskSpans {
    let or_head = |e: &Option<typed::Expr>| e.as_ref().map_or(task.span, |e| e.span);
    TaskSpans {
        head: task.span,
        goal: task.goal_span,
        views: task.views.span,
        voxel: task.voxel.span,
        space: task.shape.span,
        limit: or_head(&task.limit),
        overlap: or_head(&task.overlap),
        near: task.near.span,
        absent: task.absent.span,
        confidence: task.confidence.span,
        sensor_model: task.sensor_model.iter().map(|(name, e)| (*name, e.span)).collect(),
    }
}
