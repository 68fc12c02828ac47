//! The row of a run: one line of `runs.jsonl`.

use serde::{Deserialize, Serialize};

/// What a run came to. Lengths are metres; shares are rounded to a millionth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// Its place in the order of the study.
    pub run: u64,
    /// The study.
    pub suite: String,
    /// The object.
    pub object: String,
    /// The method, or `bound`, `oracle`.
    pub method: String,
    /// The variant of the task; empty for the study's own settings.
    pub variant: String,
    /// What happened to depth.
    pub noise: String,
    /// First view.
    pub start: usize,
    /// Seed.
    pub seed: u64,
    /// As in a run log; `bound` and `oracle` for those.
    pub outcome: String,
    /// Measurements, the first included.
    pub views: u32,
    /// The class that the run is certain of.
    pub class: Option<String>,
    /// The class of the object, where it has one.
    pub truth: Option<String>,
    /// Share of the observable surface that was measured.
    pub coverage: Option<f64>,
    /// Measurements until 95 % were; none where that never came.
    pub to95: Option<u32>,
    /// Measurements until 97 % were.
    pub to97: Option<u32>,
    /// Measurements until 99 % were.
    pub to99: Option<u32>,
    /// Mean coverage over all measurements that the limit allows.
    pub area: Option<f64>,
    /// Length of the camera's path, straight from view to view.
    pub path: f64,
    /// Coverage after each measurement.
    pub curve: Vec<f64>,
    /// The views in order.
    pub sequence: Vec<usize>,
    /// The measurement that first decoded a marker.
    pub first: Option<u32>,
    /// The best expected number of measurements from that one on, itself included.
    pub best_from_first: Option<f64>,
    /// Of `bound`: the best expected number of measurements over all classes.
    pub expected: Option<f64>,
    /// Of `bound`: whether as few are known to do; otherwise more may be needed.
    pub closed: Option<bool>,
}

impl Row {
    /// The line without its end.
    pub fn to_line(&self) -> String {
        serde_json::to_string(self).unwrap_or_else(|error| unreachable!("a row is plain data: {error}"))
    }

    /// Measurements from the first decoded marker on.
    pub fn from_first(&self) -> Option<u32> {
        self.first.map(|first| self.views - first.min(self.views) + 1)
    }
}

/// To a millionth, so that no last bit of a sum is kept.
pub fn rounded(x: f64) -> f64 {
    (x * 1e6).round() / 1e6
}
