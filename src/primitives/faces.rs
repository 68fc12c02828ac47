//! Primitives that give a face or an edge of one.

use super::{Parameter, Primitive, Type};

/// Most corners of a written face.
pub const MOST_CORNERS: usize = 64;

pub(super) const ALL: &[Primitive] = &[
    Primitive {
        name: "polygon",
        result: Type::Polygon,
        features: &[],
        parameters: &[Parameter::required(
            "corners",
            Type::List(&Type::Point),
            "Its corners, counter-clockwise as seen from outside, 3 to 64; those of a bottom, which looks down, go clockwise as seen from above.",
        )],
        doc: "A planar face of known place; its first edge runs from the first corner to the second.",
    },
    Primitive {
        name: "edge_of",
        result: Type::Edge,
        features: &[],
        parameters: &[
            Parameter::required("face", Type::Polygon, "The face."),
            Parameter::required("number", Type::Count, "Which edge, from 1."),
        ],
        doc: "An edge of a face.",
    },
];
