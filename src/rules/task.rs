//! Tasks: goal, camera, space, candidate views and thresholds.

use serde::{Deserialize, Serialize};

use super::{Call, Place};
use crate::geometry::{Bounds, Camera, Point, Vector};

/// A perception task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Task {
    /// Name.
    pub name: String,
    /// Name of its library.
    pub library: String,
    /// Expected completion status.
    pub goal: Goal,
    /// The sensor.
    pub camera: Camera,
    /// The model space.
    pub space: Space,
    /// S_v, a views primitive; [`crate::primitives::views`] gives the poses.
    pub views: Call,
    /// ξ, ξ_ned, ξ_cfd.
    pub thresholds: Thresholds,
    /// Share that G_ovlp asks for.
    pub overlap: f64,
    /// The method of choosing views, lower case.
    pub method: String,
    /// Most measurements, the first included.
    pub limit: u32,
    /// Gains below this many voxels count as none.
    pub gain_floor: u32,
    /// How eq. 3 counts a voxel.
    pub inspected: Inspected,
    /// How it is decided what hides a voxel.
    pub visibility: Visibility,
    /// Whether every predicted feature of the winning class must be inspected
    /// before the class counts as confident.
    pub verify: bool,
    /// How measurements enter the map.
    #[serde(default)]
    pub insertion: Insertion,
    /// How measurements change a voxel.
    pub sensor_model: SensorModel,
    /// Where it was declared.
    pub place: Place,
}

/// The names of the methods of choosing views that a task can ask for.
///
/// `_implemented` is a method as its reference implementation has it, where that
/// is not what was published.
pub const METHODS: &[&str] = &[
    "gn",
    "gno",
    "joint",
    "joint2",
    "oa",
    "oa_implemented",
    "uv",
    "uv_implemented",
    "rsv",
    "rsv_implemented",
    "rse",
    "rse_implemented",
    "pc",
    "af",
    "ae",
    "ae_implemented",
    "ts",
    "pfdt",
    "random",
];

/// The parts of the completion status that must be reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Goal {
    /// s_cfd.
    pub confident: bool,
    /// s_ail.
    pub exhausted: bool,
}

/// The model space: an axis-aligned box of cubic voxels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Space {
    /// Centre, metres.
    #[cfg_attr(test, schemars(with = "[f64; 3]"))]
    pub centre: Point,
    /// Full extents, metres.
    #[cfg_attr(test, schemars(with = "[f64; 3]"))]
    pub size: Vector,
    /// Edge of a voxel, metres.
    pub voxel: f64,
}

/// Bytes that the map takes for a measured voxel away from surfaces, at most.
pub(crate) const BYTES_PER_VOXEL: f64 = 1.1;

impl Space {
    /// Bytes of a map of which everything was measured, about: one a voxel, where
    /// no brick of 8³ is of one value. Only what was measured takes any.
    pub fn map_bytes(&self) -> f64 {
        let voxels: f64 = self.size.iter().map(|side| (side / self.voxel).ceil()).product();
        voxels * BYTES_PER_VOXEL
    }

    /// The box.
    pub fn bounds(&self) -> Bounds {
        Bounds::centred(self.centre, self.size)
    }
}

/// ξ, ξ_ned, ξ_cfd.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Thresholds {
    /// ξ, metres.
    pub near: f64,
    /// ξ_ned, a share of the predicted voxels.
    pub absent: f64,
    /// ξ_cfd, a probability.
    pub confidence: f64,
}

/// When a predicted voxel counts as inspected.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Inspected {
    /// Eq. 3 to the letter: an observed point lies within ξ.
    NearPoint,
    /// An observed point lies within ξ, or the voxel was observed free.
    Observed,
}

/// Which voxels a measurement finds free.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Insertion {
    /// Those that a ray passes on its way to the centre of a voxel with a point: OctoMap's.
    #[default]
    Exact,
    /// Those whose centre lies nearer than the reading of the pixel that it falls on.
    Projective,
}

/// How it is decided whether something hides a voxel from a view.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Visibility {
    /// An occupied voxel lies on the line from its centre to the eye.
    Exact,
    /// An occupied voxel is nearer where its centre falls in the image.
    Centre,
}

/// OctoMap's sensor model, in probabilities.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SensorModel {
    /// P(occupied) after one hit.
    pub hit: f64,
    /// P(occupied) after one miss.
    pub miss: f64,
    /// Lower clamp.
    pub clamp_min: f64,
    /// Upper clamp.
    pub clamp_max: f64,
    /// Occupied from this probability on.
    pub occupied: f64,
}

impl Default for SensorModel {
    /// OctoMap's shipped values (Hornung et al. 2013).
    fn default() -> Self {
        Self {
            hit: 0.7,
            miss: 0.4,
            clamp_min: 0.1192,
            clamp_max: 0.971,
            occupied: 0.5,
        }
    }
}
