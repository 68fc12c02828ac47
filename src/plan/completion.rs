//! Completion status and how a run ends (eqs. 10 and 11, expected completion).

use super::knowledge::Knowledge;
use super::predictions::is_inspected;
use super::status::Status;
use crate::rules::Goal;

/// s_cmp = (s_cfd, s_ail).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Completion {
    /// A class has reached ξ_cfd, and with `verify` its predicted features are inspected.
    pub confident: bool,
    /// No unvisited view gains anything.
    pub exhausted: bool,
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The library cannot explain what was seen.
    Contradiction,
    /// What the task asked for.
    Goal,
    /// No view can gain anything, and the goal is not reached.
    Exhausted,
    /// The task's number of views is used up.
    ViewLimit,
}

impl Outcome {
    /// Its name in the run log.
    pub fn name(self) -> &'static str {
        match self {
            Self::Contradiction => "contradiction",
            Self::Goal => "goal",
            Self::Exhausted => "exhausted",
            Self::ViewLimit => "view_limit",
        }
    }
}

/// s_cfd (eq. 10): the likeliest class has reached ξ_cfd; with `verify: all`
/// only when every feature of it whose place is predicted has been inspected.
pub fn confident(status: &Status, knowledge: &Knowledge) -> bool {
    let (winner, probability) = likeliest(&status.posterior);
    let Some(class) = knowledge.library.classes.get(winner) else {
        return false;
    };
    let mut has = knowledge.library.feature_ids().filter(|id| class.presence.has(*id));
    let checked = |feature: &super::features::FeatureStatus| {
        !feature.is_predicted() || is_inspected(feature, knowledge.criteria.absent)
    };
    status.contradiction.is_none()
        && probability >= knowledge.task.thresholds.confidence
        && (!knowledge.task.verify || has.all(|id| checked(status.feature(id))))
}

/// The likeliest class, the first of equals, and its probability.
pub fn likeliest(posterior: &[f64]) -> (usize, f64) {
    let better = |best: (usize, f64), (m, p): (usize, &f64)| if *p > best.1 { (m, *p) } else { best };
    posterior.iter().enumerate().fold((0, 0.0), better)
}

/// Whether a run ends, and how. Where several hold: contradiction, goal,
/// exhausted, view limit.
pub fn outcome(completion: Completion, goal: Goal, contradicted: bool, views: usize, limit: u32) -> Option<Outcome> {
    let reached = (!goal.confident || completion.confident) && (!goal.exhausted || completion.exhausted);
    if contradicted {
        Some(Outcome::Contradiction)
    } else if reached {
        Some(Outcome::Goal)
    } else if completion.exhausted {
        Some(Outcome::Exhausted)
    } else {
        (views >= limit as usize).then_some(Outcome::ViewLimit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RECOGNISE: Goal = Goal {
        confident: true,
        exhausted: false,
    };
    const RECONSTRUCT: Goal = Goal {
        confident: false,
        exhausted: true,
    };

    fn end(confident: bool, exhausted: bool, goal: Goal, views: usize) -> Option<Outcome> {
        outcome(Completion { confident, exhausted }, goal, false, views, 20)
    }

    #[test]
    fn a_goal_of_0_does_not_care() {
        assert_eq!(end(true, false, RECOGNISE, 3), Some(Outcome::Goal));
        assert_eq!(end(true, false, RECONSTRUCT, 3), None);
        assert_eq!(end(false, true, RECONSTRUCT, 3), Some(Outcome::Goal));
        let both = Goal {
            confident: true,
            exhausted: true,
        };
        assert_eq!(end(true, false, both, 3), None);
        assert_eq!(end(true, true, both, 3), Some(Outcome::Goal));
    }

    #[test]
    fn contradiction_goes_before_goal_before_exhausted_before_the_limit() {
        assert_eq!(end(false, true, RECOGNISE, 20), Some(Outcome::Exhausted));
        assert_eq!(end(true, true, RECOGNISE, 20), Some(Outcome::Goal));
        assert_eq!(end(false, false, RECOGNISE, 20), Some(Outcome::ViewLimit));
        assert_eq!(end(false, false, RECOGNISE, 19), None);
        let all = Completion {
            confident: true,
            exhausted: true,
        };
        assert_eq!(outcome(all, RECOGNISE, true, 20, 20), Some(Outcome::Contradiction));
    }
}
