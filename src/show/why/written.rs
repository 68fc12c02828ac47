//! Rules as their program writes them, where the program is still at hand.

use serde::Serialize;

use crate::rules::{Library, Place, Rule, RuleSet};
use crate::show::log::Start;

/// Most lines of a rule that are shown.
const MOST_LINES: usize = 16;

/// How a rule is written.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Written {
    /// It is not asked for.
    #[default]
    Unasked,
    /// In the program of the run.
    Here(Passage),
    /// It cannot be shown, and why.
    Gone(String),
}

/// A rule in its program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Passage {
    /// The file.
    pub file: String,
    /// The line that it begins in, from 1.
    pub line: u32,
    /// The text, without the indentation of the whole.
    pub text: String,
}

impl Written {
    /// The rule `id` of a run as its program, compiled to `rules`, writes it now: where
    /// it still means what it did, wherever it stands by now. `text` gives the name of a
    /// place's file, and the declaration that begins there, indented as it stands.
    pub fn of(rules: &RuleSet, run: &Start, id: &str, text: impl Fn(Place) -> Option<(String, String)>) -> Self {
        let task = rules.tasks.iter().find(|t| t.name == run.task);
        let library = task.and_then(|t| rules.library(t));
        let then = run.library.as_ref().and_then(|l| l.rules.get(id));
        let unchanged = rules.digest() == run.rules;
        let same = |library: &Library, rule: &Rule| match then {
            _ if unchanged => rule.id == id,
            Some(then) => rule.digest(library) == then.digest,
            None => false,
        };
        let rule = library.and_then(|l| l.rules.iter().find(|r| same(l, r)));
        let (Some(library), Some(rule)) = (library, rule) else {
            return Self::Gone(format!(
                "no rule of the program is what `{id}` was in the run any more, so its text is not shown"
            ));
        };
        match text(rule.place) {
            Some((file, text)) => Self::Here(Passage {
                file,
                line: rule.place.line,
                text: shortened(&undented(&text), rule, library),
            }),
            None => Self::Gone("the rule's text cannot be read".into()),
        }
    }

    pub(super) fn passage(&self) -> Option<&Passage> {
        match self {
            Self::Here(passage) => Some(passage),
            Self::Unasked | Self::Gone(_) => None,
        }
    }

    pub(super) fn reservation(&self) -> Option<String> {
        match self {
            Self::Gone(why) => Some(why.clone()),
            Self::Unasked | Self::Here(_) => None,
        }
    }
}

/// The lines without the indentation that they share.
fn undented(text: &str) -> Vec<String> {
    let indentation = |line: &str| line.len() - line.trim_start_matches(' ').len();
    let lines = || text.lines().filter(|l| !l.trim().is_empty());
    let shared = lines().map(indentation).min().unwrap_or(0);
    let cut = |line: &str| line.get(shared..).unwrap_or("").trim_end().to_owned();
    text.lines().map(cut).collect()
}

/// Of a passage that stands for many rules, a layout, the lines that name this one's features.
fn shortened(lines: &[String], rule: &Rule, library: &Library) -> String {
    if !lines.first().is_some_and(|l| l.starts_with("layout")) && lines.len() <= MOST_LINES {
        return lines.join("\n");
    }
    let names: Vec<&str> = rule
        .antecedents
        .iter()
        .chain([&rule.consequent])
        .map(|id| library.feature(*id).name.as_str())
        .collect();
    let named = |line: &&String| names.iter().any(|n| line.contains(n));
    let mut kept: Vec<&str> = lines.first().map(String::as_str).into_iter().collect();
    kept.extend(lines.iter().skip(1).filter(named).take(MOST_LINES).map(String::as_str));
    kept.join("\n")
}
