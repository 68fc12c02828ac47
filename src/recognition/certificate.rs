//! The fewest feature outcomes that make a class certain.
//!
//! Covering by as few sets as possible is hard in general; small libraries are solved
//! exactly by deepening one outcome at a time, larger ones as far as the budget goes.

use super::{Budget, ClassSet, Recognition};
use crate::rules::FeatureId;

/// Outcomes that make a class certain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Certificate {
    /// Features and whether they are found, in the library's order.
    pub outcomes: Vec<(FeatureId, bool)>,
    /// No certificate has fewer outcomes than this.
    pub at_least: usize,
}

impl Certificate {
    /// Whether no shorter one exists.
    pub fn is_shortest(&self) -> bool {
        self.outcomes.len() == self.at_least
    }
}

/// A look and the classes that it excludes.
type Look = (FeatureId, ClassSet);

impl Recognition {
    /// The shortest certificate of a class; `None` where it can never be certain, or
    /// where the budget ends before one is found.
    pub fn certificate(&self, class: usize, budget: &mut Budget) -> Option<Certificate> {
        let looks = self.looks(class);
        let search = Search {
            recognition: self,
            class,
            looks: &looks,
        };
        let mut chosen = search.greedy(budget)?;
        let mut at_least = chosen.len();
        for k in 0..chosen.len() {
            match search.within(self.all(), ClassSet::none(self.classes()), k, budget) {
                None => {
                    at_least = k;
                    break;
                }
                Some(Some(found)) => {
                    (at_least, chosen) = (k, found);
                    break;
                }
                Some(None) => {}
            }
        }
        chosen.sort_unstable();
        let outcome = |f: FeatureId| (f, self.has[f.index()].contains(class));
        Some(Certificate {
            outcomes: chosen.into_iter().map(outcome).collect(),
            at_least,
        })
    }

    /// Looks that exclude something, the first of those that exclude the same.
    fn looks(&self, class: usize) -> Vec<Look> {
        let mut looks: Vec<Look> = Vec::new();
        let mut seen = std::collections::BTreeSet::new();
        for feature in (0..self.has.len() as u32).map(FeatureId) {
            let Some(excluded) = self.excluded(feature, class) else {
                continue;
            };
            if !excluded.is_empty() && seen.insert(excluded.clone()) {
                looks.push((feature, excluded));
            }
        }
        looks
    }
}

struct Search<'a> {
    recognition: &'a Recognition,
    class: usize,
    looks: &'a [Look],
}

impl Search<'_> {
    fn is_done(&self, left: &ClassSet) -> bool {
        self.recognition.share(self.class, left) >= self.recognition.confidence
    }

    /// A certificate by always taking the look that excludes most.
    fn greedy(&self, budget: &mut Budget) -> Option<Vec<FeatureId>> {
        let mut left = self.recognition.all();
        let mut chosen = Vec::new();
        while !self.is_done(&left) {
            budget.take(self.looks.len() * self.recognition.work(&left) + 1)?;
            let best = self
                .looks
                .iter()
                .map(|(f, excluded)| (self.recognition.common_mass(&left, excluded), *f, excluded))
                .reduce(|best, next| if next.0 > best.0 { next } else { best })?;
            if best.0 <= 0.0 {
                return None;
            }
            left = left.without(best.2);
            chosen.push(best.1);
        }
        Some(chosen)
    }

    /// `k` looks at most that make the class certain, if there are; `None` where the
    /// budget ends. The classes of `kept` are not to be excluded.
    fn within(&self, left: ClassSet, kept: ClassSet, k: usize, budget: &mut Budget) -> Option<Option<Vec<FeatureId>>> {
        if self.is_done(&left) {
            return Some(Some(Vec::new()));
        }
        budget.take(self.looks.len() * self.recognition.work(&left) + 1)?;
        if k == 0 || self.is_hopeless(&left, k) || !self.bears(&kept) {
            return Some(None);
        }
        let Some((rival, looks)) = self.rival(&left, &kept) else {
            return Some(None);
        };
        for (feature, excluded) in looks {
            if let Some(mut chosen) = self.within(left.without(excluded), kept.clone(), k - 1, budget)? {
                chosen.push(*feature);
                return Some(Some(chosen));
            }
        }
        let mut kept = kept;
        kept.insert(rival);
        self.within(left, kept, k, budget)
    }

    /// Whether `k` looks, each as good as the best one, exclude too little.
    fn is_hopeless(&self, left: &ClassSet, k: usize) -> bool {
        let r = self.recognition;
        let best = self.looks.iter().map(|(_, excluded)| r.common_mass(left, excluded));
        let best = best.fold(0.0, f64::max);
        let least = r.mass(left) - k as f64 * best;
        // With a margin, for sums are rounded.
        r.priors[self.class] < (least - 1e-9) * r.confidence
    }

    /// Whether the class can be certain beside those that are kept.
    fn bears(&self, kept: &ClassSet) -> bool {
        let mut left = kept.clone();
        left.insert(self.class);
        self.is_done(&left)
    }

    /// The rival that the fewest looks exclude, with those looks.
    fn rival(&self, left: &ClassSet, kept: &ClassSet) -> Option<(usize, Vec<&Look>)> {
        let rivals = left.iter().filter(|r| *r != self.class && !kept.contains(*r));
        let looks = |rival: usize| -> Vec<&Look> { self.looks.iter().filter(|(_, e)| e.contains(rival)).collect() };
        rivals.map(|r| (r, looks(r))).min_by_key(|(_, looks)| looks.len())
    }
}
