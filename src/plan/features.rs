//! Feature status: states, measured instances and predicted ones.
//!
//! Data only; `instances` merges measurements into it and `reasoning` moves the
//! states.

use std::collections::BTreeMap;

use super::inspection::{self, PredictedVoxel};
use crate::detect::{Evidence, Measurement};
use crate::geometry::Polygon;
use crate::map::{Tag, Voxel};
use crate::primitives::{Arguments, Envelope};
use crate::rules::Library;

/// es_i without the mark 4.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Existence {
    /// −1: nothing is known.
    Unknown,
    /// 0: inspected and not there. Final.
    Absent,
    /// 1: detected. Final.
    Detected,
    /// 2: every class still possible has it.
    Present,
    /// 3: no class still possible has it. Final.
    Excluded,
}

impl Existence {
    /// The paper's number.
    pub fn code(self) -> i8 {
        match self {
            Self::Unknown => -1,
            Self::Absent => 0,
            Self::Detected => 1,
            Self::Present => 2,
            Self::Excluded => 3,
        }
    }

    /// Whether the feature may still be detected: −1 or 2.
    pub fn is_open(self) -> bool {
        matches!(self, Self::Unknown | Self::Present)
    }
}

/// A measured instance f_ij.
#[derive(Clone, Debug)]
pub struct Found {
    /// Number among its feature's instances, from 1, in the order of detection.
    pub number: u32,
    /// What the detector found in all views; `None` for a shell.
    pub evidence: Option<Evidence>,
    /// Its attributes as measured now.
    pub measurement: Measurement,
    /// Its attributes as rules use them: they follow `measurement` only when it
    /// has moved by more than half a voxel, so that predictions stay put.
    pub anchor: Measurement,
    /// Names this anchor: another one has another revision.
    pub revision: u32,
    /// How it is measured anew when evidence comes in.
    pub measure: (String, Arguments),
    /// The edge at which a rule with antecedents found it.
    pub pin: Option<Pin>,
    /// Its key, as the log shows it.
    pub key: String,
}

/// A key that holds as long as the anchors it was made from do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pin {
    /// The instance's key, `bottom.1/edge.3`.
    pub key: String,
    /// Revisions of the antecedents' anchors.
    pub revisions: Vec<u32>,
}

/// A predicted instance f_ij, not measured.
#[derive(Clone, Debug)]
pub struct Predicted {
    /// Where it must be.
    pub polygons: Vec<Polygon>,
    /// PV_ij; never empty.
    pub voxels: Vec<PredictedVoxel>,
    /// Which looks count.
    pub envelope: Envelope,
    /// Its tag in the map.
    pub tag: Tag,
    /// The voxels it tags.
    pub tagged: Vec<Voxel>,
    /// Index of the rule whose prediction counts.
    pub rule: usize,
    /// Ids of all rules that predict it, in the library's order.
    pub by: Vec<String>,
    /// Number of visited views that cannot have been a look: its detector could
    /// not be run on them.
    pub blind: usize,
    /// What each visited view reached of `voxels`, one row a view; nothing in
    /// the blind ones.
    pub looks: Vec<Vec<bool>>,
    /// Which of `voxels` have a measured point within ξ.
    pub touched: Vec<bool>,
    /// Which of `voxels` are inspected.
    pub inspected: Vec<bool>,
}

impl Predicted {
    /// Inspected voxels over all.
    pub fn share(&self) -> f64 {
        let done = self.inspected.iter().filter(|i| **i).count();
        done as f64 / self.voxels.len().max(1) as f64
    }

    /// Whether at least `absent` (ξ_ned) of it is inspected.
    pub fn is_inspected(&self, absent: f64) -> bool {
        let done = self.inspected.iter().filter(|i| **i).count();
        inspection::reaches(done, self.voxels.len(), absent)
    }
}

/// The status of one feature.
#[derive(Clone, Debug)]
pub struct FeatureStatus {
    /// es_i.
    pub state: Existence,
    /// Measured instances by number.
    pub found: Vec<Found>,
    /// Predicted instances by key.
    pub predicted: BTreeMap<String, Predicted>,
}

impl FeatureStatus {
    fn unknown() -> Self {
        Self {
            state: Existence::Unknown,
            found: Vec::new(),
            predicted: BTreeMap::new(),
        }
    }

    /// The mark 4: not detected, and its place is predicted.
    pub fn is_predicted(&self) -> bool {
        self.state.is_open() && !self.predicted.is_empty()
    }

    /// Inspected share of the union of PV_ij over j, as counts: inspected, all.
    pub fn inspected_union(&self) -> (usize, usize) {
        let mut union: BTreeMap<Voxel, bool> = BTreeMap::new();
        for predicted in self.predicted.values() {
            for (voxel, inspected) in predicted.voxels.iter().zip(&predicted.inspected) {
                *union.entry(voxel.voxel).or_default() |= inspected;
            }
        }
        (union.values().filter(|i| **i).count(), union.len())
    }
}

/// All features unknown.
pub fn unknown(library: &Library) -> Vec<FeatureStatus> {
    library.features.iter().map(|_| FeatureStatus::unknown()).collect()
}
