//! All runs of a study that are not done yet, side by side.

use std::collections::BTreeMap;
use std::sync::Mutex;

use rayon::prelude::*;

use super::bounds::{Decoded, Policy, Sight};
use super::design::{Design, Job, Kind};
use super::error::StudyError;
use super::row::{Row, rounded};
use super::run;
use super::stage::Stage;

/// A part of the runs: every `of`-th, from the `number`-th on. Both count from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Which.
    pub number: u64,
    /// Out of how many.
    pub of: u64,
}

impl Shard {
    /// Everything.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// Whether a run is in it.
    pub fn has(self, job: &Job) -> bool {
        job.index % self.of == self.number - 1
    }
}

/// Makes the runs for which `due` holds, and gives each row to `done` as it comes, in any
/// order. Objects follow each other; the runs of one are side by side.
///
/// # Errors
/// The first that a run or `done` gives.
pub fn execute(
    design: &Design,
    due: impl Fn(&Job) -> bool,
    done: impl FnMut(Row) -> Result<(), StudyError> + Send,
) -> Result<(), StudyError> {
    let done = Mutex::new(done);
    let mut groups: BTreeMap<(usize, usize), Vec<&Job>> = BTreeMap::new();
    for job in design.jobs.iter().filter(|job| due(job)) {
        let key = (job.object, design.arms[job.arm].variant);
        groups.entry(key).or_default().push(job);
    }
    for ((object, variant), jobs) in groups {
        let group = Group::new(design, object, variant, &jobs)?;
        jobs.par_iter().try_for_each(|job| {
            let row = group.row(job)?;
            let mut done = done.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            (*done)(row)
        })?;
    }
    Ok(())
}

/// What the runs of an object under a variant share.
struct Group<'a> {
    design: &'a Design,
    stage: Stage,
    sight: Option<Sight>,
    optimal: Option<(Policy, Decoded)>,
}

impl<'a> Group<'a> {
    fn new(design: &'a Design, object: usize, variant: usize, jobs: &[&Job]) -> Result<Self, StudyError> {
        let changed = &design.variants[variant];
        let stage = Stage::new(&design.study, object, changed)?;
        let bounds = jobs
            .iter()
            .any(|job| !matches!(design.arms[job.arm].kind, Kind::Method(_)));
        let recognition = changed.task.goal.confident;
        let sight = (bounds && !recognition).then(|| stage.sight(changed));
        let optimal = if recognition {
            optimal(design, object, variant)?
        } else {
            None
        };
        Ok(Self {
            design,
            stage,
            sight,
            optimal,
        })
    }

    fn row(&self, job: &Job) -> Result<Row, StudyError> {
        let arm = &self.design.arms[job.arm];
        let optimal = self.optimal.as_ref();
        match (&arm.kind, &self.sight) {
            (Kind::Method(method), _) => {
                let optimal = optimal.map(|(policy, decoded)| (policy, decoded));
                run::run(self.design, &self.stage, job, method, optimal)
            }
            (Kind::Bound, Some(sight)) => Ok(self.cover(job, sight)),
            (Kind::Oracle, Some(sight)) => Ok(self.oracle(job, sight)),
            (Kind::Bound | Kind::Oracle, None) => Ok(self.policy(job)),
        }
    }

    /// The least views from the start; it stops where 97 % are covered.
    fn cover(&self, job: &Job, sight: &Sight) -> Row {
        let mut row = run::blank(self.design, &self.stage, job);
        let limit = self.design.variant(job.arm).task.limit;
        // More than the limit allows is never, as for methods.
        let least = |share| sight.least(job.start, share).filter(|l| l.views <= limit);
        let least = [0.95, 0.97, 0.99].map(least);
        let views = |k: usize| least[k].as_ref().map(|l| l.views);
        (row.to95, row.to97, row.to99) = (views(0), views(1), views(2));
        row.closed = Some(least.iter().flatten().all(|l| l.closed));
        row.sequence = least[1].as_ref().map_or(Vec::new(), |l| l.chosen.clone());
        row.path = rounded(run::path(&self.stage.views, &row.sequence));
        row.views = row.to97.unwrap_or(limit);
        row.outcome = if row.to97.is_some() { "bound" } else { "view_limit" }.into();
        row
    }

    /// Greedy, the shape being known; stops where 97 % are covered.
    fn oracle(&self, job: &Job, sight: &Sight) -> Row {
        let mut row = run::blank(self.design, &self.stage, job);
        let limit = self.design.variant(job.arm).task.limit;
        let (sequence, curve) = sight.greedy(job.start, limit as usize);
        let curve: Vec<f64> = curve.into_iter().map(rounded).collect();
        run::covered(&mut row, &curve, limit);
        row.views = row.to97.unwrap_or(limit);
        row.outcome = if row.to97.is_some() { "oracle" } else { "view_limit" }.into();
        let taken = (row.views as usize).min(sequence.len());
        row.path = rounded(run::path(&self.stage.views, &sequence[..taken]));
        row.coverage = taken.checked_sub(1).map(|last| curve[last]);
        (row.sequence, row.curve) = (sequence, curve);
        row
    }

    /// The best policy of recognition.
    fn policy(&self, job: &Job) -> Row {
        let mut row = run::blank(self.design, &self.stage, job);
        row.outcome = "none".into();
        let (Some((policy, decoded)), Some(truth)) = (&self.optimal, &self.stage.truth) else {
            return row;
        };
        let mut policy = policy.clone();
        let expected = policy.expected_from(decoded, job.start);
        let Some(sequence) = policy
            .views_of(decoded, job.start, truth)
            .filter(|_| expected.is_finite())
        else {
            return row;
        };
        row.outcome = "bound".into();
        row.views = sequence.len() as u32;
        row.class = Some(truth.clone());
        row.path = rounded(run::path(&self.stage.views, &sequence));
        row.expected = Some(rounded(expected));
        row.closed = Some(policy.is_closed());
        row.sequence = sequence;
        row
    }
}

fn optimal(design: &Design, object: usize, variant: usize) -> Result<Option<(Policy, Decoded)>, StudyError> {
    let changed = &design.variants[variant];
    let Some(decoded) = Stage::decoded(&design.study, object, changed)? else {
        return Ok(None);
    };
    let library = changed.rules.library(&changed.task);
    let policy = library.and_then(|l| Policy::new(l, changed.task.thresholds.confidence, &decoded));
    Ok(policy.map(|policy| (policy, decoded)))
}
