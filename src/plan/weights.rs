//! Weights w_i of eq. 9, in bits.
//!
//! In state −1 the weight is H(f_i | S), the entropy of the feature's existence
//! under the class posterior: presence is a function of the class, so this is
//! what one learns about the class. In state 2 it is half of the least positive
//! weight among the features in state −1, or 1 where there is none.

use super::features::Existence;

/// Entropy of an event of probability `p`, bits. Certain up to rounding is certain.
pub fn entropy(p: f64) -> f64 {
    let term = |q: f64| -q * q.log2();
    if (1e-12..=1.0 - 1e-12).contains(&p) {
        term(p) + term(1.0 - p)
    } else {
        0.0
    }
}

/// The weights, given states and probabilities of existence in feature order.
/// `spent` features (in state 2, inspected, and not to be proven) weigh nothing.
pub fn weights(states: &[Existence], existence: &[f64], spent: &[bool]) -> Vec<f64> {
    let entropies: Vec<f64> = existence.iter().map(|p| entropy(*p)).collect();
    let open = states.iter().zip(&entropies).filter(|(s, _)| **s == Existence::Unknown);
    let least = open.map(|(_, h)| *h).filter(|h| *h > 0.0).min_by(f64::total_cmp);
    let present = least.map_or(1.0, |h| h / 2.0);
    let weight = |k: usize| match states[k] {
        Existence::Unknown => entropies[k],
        Existence::Present if !spent[k] => present,
        _ => 0.0,
    };
    (0..states.len()).map(weight).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use Existence::{Absent, Detected, Excluded, Present, Unknown};

    #[test]
    fn entropy_is_that_of_a_coin() {
        assert_eq!((entropy(0.0), entropy(0.5), entropy(1.0)), (0.0, 1.0, 0.0));
        assert!((entropy(0.25) - 0.811_278).abs() < 1e-6);
    }

    #[test]
    fn what_must_exist_weighs_half_of_the_least_open_one() {
        let states = [Unknown, Present, Unknown, Detected, Absent, Excluded, Present];
        let p = [0.25, 1.0, 0.5, 1.0, 0.0, 0.0, 1.0];
        let spent = [false, false, false, false, false, false, true];
        let w = weights(&states, &p, &spent);
        assert!((w[1] - 0.811_278 / 2.0).abs() < 1e-6);
        assert_eq!((w[2], &w[3..]), (1.0, [0.0; 4].as_slice()));
    }

    #[test]
    fn with_nothing_open_what_must_exist_weighs_one() {
        assert_eq!(weights(&[Present, Detected], &[1.0, 1.0], &[false; 2]), [1.0, 0.0]);
        // An open feature of no entropy is no measure for the others.
        assert_eq!(weights(&[Present, Unknown], &[1.0, 1.0], &[false; 2]), [1.0, 0.0]);
    }
}
