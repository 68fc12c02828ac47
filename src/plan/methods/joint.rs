//! Joint: the expected drop of the class entropy over the joint outcome of a view.
//!
//! Eq. 9 values a view by its single best feature. A view that shows three of
//! them answers three questions, and two that always go together answer one: what
//! counts is how the joint outcome parts the classes that are still possible.
//! Presence is a function of the class, so the expected drop is the entropy of
//! that partition. A look that shows a share q of what is left of a feature's
//! place is taken to settle it with probability q, independently of the others.
//!
//! `joint2` looks one view further. It values a view by the class entropy over the
//! views that are expected to be rid of it, the view itself included: an outcome that
//! leaves H bits, of which the best next view is expected to take d, costs H / d more
//! views, at least one. Features that a look settles with at least even odds count as
//! settled there.
//!
//! Where the goal asks for no class, or no view can tell classes apart, the new surface
//! that a view is expected to show decides (`prospect`); `joint2` adds what the best view
//! after it would still show, for the few most promising ones. Where no class is asked
//! for, the run is exhausted when no view is expected to show as much as the gain floor,
//! by what is predicted and what must be.

use rand_pcg::Pcg64;
use rayon::prelude::*;

use super::prospect::{Expected, Prospect};
use super::{Choice, Method, Situation, Worth};
use crate::plan::features::Existence;
use crate::plan::{completion, score};
use crate::rules::FeatureId;

pub(super) struct Joint;
pub(super) struct Joint2;

impl Method for Joint {
    fn name(&self) -> &'static str {
        "joint"
    }

    fn choose(&self, situation: &Situation<'_>, _: &mut Pcg64) -> Option<Choice> {
        if !asks_for_class(situation) {
            return by_surface(situation, 1);
        }
        let looks = looks(situation);
        let posterior = &situation.status.posterior;
        let value = |look: &Look| expected_drop(situation, posterior, look);
        or_surface(situation, looks.iter().map(value).collect(), 1)
    }
}

impl Method for Joint2 {
    fn name(&self) -> &'static str {
        "joint2"
    }

    fn choose(&self, situation: &Situation<'_>, _: &mut Pcg64) -> Option<Choice> {
        if !asks_for_class(situation) {
            return by_surface(situation, 2);
        }
        let looks = looks(situation);
        let likely: Vec<Look> = looks.iter().map(Look::likely).collect();
        let posterior = &situation.status.posterior;
        let now = partition_entropy(&singles(posterior));
        let value = |(look, sure): (&Look, &Look)| {
            if expected_drop(situation, posterior, look) <= 0.0 {
                return 0.0;
            }
            let parts = parts(situation, posterior, &sure.features());
            let later = parts.iter().map(|part| {
                let best = likely.iter().map(|next| expected_drop(situation, part, next));
                part.iter().sum::<f64>() * views_left(part, best.fold(0.0, f64::max))
            });
            now / (1.0 + later.sum::<f64>())
        };
        let values = looks.par_iter().zip(&likely).map(value).collect();
        or_surface(situation, values, 2)
    }
}

/// Whether a class is still to be found.
fn asks_for_class(situation: &Situation<'_>) -> bool {
    situation.knowledge.task.goal.confident && !completion::confident(situation.status, situation.knowledge)
}

/// The view of largest value; by new surface where all values are 0. What is worth a
/// view is left to eq. 11, for the class is not known yet.
fn or_surface(situation: &Situation<'_>, values: Vec<f64>, ahead: usize) -> Option<Choice> {
    if values.iter().any(|value| *value > 0.0) {
        return situation.largest(&values);
    }
    let choice = by_surface(situation, ahead)?;
    Some(Choice { worth: None, ..choice })
}

/// Views of which the next one is looked at as well.
const PROMISING: usize = 8;

/// The view that is expected to show most new surface, the best view after it included
/// where `ahead` is 2.
fn by_surface(situation: &Situation<'_>, ahead: usize) -> Option<Choice> {
    let prospect = Prospect::of(situation);
    let expected = prospect.of_views(situation);
    let mut values: Vec<f64> = expected.iter().map(|e| e.all).collect();
    if ahead > 1 {
        look_ahead(situation, &prospect, &mut values);
    }
    let most = expected.iter().map(|e| e.firm).fold(0.0, f64::max);
    let least = f64::from(situation.knowledge.task.gain_floor.max(1));
    let choice = situation.largest(&values)?;
    Some(Choice {
        worth: Some(Worth { most, least }),
        ..choice
    })
}

/// Adds to the most promising views what the best one after each would show; the
/// others are no longer considered.
fn look_ahead(situation: &Situation<'_>, prospect: &Prospect, values: &mut [f64]) {
    let viewpoint = |k: usize| &situation.candidates[situation.gains.views[k]];
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*b].total_cmp(&values[*a]).then(a.cmp(b)));
    order.truncate(PROMISING);
    let with_next = |first: &usize| {
        let left = prospect.after(viewpoint(*first));
        let next = (0..values.len()).filter(|k| k != first);
        let shown = next.map(|k| prospect.of_view(viewpoint(k), &left, |_, _| {}));
        (
            *first,
            values[*first] + shown.map(|e: Expected| e.all).fold(0.0, f64::max),
        )
    };
    let totals: Vec<(usize, f64)> = order.par_iter().map(with_next).collect();
    values.fill(0.0);
    for (first, total) in totals {
        values[first] = total;
    }
}

