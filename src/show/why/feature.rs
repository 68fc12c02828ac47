//! How a feature, or one instance of it, came to its state.

use std::fmt::Write as _;

use serde::Serialize;

use super::history::{Past, measured};
use super::rule::lines_of;
use super::words::{listed, plural, share, state};
use crate::plan::trace::Try;
use crate::plan::{Absence, Existence};
use crate::show::log::{Instance, View};

/// How a feature came to its state.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FeatureAnswer {
    /// Its name.
    pub feature: String,
    /// Its state: −1, 0, 1, 2 or 3.
    pub state: i8,
    /// Whether its place is predicted (the mark 4).
    pub predicted: bool,
    /// How it changed.
    pub history: Vec<Change>,
    /// Its weight before the first measurement and after each, bits.
    pub weights: Vec<f64>,
    /// Its instances.
    pub instances: Vec<Instance>,
    /// The share of its place from which it counts as absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub absent_from: Option<f64>,
    /// Where it is still open: what the rules that conclude it last tried.
    pub tries: Vec<Tried>,
}

/// A change with a measurement.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Change {
    /// Number of the measurement.
    pub n: u32,
    /// The state after it.
    pub state: i8,
    /// The mark 4 after it.
    pub predicted: bool,
    /// Measured instances after it.
    pub instances: usize,
    /// The rule that found it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by: Option<String>,
    /// The run of its detector that did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub found: Option<Try>,
    /// How it came to count as absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub absence: Option<Absence>,
    /// The classes left, where they decide.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub classes: Vec<String>,
}

/// The last run of a rule's detector.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Tried {
    /// The rule.
    pub rule: String,
    /// Number of the measurement.
    pub n: u32,
    /// What it did.
    pub tries: Vec<Try>,
}

/// What became of one instance.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InstanceAnswer {
    /// Its key.
    pub key: String,
    /// A row for every feature and measurement in which it changed.
    pub rows: Vec<Row>,
}

/// How an instance stood.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Number of the measurement.
    pub n: u32,
    /// Its feature.
    pub feature: String,
    /// How it stood; `None` where it is gone.
    pub instance: Option<Instance>,
}

/// The answer about a feature.
pub(super) fn answer(past: &Past<'_>, name: &str) -> FeatureAnswer {
    let before = past.run.start.weights.get(name).copied();
    let after = past.views.iter().filter_map(|v| v.features.get(name));
    let now = past.feature(name);
    let open = matches!(past.state(name), -1 | 2);
    FeatureAnswer {
        feature: name.to_owned(),
        state: past.state(name),
        predicted: now.is_some_and(|f| f.predicted),
        history: history(past, name),
        weights: before.into_iter().chain(after.map(|f| f.weight)).collect(),
        instances: now.map(|f| f.instances.clone()).unwrap_or_default(),
        absent_from: past.absent_share(),
        tries: if open { last_tries(past, name) } else { Vec::new() },
    }
}

fn history(past: &Past<'_>, name: &str) -> Vec<Change> {
    let mut changes = Vec::new();
    let mut before = (Existence::Unknown.code(), false, 0);
    for view in past.views {
        let Some(feature) = view.features.get(name) else {
            continue;
        };
        let now = (feature.state, feature.predicted, measured(feature));
        if now != before {
            changes.push(change(past, view, name, now, before.0));
        }
        before = now;
    }
    changes
}

fn change(past: &Past<'_>, view: &View, name: &str, now: (i8, bool, usize), before: i8) -> Change {
    let (state, predicted, instances) = now;
    let finder = past
        .views
        .iter()
        .find(|v| v.n == view.n)
        .and_then(|v| past.finder(v, name));
    let found = finder.filter(|_| state == Existence::Detected.code());
    let by_classes = state != before && matches!(state, 2 | 3);
    let left = view
        .classes
        .0
        .iter()
        .filter(|(_, p)| *p > 0.0)
        .map(|(class, _)| class.clone());
    Change {
        n: view.n,
        state,
        predicted,
        instances,
        by: found.map(|(id, _)| id.to_owned()),
        found: found.and_then(|(_, trace)| trace.tries.iter().find(|t| t.found > 0).cloned()),
        absence: view.absent.get(name).cloned(),
        classes: if by_classes { left.collect() } else { Vec::new() },
    }
}

/// The last runs of each rule that concludes a feature, as long as they found nothing.
fn last_tries(past: &Past<'_>, name: &str) -> Vec<Tried> {
    let rules = past.run.start.library.iter().flat_map(|l| &l.rules.0);
    let concluding = rules.filter(|(_, rule)| rule.consequent == name);
    let last = |(id, _): &(String, _)| {
        let mut back = past.views.iter().rev();
        let (n, trace) = back.find_map(|v| Some((v.n, v.rules.get(id).filter(|t| !t.tries.is_empty())?)))?;
        Some(Tried {
            rule: id.clone(),
            n,
            tries: trace.tries.clone(),
        })
    };
    concluding.filter_map(last).collect()
}

