//! The best adaptive policy of recognition: exact dynamic programming.
//!
//! Layout and pose are known, and which markers each view decodes: so what is left to
//! find out is the class, and what a view says is which of its markers the object bears.
//! Looking twice says nothing new; the state is the set of classes that are left.

use std::collections::BTreeMap;

use super::Decoded;
use crate::rules::Library;

/// Most classes: a bit each.
const MOST_CLASSES: usize = 64;
/// Most sets of classes that are solved.
const MOST_STATES: usize = 200_000;

/// The best policy for one object's layout and pose.
#[derive(Clone, Debug)]
pub struct Policy {
    names: Vec<String>,
    priors: Vec<f64>,
    confidence: f64,
    /// By feature: the classes that have it.
    has: Vec<u64>,
    /// What the views decode, each set of features once, with a view that decodes it.
    looks: Vec<(Vec<bool>, usize)>,
    /// By the classes that are left: measurements that are still due, weighted by the
    /// priors, and the look that is best.
    solved: BTreeMap<u64, (f64, usize)>,
    closed: bool,
}

impl Policy {
    /// Solves every state that can come up. `None` for more than 64 classes.
    pub fn new(library: &Library, confidence: f64, decoded: &Decoded) -> Option<Self> {
        if library.classes.len() > MOST_CLASSES || library.classes.is_empty() {
            return None;
        }
        let has = library.feature_ids().map(|id| {
            let with = library.classes.iter().enumerate().filter(|(_, c)| c.presence.has(id));
            with.fold(0_u64, |set, (k, _)| set | 1 << k)
        });
        let mut looks: Vec<(Vec<bool>, usize)> = Vec::new();
        for (view, found) in decoded.found.iter().enumerate() {
            if !looks.iter().any(|(known, _)| known == found) {
                looks.push((found.clone(), view));
            }
        }
        let mut policy = Self {
            names: library.classes.iter().map(|c| c.name.clone()).collect(),
            priors: library.classes.iter().map(|c| c.prior).collect(),
            confidence,
            has: has.collect(),
            looks,
            solved: BTreeMap::new(),
            closed: true,
        };
        let all = policy.all();
        policy.solve(all);
        Some(policy)
    }

    /// Whether every state was solved exactly.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// The best expected number of measurements from a first view on, itself included,
    /// over all classes; infinite where some class can never be certain.
    pub fn expected_from(&mut self, decoded: &Decoded, start: usize) -> f64 {
        let all = self.all();
        let look = decoded.found[start].clone();
        let parts = self.parts(all, &look);
        let rest: f64 = parts.iter().map(|part| self.solve(*part)).sum();
        1.0 + rest / self.mass(all)
    }

    /// The views that the policy takes on an object of a class, the first given.
    /// `None` where some class that is left never becomes certain.
    pub fn views_of(&mut self, decoded: &Decoded, start: usize, class: &str) -> Option<Vec<usize>> {
        let class = self.names.iter().position(|name| name == class)?;
        let mut left = self.after(self.all(), &decoded.found[start], class);
        let mut views = vec![start];
        while !self.is_certain(left) {
            if !self.solve(left).is_finite() {
                return None;
            }
            let (_, best) = *self.solved.get(&left)?;
            let (look, view) = self.looks.get(best)?.clone();
            left = self.after(left, &look, class);
            views.push(view);
        }
        Some(views)
    }

    /// The best expected number of further measurements after some views of an object.
    pub fn best_after(&self, decoded: &Decoded, seen: &[usize], class: Option<&str>) -> Option<f64> {
        let class = self.names.iter().position(|name| Some(name.as_str()) == class)?;
        let left = (seen.iter()).fold(self.all(), |left, view| self.after(left, &decoded.found[*view], class));
        if self.is_certain(left) {
            return Some(0.0);
        }
        let cost = match self.solved.get(&left) {
            Some((cost, _)) => *cost,
            None => self.clone_without_states().solve(left),
        };
        let rest = cost / self.mass(left);
        rest.is_finite().then_some(rest)
    }

    fn clone_without_states(&self) -> Self {
        Self {
            solved: BTreeMap::new(),
            names: self.names.clone(),
            priors: self.priors.clone(),
            has: self.has.clone(),
            looks: self.looks.clone(),
            ..*self
        }
    }

    fn all(&self) -> u64 {
        match self.names.len() {
            MOST_CLASSES => u64::MAX,
            n => (1 << n) - 1,
        }
    }

    fn mass(&self, left: u64) -> f64 {
        members(left).map(|k| self.priors[k]).sum()
    }

    fn is_certain(&self, left: u64) -> bool {
        let mass = self.mass(left);
        members(left).any(|k| self.priors[k] >= self.confidence * mass)
    }

    /// The classes that are left on an object of a class after a look.
    fn after(&self, left: u64, look: &[bool], class: usize) -> u64 {
        let shown = self.has.iter().zip(look).filter(|(_, shown)| **shown);
        shown.fold(
            left,
            |left, (has, _)| {
                if has >> class & 1 == 1 { left & has } else { left & !has }
            },
        )
    }

    /// How a look splits the classes that are left.
    fn parts(&self, left: u64, look: &[bool]) -> Vec<u64> {
        let mut parts = vec![left];
        for (has, _) in self.has.iter().zip(look).filter(|(_, shown)| **shown) {
            let split = parts.iter().flat_map(|part| [part & has, part & !has]);
            parts = split.filter(|part| *part != 0).collect();
        }
        parts
    }

