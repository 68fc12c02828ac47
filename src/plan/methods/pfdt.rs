//! PFDT: each feature has its one view, and features are asked for in turn.
//!
//! Our reading: a feature's view is the candidate that shows most of the place
//! where the feature must be, whatever was inspected there already. The next
//! view is that of the undetected feature from which the largest drop of the
//! class entropy is expected, which is H(f_i | S). A feature whose view was
//! taken in vain is not asked for again, and while no place is known the nearest
//! view is taken.

use rand_pcg::Pcg64;
use rayon::prelude::*;

use super::{Choice, Method, Situation};
use crate::plan::features::{Existence, Predicted};
use crate::plan::{Viewpoint, score};
use crate::rules::FeatureId;

pub(super) struct Pfdt;

impl Method for Pfdt {
    fn name(&self) -> &'static str {
        "pfdt"
    }

    fn choose(&self, situation: &Situation<'_>, _: &mut Pcg64) -> Option<Choice> {
        let mut values = vec![0.0_f64; situation.gains.views.len()];
        for id in situation.knowledge.library.feature_ids() {
            let status = situation.status.feature(id);
            if status.state != Existence::Unknown {
                continue;
            }
            for predicted in status.predicted.values() {
                if let Some(position) = unvisited_view_of(situation, predicted) {
                    values[position] = values[position].max(expected_drop(situation, id));
                }
            }
        }
        situation.largest(&values)
    }
}

/// H(f_i | S), bits.
fn expected_drop(situation: &Situation<'_>, id: FeatureId) -> f64 {
    situation.status.weights[id.index()]
}

/// The one view of a predicted instance, as a position among the unvisited
/// views; `None` where it was taken or nothing shows the instance.
fn unvisited_view_of(situation: &Situation<'_>, predicted: &Predicted) -> Option<usize> {
    let shown = |view: &Viewpoint| score::shown_count(situation.world, view, predicted, situation.knowledge);
    let counts: Vec<usize> = situation.candidates.par_iter().map(shown).collect();
    let most = *counts.iter().max()?;
    let view = counts.iter().position(|n| *n == most && most > 0)?;
    situation.gains.views.binary_search(&view).ok()
}
