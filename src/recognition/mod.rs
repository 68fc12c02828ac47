//! What telling classes apart costs: the shortest certificate of each class and the
//! best expected number of features to look for.
//!
//! Pure functions over presence rows and priors. They agree with the planner: a look
//! ends with a feature found or found absent, only what is predicted is found absent,
//! and a class is certain when its share of the prior mass that is left reaches the
//! confidence. The task checks report them; nothing here knows of views.

mod certificate;
mod reach;
mod set;
#[cfg(test)]
mod tests;
mod tree;

pub use certificate::Certificate;
pub use reach::Reach;
pub use set::ClassSet;
pub use tree::Tests;

use crate::rules::{FeatureId, Library};

/// Most classes that are looked at.
const MOST_CLASSES: usize = 1_024;
/// Most class-rule pairs for which it is followed what each class lets the rules find.
const MOST_PAIRS: usize = 20_000_000;

/// Work that is left, in counted steps, so that whatever is asked ends.
#[derive(Clone, Copy, Debug)]
pub struct Budget(pub u64);

impl Budget {
    /// One of equal parts.
    pub fn part(self, parts: usize) -> Self {
        Self(self.0 / parts.max(1) as u64)
    }

    /// Takes `steps`; `None` where they are not left.
    fn take(&mut self, steps: usize) -> Option<()> {
        self.0 = self.0.checked_sub(steps as u64)?;
        Some(())
    }
}

/// Classes to be told apart by features.
#[derive(Clone, Debug)]
pub struct Recognition {
    priors: Vec<f64>,
    confidence: f64,
    /// The prior of every class, where all are alike.
    uniform: Option<f64>,
    /// By feature: the classes that have it.
    has: Vec<ClassSet>,
    /// By feature: the classes on whose objects looking for it comes to an end.
    settled: Vec<ClassSet>,
}

impl Recognition {
    /// The classes of a library under a confidence (ξ_cfd). `None` where the library is
    /// too large to follow what each class lets the rules find.
    pub fn of(library: &Library, confidence: f64) -> Option<Self> {
        let classes = library.classes.len();
        if classes > MOST_CLASSES || classes * library.rules.len() > MOST_PAIRS {
            return None;
        }
        let reach = Reach::new(library);
        let rows = library.classes.iter().map(|class| {
            let row = &class.presence.0;
            let settled = reach.settled(|f| row[f]);
            row.iter().zip(settled).map(|(has, s)| (*has, s)).collect()
        });
        let priors = library.classes.iter().map(|c| c.prior).collect();
        Some(Self::new(library.features.len(), rows.collect(), priors, confidence))
    }

    /// Classes by rows: whether the class has each feature, and whether looking for it
    /// on an object of the class comes to an end.
    pub fn new(features: usize, rows: Vec<Vec<(bool, bool)>>, priors: Vec<f64>, confidence: f64) -> Self {
        let none = ClassSet::none(rows.len());
        let (mut has, mut settled) = (vec![none.clone(); features], vec![none; features]);
        for (class, row) in rows.iter().enumerate() {
            for (feature, &(present, ends)) in row.iter().enumerate() {
                if present {
                    has[feature].insert(class);
                }
                if ends {
                    settled[feature].insert(class);
                }
            }
        }
        let uniform = priors.first().copied().filter(|p| priors.iter().all(|q| q == p));
        Self {
            priors,
            confidence,
            uniform,
            has,
            settled,
        }
    }

    /// Number of classes.
    pub fn classes(&self) -> usize {
        self.priors.len()
    }

    /// All classes.
    pub fn all(&self) -> ClassSet {
        ClassSet::all(self.classes())
    }

    /// P(class) where `left` are the classes that are still possible (eq. 7).
    pub fn share(&self, class: usize, left: &ClassSet) -> f64 {
        let total = self.mass(left);
        if total > 0.0 { self.priors[class] / total } else { 0.0 }
    }

    /// Whether some class is certain when `left` are still possible (eq. 10).
    pub fn is_certain(&self, left: &ClassSet) -> bool {
        left.iter().any(|class| self.share(class, left) >= self.confidence)
    }

    /// The classes that are still possible on an object of `class` when everything that
    /// can be looked for has been.
    pub fn left_at_best(&self, class: usize) -> ClassSet {
        let features = 0..self.has.len() as u32;
        features
            .map(FeatureId)
            .fold(self.all(), |left, f| match self.excluded(f, class) {
                Some(excluded) => left.without(&excluded),
                None => left,
            })
    }

    /// Whether a class can ever be certain.
    pub fn can_be_certain(&self, class: usize) -> bool {
        self.share(class, &self.left_at_best(class)) >= self.confidence
    }

    /// The classes that looking for a feature on an object of `class` excludes; `None`
    /// where the look comes to no end.
    fn excluded(&self, feature: FeatureId, class: usize) -> Option<ClassSet> {
        let k = feature.index();
        self.settled[k].contains(class).then(|| {
            if self.has[k].contains(class) {
                self.all().without(&self.has[k])
            } else {
                self.has[k].clone()
            }
        })
    }

    /// The mass of the classes that are in both, up to rounding.
    fn common_mass(&self, a: &ClassSet, b: &ClassSet) -> f64 {
        match self.uniform {
            Some(prior) => a.in_common(b) as f64 * prior,
            None => self.mass(&a.and(b)),
        }
    }

    /// Steps that a mass of some of these classes takes.
    fn work(&self, classes: &ClassSet) -> usize {
        match self.uniform {
            Some(_) => self.classes().div_ceil(64) + 1,
            None => classes.len() + 1,
        }
    }

    fn mass(&self, classes: &ClassSet) -> f64 {
        classes.iter().map(|class| self.priors[class]).sum()
    }
}
