//! Predictors (pred functions): where a feature must be, given others.

use super::{Parameter, Primitive, Type};
use crate::rules::FeatureKind;

pub(super) const ALL: &[Primitive] = &[
    Primitive {
        name: "rectangle_on",
        result: Type::Predictor,
        features: &[FeatureKind::Polygon],
        parameters: &[
            Parameter::required("on", Type::Edge, "The common edge."),
            Parameter::required(
                "dihedral",
                Type::Angle,
                "The angle inside the object between the two faces.",
            ),
            Parameter::required("height", Type::Length, "How far the rectangle reaches from the edge."),
        ],
        doc: "Strong: a rectangle on a common edge at a dihedral angle.",
    },
    Primitive {
        name: "rectangle_by_marker",
        result: Type::Predictor,
        features: &[FeatureKind::Polygon],
        parameters: &[
            Parameter::required("marker", Type::Pose, "Pose of a detected marker, like `label.pose`."),
            Parameter::required(
                "at",
                Type::Point,
                "Centre of the face in the marker's axes: x right and y up on the print, z out of it.",
            ),
            Parameter::required(
                "facing",
                Type::Direction,
                "Which way the face looks, in the marker's axes.",
            ),
            Parameter::required(
                "width",
                Type::Length,
                "Its horizontal extent as one looks at it with the marker's y up, its z where it looks along y.",
            ),
            Parameter::required("height", Type::Length, "Its other extent."),
        ],
        doc: "Strong: a rectangular face whose place on the object a marker tells.",
    },
    Primitive {
        name: "triangle_to",
        result: Type::Predictor,
        features: &[FeatureKind::Polygon],
        parameters: &[
            Parameter::required("on", Type::Edge, "The common edge."),
            Parameter::required("apex", Type::Point, "The third vertex."),
        ],
        doc: "Strong: the triangle of a common edge and an apex, apex first.",
    },
    Primitive {
        name: "completed_square",
        result: Type::Predictor,
        features: &[FeatureKind::Polygon],
        parameters: &[
            Parameter::required(
                "edges",
                Type::List(&Type::Edge),
                "The common edges that are known, one or more, end to end.",
            ),
            Parameter::required("facing", Type::Direction, "Which way the face looks, roughly."),
        ],
        doc: "Weak: the missing edges are completed to a square.\n\nThe square stands on the line that joins the free ends of the known edges (paper, Fig. 4), on the object's side of it.",
    },
    Primitive {
        name: "prism_over",
        result: Type::Predictor,
        features: &[FeatureKind::Shell],
        parameters: &[
            Parameter::required("base", Type::Polygon, "The bottom face."),
            Parameter::required("height", Type::Length, "The height over it."),
        ],
        doc: "Strong: all faces of the upright prism over a base, the base included.",
    },
    Primitive {
        name: "pyramid_over",
        result: Type::Predictor,
        features: &[FeatureKind::Shell],
        parameters: &[
            Parameter::required("base", Type::Polygon, "The bottom face."),
            Parameter::required("apex", Type::Point, "The apex."),
        ],
        doc: "Strong: all faces of the pyramid over a base, the base included.",
    },
    Primitive {
        name: "rigid_marker",
        result: Type::Predictor,
        features: &[FeatureKind::Marker],
        parameters: &[
            Parameter::required("antecedent", Type::Pose, "Pose of the detected marker, world axes."),
            Parameter::required(
                "antecedent_from_consequent",
                Type::Pose,
                "The layout: the consequent's pose in the antecedent's frame.",
            ),
            Parameter::required(
                "size",
                Type::Length,
                "Edge of the predicted square: the code with its quiet zone.",
            ),
        ],
        doc: "Strong: a marker that a rigid layout ties to a detected one. Layouts lower to it.",
    },
];

/// How certain a prediction is: what is strong goes before what is weak.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Strength {
    /// Every vertex follows.
    Strong,
    /// Only common edges are known.
    Weak,
}

/// The strength of a predictor.
pub fn strength(name: &str) -> Strength {
    if name == "completed_square" {
        Strength::Weak
    } else {
        Strength::Strong
    }
}
