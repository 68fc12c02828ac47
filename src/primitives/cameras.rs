//! Camera models.

use super::{Parameter, Primitive, Type};
use crate::geometry::{Camera, DepthRange, Intrinsics};
use crate::rules::{BadArgument, Call};

pub(super) const ALL: &[Primitive] = &[Primitive {
    name: "rgbd_camera",
    result: Type::Camera,
    features: &[],
    parameters: &[
        Parameter::required(
            "depth",
            Type::List(&Type::Count),
            "Columns and rows of the depth image.",
        ),
        Parameter::required(
            "depth_fov",
            Type::List(&Type::Angle),
            "Horizontal and vertical field of view of the depth image.",
        ),
        Parameter::required(
            "colour",
            Type::List(&Type::Count),
            "Columns and rows of the colour image.",
        ),
        Parameter::required(
            "colour_fov",
            Type::List(&Type::Angle),
            "Horizontal and vertical field of view of the colour image.",
        ),
        Parameter::required("nearest", Type::Length, "Nearest depth that is read."),
        Parameter::required("farthest", Type::Length, "Farthest depth that is read."),
    ],
    doc: "A pinhole depth camera with a registered colour image.\n\nBoth images share the optical centre; they may differ in resolution and field of view.",
}];

/// The camera of a call of `rgbd_camera`.
///
/// # Errors
/// Another primitive, a missing argument, or an image of no size.
pub fn camera(call: &Call) -> Result<Camera, BadArgument> {
    if call.primitive != "rgbd_camera" {
        return Err(BadArgument::new(&call.primitive, "a camera"));
    }
    let image = |size: &str, fov: &str| -> Result<Intrinsics, BadArgument> {
        let (&[w, h], &[fx, fy]) = (call.counts(size)?.as_slice(), call.angles(fov)?.as_slice()) else {
            return Err(BadArgument::new(size, "two values, horizontal and vertical"));
        };
        let sides = 1..=16_384;
        let fields = 0.001..3.1;
        if !(sides.contains(&w) && sides.contains(&h) && fields.contains(&fx) && fields.contains(&fy)) {
            return Err(BadArgument::new(
                size,
                "an image of 1 to 16384 pixels a side, its field of view under 180 deg",
            ));
        }
        Ok(Intrinsics::with_fields_of_view(w as u32, h as u32, fx, fy))
    };
    let range = DepthRange {
        min: call.length("nearest")?,
        max: call.length("farthest")?,
    };
    if !(0.0 < range.min && range.min < range.max) {
        return Err(BadArgument::new("nearest", "above zero and below `farthest`"));
    }
    Ok(Camera {
        depth: image("depth", "depth_fov")?,
        colour: image("colour", "colour_fov")?,
        range,
    })
}
