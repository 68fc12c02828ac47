//! Where a run's measurements come from: the simulator or recorded frames.

use super::record::Recorder;
use super::recorded::{self, Recorded};
use super::resume;
use super::stage::{self, Stage};
use super::{Plan, refuse};
use crate::cli::{Failure, Outcome};
use crate::geometry::{Camera, Pose};
use crate::lang::{Compilation, Diagnostic};
use crate::plan::{self, ClosedLoop, Decision, Part, Sensor, Session};
use crate::rules::{RuleSet, Task};
use crate::sense::{Coverage, Noise};

/// Where measurements come from.
pub(super) enum Source {
    /// The simulator with its object.
    Simulated(Box<Stage>),
    /// Frames that were taken.
    Recorded(Box<Recorded>),
}

impl Source {
    /// Of the options; a program that cannot be shown is refused. A task whose
    /// frames are recorded is given their camera.
    pub fn set(
        options: &Plan,
        compiled: &Compilation,
        rules: &RuleSet,
        task: &mut Task,
    ) -> Result<Result<Self, Outcome>, Failure> {
        if let Some(path) = &options.frames {
            let mut recorded = recorded::open(path, options)?;
            recorded.equip(task)?;
            recorded.warn(task)?;
            return Ok(Ok(Self::Recorded(Box::new(recorded))));
        }
        if let Some(option) = options.recording.first_set() {
            return Err(Failure::Usage(format!(
                "`{option}` is for recorded frames; name them with `--frames`"
            )));
        }
        match stage::set(options, compiled, rules, task)? {
            Ok(stage) => Ok(Ok(Self::Simulated(Box::new(stage)))),
            Err(diagnostic) => refuse(compiled, diagnostic).map(Err),
        }
    }

    /// What is seen, for the log.
    pub fn name(&self) -> String {
        match self {
            Self::Simulated(stage) => stage.name.clone(),
            Self::Recorded(recorded) => recorded.name(),
        }
    }

    /// The candidate views in place of the task's.
    pub fn views(&self) -> Option<Vec<(Camera, Pose)>> {
        match self {
            Self::Simulated(_) => None,
            Self::Recorded(recorded) => Some(recorded.views()),
        }
    }

    /// The views that stand inside the simulated object, as a diagnostic.
    pub fn views_inside(&self, session: &Session) -> Option<Diagnostic> {
        match self {
            Self::Simulated(stage) => stage::views_inside(stage, session),
            Self::Recorded(_) => None,
        }
    }

    /// Runs the loop to its end, a record and a line a view.
    pub fn drive(&self, session: &mut Session, start: usize, drive: Drive) -> Result<plan::Outcome, Failure> {
        let task = session.task().clone();
        match self {
            Self::Recorded(recorded) => looped(session, recorded.sensor(), None, start, drive),
            Self::Simulated(stage) => {
                drive
                    .recorder
                    .preparing(&format!("working out what can be seen of {}", stage.name));
                let coverage = Coverage::new(&stage.simulator, &task.camera, session.views(), task.thresholds.near);
                let sensor = stage.sensor(task.camera, drive.noise, drive.seed);
                looped(session, sensor, Some(coverage), start, drive)
            }
        }
    }
}

/// What a run is driven with.
pub(super) struct Drive<'a> {
    pub noise: Noise,
    pub seed: u64,
    /// Views of a run that is repeated.
    pub logged: &'a [usize],
    pub recorder: &'a mut Recorder,
}

fn looped(
    session: &mut Session,
    sensor: impl Sensor,
    mut coverage: Option<Coverage>,
    start: usize,
    drive: Drive,
) -> Result<plan::Outcome, Failure> {
    let recorder = drive.recorder;
    let mut turn = ClosedLoop::new(session, sensor, start);
    loop {
        recorder.begin_view();
        let step = turn
            .step(&mut |part: Part| recorder.lap(part))
            .map_err(|e| Failure::Run(e.to_string()))?;
        let Some(step) = step else {
            return Err(Failure::Run("the run has no end".into()));
        };
        if let Some(coverage) = &mut coverage {
            coverage.observe(&step.observation);
        }
        recorder.view(turn.session(), &step)?;
        resume::agrees(drive.logged, &step)?;
        if let Decision::End(end) = &step.decision {
            recorder.end(end, coverage.and_then(|c| c.share()))?;
            return Ok(end.outcome);
        }
    }
}
