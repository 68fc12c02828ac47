//! Boxes: three sizes, and a colour a face.

use super::builder::Builder;
use super::outline::SIZES;
use super::range;
use crate::geometry::{Point, Vector};
use crate::rules::Call;
use crate::sense::{Mesh, SceneError};

/// The mesh of a `box` call.
pub(super) fn build(call: &Call) -> Result<Mesh, SceneError> {
    let size = |name| range::length(call, name, SIZES);
    let half = Vector::new(size("width")?, size("depth")?, size("height")?) / 2.0;
    let (x, y, z) = (Vector::x(), Vector::y(), Vector::z());
    let mut builder = Builder::default();
    // Each with a right and an up that make its outward normal.
    for (name, right, up) in [
        ("front", y, z),
        ("back", -y, z),
        ("left", -x, z),
        ("right", x, z),
        ("top", x, y),
        ("bottom", x, -y),
    ] {
        let out = right.cross(&up);
        let corner = |a: f64, b: f64| Point::from(half.component_mul(&(out + right * a + up * b)));
        let outline = [
            corner(-1.0, -1.0),
            corner(1.0, -1.0),
            corner(1.0, 1.0),
            corner(-1.0, 1.0),
        ];
        builder.convex(&outline, colour(call, name)?);
    }
    Ok(builder.finish())
}

/// The colour of a face: its own, or that of the whole.
fn colour(call: &Call, face: &str) -> Result<[u8; 3], SceneError> {
    let own = call.arguments.contains_key(face);
    let name = if own { face } else { "colour" };
    Ok(call.colour(name).map_err(SceneError::argument("box"))?.0)
}
