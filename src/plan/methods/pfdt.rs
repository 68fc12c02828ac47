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
use crate::plan::{Look, Viewpoint, score};
use crate::rules::FeatureId;

pub(super) struct Pfdt;

impl Method for Pfdt {
    fn name(&self) -> &'static str {
        "pfdt"
    }

    fn choose(&self, situation: &Situation<'_>, _: &mut Pcg64) -> Option<Choice> {
        let status = situation.status;
        let asked = |id: &FeatureId| status.feature(*id).state == Existence::Unknown;
        let features = situation.knowledge.library.feature_ids().filter(asked);
        let places: Vec<(FeatureId, &Predicted)> = features
            .flat_map(|id| {
                status
                    .feature(id)
                    .predicted
                    .values()
                    .map(move |predicted| (id, predicted))
            })
            .collect();
        let shown = shown(situation, &places);
        let mut values = vec![0.0_f64; situation.gains.views.len()];
        for (k, (id, _)) in places.iter().enumerate() {
            let counts: Vec<usize> = shown.iter().map(|view| view[k]).collect();
            if let Some(position) = unvisited_view_of(situation, &counts) {
                values[position] = values[position].max(expected_drop(situation, *id));
            }
        }
        situation.largest(&values)
    }
}

/// What every candidate view shows of some places, in voxels.
fn shown(situation: &Situation<'_>, places: &[(FeatureId, &Predicted)]) -> Vec<Vec<usize>> {
    let knowledge = situation.knowledge;
    let views = situation.candidates.par_iter();
    let shown = |view: &Viewpoint| {
        let look = Look::of(situation.world, view, knowledge.criteria.visibility);
        let of = |(_, predicted): &(FeatureId, &Predicted)| score::shown_count(&look, predicted, knowledge);
        places.iter().map(of).collect()
    };
    views.map(shown).collect()
}

/// H(f_i | S), bits.
fn expected_drop(situation: &Situation<'_>, id: FeatureId) -> f64 {
    situation.status.weights[id.index()]
}

/// The one view of a predicted instance, as a position among the unvisited
/// views; `None` where it was taken or nothing shows the instance.
fn unvisited_view_of(situation: &Situation<'_>, counts: &[usize]) -> Option<usize> {
    let most = *counts.iter().max()?;
    let view = counts.iter().position(|n| *n == most && most > 0)?;
    situation.gains.views.binary_search(&view).ok()
}
