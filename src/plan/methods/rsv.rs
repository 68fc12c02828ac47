//! RSV: rear-side voxels (Delmerico et al. 2018).
//!
//! The number of rays that reach an occupied voxel straight out of an unknown one:
//! they look at the back of a measured surface.

use rand_pcg::Pcg64;

use super::rays::{self, Reading, Visit};
use super::{Choice, Method, Situation};

pub(super) struct RearSideVoxel(pub Reading);

impl Method for RearSideVoxel {
    fn name(&self) -> &'static str {
        match self.0 {
            Reading::Published => "rsv",
            Reading::Implemented => "rsv_implemented",
        }
    }

    fn choose(&self, situation: &Situation<'_>, _: &mut Pcg64) -> Option<Choice> {
        let from_behind = |ray: &[Visit]| match ray {
            [.., before, _] => before.is_unknown() && rays::ends_occupied(ray),
            _ => false,
        };
        rays::largest_sum(situation, self.0, |ray| f64::from(from_behind(ray)))
    }
}
