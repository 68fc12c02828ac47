//! Means with bootstrap intervals.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Resamples of a bootstrap.
const RESAMPLES: usize = 2_000;
/// All intervals are drawn from the same stream.
const SEED: u64 = 0xb007_57a9;

/// A mean and the 95 % interval around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The mean.
    pub mean: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Interval {
    /// Whether it has 0 on one side.
    pub fn excludes_zero(&self) -> bool {
        self.low > 0.0 || self.high < 0.0
    }
}

/// The mean; `None` of nothing.
pub fn mean(values: &[f64]) -> Option<f64> {
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// The mean of independent values with its percentile bootstrap interval (Efron 1979).
/// `None` of nothing.
pub fn bootstrap(values: &[f64]) -> Option<Interval> {
    let mean = mean(values)?;
    let mut random = Pcg64::seed_from_u64(SEED);
    let n = values.len();
    let resample = |_| (0..n).map(|_| values[random.random_range(0..n)]).sum::<f64>() / n as f64;
    let mut means: Vec<f64> = (0..RESAMPLES).map(resample).collect();
    means.sort_by(f64::total_cmp);
    let at = |share: f64| means[((RESAMPLES - 1) as f64 * share).round() as usize];
    Some(Interval {
        mean,
        low: at(0.025),
        high: at(0.975),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_is_as_wide_as_its_values_spread() {
        assert_eq!(bootstrap(&[]), None);
        let same = bootstrap(&[3.0; 10]).unwrap();
        assert_eq!((same.mean, same.low, same.high), (3.0, 3.0, 3.0));
        // σ of the mean is 0.5 for 100 values of −5 and 5.
        let spread: Vec<f64> = (0..100).map(|k| if k % 2 == 0 { 5.0 } else { -5.0 }).collect();
        let interval = bootstrap(&spread).unwrap();
        assert_eq!(interval.mean, 0.0);
        assert!(
            (interval.high - 0.98).abs() < 0.15 && (interval.low + 0.98).abs() < 0.15,
            "{interval:?}"
        );
        assert!(!interval.excludes_zero() && bootstrap(&[1.0, 2.0]).unwrap().excludes_zero());
    }
}
