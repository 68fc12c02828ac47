//! Why a rule fired, or did not.

use std::fmt::Write as _;

use serde::Serialize;

use super::feature::absence_text;
use super::history::Past;
use super::words::{listed, mark, plural, share, state, wrapped};
use super::written::{Passage, Written};
use crate::plan::trace::{Blank, Nothing, Try};
use crate::plan::{Absence, Existence, RuleTrace};
use crate::show::log::View;

/// Why a rule fired, or did not.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RuleAnswer {
    /// Its id.
    pub rule: String,
    /// Its antecedents, consequent and calls; `None` where the log does not tell.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub declared: Option<Declared>,
    /// How it is written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub written: Option<Passage>,
    /// The answer in a sentence.
    pub verdict: String,
    /// Its antecedents as they stand.
    pub antecedents: Vec<Antecedent>,
    /// What its detector did, measurement by measurement.
    pub measurements: Vec<Measured>,
    /// The instances that it predicts.
    pub predictions: Vec<Prediction>,
    /// How its consequent stands.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub concluded: Option<Concluded>,
}

/// What a rule is made of, by name.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Declared {
    /// Antecedents.
    pub antecedents: Vec<String>,
    /// Consequent.
    pub consequent: String,
    /// What it is repeated for.
    pub each: Vec<String>,
    /// Detector.
    pub detect: String,
    /// Predictor.
    pub predict: Option<String>,
}

/// An antecedent.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Antecedent {
    /// Its name.
    pub feature: String,
    /// Whether it is detected.
    pub holds: bool,
    /// Its state.
    pub state: i8,
    /// The measurement after which it came to that state.
    pub since: Option<u32>,
    /// How many instances of it are measured.
    pub instances: usize,
}

/// What a rule did in one measurement.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measured {
    /// Number of the measurement.
    pub n: u32,
    /// Another rule that asked the same of the same detector before, and whose
    /// answer this is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by: Option<String>,
    /// What it did.
    #[serde(flatten)]
    pub trace: RuleTrace,
}

/// An instance that a rule predicts.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Prediction {
    /// Its key.
    pub key: String,
    /// Voxels of its place.
    pub voxels: usize,
    /// Their inspected share.
    pub inspected: f64,
    /// The share from which the feature counts as absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub absent_from: Option<f64>,
    /// The rule whose prediction counts, where the log says it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub counts: Option<String>,
}

/// How a rule's consequent stands.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Concluded {
    /// Its name.
    pub feature: String,
    /// Its state.
    pub state: i8,
    /// The measurement after which it came to that state.
    pub since: Option<u32>,
    /// The rule that found it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by: Option<String>,
    /// How it came to count as absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub absence: Option<Absence>,
    /// The share of its place from which it does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub absent_from: Option<f64>,
}

/// The answer about a rule.
pub(super) fn answer(past: &Past<'_>, id: &str, written: &Written) -> RuleAnswer {
    let declared = past.rule(id).map(|rule| Declared {
        antecedents: rule.antecedents.clone(),
        consequent: rule.consequent.clone(),
        each: rule.each.clone(),
        detect: rule.detect.clone(),
        predict: rule.predict.clone(),
    });
    let antecedents: Vec<Antecedent> = declared
        .iter()
        .flat_map(|d| &d.antecedents)
        .map(|feature| antecedent(past, feature))
        .collect();
    let measurements: Vec<Measured> = past.views.iter().filter_map(|v| measured(v, id)).collect();
    let concluded = declared.as_ref().map(|d| concluded(past, &d.consequent));
    RuleAnswer {
        rule: id.to_owned(),
        written: written.passage().cloned(),
        verdict: verdict(past, id, &antecedents, &measurements, concluded.as_ref()),
        antecedents,
        measurements,
        predictions: predictions(past, id),
        concluded,
        declared,
    }
}

fn antecedent(past: &Past<'_>, feature: &str) -> Antecedent {
    let state = past.state(feature);
    Antecedent {
        feature: feature.to_owned(),
        holds: state == Existence::Detected.code(),
        state,
        since: past.since(feature),
        instances: past.measured(feature),
    }
}

