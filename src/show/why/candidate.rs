//! What became of a candidate view: taken, passed over, or never near.

use std::fmt::Write as _;

use serde::Serialize;

use super::history::Past;
use super::view::row;
use super::words::plural;
use crate::show::log::Standing;

/// What became of a candidate view.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CandidateAnswer {
    /// Its index.
    pub candidate: usize,
    /// The measurement that was made from it.
    pub measured: Option<u32>,
    /// Decisions in which it was among the best few.
    pub ranked: Vec<Ranked>,
}

/// A candidate view in one decision.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ranked {
    /// The measurement after which it was made.
    pub after: u32,
    /// Its place, from 1.
    pub place: usize,
    /// How it stood.
    pub standing: Standing,
    /// The view that was chosen.
    pub chosen: Standing,
}

/// The answer about a candidate view.
pub(super) fn answer(past: &Past<'_>, candidate: usize) -> CandidateAnswer {
    let decisions = past.views.iter().filter_map(|v| Some((v.n, v.next.as_ref()?)));
    let ranked = decisions.filter_map(|(after, next)| {
        let mut all = std::iter::once(&next.chosen).chain(&next.runners_up);
        let place = all.clone().position(|s| s.view == candidate)?;
        Some(Ranked {
            after,
            place: place + 1,
            standing: all.nth(place)?.clone(),
            chosen: next.chosen.clone(),
        })
    });
    CandidateAnswer {
        candidate,
        measured: past.views.iter().find(|v| v.view == candidate).map(|v| v.n),
        ranked: ranked.collect(),
    }
}

impl CandidateAnswer {
    /// For people.
    pub(super) fn to_text(&self) -> String {
        let what = match self.measured {
            Some(n) => format!("taken as view {n}; `view {n}` tells why"),
            None => "not taken".to_owned(),
        };
        let mut text = format!("#{}  {what}\n", self.candidate);
        if self.ranked.is_empty() && self.measured.is_none() {
            text += "\nit was among the best few in no decision, and the log keeps no others\n";
        }
        for ranked in &self.ranked {
            let _ = writeln!(
                text,
                "\nafter {}: place {}",
                plural(ranked.after as usize, "view"),
                ranked.place
            );
            text += &row(if ranked.place == 1 { '✓' } else { ' ' }, &ranked.standing);
            if ranked.place > 1 {
                text += &row('✓', &ranked.chosen);
            }
        }
        text
    }
}
