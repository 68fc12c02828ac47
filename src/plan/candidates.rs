//! Candidate status: which classes are still possible, and how likely (eq. 7).

use super::features::Existence;
use crate::rules::{FeatureId, Library};

/// P(class_m | S_es): the priors of the classes that no detected state (1 or 0)
/// contradicts, normalised. All 0 where every class is excluded.
pub fn posterior(library: &Library, states: &[Existence]) -> Vec<f64> {
    let likelihood = |m: usize| {
        let class = &library.classes[m];
        let fits = |id: FeatureId| match states[id.index()] {
            Existence::Detected => class.presence.has(id),
            Existence::Absent => !class.presence.has(id),
            _ => true,
        };
        if library.feature_ids().all(fits) {
            class.prior
        } else {
            0.0
        }
    };
    let joint: Vec<f64> = (0..library.classes.len()).map(likelihood).collect();
    let total: f64 = joint.iter().sum();
    if total > 0.0 {
        joint.iter().map(|p| p / total).collect()
    } else {
        vec![0.0; joint.len()]
    }
}

/// p_i = Σ_m P(class_m | S)·ext_i^m: how likely a feature exists.
pub fn presence(library: &Library, posterior: &[f64], feature: FeatureId) -> f64 {
    let classes = library.classes.iter().zip(posterior);
    classes.filter(|(c, _)| c.presence.has(feature)).map(|(_, p)| p).sum()
}

/// Whether every class (`true`) or no class (`false`) still possible has a
/// feature (eqs. 4 and 5 over the remaining classes); `None` where they differ
/// or none is possible.
pub fn settled(library: &Library, posterior: &[f64], feature: FeatureId) -> Option<bool> {
    let possible = library.classes.iter().zip(posterior).filter(|(_, p)| **p > 0.0);
    let mut has = possible.map(|(c, _)| c.presence.has(feature));
    let first = has.next()?;
    has.all(|h| h == first).then_some(first)
}
