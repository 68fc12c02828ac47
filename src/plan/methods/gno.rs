//! GNO: the paper's planner with the overlap constraint (eqs. 8, 9, 12).
//!
//! If every view that gains something fails the constraint, the one of largest
//! overlap among them is taken and marked as relaxed.

use rand_pcg::Pcg64;

use super::{Choice, Method, Situation};

pub(super) struct Gno;

impl Method for Gno {
    fn name(&self) -> &'static str {
        "gno"
    }

    fn choose(&self, situation: &Situation<'_>, _: &mut Pcg64) -> Option<Choice> {
        let gaining = situation.gaining();
        let shares = situation.overlaps(&gaining);
        let least = situation.knowledge.task.overlap;
        let both = || gaining.iter().copied().zip(shares.iter().copied());
        let passing = both().filter(|(_, share)| *share >= least - 1e-9);
        if let Some((position, score)) = situation.best(passing.map(|(k, _)| (k, situation.gains.total(k)))) {
            return Some(Choice {
                position,
                score,
                overlap: true,
                relaxed: false,
            });
        }
        let (position, _) = situation.best(both())?;
        Some(Choice {
            position,
            score: 0.0,
            overlap: false,
            relaxed: true,
        })
    }
}