fn measured(view: &View, id: &str) -> Option<Measured> {
    let by = view.rules.0.iter().find(|(_, t)| t.also.iter().any(|a| a == id));
    let own = view.rules.get(id);
    let (by, trace) = match (own, by) {
        (Some(own), _) if !own.tries.is_empty() => (None, own.clone()),
        (own, Some((by, theirs))) => {
            let own = own.cloned().unwrap_or_default();
            let tries = theirs.tries.clone();
            (Some(by.clone()), RuleTrace { tries, ..own })
        }
        (Some(own), None) => (None, own.clone()),
        (None, None) => return None,
    };
    let n = view.n;
    Some(Measured { n, by, trace })
}

fn concluded(past: &Past<'_>, feature: &str) -> Concluded {
    let (state, since) = (past.state(feature), past.since(feature));
    let found = since.filter(|_| state == Existence::Detected.code());
    let by = found
        .and_then(|n| past.views.get(n as usize - 1))
        .and_then(|view| past.finder(view, feature));
    Concluded {
        feature: feature.to_owned(),
        state,
        since,
        by: by.map(|(id, _)| id.to_owned()),
        absence: past.absence(feature).map(|(_, absence)| absence.clone()),
        absent_from: past.absent_share(),
    }
}

fn predictions(past: &Past<'_>, id: &str) -> Vec<Prediction> {
    let features = past.last().map(|v| v.features.0.as_slice()).unwrap_or_default();
    let instances = features.iter().flat_map(|(_, f)| &f.instances);
    let mine = instances.filter(|i| i.predicted_by.iter().any(|rule| rule == id));
    mine.map(|i| Prediction {
        key: i.key.clone(),
        voxels: i.predicted_voxels,
        inspected: i.inspected,
        absent_from: past.absent_share(),
        counts: i.rule.clone(),
    })
    .collect()
}

fn verdict(
    past: &Past<'_>,
    id: &str,
    antecedents: &[Antecedent],
    measurements: &[Measured],
    concluded: Option<&Concluded>,
) -> String {
    let Some(concluded) = concluded else {
        return "the log does not tell what this rule did".into();
    };
    let feature = &concluded.feature;
    let fired: Vec<&Measured> = measurements
        .iter()
        .filter(|m| m.by.is_none() && m.trace.tries.iter().any(|t| t.found > 0))
        .collect();
    if let Some(first) = fired.first() {
        let times = if fired.len() > 1 {
            format!(", and in {} after it", plural(fired.len() - 1, "view"))
        } else {
            String::new()
        };
        return format!("fired: it found `{feature}` in view {}{times}", first.n);
    }
    let missing: Vec<&str> = antecedents
        .iter()
        .filter(|a| !a.holds)
        .map(|a| a.feature.as_str())
        .collect();
    if !missing.is_empty() {
        let are = if missing.len() > 1 { "are" } else { "is" };
        return format!("did not fire: {} {are} not detected", listed(&missing));
    }
    let since = concluded.since.map_or(String::new(), |n| format!(" since view {n}"));
    match (concluded.state, &concluded.by) {
        (1, Some(by)) if by != id => format!(
            "was not needed: {by} found `{feature}` in view {}",
            concluded.since.unwrap_or(0)
        ),
        (1, _) => format!("was not needed: `{feature}` was found without it{since}"),
        (0, _) => format!("did not fire: `{feature}` was looked for and counts as absent{since}"),
        (3, _) => format!("did not fire: no class left has `{feature}`{since}"),
        _ => match measurements
            .iter()
            .map(|m| m.trace.tries.len() + m.trace.more)
            .sum::<usize>()
        {
            0 => format!(
                "did not fire: in {} its detector had no call to make",
                plural(past.views.len(), "view")
            ),
            tries => format!(
                "did not fire: none of {} found `{feature}`",
                plural(tries, "run") + " of its detector"
            ),
        },
    }
}

