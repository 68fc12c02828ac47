//! `--resume`: a logged run is repeated view by view and then continued.
//!
//! The session is deterministic, so repeating the run restores it; the log says
//! whether it is the same run.

use std::fs;
use std::path::Path;

use crate::cli::Failure;
use crate::plan::Step;
use crate::show::log::{Run, Start};

/// The views of a logged run, in order.
///
/// # Errors
/// No log, another run, or one that began elsewhere.
pub(super) fn views(path: &Path, now: &Start, start: usize) -> Result<Vec<usize>, Failure> {
    let refuse = |why: String| Failure::Resume(format!("`{}`", path.display()), why);
    let bytes = fs::read(path).map_err(|error| refuse(error.to_string()))?;
    let run = Run::read(&bytes).map_err(|error| refuse(error.to_string()))?;
    if let Some(difference) = difference(&run.start, now) {
        return Err(refuse(difference));
    }
    let views: Vec<usize> = run.views.iter().map(|v| v.view).collect();
    match views.first() {
        Some(first) if *first != start => Err(refuse(format!(
            "it began at view {first}, and this run would at {start}; say `--start {first}`"
        ))),
        _ => Ok(views),
    }
}

/// What differs between two runs, for people.
fn difference(then: &Start, now: &Start) -> Option<String> {
    let pairs = [
        ("vpl", then.vpl.clone(), now.vpl.clone()),
        ("rule set", then.rules.clone(), now.rules.clone()),
        ("task", then.task.clone(), now.task.clone()),
        ("object", then.object.clone(), now.object.clone()),
        ("method", then.method.clone(), now.method.clone()),
        ("seed", then.seed.to_string(), now.seed.to_string()),
        ("noise", then.noise.clone(), now.noise.clone()),
        ("limit of views", then.limit.to_string(), now.limit.to_string()),
    ];
    let (what, then, now) = pairs.into_iter().find(|(_, a, b)| a != b)?;
    Some(format!(
        "it is of another run: its {what} is `{then}`, and this one's is `{now}`"
    ))
}

/// Whether a step took the view that the log has in its place.
pub(super) fn agrees(logged: &[usize], step: &Step) -> Result<(), Failure> {
    let taken = (step.update.n, step.update.view);
    match logged.get(taken.0 - 1) {
        Some(view) if *view != taken.1 => Err(Failure::Run(format!(
            "the logged run took view {view} as number {}, and this one view {}: the log was not written by this version",
            taken.0, taken.1
        ))),
        _ => Ok(()),
    }
}
