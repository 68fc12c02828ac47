//! AE: average entropy (Delmerico et al. 2018).
//!
//! The mean entropy of all voxels on the rays that end on a surface.

use rand_pcg::Pcg64;

use super::rays::{self, Reading, Visit};
use super::{Choice, Method, Situation};

pub(super) struct AverageEntropy(pub Reading);

impl Method for AverageEntropy {
    fn name(&self) -> &'static str {
        match self.0 {
            Reading::Published => "ae",
            Reading::Implemented => "ae_implemented",
        }
    }

    fn choose(&self, situation: &Situation<'_>, _: &mut Pcg64) -> Option<Choice> {
        let count = |(sum, n): &mut (f64, usize), ray: &[Visit]| {
            if rays::ends_occupied(ray) {
                *sum += ray.iter().map(Visit::entropy).sum::<f64>();
                *n += ray.len();
            }
        };
        rays::largest(situation, self.0, count, |(sum, n)| sum / n.max(1) as f64)
    }
}