impl RuleAnswer {
    /// For people.
    pub(super) fn to_text(&self) -> String {
        let mut text = self.rule.clone();
        if let Some(d) = &self.declared {
            let from = if d.antecedents.is_empty() {
                String::new()
            } else {
                d.antecedents.join(", ") + " "
            };
            let _ = write!(text, "  {from}→ {}", d.consequent);
        }
        if let Some(passage) = &self.written {
            let _ = write!(text, "  ({}:{})", passage.file, passage.line);
        }
        text.push('\n');
        if let Some(passage) = &self.written {
            passage.text.lines().for_each(|line| text += &format!("    {line}\n"));
        }
        let _ = writeln!(text, "\n{}", self.verdict);
        self.antecedents_to(&mut text);
        self.measurements_to(&mut text);
        self.predictions_to(&mut text);
        if let Some(c) = &self.concluded {
            let since = c.since.map_or(String::new(), |n| format!(" since view {n}"));
            let how = match (&c.absence, &c.by) {
                (Some(absence), _) => format!(": {}", absence_text(absence, c.absent_from)),
                (None, Some(by)) => format!(", by {by}"),
                (None, None) => String::new(),
            };
            let _ = writeln!(text, "\n{} is {}{since}{how}", c.feature, state(c.state));
        }
        text
    }

    fn antecedents_to(&self, text: &mut String) {
        if self.antecedents.is_empty() {
            return;
        }
        *text += "\nantecedents\n";
        for a in &self.antecedents {
            let since = a.since.map_or(String::new(), |n| format!(" since view {n}"));
            let count = if a.instances > 0 {
                format!(", {}", plural(a.instances, "instance"))
            } else {
                String::new()
            };
            let _ = writeln!(
                text,
                "  {} {} {}{since}{count}",
                mark(a.holds),
                a.feature,
                state(a.state)
            );
        }
    }

    fn measurements_to(&self, text: &mut String) {
        if self.measurements.is_empty() {
            return;
        }
        let detector = self.declared.as_ref().map_or("its detector", |d| d.detect.as_str());
        let _ = writeln!(text, "\nwhat {detector} found");
        for m in &self.measurements {
            let by =
                m.by.as_ref()
                    .map_or(String::new(), |by| format!(", asked by {by} already"));
            let _ = writeln!(text, "  view {}{by}", m.n);
            *text += &lines_of(&m.trace.tries);
            if m.trace.more > 0 {
                let _ = writeln!(text, "    and {} more", plural(m.trace.more, "combination"));
            }
            for call in &m.trace.waits {
                let _ = writeln!(text, "    ✗ `{call}` uses an attribute that has no value yet");
            }
            m.trace.blank.iter().for_each(|b| *text += &blank_line(b));
        }
    }

    fn predictions_to(&self, text: &mut String) {
        if self.predictions.is_empty() {
            return;
        }
        *text += "\nwhat it predicts\n";
        for p in &self.predictions {
            let from = p
                .absent_from
                .map_or(String::new(), |s| format!(" (absent from {})", share(s)));
            let counts = match &p.counts {
                Some(rule) if *rule != self.rule => format!(", but the prediction of {rule} counts"),
                _ => String::new(),
            };
            let inspected = share(p.inspected);
            let _ = writeln!(
                text,
                "  {}  {} voxels, {inspected} inspected{from}{counts}",
                p.key, p.voxels
            );
        }
    }
}

/// `    bottom.1/edge.2  ✗ 0 of 7: ✓ colour green … · ✗ dihedral …`; runs that
/// came out alike share their lines.
pub(super) fn lines_of(tries: &[Try]) -> String {
    let mut text = String::new();
    let mut told: Vec<&Try> = Vec::new();
    let alike = |a: &Try, b: &Try| a.looked == b.looked && a.found == b.found && a.conditions == b.conditions;
    for one in tries {
        if told.iter().any(|t| alike(t, one)) {
            continue;
        }
        told.push(one);
        let more = tries.iter().filter(|t| alike(t, one)).count() - 1;
        let more = if more > 0 {
            format!(" and {more} more")
        } else {
            String::new()
        };
        let looked = match one.looked {
            0 => "nothing to look at".to_owned(),
            looked => format!("{} of {looked}", one.found),
        };
        let head = format!("    {}{more}  {} {looked}", one.key, mark(one.found > 0));
        text += &wrapped(&head, &one.conditions);
    }
    text
}

fn blank_line(blank: &Blank) -> String {
    let why = match blank.why {
        Nothing::NoFace => "no face has those edges and angles",
        Nothing::Outside => "it lies outside the space",
    };
    format!("    {}  ✗ predicts nothing: {why}\n", blank.key)
}
