//! The best expected number of features to look for, over all decision trees.
//!
//! Exact dynamic programming over the sets of classes that are left, each solved once;
//! sets that an entropy bound rules out are left alone. Where the budget ends, bounds.

use std::collections::BTreeMap;

use super::{Budget, ClassSet, Recognition};

/// Most classes of a library that is solved exactly: a tree is at most as deep.
const MOST_CLASSES: usize = 256;

/// The expected number of features to look for until some class is certain, with the
/// priors as weights and the best order of looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tests {
    /// No order has fewer, and one has as many.
    Exact(f64),
    /// The library is too large to be solved exactly.
    Between {
        /// No order has fewer than this.
        least: f64,
        /// Some order has as many as this, where one was found.
        most: Option<f64>,
    },
    /// No order of looks makes a class certain on every object.
    Endless,
}

impl Recognition {
    /// The best expected number of features to look for.
    pub fn tests(&self, budget: &mut Budget) -> Tests {
        let mut trees = Trees {
            recognition: self,
            looks: self.splits(),
            solved: BTreeMap::new(),
            budget,
        };
        let all = self.all();
        if self.classes() <= MOST_CLASSES {
            match trees.best(&all) {
                Some(cost) if cost.is_finite() => return Tests::Exact(cost),
                Some(_) => return Tests::Endless,
                None => {}
            }
        }
        trees.solved.clear();
        let mut some = Budget(GREEDY);
        trees.budget = &mut some;
        Tests::Between {
            least: self.at_least(&all),
            most: trees.greedy(&all),
        }
    }

    /// The ways in which a look splits the classes, each once: who has the feature, and
    /// on whose objects the look comes to an end.
    fn splits(&self) -> Vec<(&ClassSet, &ClassSet)> {
        let mut seen = std::collections::BTreeSet::new();
        let all = self.all();
        let both = self.has.iter().zip(&self.settled);
        both.filter(|(has, settled)| {
            let other = all.without(has);
            let useful = !has.is_empty() && !other.is_empty();
            useful && seen.insert((other.min((*has).clone()), (*settled).clone()))
        })
        .collect()
    }

    /// A lower bound: looks are yes-or-no questions, so their number is at least the
    /// information that they give about the class.
    fn at_least(&self, left: &ClassSet) -> f64 {
        if self.is_certain(left) {
            return 0.0;
        }
        let mass = self.mass(left);
        let own: f64 = left.iter().map(|m| times_log(self.priors[m])).sum();
        (times_log(mass) - own - mass * self.most_doubt(left)).max(mass)
    }

    /// The most entropy that a certain class leaves among the others (Fano).
    fn most_doubt(&self, left: &ClassSet) -> f64 {
        let (doubt, n) = (1.0 - self.confidence, left.len() as f64);
        let prior = |m: usize| self.priors[m];
        let least = left.iter().map(prior).fold(f64::INFINITY, f64::min);
        let most = left.iter().map(prior).fold(0.0, f64::max);
        if least * self.confidence > most * doubt * (1.0 + 1e-9) {
            // Nothing can stay beside a certain class.
            0.0
        } else if doubt >= 1.0 - 1.0 / n {
            n.log2()
        } else {
            -times_log(doubt) - times_log(1.0 - doubt) + doubt * (n - 1.0).log2()
        }
    }
}

/// Steps that the search for some tree may take.
const GREEDY: u64 = 3_000_000;

/// x · log₂ x, which is 0 at 0.
fn times_log(x: f64) -> f64 {
    if x > 0.0 { x * x.log2() } else { 0.0 }
}

struct Trees<'a, 'b> {
    recognition: &'a Recognition,
    looks: Vec<(&'a ClassSet, &'a ClassSet)>,
    /// Mass times looks, by the classes that are left.
    solved: BTreeMap<ClassSet, f64>,
    budget: &'b mut Budget,
}

impl Trees<'_, '_> {
    /// Mass times looks of the best tree, infinite where none ends; `None` where the
    /// budget does.
    fn best(&mut self, left: &ClassSet) -> Option<f64> {
        if self.recognition.is_certain(left) {
            return Some(0.0);
        }
        if let Some(cost) = self.solved.get(left) {
            return Some(*cost);
        }
        let mass = self.recognition.mass(left);
        let mut best = f64::INFINITY;
        for (bound, with, without) in self.promising(left)? {
            // Bounds ascend; the margin is for the rounding of sums.
            if bound >= best - 1e-12 {
                break;
            }
            let with_cost = self.best(&with)?;
            if mass + with_cost + self.recognition.at_least(&without) < best - 1e-12 {
                best = best.min(mass + with_cost + self.best(&without)?);
            }
        }
        self.solved.insert(left.clone(), best);
        Some(best)
    }

    /// The splits of a set, the most promising first, with a lower bound of each.
    fn promising(&mut self, left: &ClassSet) -> Option<Vec<(f64, ClassSet, ClassSet)>> {
        self.budget.take((self.looks.len() + 1) * (left.len() + 1))?;
        let r = self.recognition;
        let mass = r.mass(left);
        let mut seen = std::collections::BTreeSet::new();
        let mut splits = Vec::new();
        for (has, settled) in &self.looks {
            let (with, without) = (left.and(has), left.without(has));
            if left.is_within(settled) && !with.is_empty() && !without.is_empty() && seen.insert(with.clone()) {
                splits.push((mass + r.at_least(&with) + r.at_least(&without), with, without));
            }
        }
        splits.sort_by(|a, b| a.0.total_cmp(&b.0));
        Some(splits)
    }

    /// Looks of some good tree: always the most even split; `None` where it does not
    /// end, or the budget does.
    fn greedy(&mut self, all: &ClassSet) -> Option<f64> {
        let r = self.recognition;
        let mut cost = 0.0;
        let mut open = vec![all.clone()];
        while let Some(left) = open.pop() {
            if r.is_certain(&left) {
                continue;
            }
            self.budget.take((self.looks.len() + 1) * (left.len() + 1))?;
            let mass = r.mass(&left);
            let uneven = |with: &ClassSet| (2.0 * r.common_mass(with, &left) - mass).abs();
            let splits = self.looks.iter().filter(|(_, settled)| left.is_within(settled));
            let splits = splits
                .map(|(has, _)| left.and(has))
                .filter(|with| !with.is_empty() && *with != left);
            let with = splits.map(|w| (uneven(&w), w)).min_by(|a, b| a.0.total_cmp(&b.0))?.1;
            cost += r.mass(&left);
            open.push(left.without(&with));
            open.push(with);
        }
        Some(cost)
    }
}
