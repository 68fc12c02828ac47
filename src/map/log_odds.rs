//! OctoMap's sensor model in fixed point.
//!
//! Log-odds are kept as `i8` in units of `1 / scale`. The scale is the one at
//! which a miss is a whole number of units and a hit comes nearest to one,
//! among those at which both clamps fit ±127. With the shipped model a hit is
//! +23, a miss −11 and the clamps are −54 and +95 (exact: 23.0, −11, −54.3,
//! 95.2): hits and misses that outweigh each other do so as in OctoMap.
//!
//! A voxel's value is its log-odds plus 128 as a `u8`, which leaves 0 for a voxel
//! that was never measured and orders values as log-odds; every processor has the
//! saturating operations on unsigned bytes.

use crate::rules::SensorModel;

/// Value of a voxel that was never measured.
pub(super) const UNKNOWN: u8 = 0;
/// Value of log-odds 0.
const EVEN: u8 = 128;

/// A sensor model in units of `1 / scale`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LogOdds {
    hit: Change,
    miss: Change,
    /// Clamps, as values.
    min: u8,
    max: u8,
    /// Occupied from this value on.
    occupied: u8,
    scale: f64,
}

/// What a look adds and takes away; one of them is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Change {
    up: u8,
    down: u8,
}

impl Change {
    fn by(units: i8) -> Self {
        let size = units.unsigned_abs();
        if units > 0 {
            Self { up: size, down: 0 }
        } else {
            Self { up: 0, down: size }
        }
    }
}

impl LogOdds {
    /// The nearest fixed-point model. Probabilities are kept at least a
    /// millionth from 0 and 1; a hit or a miss other than 0.5 moves a voxel by
    /// at least one unit.
    pub fn quantised(model: &SensorModel) -> Self {
        let [hit, miss] = [model.hit, model.miss].map(logit);
        let clamps = [model.clamp_min, model.clamp_max].map(logit);
        let limit = clamps[0].abs().max(clamps[1].abs()).max(1e-3);
        let scale = best_scale(hit, miss, 127.0 / limit);
        let (low, high) = (clamps[0].min(clamps[1]), clamps[0].max(clamps[1]));
        Self {
            hit: Change::by(at_least_one(hit, scale)),
            miss: Change::by(at_least_one(miss, scale)),
            min: value(units(low, scale)),
            max: value(units(high, scale)),
            occupied: value(units(logit(model.occupied), scale)),
            scale,
        }
    }

    /// A value after a look: `hit` and `miss` are all ones for the one that it
    /// was and 0 for the other. With neither, a clamped value of what was known.
    #[inline(always)]
    pub fn moved(&self, value: u8, hit: u8, miss: u8) -> u8 {
        let known = if value == UNKNOWN { EVEN } else { value };
        let up = (self.hit.up & hit) | (self.miss.up & miss);
        let down = (self.hit.down & hit) | (self.miss.down & miss);
        known
            .saturating_add(up)
            .saturating_sub(down)
            .max(self.min)
            .min(self.max)
    }

    /// A value after a miss.
    #[inline(always)]
    pub fn missed(&self, value: u8) -> u8 {
        self.moved(value, 0, u8::MAX)
    }

    /// The least value that is occupied.
    #[inline(always)]
    pub fn occupied_from(&self) -> u8 {
        self.occupied
    }

    /// Whether a voxel of this value was measured and is occupied.
    #[inline(always)]
    pub fn is_occupied(&self, value: u8) -> bool {
        value >= self.occupied
    }

    /// The probability that the value of a measured voxel stands for.
    pub fn probability(&self, value: u8) -> f64 {
        let units = f64::from(value) - f64::from(EVEN);
        1.0 / (1.0 + (-units / self.scale).exp())
    }
}

fn value(units: i8) -> u8 {
    units.cast_unsigned() ^ EVEN
}

fn logit(p: f64) -> f64 {
    let p = if p.is_nan() { 0.5 } else { p.clamp(1e-6, 1.0 - 1e-6) };
    (p / (1.0 - p)).ln()
}

/// Among the scales up to `most` that make a miss a whole number of units, the
/// one that brings a hit nearest to whole relative to its size.
fn best_scale(hit: f64, miss: f64, most: f64) -> f64 {
    let whole = (miss.abs() * most).min(127.0) as u32;
    let rounding = |scale: f64| {
        let exact = hit.abs() * scale;
        (exact.round().max(1.0) - exact).abs() / exact
    };
    (1..=whole)
        .map(|units| f64::from(units) / miss.abs())
        .min_by(|a, b| rounding(*a).total_cmp(&rounding(*b)))
        .unwrap_or(most)
}

fn units(log_odds: f64, scale: f64) -> i8 {
    (log_odds * scale).round().clamp(-127.0, 127.0) as i8
}

fn at_least_one(log_odds: f64, scale: f64) -> i8 {
    match units(log_odds, scale) {
        0 if log_odds > 1e-9 => 1,
        0 if log_odds < -1e-9 => -1,
        n => n,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shipped_model_has_the_documented_units() {
        let m = LogOdds::quantised(&SensorModel::default());
        assert_eq!((m.hit, m.miss), (Change::by(23), Change::by(-11)));
        assert_eq!([m.min, m.max, m.occupied], [-54, 95, 0].map(value));
        assert!((m.probability(value(23)) - 0.7).abs() < 1e-3);
        assert!((m.probability(value(-11)) - 0.4).abs() < 1e-3);
        assert!((m.probability(m.max) - 0.971).abs() < 1e-3);
    }

    /// All sequences of 16 hits and misses end in the state that OctoMap's
    /// floating-point update gives.
    #[test]
    fn no_sequence_of_looks_tells_it_from_octomap() {
        let model = SensorModel::default();
        let m = LogOdds::quantised(&model);
        for looks in 0_u32..1 << 16 {
            let (mut ours, mut exact) = (UNKNOWN, 0.0_f64);
            for i in 0..16 {
                let hit = looks >> i & 1 == 1;
                ours = if hit { m.moved(ours, u8::MAX, 0) } else { m.missed(ours) };
                exact += logit(if hit { model.hit } else { model.miss });
                exact = exact.clamp(logit(model.clamp_min), logit(model.clamp_max));
                assert_eq!(m.is_occupied(ours), exact >= 0.0, "look {i} of {looks:016b}");
            }
        }
    }

    #[test]
    fn weak_looks_still_count_and_odd_models_stay_finite() {
        let weak = LogOdds::quantised(&SensorModel {
            hit: 0.501,
            miss: 0.499,
            clamp_min: 0.0,
            clamp_max: 1.0,
            occupied: 0.5,
        });
        assert_eq!((weak.hit, weak.miss), (Change::by(1), Change::by(-1)));
        let odd = LogOdds::quantised(&SensorModel {
            hit: f64::NAN,
            miss: 0.5,
            clamp_min: 0.5,
            clamp_max: 0.5,
            occupied: 2.0,
        });
        assert_eq!(
            (odd.hit, odd.miss, odd.occupied),
            (Change::by(0), Change::by(0), u8::MAX)
        );
        assert_eq!(odd.missed(UNKNOWN), EVEN, "a look that says nothing is still a look");
    }
}
