//! GNO: the paper's planner with the overlap constraint (eqs. 8, 9, 12).
//!
//! If every view that gains something fails the constraint, the one of largest
//! overlap among them is taken and marked as relaxed.

use rand_pcg::Pcg64;

use super::{Choice, MOST_RIVALS, Method, Rank, Situation};
use crate::plan::score::OverlapParts;

pub(super) struct Gno;

/// Views whose overlap is counted together. It is dear, so views are judged in the order
/// of their gain until enough of them pass.
const BATCH: usize = 16;

impl Method for Gno {
    fn name(&self) -> &'static str {
        "gno"
    }

    fn choose(&self, situation: &Situation<'_>, _: &mut Pcg64) -> Option<Choice> {
        let least = situation.knowledge.task.overlap;
        let gain = |rank: &Rank| situation.gains.total(rank.position);
        let judged = |rank: &Rank, share: f64| {
            let overlap = share >= least - 1e-9;
            Rank {
                score: if overlap { gain(rank) } else { 0.0 },
                overlap,
                share: Some(share),
                ..*rank
            }
        };
        let gaining = situation.gaining().into_iter().map(unjudged);
        let mut ranks: Vec<Rank> = gaining.collect();
        situation.sort(&mut ranks, gain);
        let parts = OverlapParts::of(situation.world, situation.status);
        let (mut passing, mut failing) = (Vec::new(), Vec::new());
        for batch in ranks.chunks(BATCH) {
            let shares = situation.overlaps(&parts, batch);
            let judged = batch.iter().zip(shares).map(|(rank, share)| judged(rank, share));
            let (pass, fail): (Vec<Rank>, Vec<Rank>) = judged.partition(|rank| rank.overlap);
            passing.extend(pass);
            failing.extend(fail);
            if passing.len() > MOST_RIVALS {
                break;
            }
        }
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

/// A view whose overlap was not counted yet.
fn unjudged(position: usize) -> Rank {
    Rank {
        position,
        score: 0.0,
        overlap: false,
        share: None,
    }
}
