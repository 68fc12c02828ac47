//! The closed loop: measure, take in, decide, move; until the run ends.
//!
//! Drives a [`Session`] with any sensor: the simulator, recorded frames, a
//! robot. It keeps no time; a caller that wants times is told when each part of
//! a step has ended.

use super::error::PlanError;
use super::report::{Decision, Update};
use super::session::{Phase, Session};
use crate::geometry::Pose;
use crate::sense::Observation;

/// Takes measurement number `n` (from 1) at candidate `view`.
pub trait Sensor {
    /// The measurement from a `world_from_camera` pose.
    ///
    /// # Errors
    /// [`PlanError::Sensor`] where there is none.
    fn measure(&mut self, n: u32, view: usize, world_from_camera: &Pose) -> Result<Observation, PlanError>;
}

/// The parts of a step, in the order in which they end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// The sensor has measured.
    Sense,
    /// The session has finished a phase.
    Session(Phase),
}

/// One turn of the loop.
#[derive(Debug)]
pub struct Step {
    /// What was measured.
    pub observation: Observation,
    /// What changed.
    pub update: Update,
    /// What to do now.
    pub decision: Decision,
}

/// A run in progress.
pub struct ClosedLoop<'a, S> {
    session: &'a mut Session,
    sensor: S,
    next: Option<usize>,
    n: u32,
}

impl<'a, S: Sensor> ClosedLoop<'a, S> {
    /// A loop that begins at candidate `start`.
    pub fn new(session: &'a mut Session, sensor: S, start: usize) -> Self {
        Self {
            session,
            sensor,
            next: Some(start),
            n: 0,
        }
    }

    /// The session that it drives.
    pub fn session(&self) -> &Session {
        self.session
    }

    /// The next turn; `None` once the run has ended.
    ///
    /// # Errors
    /// The sensor gives no measurement, or the session cannot use it.
    pub fn step(&mut self, ended: &mut dyn FnMut(Part)) -> Result<Option<Step>, PlanError> {
        let Some(view) = self.next else { return Ok(None) };
        let count = self.session.views().len();
        let pose = *self
            .session
            .views()
            .get(view)
            .ok_or(PlanError::NoSuchView { view, count })?;
        self.n += 1;
        let observation = self.sensor.measure(self.n, view, &pose)?;
        ended(Part::Sense);
        let update = self
            .session
            .observe_in_phases(view, &observation, &mut |phase| ended(Part::Session(phase)))?;
        let decision = self.session.next_view();
        self.next = match &decision {
            Decision::Next(next) => Some(next.chosen.view),
            Decision::End(_) => None,
        };
        Ok(Some(Step {
            observation,
            update,
            decision,
        }))
    }
}
