//! OA: occlusion-aware information gain (Delmerico et al. 2018).
//!
//! Σ over rays and their voxels of vis_i · H(v_i).

use rand_pcg::Pcg64;

use super::rays::{self, Reading};
use super::{Choice, Method, Situation};

pub(super) struct OcclusionAware(pub Reading);

impl Method for OcclusionAware {
    fn name(&self) -> &'static str {
        match self.0 {
            Reading::Published => "oa",
            Reading::Implemented => "oa_implemented",
        }
    }

    fn choose(&self, situation: &Situation<'_>, _: &mut Pcg64) -> Option<Choice> {
        rays::largest_sum(situation, self.0, |ray| {
            let voxels = self.0.with_visibility(ray);
            voxels.map(|(visibility, v)| visibility * v.entropy()).sum()
        })
    }
}
