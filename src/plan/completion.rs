//! Completion status and how a run ends (eqs. 10 and 11, expected completion).

use super::features::FeatureStatus;
use super::knowledge::Knowledge;
use super::methods::Worth;
use super::predictions::is_inspected;
use super::score::Gains;
use super::status::Status;
use crate::detect::{Condition, Unit};
use crate::rules::{Class, Goal};

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
    let contradicted = status.contradiction.is_some() || knowledge.library.classes.is_empty();
    !contradicted && confidence(status, knowledge).iter().all(|c| c.holds)
}

/// The conditions of s_cfd, for the likeliest class.
fn confidence(status: &Status, knowledge: &Knowledge) -> Vec<Condition> {
    let (winner, probability) = likeliest(&status.posterior);
    let class = knowledge.library.classes.get(winner);
    let probability = if status.contradiction.is_some() {
        0.0
    } else {
        probability
    };
    let least = knowledge.task.thresholds.confidence;
    let certain = Condition::at_least("confident", Unit::Share, probability, least);
    let mut conditions = vec![certain.of(class.map(|c| c.name.clone()))];
    if let Some(class) = class.filter(|_| knowledge.task.verify) {
        conditions.push(verified(class, status, knowledge));
    }
    conditions
}

/// Whether every predicted feature of a class has been inspected.
fn verified(class: &Class, status: &Status, knowledge: &Knowledge) -> Condition {
    let checked = |feature: &FeatureStatus| !feature.is_predicted() || is_inspected(feature, knowledge.criteria.absent);
    let mut has = knowledge.library.feature_ids().filter(|id| class.presence.has(*id));
    let open = has.find(|id| !checked(status.feature(*id)));
    let name = open.map(|id| knowledge.library.feature(id).name.clone());
    Condition::plain("verified", open.is_none()).of(name)
}

/// Everything that a run can end by, and which of it holds.
///
/// `worth` is the method's own measure of what is left to gain, where it has one.
pub fn because(
    status: &Status,
    knowledge: &Knowledge,
    gains: &Gains,
    worth: Option<Worth>,
    limit: u32,
) -> Vec<Condition> {
    let library = &knowledge.library;
    let contradicted = status
        .contradiction
        .as_ref()
        .map(|c| library.feature(c.feature).name.clone());
    let mut conditions = vec![Condition::plain("contradiction", contradicted.is_some()).of(contradicted)];
    conditions.extend(confidence(status, knowledge));
    conditions.extend(worth.map_or_else(|| exhaustion(knowledge, gains), |w| vec![too_little(w)]));
    let views = status.visited.len() as f64;
    conditions.push(Condition::at_least("view limit", Unit::Count, views, f64::from(limit)));
    conditions
}

/// No view is expected to show enough new surface.
fn too_little(worth: Worth) -> Condition {
    let bounds = (None, Some(worth.least));
    Condition::quantity("new surface", Unit::Voxels, worth.most, bounds, worth.exhausted())
}

/// The conditions of s_ail (eq. 11): what the unvisited views come nearest to
/// gaining does not count. The surface matters only where no feature gains.
fn exhaustion(knowledge: &Knowledge, gains: &Gains) -> Vec<Condition> {
    let most = f64::from(knowledge.task.gain_floor.max(1) - 1);
    let mut conditions = vec![no_feature_gains(most, knowledge, gains)];
    if gains.w {
        let nothing = gains.surface.iter().all(|n| *n == 0);
        let bounds = (None, Some(most));
        let found = gains.most_surface as f64;
        conditions.push(Condition::quantity(
            "surface gain",
            Unit::Voxels,
            found,
            bounds,
            nothing,
        ));
    }
    conditions
}

/// `most` voxels of a feature do not count yet; nor do more of one that must be
/// seen whole, where a view does not show enough of it.
fn no_feature_gains(most: f64, knowledge: &Knowledge, gains: &Gains) -> Condition {
    let counted = gains.feature.iter().filter_map(|g| g.target.as_ref());
    let target = counted.max_by_key(|t| t.reached).or(gains.most_uncounted());
    let reached = target.map_or(0.0, |t| t.reached as f64);
    let condition = match target {
        Some(t) if gains.w && reached > most => {
            let bounds = (None, Some(knowledge.criteria.absent));
            let share = reached / t.voxels as f64;
            Condition::quantity("feature seen whole", Unit::Share, share, bounds, true)
        }
        _ => Condition::quantity("feature gain", Unit::Voxels, reached, (None, Some(most)), gains.w),
    };
    condition.of(target.map(|t| knowledge.library.feature(t.feature).name.clone()))
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