    /// Measurements due, weighted by priors, where some classes are left.
    fn solve(&mut self, left: u64) -> f64 {
        if self.is_certain(left) {
            return 0.0;
        }
        if let Some((cost, _)) = self.solved.get(&left) {
            return *cost;
        }
        let mut splits: Vec<(usize, Vec<u64>)> = (0..self.looks.len())
            .map(|k| (k, self.parts(left, &self.looks[k].0)))
            .filter(|(_, parts)| parts.len() > 1)
            .collect();
        // Good looks first: with a bound at hand the others are soon given up.
        splits.sort_by_key(|(k, parts)| (std::cmp::Reverse(parts.len()), *k));
        splits.dedup_by(|a, b| a.1 == b.1);
        if self.solved.len() >= MOST_STATES {
            self.closed = false;
            splits.truncate(1);
        }
        let mass = self.mass(left);
        let mut best = (f64::INFINITY, usize::MAX);
        for (k, parts) in splits {
            // Every part that is not certain takes a look at least.
            let unsure = |part: &u64| if self.is_certain(*part) { 0.0 } else { self.mass(*part) };
            let mut bound = mass + parts.iter().map(unsure).sum::<f64>();
            let mut cost = mass;
            for part in &parts {
                if bound >= best.0 - 1e-12 {
                    break;
                }
                let least = if self.is_certain(*part) { 0.0 } else { self.mass(*part) };
                let exact = self.solve(*part);
                bound += exact - least;
                cost += exact;
            }
            if bound < best.0 - 1e-12 {
                best = (cost, k);
            }
        }
        self.solved.insert(left, best);
        best.0
    }
}

fn members(set: u64) -> impl Iterator<Item = usize> {
    (0..MOST_CLASSES).filter(move |k| set >> k & 1 == 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::{Class, Feature, FeatureKind, Presence};

    /// Classes by rows of presences.
    fn library(rows: &[&[u8]]) -> Library {
        let features = (0..rows[0].len()).map(|k| Feature {
            name: format!("code[{k}]"),
            kind: FeatureKind::Marker,
            many: false,
            place: Default::default(),
        });
        let class = |(k, row): (usize, &&[u8])| Class {
            name: format!("c{k}"),
            prior: 1.0 / rows.len() as f64,
            presence: Presence(row.iter().map(|cell| *cell == 1).collect()),
            place: Default::default(),
        };
        Library {
            name: "l".into(),
            features: features.collect(),
            classes: rows.iter().enumerate().map(class).collect(),
            rules: Vec::new(),
            place: Default::default(),
        }
    }

    fn decoded(views: &[&[u8]]) -> Decoded {
        Decoded {
            found: views
                .iter()
                .map(|v| v.iter().map(|cell| *cell == 1).collect())
                .collect(),
        }
    }

    #[test]
    fn four_classes_of_two_codes_by_hand() {
        let library = library(&[&[0, 0], &[0, 1], &[1, 0], &[1, 1]]);
        let one_each = decoded(&[&[1, 0], &[0, 1], &[0, 0]]);
        let mut policy = Policy::new(&library, 0.99, &one_each).unwrap();
        assert!(policy.is_closed());
        assert_eq!(policy.expected_from(&one_each, 0), 2.0);
        assert_eq!(policy.expected_from(&one_each, 2), 3.0);
        assert_eq!(policy.views_of(&one_each, 2, "c3").unwrap().len(), 3);
        assert_eq!(policy.best_after(&one_each, &[2, 0], Some("c1")), Some(1.0));
        let both = decoded(&[&[1, 0], &[1, 1]]);
        let mut policy = Policy::new(&library, 0.99, &both).unwrap();
        assert_eq!(policy.expected_from(&both, 1), 1.0);
        assert_eq!(policy.expected_from(&both, 0), 2.0);
    }

    #[test]
    fn what_no_view_decodes_is_never_certain() {
        let library = library(&[&[0, 0], &[0, 1], &[1, 0]]);
        let first_only = decoded(&[&[1, 0], &[0, 0]]);
        let mut policy = Policy::new(&library, 0.99, &first_only).unwrap();
        assert_eq!(policy.expected_from(&first_only, 0), f64::INFINITY);
        assert_eq!(policy.views_of(&first_only, 0, "c1"), None);
        // The class itself is told at once, but no policy ends on all of them.
        assert_eq!(policy.views_of(&first_only, 0, "c2").unwrap(), [0]);
        assert_eq!(policy.views_of(&first_only, 1, "c2"), None);
    }

    /// Adaptive: the second look depends on what the first one said.
    #[test]
    fn the_best_policy_is_no_fixed_list_of_views() {
        let library = library(&[&[0, 0, 0], &[0, 1, 0], &[1, 0, 0], &[1, 0, 1]]);
        let views = decoded(&[&[1, 0, 0], &[0, 1, 0], &[0, 0, 1]]);
        let mut policy = Policy::new(&library, 0.99, &views).unwrap();
        assert_eq!(policy.expected_from(&views, 0), 2.0);
        assert_eq!(policy.views_of(&views, 0, "c1").unwrap(), [0, 1]);
        assert_eq!(policy.views_of(&views, 0, "c3").unwrap(), [0, 2]);
    }
}
