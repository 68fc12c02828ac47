//! AF: area factor (Vasquez-Gomez et al. 2014, as in Delmerico et al. 2018).
//!
//! Every ray has one vote: for the first occluded or occupied voxel on it, or for
//! neither. Best are a fifth of occupied votes, which help to register the view, and
//! four fifths of occluded ones. A ray that misses the space has no vote.

use rand_pcg::Pcg64;

use super::occluded::Occluded;
use super::rays::{self, Reading, Visit};
use super::{Choice, Method, Situation};
use crate::map::Occupancy;

pub(super) struct AreaFactor;

/// Votes: occupied, occluded, all.
type Votes = [usize; 3];

impl Method for AreaFactor {
    fn name(&self) -> &'static str {
        "af"
    }

    fn choose(&self, situation: &Situation<'_>, _: &mut Pcg64) -> Option<Choice> {
        let occluded = Occluded::of(situation.world, &situation.status.visited);
        let vote = |votes: &mut Votes, ray: &[Visit]| {
            let hidden = |v: &Visit| occluded.steps_behind(v).is_some();
            let first = ray.iter().find(|v| hidden(v) || v.state == Occupancy::Occupied);
            let at = first.map(|v| usize::from(v.state != Occupancy::Occupied));
            at.into_iter().for_each(|k| votes[k] += 1);
            votes[2] += 1;
        };
        let value = |[occupied, occluded, all]: Votes| {
            let share = |n: usize| n as f64 / all.max(1) as f64;
            factor(0.2, share(occupied)) + factor(0.8, share(occluded))
        };
        rays::largest(situation, Reading::Published, vote, value)
    }
}

/// f_α: 0 at 0, 1 at α, 0 at 1, flat at 0 and at α.
fn factor(alpha: f64, x: f64) -> f64 {
    if x <= alpha {
        return (3.0 - 2.0 * x / alpha) * (x / alpha).powi(2);
    }
    let k = (alpha - 1.0).powi(3);
    (-2.0 * x.powi(3) + (3.0 * alpha + 3.0) * x.powi(2) - 6.0 * alpha * x + 3.0 * alpha - 1.0) / k
}

#[cfg(test)]
mod tests {
    use super::factor;

    #[test]
    fn the_factor_is_1_at_its_best_share_and_0_at_both_ends() {
        for alpha in [0.2, 0.8] {
            let at = |x| factor(alpha, x);
            assert_eq!((at(0.0), at(alpha)), (0.0, 1.0));
            assert!(at(1.0).abs() < 1e-12 && (at(alpha + 1e-9) - 1.0).abs() < 1e-6);
        }
        // Halfway to the best share, on either side: 3/4 − 2/8.
        assert!((factor(0.2, 0.1) - 0.5).abs() < 1e-12 && (factor(0.2, 0.6) - 0.5).abs() < 1e-12);
    }
}
