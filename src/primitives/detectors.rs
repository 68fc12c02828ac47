//! Detectors (proof functions) and their envelopes.

use qrcodegen::{QrCode, QrCodeEcc};

use super::{Parameter, Primitive, Type};
use crate::rules::{BadArgument, Call, FeatureKind, Value};

pub(super) const ALL: &[Primitive] = &[
    Primitive {
        name: "planar_region",
        result: Type::Detector,
        features: &[FeatureKind::Polygon],
        parameters: &[
            Parameter::optional("colour", Type::Colour, "The face's colour; any where left out."),
            Parameter::or(
                "smallest",
                Type::Length,
                || Value::Length(0.04),
                "Faces whose square root of area is smaller are ignored.",
            ),
        ],
        doc: "A planar face of one colour.\n\nPixels of the colour are grouped by depth and surface normal, each group is fitted with a robust plane, and its outline is traced.",
    },
    Primitive {
        name: "plane_beside",
        result: Type::Detector,
        features: &[FeatureKind::Polygon],
        parameters: &[
            Parameter::required("edge", Type::Edge, "The edge of a measured face that the plane shares."),
            Parameter::required(
                "dihedral",
                Type::Angle,
                "The angle inside the object between the two faces.",
            ),
            Parameter::required("within", Type::Angle, "How far the angle may be off."),
            Parameter::optional("colour", Type::Colour, "The face's colour; any where left out."),
        ],
        doc: "A planar face beside a known edge at a dihedral angle.",
    },
    Primitive {
        name: "qr",
        result: Type::Detector,
        features: &[FeatureKind::Marker],
        parameters: &[
            Parameter::required("text", Type::Text, "The text of the code."),
            Parameter::required(
                "size",
                Type::Length,
                "Edge of the square of modules, without the quiet zone.",
            ),
        ],
        doc: "A QR code with a given text, decoded from the colour image and placed by the depth image.",
    },
    Primitive {
        name: "mostly_seen",
        result: Type::Detector,
        features: &[FeatureKind::Shell],
        parameters: &[Parameter::or(
            "share",
            Type::Share,
            || Value::Share(0.8),
            "The share of the predicted surface that must have been measured.",
        )],
        doc: "A rough shape most of whose predicted surface was measured.\n\nA predicted voxel counts when a measured point lies within twice the task's `near`.",
    },
];

/// Which image a detector's resolution is counted in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImageKind {
    /// The depth image.
    Depth,
    /// The colour image.
    Colour,
}

/// Where a detector can be expected to succeed. Only looks inside count.
///
/// Measured on the built-in simulator with and without structured-light noise
/// (the tests of `detect` hold a part of it): inside, nothing unhidden was
/// missed. Incidence is judged at the feature's centre; resolution is
/// fx / z-depth, so foreshortening counts in the incidence alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Envelope {
    /// Largest angle between the surface normal and the line of sight, radians.
    pub max_incidence: f64,
    /// The image that the resolution is counted in.
    pub image: ImageKind,
    /// Least resolution, pixels a metre on a surface seen head-on at that distance.
    pub min_pixels_per_metre: f64,
    /// Whether the feature must be seen whole in one view.
    pub whole: bool,
}

/// Modules along the edge of the smallest QR code (version 1).
pub const QR_MODULES: f64 = 21.0;

/// Pixels that a module must measure head-on to be read.
const PIXELS_PER_MODULE: f64 = 4.0;

/// Modules along the edge of the code of a `qr` call: the smallest version
/// that holds the text with error correction M, as the simulator prints it.
fn modules(detect: &Call) -> f64 {
    let code = detect
        .text("text")
        .ok()
        .and_then(|t| QrCode::encode_text(t, QrCodeEcc::Medium).ok());
    code.map_or(QR_MODULES, |c| f64::from(c.size()))
}

/// Largest difference between the declared and the measured size of a code, as a share.
pub const QR_SIZE_WITHIN: f64 = 0.25;

/// Modules of quiet zone on each side of a code.
const QUIET_ZONE: f64 = 4.0;

/// Edge of the print of a `qr` call, metres: the code with its quiet zone, which
/// a reader needs as much as the modules.
///
/// # Errors
/// The call has no size.
pub fn printed_edge(detect: &Call) -> Result<f64, BadArgument> {
    let modules = modules(detect);
    Ok(detect.length("size")? * (modules + 2.0 * QUIET_ZONE) / modules)
}

/// The envelope of a detector call.
///
/// # Errors
/// The call is not of a detector, or lacks an argument that the envelope depends on.
pub fn envelope(detect: &Call) -> Result<Envelope, BadArgument> {
    match detect.primitive.as_str() {
        "planar_region" | "plane_beside" => Ok(Envelope {
            max_incidence: 70_f64.to_radians(),
            image: ImageKind::Depth,
            min_pixels_per_metre: 180.0,
            whole: false,
        }),
        "mostly_seen" => Ok(Envelope {
            max_incidence: 80_f64.to_radians(),
            image: ImageKind::Depth,
            min_pixels_per_metre: 100.0,
            whole: false,
        }),
        "qr" => Ok(Envelope {
            max_incidence: 72_f64.to_radians(),
            image: ImageKind::Colour,
            min_pixels_per_metre: PIXELS_PER_MODULE * modules(detect) / detect.length("size")?,
            whole: true,
        }),
        other => Err(BadArgument::new(other, "a detector")),
    }
}

#[cfg(test)]
pub(super) fn declares_envelope(name: &str) -> bool {
    let arguments = [("size".to_owned(), crate::rules::Expr::Value(Value::Length(0.2)))].into();
    envelope(&Call {
        primitive: name.to_owned(),
        arguments,
    })
    .is_ok()
}
