//! A run up to a measurement: what the answers have in common.

use crate::plan::{Absence, Existence, RuleTrace};
use crate::show::log::{Class, Contradiction, Feature, Rule, Run, View};

/// A run as far as a question goes.
pub(super) struct Past<'a> {
    /// All of it.
    pub run: &'a Run,
    /// The measurements asked about.
    pub views: &'a [View],
}

impl<'a> Past<'a> {
    /// A run up to measurement `at`.
    pub fn of(run: &'a Run, at: u32) -> Self {
        let views = &run.views[..run.views.len().min(at as usize)];
        Self { run, views }
    }

    /// The last measurement asked about.
    pub fn last(&self) -> Option<&'a View> {
        self.views.last()
    }

    /// A feature after the last measurement.
    pub fn feature(&self, name: &str) -> Option<&'a Feature> {
        self.last()?.features.get(name)
    }

    /// Its state then; unknown before the first.
    pub fn state(&self, name: &str) -> i8 {
        self.feature(name).map_or(Existence::Unknown.code(), |f| f.state)
    }

    /// The first measurement after which a feature was in the state that it is in
    /// now; `None` where nothing is known of it.
    pub fn since(&self, name: &str) -> Option<u32> {
        let state = Some(self.state(name)).filter(|s| *s != Existence::Unknown.code())?;
        let other = |view: &&View| view.features.get(name).is_none_or(|f| f.state != state);
        let same = self.views.iter().rev().take_while(|v| !other(v));
        same.last().map(|v| v.n)
    }

    /// Measured instances of a feature after the last measurement.
    pub fn measured(&self, name: &str) -> usize {
        self.feature(name).map_or(0, measured)
    }

    /// A rule, as the log tells it.
    pub fn rule(&self, id: &str) -> Option<&'a Rule> {
        self.run.start.library.as_ref()?.rules.get(id)
    }

    /// A class, as the log tells it.
    pub fn class(&self, name: &str) -> Option<&'a Class> {
        self.run.start.library.as_ref()?.classes.get(name)
    }

    /// Whether a class has a feature; `None` where the log does not say.
    pub fn has(&self, class: &str, feature: &str) -> Option<bool> {
        let position = self.run.start.weights.names().position(|n| n == feature)?;
        let presence = self.class(class)?.presence.as_bytes();
        presence.get(position).map(|bit| *bit == b'1')
    }

    /// The rule that found a feature in a measurement, with its trace: the first
    /// in the order in which they run.
    pub fn finder(&self, view: &'a View, feature: &str) -> Option<(&'a str, &'a RuleTrace)> {
        let found = view.rules.0.iter().filter(|(id, trace)| {
            let concludes = self.rule(id).is_some_and(|r| r.consequent == feature);
            concludes && trace.tries.iter().any(|t| t.found > 0)
        });
        let definite = |id: &str| self.rule(id).is_some_and(|r| r.antecedents.is_empty());
        let first = found.min_by_key(|(id, _)| !definite(id))?;
        Some((first.0.as_str(), &first.1))
    }

    /// How a feature came to count as absent, and after which measurement.
    pub fn absence(&self, feature: &str) -> Option<(u32, &'a Absence)> {
        self.views.iter().find_map(|v| Some((v.n, v.absent.get(feature)?)))
    }

    /// What contradicted the library, where the run ended so by the last measurement.
    pub fn contradiction(&self) -> Option<&'a Contradiction> {
        let whole = self.views.len() == self.run.views.len();
        self.run.end.as_ref().filter(|_| whole)?.contradiction.as_ref()
    }

    /// ξ_ned, where the log says it.
    pub fn absent_share(&self) -> Option<f64> {
        self.run.start.criteria.as_ref().map(|c| c.absent)
    }

    /// Whether the log tells what rules did.
    pub fn is_traced(&self) -> bool {
        self.run.start.library.is_some()
    }

    /// What limits every answer from this log.
    pub fn reservations(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if !self.is_traced() {
            notes.push(
                "this log was written before logs told what rules did; plan again with `--log`, or go on with `--resume`"
                    .to_owned(),
            );
        }
        if self.run.end.is_none() {
            let views = self.run.views.len();
            notes.push(format!(
                "the log ends after view {views} without an outcome: the run was interrupted"
            ));
        }
        notes
    }
}

/// Measured instances of a feature.
pub(super) fn measured(feature: &Feature) -> usize {
    let detected = Existence::Detected.code();
    feature.instances.iter().filter(|i| i.state == detected).count()
}
