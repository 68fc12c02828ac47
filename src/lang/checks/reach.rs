//! Which features can ever be detected.

use crate::rules::Library;

/// By feature: whether some chain of rules that begins with a definite one ends in it.
pub(super) fn detectable(library: &Library) -> Vec<bool> {
    let mut reached = vec![false; library.features.len()];
    loop {
        let mut grew = false;
        for rule in &library.rules {
            let fires = rule.antecedents.iter().all(|a| reached[a.index()]);
            if fires && !std::mem::replace(&mut reached[rule.consequent.index()], true) {
                grew = true;
            }
        }
        if !grew {
            return reached;
        }
    }
}
