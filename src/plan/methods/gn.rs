//! GN: the paper's planner without the overlap constraint (eqs. 8, 9, 12).

use rand_pcg::Pcg64;

use super::{Choice, Method, Situation};

pub(super) struct Gn;

impl Method for Gn {
    fn name(&self) -> &'static str {
        "gn"
    }

    fn choose(&self, situation: &Situation<'_>, _: &mut Pcg64) -> Option<Choice> {
        let positions = 0..situation.gains.views.len();
        let (position, score) = situation.best(positions.map(|k| (k, situation.gains.total(k))))?;
        Some(Choice {
            position,
            score,
            overlap: true,
            relaxed: false,
        })
    }
}
