//! GNO: the paper's planner with the overlap constraint (eqs. 8, 9, 12).
//!
//! If every view that gains something fails the constraint, the one of largest
//! overlap among them is taken and marked as relaxed.

use rand_pcg::Pcg64;

use super::{Choice, Method, Rank, Situation};

pub(super) struct Gno;

impl Method for Gno {
    fn name(&self) -> &'static str {
        "gno"
    }

    fn choose(&self, situation: &Situation<'_>, _: &mut Pcg64) -> Option<Choice> {
        let gaining = situation.gaining();
        let shares = situation.overlaps(&gaining);
        let least = situation.knowledge.task.overlap;
        let gain = |rank: &Rank| situation.gains.total(rank.position);
        let rank = |(position, share): (usize, f64)| {
            let overlap = share >= least - 1e-9;
            Rank {
                position,
                score: if overlap { situation.gains.total(position) } else { 0.0 },
                overlap,
                share: Some(share),
            }
        };
        let ranks = gaining.into_iter().zip(shares).map(rank);
        let (passing, failing): (Vec<Rank>, Vec<Rank>) = ranks.partition(|rank| rank.overlap);
        if let Some((best, mut rivals)) = situation.ranked(passing, gain) {
            // What only the overlap kept from winning.
            let stronger = failing.into_iter().filter(|rank| gain(rank) > gain(&best)).collect();
            if let Some((first, _)) = situation.ranked(stronger, gain) {
                rivals.push(first);
            }
            return Some(Choice {
                best,
                relaxed: false,
                rivals,
                worth: None,
            });
        }
        let (best, rivals) = situation.ranked(failing, |rank| rank.share.unwrap_or(0.0))?;
        Some(Choice {
            best,
            relaxed: true,
            rivals,
            worth: None,
        })
    }
}
