//! Measures (cal functions): from a detection to a feature's attributes.

use super::{Parameter, Primitive, Type};
use crate::rules::{FeatureKind, Value};

pub(super) const ALL: &[Primitive] = &[
    Primitive {
        name: "outline",
        result: Type::Measure,
        features: &[FeatureKind::Polygon],
        parameters: &[
            Parameter::or(
                "begin",
                Type::Choice(&["any", "lowest", "apex"]),
                || Value::Choice("any".into()),
                "What the order begins with: any vertex, the lowest edge, or the vertex farthest from that edge.",
            ),
            Parameter::optional(
                "first",
                Type::Edge,
                "The edge of another face: the outline's edge nearest to it takes the place of the lowest.",
            ),
        ],
        doc: "The outline of a planar face as ordered vertices and a normal.\n\nVertices run counter-clockwise as seen from outside.",
    },
    Primitive {
        name: "marker_pose",
        result: Type::Measure,
        features: &[FeatureKind::Marker],
        parameters: &[],
        doc: "A marker's pose, from its corners in the colour image and the depth behind them.",
    },
    Primitive {
        name: "rough_shape",
        result: Type::Measure,
        features: &[FeatureKind::Shell],
        parameters: &[],
        doc: "The predicted faces of a proven rough shape.",
    },
];
