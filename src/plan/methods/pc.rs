//! PC: proximity count (Delmerico et al. 2018).
//!
//! Σ over the occluded voxels on the rays of d_max − d: unmeasured space counts the
//! more, the nearer it lies behind a measured surface.

use rand_pcg::Pcg64;

use super::occluded::Occluded;
use super::rays::{self, Reading};
use super::{Choice, Method, Situation};

pub(super) struct ProximityCount;

impl Method for ProximityCount {
    fn name(&self) -> &'static str {
        "pc"
    }

    fn choose(&self, situation: &Situation<'_>, _: &mut Pcg64) -> Option<Choice> {
        let occluded = Occluded::of(situation.world, &situation.status.visited);
        rays::largest_sum(situation, Reading::Published, |ray| {
            let proximity = |v: &rays::Visit| occluded.steps_behind(v).map(|d| occluded.most - d);
            ray.iter().filter_map(proximity).map(f64::from).sum()
        })
    }
}