/// What a view would tell: features, and how likely its look settles each.
#[derive(Clone, Debug, Default)]
struct Look(Vec<(FeatureId, f64)>);

/// Most features that are settled by chance and enter a joint outcome: their
/// subsets are summed over.
const MOST_BY_CHANCE: usize = 6;

impl Look {
    /// What it settles with at least even odds, as if it were sure.
    fn likely(&self) -> Self {
        let likely = self.0.iter().filter(|(_, chance)| *chance >= 0.5);
        Self(likely.map(|(id, _)| (*id, 1.0)).collect())
    }

    fn features(&self) -> Vec<FeatureId> {
        self.0.iter().map(|(id, _)| *id).collect()
    }
}

/// The look of every unvisited view.
fn looks(situation: &Situation<'_>) -> Vec<Look> {
    let positions = (0..situation.gains.views.len()).into_par_iter();
    positions.map(|position| look(situation, position)).collect()
}

fn look(situation: &Situation<'_>, position: usize) -> Look {
    let (status, knowledge, seen) = (situation.status, situation.knowledge, situation.look(position));
    let open = |id: &FeatureId| status.feature(*id).state == Existence::Unknown && status.weights[id.index()] > 0.0;
    let chance = |id: FeatureId| {
        let instances = status.feature(id).predicted.values();
        let shares = instances.map(|predicted| {
            let left = predicted.inspected.iter().filter(|done| !**done).count();
            let n = score::reachable_count(&seen, predicted, knowledge);
            n as f64 / left.max(1) as f64
        });
        (id, shares.fold(0.0, f64::max))
    };
    let settled = knowledge.library.feature_ids().filter(open).map(chance);
    Look(settled.filter(|(_, chance)| *chance > 0.0).collect())
}

/// Expected drop of the class entropy, bits, under probabilities that need not
/// sum to 1.
fn expected_drop(situation: &Situation<'_>, posterior: &[f64], look: &Look) -> f64 {
    let enough = situation.knowledge.criteria.absent;
    let (certain, mut open): (Vec<_>, Vec<_>) = look.0.iter().partition(|(_, chance)| *chance >= enough);
    open.sort_by(|a: &(FeatureId, f64), b| b.1.total_cmp(&a.1));
    open.truncate(MOST_BY_CHANCE);
    let mut drop = 0.0;
    for subset in 0..1_usize << open.len() {
        let is_in = |k: &usize| subset >> k & 1 == 1;
        let odds = |k: usize| if is_in(&k) { open[k].1 } else { 1.0 - open[k].1 };
        let chance: f64 = (0..open.len()).map(odds).product();
        let settled = (0..open.len()).filter(is_in).map(|k| open[k].0);
        let settled: Vec<FeatureId> = certain.iter().map(|(id, _)| *id).chain(settled).collect();
        drop += chance * partition_entropy(&parts(situation, posterior, &settled));
    }
    drop
}

/// Expected number of views until the classes of a part are told apart, where the
/// best next one takes `drop` bits. What no view is known to tell costs a view a bit.
fn views_left(part: &[f64], drop: f64) -> f64 {
    let left = partition_entropy(&singles(part));
    if left <= 0.0 {
        0.0
    } else if drop <= 0.0 {
        1.0 + left
    } else {
        (left / drop).max(1.0)
    }
}

/// Every possible class a part of its own.
fn singles(posterior: &[f64]) -> Vec<Vec<f64>> {
    posterior.iter().filter(|p| **p > 0.0).map(|p| vec![*p]).collect()
}

/// The posterior by the presence of some features, a part an outcome.
fn parts(situation: &Situation<'_>, posterior: &[f64], settled: &[FeatureId]) -> Vec<Vec<f64>> {
    let classes = &situation.knowledge.library.classes;
    let mut parts: Vec<Vec<f64>> = vec![posterior.to_vec()];
    for id in settled {
        let split = |part: Vec<f64>| {
            let side = |has: bool| {
                let kept = part.iter().zip(classes);
                kept.map(|(p, class)| if class.presence.has(*id) == has { *p } else { 0.0 })
                    .collect::<Vec<f64>>()
            };
            [side(true), side(false)]
        };
        parts = parts.into_iter().flat_map(split).collect();
        parts.retain(|part| part.iter().any(|p| *p > 0.0));
    }
    parts
}

/// Entropy of which part it is, bits.
fn partition_entropy(parts: &[Vec<f64>]) -> f64 {
    let masses: Vec<f64> = parts.iter().map(|part| part.iter().sum()).collect();
    let total: f64 = masses.iter().sum();
    let term = |mass: &f64| -(mass / total) * (mass / total).log2();
    if masses.len() < 2 {
        0.0
    } else {
        masses.iter().map(term).sum()
    }
}
