//! What the rules can find on an object, given the features that it has.

use crate::rules::Library;

/// The rules by what they wait for.
pub struct Reach<'a> {
    library: &'a Library,
    /// By feature: the rules with it among their antecedents.
    waiting: Vec<Vec<usize>>,
    definite: Vec<usize>,
}

impl<'a> Reach<'a> {
    /// Of a library.
    pub fn new(library: &'a Library) -> Self {
        let mut waiting = vec![Vec::new(); library.features.len()];
        let mut definite = Vec::new();
        for (k, rule) in library.rules.iter().enumerate() {
            match rule.antecedents.as_slice() {
                [] => definite.push(k),
                antecedents => antecedents.iter().for_each(|a| waiting[a.index()].push(k)),
            }
        }
        Self {
            library,
            waiting,
            definite,
        }
    }

    /// By feature: whether some chain of rules that begins with a definite one finds it
    /// on an object that has the features of `has`.
    pub fn found(&self, has: impl Fn(usize) -> bool) -> Vec<bool> {
        let rules = &self.library.rules;
        let mut missing: Vec<usize> = rules.iter().map(|r| r.antecedents.len()).collect();
        let mut found = vec![false; self.library.features.len()];
        let mut firing = self.definite.clone();
        while let Some(rule) = firing.pop() {
            let feature = rules[rule].consequent.index();
            if !has(feature) || std::mem::replace(&mut found[feature], true) {
                continue;
            }
            for &next in &self.waiting[feature] {
                missing[next] -= 1;
                if missing[next] == 0 {
                    firing.push(next);
                }
            }
        }
        found
    }

    /// By feature: whether looking for it comes to an end on that object. What is found
    /// is found; what is not there is found absent only where a rule predicts its place.
    pub fn settled(&self, has: impl Fn(usize) -> bool) -> Vec<bool> {
        let found = self.found(&has);
        let mut settled = found.clone();
        for rule in &self.library.rules {
            let predicts = rule.predict.is_some() && !rule.antecedents.is_empty();
            let feature = rule.consequent.index();
            if predicts && !has(feature) && rule.antecedents.iter().all(|a| found[a.index()]) {
                settled[feature] = true;
            }
        }
        settled
    }
}
