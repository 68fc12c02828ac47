//! Random: uniform over the unvisited views.

use rand::RngExt;
use rand_pcg::Pcg64;

use super::{Choice, Method, Rank, Situation};

pub(super) struct Random;

impl Method for Random {
    fn name(&self) -> &'static str {
        "random"
    }

    fn choose(&self, situation: &Situation<'_>, random: &mut Pcg64) -> Option<Choice> {
        let count = situation.gains.views.len();
        (count > 0).then(|| Choice {
            best: Rank {
                position: random.random_range(0..count),
                score: 0.0,
                overlap: true,
                share: None,
            },
            relaxed: false,
            rivals: Vec::new(),
            worth: None,
        })
    }
}
