//! The least number of views from a start that cover a share of the samples: exact, by
//! branch and bound, with the Lagrangian bound of the maximum coverage problem.
//!
//! With k more views at most max Σ_s y_s, y_s ≤ Σ_{v ∋ s} x_v, Σ x = k can be covered.
//! Relaxing the first constraints with 0 ≤ λ_s ≤ 1 leaves Σ_s (1 − λ_s) plus the k
//! largest Σ_{s ∈ v} λ_s, which subgradient steps bring down (Fisher 1981).

use std::collections::BTreeMap;

/// Steps of the subgradient method at the root and at other nodes.
const STEPS: (usize, usize) = (150, 12);
/// Most nodes of a search; then the bound stays open.
const MOST_NODES: usize = 1_500;

/// What each view shows of the samples.
#[derive(Clone, Debug)]
pub struct Sight {
    /// By view: which groups of samples it shows. A group is seen by the same views.
    groups: Vec<Vec<u32>>,
    /// By group: its samples.
    weights: Vec<u32>,
    samples: u32,
}

/// The least number of views.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Least {
    /// No fewer do, the start included.
    pub views: u32,
    /// Whether as many are known to do.
    pub closed: bool,
    /// The views found, the start first; none where the search was given up.
    pub chosen: Vec<usize>,
}

impl Sight {
    /// `seen[v][s]`: view v shows sample s.
    pub fn new(seen: &[Vec<bool>]) -> Self {
        let samples = seen.first().map_or(0, Vec::len);
        let mut known: BTreeMap<Vec<u64>, u32> = BTreeMap::new();
        for s in 0..samples {
            let signature = seen.chunks(64).map(|views| {
                let bits = views.iter().enumerate();
                bits.fold(0_u64, |word, (k, view)| word | u64::from(view[s]) << k)
            });
            *known.entry(signature.collect()).or_default() += 1;
        }
        let shows = |view: usize| {
            let with = known.keys().enumerate();
            with.filter(|(_, words)| words[view / 64] >> (view % 64) & 1 == 1)
                .map(|(group, _)| group as u32)
                .collect()
        };
        Self {
            groups: (0..seen.len()).map(shows).collect(),
            weights: known.values().copied().collect(),
            samples: samples as u32,
        }
    }

    /// Samples that make up a share.
    fn needed(&self, share: f64) -> u32 {
        (share * f64::from(self.samples) - 1e-9).ceil().max(0.0) as u32
    }

    /// The least views from a start; `None` where all views together do not reach it.
    pub fn least(&self, start: usize, share: f64) -> Option<Least> {
        let needed = self.needed(share);
        let mut all = vec![false; self.weights.len()];
        (0..self.groups.len()).for_each(|view| self.cover(view, &mut all));
        if self.covered(&all) < needed {
            return None;
        }
        let mut first = vec![false; self.weights.len()];
        self.cover(start, &mut first);
        let open: Vec<usize> = (0..self.groups.len()).filter(|view| *view != start).collect();
        let mut search = Search {
            sight: self,
            needed,
            nodes: MOST_NODES,
        };
        for more in 0..=open.len() {
            let mut multipliers = vec![0.5; self.weights.len()];
            if search.bound(&first, &open, more, &mut multipliers, STEPS.0) < f64::from(needed) {
                continue;
            }
            match search.extend(&first, &open, more, &multipliers) {
                Found::Views(mut chosen) => {
                    chosen.push(start);
                    chosen.reverse();
                    return Some(Least {
                        views: more as u32 + 1,
                        closed: true,
                        chosen,
                    });
                }
                Found::None => {}
                Found::GivenUp => {
                    return Some(Least {
                        views: more as u32 + 1,
                        closed: false,
                        chosen: Vec::new(),
                    });
                }
            }
        }
        None
    }

    /// From a start always the view that shows most that is new: the views, and the
    /// share that is covered after each. Ends where nothing is new.
    pub fn greedy(&self, start: usize, most: usize) -> (Vec<usize>, Vec<f64>) {
        let mut covered = vec![false; self.weights.len()];
        let (mut views, mut shares) = (Vec::new(), Vec::new());
        let mut next = Some(start);
        while let Some(view) = next.filter(|_| views.len() < most) {
            self.cover(view, &mut covered);
            views.push(view);
            shares.push(f64::from(self.covered(&covered)) / f64::from(self.samples.max(1)));
            let gains = (0..self.groups.len()).map(|v| (self.gain(v, &covered), std::cmp::Reverse(v)));
            next = gains.max().filter(|(gain, _)| *gain > 0).map(|(_, view)| view.0);
        }
        (views, shares)
    }

    fn cover(&self, view: usize, covered: &mut [bool]) {
        self.groups[view].iter().for_each(|g| covered[*g as usize] = true);
    }

    fn covered(&self, covered: &[bool]) -> u32 {
        let both = covered.iter().zip(&self.weights);
        both.map(|(c, w)| if *c { *w } else { 0 }).sum()
    }

    fn gain(&self, view: usize, covered: &[bool]) -> u32 {
        let groups = self.groups[view].iter().map(|g| *g as usize);
        groups.map(|g| if covered[g] { 0 } else { self.weights[g] }).sum()
    }
}

struct Search<'a> {
    sight: &'a Sight,
    needed: u32,
    nodes: usize,
}

enum Found {
    /// In reverse.
    Views(Vec<usize>),
    None,
    GivenUp,
}

