//! Primitives that give a point.

use super::{Parameter, Primitive, Type};

pub(super) const ALL: &[Primitive] = &[Primitive {
    name: "behind",
    result: Type::Point,
    features: &[],
    parameters: &[
        Parameter::required("face", Type::Polygon, "A measured face."),
        Parameter::required("depth", Type::Length, "How far behind it."),
    ],
    doc: "The point behind the centre of a face, against its normal: over a bottom, the apex of an upright pyramid.",
}];
