//! Why something happened in a run, or did not, from its log alone.
//!
//! A [`Subject`] is a rule, a feature, an instance, a class or a view; the
//! answer is data first ([`Answer`]) and text second. Nothing is computed anew
//! that the planner decided: conditions and values are those of the log. The
//! verb `vpl why` reads the files and prints.

mod candidate;
mod class;
mod feature;
mod history;
mod rule;
mod subject;
mod view;
mod words;
mod written;

use serde::Serialize;

use super::log::{Run, Stop};
pub use subject::{Subject, Unknown};
pub use written::Written;

/// An answer to the question why.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "about", rename_all = "snake_case")]
pub enum Answer {
    /// Why a rule fired, or did not.
    Rule(rule::RuleAnswer),
    /// How a feature came to its state.
    Feature(feature::FeatureAnswer),
    /// What became of one instance.
    Instance(feature::InstanceAnswer),
    /// Why a class is left, or was excluded.
    Class(class::ClassAnswer),
    /// Why a measurement was made from a view, and what came of it.
    View(view::ViewAnswer),
    /// What became of a candidate view.
    Candidate(candidate::CandidateAnswer),
}

/// An answer and what one should know to trust it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Explanation {
    /// The answer.
    #[serde(flatten)]
    pub answer: Answer,
    /// The measurement after which it holds.
    pub at: u32,
    /// How many measurements the log tells of.
    pub of: u32,
    /// Reservations.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

/// The answer about a subject, as of measurement `at` (from 1).
pub fn explain(run: &Run, subject: &Subject, at: u32, written: &Written) -> Explanation {
    let past = history::Past::of(run, at);
    let answer = match subject {
        Subject::Rule(id) => Answer::Rule(rule::answer(&past, id, written)),
        Subject::Feature(name) => Answer::Feature(feature::answer(&past, name)),
        Subject::Instance(key) => Answer::Instance(feature::instance(&past, key)),
        Subject::Class(name) => Answer::Class(class::answer(&past, name)),
        Subject::View(n) => Answer::View(view::answer(&past, *n)),
        Subject::Candidate(index) => Answer::Candidate(candidate::answer(&past, *index)),
    };
    let mut notes = past.reservations();
    notes.extend(written.reservation());
    Explanation {
        answer,
        at,
        of: run.views.len() as u32,
        notes,
    }
}

impl Explanation {
    /// For people.
    pub fn to_text(&self) -> String {
        let mut text = match &self.answer {
            Answer::Rule(rule) => rule.to_text(),
            Answer::Feature(feature) => feature.to_text(),
            Answer::Instance(instance) => instance.to_text(),
            Answer::Class(class) => class.to_text(),
            Answer::View(view) => view.to_text(),
            Answer::Candidate(candidate) => candidate.to_text(),
        };
        for note in &self.notes {
            text += &format!("\nnote: {note}\n");
        }
        text
    }

    /// For programs.
    pub fn to_json(&self) -> String {
        let text = serde_json::to_string_pretty(self);
        text.unwrap_or_else(|error| unreachable!("an answer is plain data: {error}")) + "\n"
    }
}

/// Why a run stops, in a few words for the line of its last view.
pub(super) fn stop_reason(stop: &Stop) -> String {
    view::stop_reason(stop)
}
