//! One run in the simulator, and its row.

use super::bounds::{Decoded, Policy};
use super::design::{Design, Job};
use super::error::StudyError;
use super::row::{Row, rounded};
use super::stage::Stage;
use crate::geometry::Pose;
use crate::plan::{ClosedLoop, Decision, End, Existence, Options, Outcome, PlanError, Session, Simulated};

/// Makes a run of a method. `optimal` is what the best continuation is read from.
///
/// # Errors
/// The planner refuses the task or a measurement.
pub fn run(
    design: &Design,
    stage: &Stage,
    job: &Job,
    method: &str,
    optimal: Option<(&Policy, &Decoded)>,
) -> Result<Row, StudyError> {
    let failed = |source: PlanError| StudyError::Plan {
        what: format!(
            "method `{method}` on `{}`",
            design.study.objects[job.object].object.name
        ),
        source,
    };
    let made = drive(design, stage, job, method).map_err(failed)?;
    let variant = design.variant(job.arm);
    let limit = variant.task.limit;
    let recognition = variant.task.goal.confident;
    let reached = made.end.outcome == Outcome::Goal;
    // All methods of reconstruction share one stop; a run without it counts the limit.
    let views = if reached || recognition { made.views } else { limit };
    let mut row = blank(design, stage, job);
    row.outcome = made.end.outcome.name().to_owned();
    row.views = views;
    row.class = made.end.class;
    row.coverage = made
        .curve
        .last()
        .copied()
        .filter(|_| !stage.coverage.samples().is_empty());
    covered(&mut row, &made.curve, limit);
    row.path = rounded(path(&stage.views, &made.sequence));
    row.first = made.first;
    row.best_from_first = match (optimal, made.first) {
        (Some((policy, decoded)), Some(first)) => {
            let seen = &made.sequence[..first as usize];
            policy
                .best_after(decoded, seen, stage.truth.as_deref())
                .map(|rest| rounded(1.0 + rest))
        }
        _ => None,
    };
    row.curve = made.curve;
    row.sequence = made.sequence;
    Ok(row)
}

/// A row that says only which run it is of.
pub fn blank(design: &Design, stage: &Stage, job: &Job) -> Row {
    let arm = &design.arms[job.arm];
    Row {
        run: job.index,
        suite: design.study.name.clone(),
        object: design.study.objects[job.object].object.name.clone(),
        method: match &arm.kind {
            super::Kind::Method(name) => name.clone(),
            super::Kind::Bound => "bound".into(),
            super::Kind::Oracle => "oracle".into(),
        },
        variant: design.variant(job.arm).name.clone(),
        noise: arm.noise.name().to_owned(),
        start: job.start,
        seed: job.seed,
        outcome: String::new(),
        views: 0,
        class: None,
        truth: stage.truth.clone(),
        coverage: None,
        to95: None,
        to97: None,
        to99: None,
        area: None,
        path: 0.0,
        curve: Vec::new(),
        sequence: Vec::new(),
        first: None,
        best_from_first: None,
        expected: None,
        closed: None,
    }
}

/// What a curve of coverage says.
pub fn covered(row: &mut Row, curve: &[f64], limit: u32) {
    let to = |share: f64| curve.iter().position(|c| *c >= share - 1e-9).map(|k| k as u32 + 1);
    (row.to95, row.to97, row.to99) = (to(0.95), to(0.97), to(0.99));
    row.area = curve.last().map(|last| {
        let rest = (limit as usize).saturating_sub(curve.len()) as f64 * last;
        rounded((curve.iter().sum::<f64>() + rest) / f64::from(limit).max(curve.len() as f64))
    });
}

/// Straight from view to view, metres.
pub fn path(views: &[Pose], sequence: &[usize]) -> f64 {
    let eye = |view: usize| views[view].translation.vector;
    sequence.windows(2).map(|w| (eye(w[1]) - eye(w[0])).norm()).sum()
}

/// A run as it went.
struct Made {
    end: End,
    views: u32,
    curve: Vec<f64>,
    sequence: Vec<usize>,
    first: Option<u32>,
}

fn drive(design: &Design, stage: &Stage, job: &Job, method: &str) -> Result<Made, PlanError> {
    let (arm, variant) = (&design.arms[job.arm], design.variant(job.arm));
    let options = Options {
        method: Some(method.to_owned()),
        seed: job.seed,
        ..Options::default()
    };
    let mut session = Session::new(&variant.rules, &variant.task.name, options)?;
    let sensor = Simulated {
        simulator: &stage.simulator,
        camera: variant.task.camera,
        noise: arm.noise,
        seed: job.seed,
    };
    let mut coverage = stage.coverage.within(variant.task.thresholds.near);
    let mut turn = ClosedLoop::new(&mut session, sensor, job.start);
    let (mut curve, mut sequence, mut first) = (Vec::new(), Vec::new(), None);
    while let Some(step) = turn.step(&mut |_| {})? {
        coverage.observe(&step.observation);
        curve.push(rounded(coverage.share().unwrap_or(0.0)));
        sequence.push(step.update.view);
        let detected = step.update.features.iter().any(|f| f.state == Existence::Detected);
        first = first.or(detected.then_some(sequence.len() as u32));
        if let Decision::End(end) = step.decision {
            return Ok(Made {
                end,
                views: sequence.len() as u32,
                curve,
                sequence,
                first,
            });
        }
    }
    Err(PlanError::BadObservation("the run has no end"))
}
