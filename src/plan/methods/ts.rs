//! T-S: two stages, first what tells the classes apart, then the surface.
//!
//! No formulas of the method are public; this is our reading of it. Until some
//! class that is still possible has all its rough shapes found, views are valued
//! by G_fd alone; from then on by G_so alone. Where the stage's own gain is 0
//! for every view the other one decides, for else chance would.

use rand_pcg::Pcg64;

use super::{Choice, Method, Situation};
use crate::plan::features::Existence;
use crate::rules::Class;

pub(super) struct TwoStages;

impl Method for TwoStages {
    fn name(&self) -> &'static str {
        "ts"
    }

    fn choose(&self, situation: &Situation<'_>, _: &mut Pcg64) -> Option<Choice> {
        let features: Vec<f64> = situation.gains.feature.iter().map(|g| g.bits).collect();
        let surfaces: Vec<f64> = situation.surfaces().into_iter().map(|n| n as f64).collect();
        let (own, other) = if has_found_a_rough_shape(situation) {
            (surfaces, features)
        } else {
            (features, surfaces)
        };
        let values = if own.iter().any(|value| *value > 0.0) {
            own
        } else {
            other
        };
        situation.largest(&values)
    }
}

/// Whether a class that is still possible has all its rough shapes found: the
/// features that no definite rule detects. One without any has.
fn has_found_a_rough_shape(situation: &Situation<'_>) -> bool {
    let (knowledge, status) = (situation.knowledge, situation.status);
    let found = |class: &Class| {
        let mut rough = knowledge
            .library
            .feature_ids()
            .filter(|id| class.presence.has(*id) && !knowledge.has_definite_rule(*id));
        rough.all(|id| status.feature(id).state == Existence::Detected)
    };
    let classes = knowledge.library.classes.iter().zip(&status.posterior);
    classes.filter(|(_, p)| **p > 0.0).any(|(class, _)| found(class))
}
