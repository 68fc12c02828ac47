//! RSE: rear-side entropy (Delmerico et al. 2018).
//!
//! Over the rays that end on a surface: Σ vis_i · H(v_i) over the unbroken run of
//! unknown voxels before the end.

use rand_pcg::Pcg64;

use super::rays::{self, Reading};
use super::{Choice, Method, Situation};

pub(super) struct RearSideEntropy(pub Reading);

impl Method for RearSideEntropy {
    fn name(&self) -> &'static str {
        match self.0 {
            Reading::Published => "rse",
            Reading::Implemented => "rse_implemented",
        }
    }

    fn choose(&self, situation: &Situation<'_>, _: &mut Pcg64) -> Option<Choice> {
        rays::largest_sum(situation, self.0, |ray| {
            let Some((_, before)) = ray.split_last().filter(|_| rays::ends_occupied(ray)) else {
                return 0.0;
            };
            let run = before.iter().rev().take_while(|v| v.is_unknown()).count();
            let voxels = self.0.with_visibility(before).skip(before.len() - run);
            voxels.map(|(visibility, v)| visibility * v.entropy()).sum()
        })
    }
}
