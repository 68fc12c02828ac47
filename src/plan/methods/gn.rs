//! GN: the paper's planner without the overlap constraint (eqs. 8, 9, 12).

use rand_pcg::Pcg64;

use super::{Choice, Method, Situation};

pub(super) struct Gn;

impl Method for Gn {
    fn name(&self) -> &'static str {
        "gn"
    }

    fn choose(&self, situation: &Situation<'_>, _: &mut Pcg64) -> Option<Choice> {
        let gain = |position: usize| situation.gains.total(position);
        let gains: Vec<f64> = (0..situation.gains.views.len()).map(gain).collect();
        situation.largest(&gains)
    }
}
