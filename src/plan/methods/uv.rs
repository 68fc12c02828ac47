//! UV: the information gain of unobserved voxels (Delmerico et al. 2018).
//!
//! As OA, over unknown voxels alone.

use rand_pcg::Pcg64;

use super::rays::{self, Reading};
use super::{Choice, Method, Situation};

pub(super) struct UnobservedVoxel(pub Reading);

impl Method for UnobservedVoxel {
    fn name(&self) -> &'static str {
        match self.0 {
            Reading::Published => "uv",
            Reading::Implemented => "uv_implemented",
        }
    }

    fn choose(&self, situation: &Situation<'_>, _: &mut Pcg64) -> Option<Choice> {
        rays::largest_sum(situation, self.0, |ray| {
            let unknown = self.0.with_visibility(ray).filter(|(_, v)| v.is_unknown());
            unknown.map(|(visibility, v)| visibility * v.entropy()).sum()
        })
    }
}
