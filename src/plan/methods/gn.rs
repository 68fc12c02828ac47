//! GN: the paper's planner without the overlap constraint (eqs. 8, 9, 12).

use rand_pcg::Pcg64;

use super::{Choice, Method, Rank, Situation};

pub(super) struct Gn;

impl Method for Gn {
    fn name(&self) -> &'static str {
        "gn"
    }

    fn choose(&self, situation: &Situation<'_>, _: &mut Pcg64) -> Option<Choice> {
        let rank = |position: usize| Rank {
            position,
            score: situation.gains.total(position),
            overlap: true,
            share: None,
        };
        let ranks = (0..situation.gains.views.len()).map(rank).collect();
        let (best, rivals) = situation.ranked(ranks, |rank| rank.score)?;
        Some(Choice {
            best,
            relaxed: false,
            rivals,
        })
    }
}