/// The answer about an instance.
pub(super) fn instance(past: &Past<'_>, key: &str) -> InstanceAnswer {
    let mut rows: Vec<Row> = Vec::new();
    for view in past.views {
        for (name, feature) in &view.features.0 {
            let now = feature.instances.iter().find(|i| i.key == key);
            let before = rows
                .iter()
                .rev()
                .find(|r| r.feature == *name)
                .and_then(|r| r.instance.as_ref());
            if now != before {
                rows.push(Row {
                    n: view.n,
                    feature: name.clone(),
                    instance: now.cloned(),
                });
            }
        }
    }
    let key = key.to_owned();
    InstanceAnswer { key, rows }
}

impl FeatureAnswer {
    /// For people.
    pub(super) fn to_text(&self) -> String {
        let place = if self.predicted { ", its place is predicted" } else { "" };
        let mut text = format!("{}  {}{place}\n", self.feature, state(self.state));
        if self.history.is_empty() {
            text += "\nnothing has changed it since the run began\n";
        } else {
            text += "\nhow it came to that\n";
        }
        for change in &self.history {
            let _ = writeln!(text, "  view {:<3} {}", change.n, change.to_text(self.absent_from));
            if let Some(found) = &change.found {
                text += &lines_of(std::slice::from_ref(found));
            }
        }
        let bits: Vec<String> = self.weights.iter().map(|w| format!("{w:.2}")).collect();
        let _ = writeln!(text, "\nweight {} bits", bits.join(" → "));
        if !self.instances.is_empty() {
            text += "\ninstances\n";
            self.instances
                .iter()
                .for_each(|i| text += &format!("  {}\n", instance_line(i)));
        }
        for tried in &self.tries {
            let _ = writeln!(text, "\n{} last looked for it in view {}", tried.rule, tried.n);
            text += &lines_of(&tried.tries);
        }
        text
    }
}

impl Change {
    fn to_text(&self, absent_from: Option<f64>) -> String {
        let by = self.by.as_ref().map_or(String::new(), |by| format!(" by {by}"));
        match (self.state, &self.absence) {
            (1, _) if self.instances > 1 => format!("{} detected, the latest{by}", plural(self.instances, "instance")),
            (1, _) => format!("detected{by}"),
            (0, Some(absence)) => format!("absent: {}", absence_text(absence, absent_from)),
            (2, _) if !self.classes.is_empty() => format!("present: every class left has it ({})", few(&self.classes)),
            (3, _) if !self.classes.is_empty() => format!("excluded: no class left has it ({})", few(&self.classes)),
            (-1 | 2, _) if self.predicted => "its place is predicted".to_owned(),
            (-1 | 2, _) => "its place is no longer predicted".to_owned(),
            (code, _) => state(code).to_owned(),
        }
    }
}

/// How a feature came to count as absent.
pub(super) fn absence_text(absence: &Absence, absent_from: Option<f64>) -> String {
    let enough = absent_from.map_or(String::new(), |s| format!(", {} are enough", share(s)));
    let inspected = share(absence.inspected as f64 / absence.voxels.max(1) as f64);
    format!(
        "{inspected} of its place was inspected ({} of {} voxels{enough}), as {} predicts it, and it was not found",
        absence.inspected,
        absence.voxels,
        absence.rules.join(", ")
    )
}

impl InstanceAnswer {
    /// For people.
    pub(super) fn to_text(&self) -> String {
        let mut text = format!("{}\n\n", self.key);
        for row in &self.rows {
            let now = row.instance.as_ref().map_or(
                "gone: found under another key, or its prediction fell".into(),
                instance_line,
            );
            let _ = writeln!(text, "  view {:<3} {}  {now}", row.n, row.feature);
        }
        text
    }
}

fn instance_line(instance: &Instance) -> String {
    if instance.state == Existence::Detected.code() {
        return format!("{}  measured", instance.key);
    }
    let counts = match &instance.rule {
        Some(rule) if instance.predicted_by.len() > 1 => format!(" ({rule} counts)"),
        _ => String::new(),
    };
    format!(
        "{}  predicted by {}{counts}: {} voxels, {} inspected",
        instance.key,
        instance.predicted_by.join(", "),
        instance.predicted_voxels,
        share(instance.inspected)
    )
}

/// A few names, or how many.
fn few(names: &[String]) -> String {
    if names.len() > 6 {
        return plural(names.len(), "name").replace("names", "classes");
    }
    listed(names)
}
