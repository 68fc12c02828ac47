//! What the runs of one object under one variant have in common.

use std::path::Path;

use rayon::prelude::*;

use super::bounds::{Decoded, Sight};
use super::design::Variant;
use super::error::StudyError;
use super::truth::truth;
use crate::geometry::{Point, Pose};
use crate::plan::{Options, Session};
use crate::rules::{Marker, SceneObject, Study};
use crate::sense::{Coverage, Noise, Simulator};

/// An object in the simulator, and what of it can be observed.
pub struct Stage {
    /// What is shown.
    pub simulator: Simulator,
    /// Nothing covered yet.
    pub coverage: Coverage,
    /// Candidate views.
    pub views: Vec<Pose>,
    /// The class that the object is of.
    pub truth: Option<String>,
}

impl Stage {
    /// Shows an object of a study.
    ///
    /// # Errors
    /// It cannot be shown, or does not fit the space.
    pub fn new(study: &Study, object: usize, variant: &Variant) -> Result<Self, StudyError> {
        let subject = &study.objects[object];
        let simulator = simulator(study, object, variant, &subject.object)?;
        let session = Session::new(&variant.rules, &variant.task.name, Options::default());
        let session = session.map_err(|source| StudyError::Plan {
            what: format!("task `{}`", variant.task.name),
            source,
        })?;
        let views = session.views().to_vec();
        fits(&simulator, &subject.object.name, &views)?;
        let task = &variant.task;
        let coverage = Coverage::new(&simulator, &task.camera, &views, task.thresholds.near);
        let library = variant.rules.library(task);
        Ok(Self {
            simulator,
            coverage,
            views,
            truth: library.and_then(|library| truth(library, &subject.object)),
        })
    }

    /// Which samples each candidate view shows, without noise.
    pub fn sight(&self, variant: &Variant) -> Sight {
        let near = variant.task.thresholds.near;
        let seen = |pose: &Pose| {
            let mut one = self.coverage.within(near);
            one.observe(&self.simulator.observe(&variant.task.camera, pose, Noise::None, 0, 1));
            one.seen().to_vec()
        };
        Sight::new(&self.views.par_iter().map(seen).collect::<Vec<_>>())
    }

    /// Which markers each candidate view decodes, were all that any object bears on
    /// this one. `None` where they would not fit on it.
    ///
    /// # Errors
    /// A view cannot be taken in.
    pub fn decoded(study: &Study, object: usize, variant: &Variant) -> Result<Option<Decoded>, StudyError> {
        let Some(markers) = all_markers(study) else {
            return Ok(None);
        };
        let full = SceneObject {
            markers,
            ..study.objects[object].object.clone()
        };
        let Ok(simulator) = simulator(study, object, variant, &full) else {
            return Ok(None);
        };
        let decoded = Decoded::new(&simulator, variant);
        decoded.map_err(|source| StudyError::Plan {
            what: format!("object `{}`", full.name),
            source,
        })
    }
}

fn simulator(study: &Study, object: usize, variant: &Variant, shown: &SceneObject) -> Result<Simulator, StudyError> {
    let subject = &study.objects[object];
    let backdrop = variant.backdrop.unwrap_or(subject.backdrop);
    let base = if subject.folder.is_empty() {
        "."
    } else {
        &subject.folder
    };
    let failed = |source| StudyError::Object {
        object: shown.name.clone(),
        source,
    };
    let space = &variant.task.space;
    let simulator = Simulator::new(shown, backdrop, space, Path::new(base)).map_err(failed)?;
    if !subject.centred {
        return Ok(simulator);
    }
    let shift = space.centre - simulator.bounds().centre();
    let moved = Pose::translation(shift.x, shift.y, shift.z);
    Ok(Simulator::from_mesh(simulator.mesh().clone(), moved, backdrop, space))
}

/// Every marker of the program's and the study's objects; `None` where there are none,
/// or two of one text stand in different places.
fn all_markers(study: &Study) -> Option<Vec<Marker>> {
    let mut all: Vec<Marker> = Vec::new();
    let scenes = study.rules.scenes.iter().flat_map(|s| &s.objects);
    let objects = scenes.chain(study.objects.iter().map(|s| &s.object));
    for marker in objects.flat_map(|o| &o.markers) {
        match all.iter().find(|known| known.text == marker.text) {
            Some(known) if known != marker => return None,
            Some(_) => {}
            None => all.push(marker.clone()),
        }
    }
    (!all.is_empty()).then_some(all)
}

fn fits(simulator: &Simulator, object: &str, views: &[Pose]) -> Result<(), StudyError> {
    let unfit = |reason: String| StudyError::Unfit {
        object: object.to_owned(),
        reason,
    };
    let (bounds, space) = (simulator.bounds(), simulator.space().bounds());
    let (extent, room) = (bounds.size().max(), space.size().min());
    if (0..3).any(|k| bounds.max[k] < space.min[k] || space.max[k] < bounds.min[k]) {
        return Err(unfit("stands outside the space of the task".into()));
    }
    if !(extent <= 2.0 * room && extent >= 3.0 * simulator.space().voxel) {
        let reason = format!("is {extent:.4} m across, which does not fit the space of {room:.4} m: in other units?");
        return Err(unfit(reason));
    }
    let eye = |pose: &Pose| Point::from(pose.translation.vector);
    match views.iter().position(|pose| simulator.contains(&eye(pose))) {
        Some(view) => Err(unfit(format!("holds view {view} of the task inside of it"))),
        None => Ok(()),
    }
}