impl Search<'_> {
    /// At most `more` views out of `open` that bring `covered` up to what is needed.
    fn extend(&mut self, covered: &[bool], open: &[usize], more: usize, multipliers: &[f64]) -> Found {
        if self.sight.covered(covered) >= self.needed {
            return Found::Views(Vec::new());
        }
        if more == 0 {
            return Found::None;
        }
        let mut gains: Vec<(u32, usize)> = open.iter().map(|v| (self.sight.gain(*v, covered), *v)).collect();
        gains.sort_by_key(|(gain, v)| (std::cmp::Reverse(*gain), *v));
        let missing = self.needed - self.sight.covered(covered);
        let mut multipliers = multipliers.to_vec();
        for k in 0..gains.len() {
            let best: u32 = gains[k..].iter().take(more).map(|g| g.0).sum();
            if best < missing {
                return Found::None;
            }
            let rest: Vec<usize> = gains[k..].iter().map(|g| g.1).collect();
            if more > 1 && self.bound(covered, &rest, more, &mut multipliers, STEPS.1) < f64::from(self.needed) {
                return Found::None;
            }
            match self.nodes.checked_sub(1) {
                Some(left) => self.nodes = left,
                None => return Found::GivenUp,
            }
            let view = gains[k].1;
            let mut with = covered.to_vec();
            self.sight.cover(view, &mut with);
            match self.extend(&with, &rest[1..], more - 1, &multipliers) {
                Found::Views(mut chosen) => {
                    chosen.push(view);
                    return Found::Views(chosen);
                }
                Found::None => {}
                Found::GivenUp => return Found::GivenUp,
            }
        }
        Found::None
    }

    /// No `more` views out of `open` cover more samples than this, with those that are.
    fn bound(&self, covered: &[bool], open: &[usize], more: usize, multipliers: &mut [f64], steps: usize) -> f64 {
        let sight = self.sight;
        let had = f64::from(sight.covered(covered));
        let mut shown = vec![false; covered.len()];
        open.iter().for_each(|v| sight.cover(*v, &mut shown));
        let free: Vec<usize> = (0..covered.len()).filter(|g| shown[*g] && !covered[*g]).collect();
        let mut least = f64::INFINITY;
        for _ in 0..steps {
            let value = |v: &usize| {
                let groups = sight.groups[*v].iter().map(|g| *g as usize).filter(|g| !covered[*g]);
                groups
                    .map(|g| multipliers[g] * f64::from(sight.weights[g]))
                    .sum::<f64>()
            };
            let mut values: Vec<(f64, usize)> = open.iter().map(|v| (value(v), *v)).collect();
            values.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            values.truncate(more);
            let slack = free
                .iter()
                .map(|g| (1.0 - multipliers[*g]) * f64::from(sight.weights[*g]));
            let bound = had + slack.sum::<f64>() + values.iter().map(|v| v.0).sum::<f64>();
            // A sample's worth of room for rounding: samples are whole.
            least = least.min(bound + 1e-6);
            if least < f64::from(self.needed) {
                break;
            }
            let mut times = vec![0_i32; covered.len()];
            for (_, v) in &values {
                sight.groups[*v].iter().for_each(|g| times[*g as usize] += 1);
            }
            let steepness: f64 = free
                .iter()
                .map(|g| (f64::from(times[*g] - 1) * f64::from(sight.weights[*g])).powi(2))
                .sum();
            if steepness <= 0.0 {
                break;
            }
            let step = (bound - f64::from(self.needed) + 1.0) / steepness;
            for g in &free {
                let down = step * f64::from(times[*g] - 1) * f64::from(sight.weights[*g]);
                multipliers[*g] = (multipliers[*g] - down).clamp(0.0, 1.0);
            }
        }
        least
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sense::least_views;
    use proptest::prelude::*;

    fn rows(sets: &[&[usize]], n: usize) -> Vec<Vec<bool>> {
        sets.iter().map(|s| (0..n).map(|k| s.contains(&k)).collect()).collect()
    }

    #[test]
    fn the_greedy_choice_is_not_always_in_the_least_cover() {
        let sight = Sight::new(&rows(&[&[], &[0, 1, 2, 3], &[0, 1, 4], &[2, 3, 5]], 6));
        let least = sight.least(0, 1.0).unwrap();
        assert_eq!((least.views, least.closed, least.chosen), (3, true, vec![0, 2, 3]));
        assert_eq!(sight.least(1, 1.0).unwrap().views, 3);
        assert_eq!(sight.least(1, 0.6).unwrap().chosen, [1]);
        let (views, shares) = sight.greedy(0, 20);
        assert_eq!(views, [0, 1, 2, 3]);
        assert_eq!(shares, [0.0, 4.0 / 6.0, 5.0 / 6.0, 1.0]);
    }

    #[test]
    fn what_no_view_shows_cannot_be_covered() {
        let sight = Sight::new(&rows(&[&[0], &[]], 2));
        assert_eq!(sight.least(1, 1.0), None);
        assert_eq!(sight.least(1, 0.5).unwrap().views, 2);
    }

    proptest! {
        /// With a start that shows nothing, one more than the least cover without a start.
        #[test]
        fn agrees_with_the_plain_search(
            mut seen in prop::collection::vec(prop::collection::vec(any::<bool>(), 24), 2..9),
            share in 0.1_f64..1.0,
        ) {
            seen[0] = vec![false; 24];
            let plain = least_views(&seen, share).map(|v| v.len() as u32 + 1);
            let least = Sight::new(&seen).least(0, share);
            prop_assert_eq!(least.as_ref().map(|l| l.views), plain);
            prop_assert!(least.is_none_or(|l| l.closed && l.chosen.len() as u32 == l.views));
        }
    }
}
