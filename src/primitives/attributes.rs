//! The attributes that a measured feature has, by kind.

use super::Type;
use crate::rules::FeatureKind;

/// An attribute of a measured feature.
#[derive(Clone, Copy, Debug)]
pub struct Attribute {
    /// Its name after the dot.
    pub name: &'static str,
    /// Its type.
    pub ty: Type,
    /// One sentence.
    pub doc: &'static str,
}

const fn attribute(name: &'static str, ty: Type, doc: &'static str) -> Attribute {
    Attribute { name, ty, doc }
}

const POLYGON: &[Attribute] = &[
    attribute(
        "edges",
        Type::Edges,
        "All edges in order, the face to the left of each as seen from outside.",
    ),
    attribute("base", Type::Edge, "The first edge."),
    attribute("apex", Type::Point, "The vertex farthest from the first edge."),
    attribute("centre", Type::Point, "The centre of area."),
    attribute("normal", Type::Direction, "The outward unit normal."),
    attribute(
        "height",
        Type::Length,
        "The largest distance of a vertex from the line of the first edge.",
    ),
];
const MARKER: &[Attribute] = &[
    attribute(
        "pose",
        Type::Pose,
        "The marker's frame: x right and y up on the print, z out of it.",
    ),
    attribute("centre", Type::Point, "The centre of the code."),
    attribute("normal", Type::Direction, "The outward unit normal."),
];
const SHELL: &[Attribute] = &[attribute("centre", Type::Point, "The mean of its vertices.")];

/// The attributes of a kind of feature.
pub fn attributes(kind: FeatureKind) -> &'static [Attribute] {
    match kind {
        FeatureKind::Polygon => POLYGON,
        FeatureKind::Marker => MARKER,
        FeatureKind::Shell => SHELL,
    }
}
