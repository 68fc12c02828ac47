//! Why a class is left, or by which evidence it was excluded.

use std::fmt::Write as _;

use serde::Serialize;

use super::feature::absence_text;
use super::history::Past;
use super::words::{mark, plural, share, state};
use crate::plan::{Absence, Existence};
use crate::show::log::{Contradiction, Feature, View};

/// Why a class is left, or was excluded.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ClassAnswer {
    /// Its name.
    pub class: String,
    /// Its probability now.
    pub probability: f64,
    /// Before anything was seen, and after each measurement.
    pub posterior: Vec<f64>,
    /// The first measurement after which it was impossible.
    pub excluded: Option<u32>,
    /// What was decided about features by then, and whether it fits the class.
    pub evidence: Vec<Evidence>,
    /// What contradicted the library, where that left no class.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub contradiction: Option<Contradiction>,
    /// The classes that are left, with their probabilities.
    pub left: Vec<(String, f64)>,
    /// The share of a place from which a feature counts as absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub absent_from: Option<f64>,
}

/// A decided feature.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Evidence {
    /// Its name.
    pub feature: String,
    /// Its state: 1 detected or 0 absent.
    pub state: i8,
    /// Whether the class has it; `None` where the log does not say.
    pub has: Option<bool>,
    /// Whether both agree.
    pub fits: Option<bool>,
    /// The measurement that decided it.
    pub n: u32,
    /// The rule that found it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by: Option<String>,
    /// How it came to count as absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub absence: Option<Absence>,
}

/// The answer about a class.
pub(super) fn answer(past: &Past<'_>, name: &str) -> ClassAnswer {
    let after = |view: &View| view.classes.get(name).copied().unwrap_or(0.0);
    let prior = past.class(name).map(|c| c.prior);
    let excluded = past.views.iter().find(|v| after(v) <= 0.0);
    let left = past.last().map(|v| v.classes.0.as_slice()).unwrap_or_default();
    ClassAnswer {
        class: name.to_owned(),
        probability: past.last().map_or(0.0, after),
        posterior: prior.into_iter().chain(past.views.iter().map(after)).collect(),
        excluded: excluded.map(|v| v.n),
        evidence: evidence(past, name, excluded.or(past.last())),
        contradiction: past
            .contradiction()
            .filter(|_| left.iter().all(|(_, p)| *p <= 0.0))
            .cloned(),
        left: left.iter().filter(|(_, p)| *p > 0.0).cloned().collect(),
        absent_from: past.absent_share(),
    }
}

/// The features decided by a measurement.
fn evidence(past: &Past<'_>, class: &str, by: Option<&View>) -> Vec<Evidence> {
    let features = by.map(|v| v.features.0.as_slice()).unwrap_or_default();
    let decided = |code: i8| code == Existence::Detected.code() || code == Existence::Absent.code();
    let of = |(name, feature): &(String, Feature)| {
        let first = past
            .views
            .iter()
            .find(|v| v.features.get(name).is_some_and(|f| f.state == feature.state))?;
        let found = feature.state == Existence::Detected.code();
        let has = past.has(class, name);
        Some(Evidence {
            feature: name.clone(),
            state: feature.state,
            has,
            fits: has.map(|has| has == found),
            n: first.n,
            by: past.finder(first, name).filter(|_| found).map(|(id, _)| id.to_owned()),
            absence: first.absent.get(name).cloned(),
        })
    };
    features
        .iter()
        .filter(|(_, f)| decided(f.state))
        .filter_map(of)
        .collect()
}

impl ClassAnswer {
    /// For people.
    pub(super) fn to_text(&self) -> String {
        let mut text = match self.excluded {
            Some(n) => format!("{}  excluded by view {n}\n", self.class),
            None => format!("{}  possible, p = {:.3}\n", self.class, self.probability),
        };
        let heading = if self.excluded.is_some() {
            "what excluded it"
        } else {
            "what was decided"
        };
        let fails = |e: &&Evidence| self.excluded.is_none() || e.fits != Some(true);
        let shown: Vec<&Evidence> = self.evidence.iter().filter(fails).collect();
        if !shown.is_empty() {
            let _ = writeln!(text, "\n{heading}");
        }
        for evidence in shown {
            let _ = writeln!(text, "  {}", evidence.to_text(&self.class, self.absent_from));
        }
        if let Some(c) = &self.contradiction {
            let _ = writeln!(
                text,
                "\nno class is left, for the library is contradicted\n  {}: {}",
                c.feature, c.evidence
            );
        }
        let posterior: Vec<String> = self.posterior.iter().map(|p| format!("{p:.3}")).collect();
        let _ = writeln!(text, "\nprobability {}", posterior.join(" → "));
        let left: Vec<String> = self
            .left
            .iter()
            .map(|(class, p)| format!("{class} {}", share(*p)))
            .collect();
        let left = if left.is_empty() {
            "none".to_owned()
        } else {
            left.join(", ")
        };
        let _ = writeln!(
            text,
            "left        {left} ({})",
            plural(self.left.len(), "class").replace("classs", "classes")
        );
        text
    }
}

impl Evidence {
    fn to_text(&self, class: &str, absent_from: Option<f64>) -> String {
        let how = match (&self.by, &self.absence) {
            (Some(by), _) => format!("detected by {by}"),
            (None, Some(absence)) => format!("absent: {}", absence_text(absence, absent_from)),
            (None, None) => state(self.state).to_owned(),
        };
        let has = match self.has {
            Some(true) => format!("; {class} has it"),
            Some(false) => format!("; {class} lacks it"),
            None => String::new(),
        };
        let mark = self.fits.map_or('?', mark);
        format!("{mark} {} view {}: {how}{has}", self.feature, self.n)
    }
}
