//! Detectors and measures: from pixels and depth to features.

use crate::geometry::Point;
use crate::geometry::{Polygon, Pose};
use crate::map::Map;
use crate::primitives::Arguments;
use crate::rules::{BadArgument, Space};
use crate::sense::Observation;

/// An observation prepared for detection: clipped to the space, with normals
/// and planar regions found once for all rules.
pub struct Scan {
    _todo: (),
}

/// What a detector found, kept so that views of one feature can be merged.
#[derive(Clone, Debug)]
pub enum Evidence {
    /// Points of a planar face.
    Face(FaceEvidence),
    /// Looks at a marker.
    Marker(MarkerEvidence),
}

/// Points of a planar face.
#[derive(Clone, Debug)]
pub struct FaceEvidence {
    /// Measured points, world axes.
    pub points: Vec<Point>,
}

/// Looks at a marker.
#[derive(Clone, Debug)]
pub struct MarkerEvidence {
    /// `world_from_marker` of each look.
    pub looks: Vec<Pose>,
}

/// The attributes of a measured instance.
#[derive(Clone, Debug, PartialEq)]
pub enum Measurement {
    /// A planar face.
    Face(Polygon),
    /// A marker.
    Marker {
        /// `world_from_marker`: x right, y up on the print, z out of it.
        pose: Pose,
        /// Edge of the square of modules, metres.
        size: f64,
    },
    /// The faces of a rough shape.
    Shell(Vec<Polygon>),
}

#[allow(unused_variables)]
impl Scan {
    /// Prepares an observation.
    pub fn new(observation: &Observation, space: &Space) -> Self {
        todo!()
    }
}

/// proof() of a polygon or marker rule on one view: every instance it finds.
#[allow(unused_variables)]
pub fn detect(primitive: &str, arguments: &Arguments, scan: &Scan) -> Result<Vec<Evidence>, BadArgument> {
    todo!()
}

/// proof() of a shell rule: whether enough of its predicted surface was measured.
#[allow(unused_variables)]
pub fn shell_proven(
    primitive: &str,
    arguments: &Arguments,
    predicted: &[Point],
    map: &Map,
    near: f64,
) -> Result<bool, BadArgument> {
    todo!()
}

/// cal(): the attributes of what was found; `None` where the evidence is too poor.
#[allow(unused_variables)]
pub fn measure(
    primitive: &str,
    arguments: &Arguments,
    evidence: &Evidence,
) -> Result<Option<Measurement>, BadArgument> {
    todo!()
}

#[allow(unused_variables)]
impl Evidence {
    /// Adds another view's evidence of the same instance.
    pub fn merge(&mut self, other: Evidence) {
        todo!()
    }
}

#[allow(unused_variables)]
impl Measurement {
    /// Whether two measurements are of one instance: the polygons overlap by
    /// half of the smaller within 2 ξ and 15°.
    pub fn same_instance(&self, other: &Measurement, near: f64) -> bool {
        todo!()
    }

    /// Whether an antecedent moved so far that predictions from it must be
    /// made anew: a vertex or the marker's centre by more than `distance` metres.
    pub fn moved(&self, from: &Measurement, distance: f64) -> bool {
        todo!()
    }
}
