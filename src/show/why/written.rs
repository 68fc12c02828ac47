//! Rules as their program writes them, where the program is still at hand.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::rules::{Library, Place, Rule, RuleSet};

/// Most lines of a rule that are shown.
const MOST_LINES: usize = 16;

/// Where rules are written; nowhere where the program cannot be had.
#[derive(Clone, Debug, PartialEq)]
pub enum Written {
    /// The program of the run.
    Here(BTreeMap<String, Passage>),
    /// Why it cannot be shown.
    Gone(String),
}

impl Default for Written {
    fn default() -> Self {
        Self::Here(BTreeMap::new())
    }
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
    /// The rules of a task's library; `text` gives the name of a place's file, and
    /// what stands there, indented as it stands.
    pub fn of(rules: &RuleSet, task: &str, text: impl Fn(Place) -> Option<(String, String)>) -> Self {
        let task = rules.tasks.iter().find(|t| t.name == task);
        let Some(library) = task.and_then(|t| rules.library(t)) else {
            return Self::Gone("the program no longer has the task of this run".into());
        };
        let passage = |rule: &Rule| {
            let (file, text) = text(rule.place)?;
            let text = shortened(&undented(&text), rule, library);
            let line = rule.place.line;
            Some((rule.id.clone(), Passage { file, line, text }))
        };
        Self::Here(library.rules.iter().filter_map(passage).collect())
    }

    pub(super) fn rule(&self, id: &str) -> Option<&Passage> {
        match self {
            Self::Here(rules) => rules.get(id),
            Self::Gone(_) => None,
        }
    }

    pub(super) fn reservation(&self) -> Option<String> {
        match self {
            Self::Here(_) => None,
            Self::Gone(why) => Some(why.clone()),
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
