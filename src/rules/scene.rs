//! Scenes: what the simulator shows.

use serde::{Deserialize, Serialize};

use super::{Call, Colour, Place};
use crate::geometry::Pose;

/// Objects for the simulator and what stands behind them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Name.
    pub name: String,
    /// What the camera sees beside the object; `None` is empty air.
    pub backdrop: Option<Backdrop>,
    /// The objects; a run shows one of them.
    pub objects: Vec<SceneObject>,
    /// Where it was declared.
    pub place: Place,
}

/// A closed sphere about the centre of the space, seen from inside.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Backdrop {
    /// Radius, metres.
    pub radius: f64,
    /// Colour.
    pub colour: Colour,
}

/// An object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct SceneObject {
    /// Name; for recognition, the true class.
    pub name: String,
    /// A shape primitive.
    pub shape: Call,
    /// Where it is: `world_from_object`.
    #[cfg_attr(test, schemars(with = "super::schema::Pose"))]
    pub world_from_object: Pose,
    /// Markers on it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub markers: Vec<Marker>,
    /// Where it was declared.
    pub place: Place,
}

/// A printed QR code.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Marker {
    /// The text it encodes.
    pub text: String,
    /// Edge of the square of modules, metres; four modules of quiet zone lie around it.
    pub size: f64,
    /// `object_from_marker`: x right and y up on the print, z out of it, the
    /// origin at the centre of the code.
    #[cfg_attr(test, schemars(with = "super::schema::Pose"))]
    pub object_from_marker: Pose,
}
