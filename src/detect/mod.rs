//! Detectors and measures: from pixels and depth to features.
//!
//! [`Scan`] prepares a view once, [`detect`] finds what a rule asks for in it,
//! [`measure`] turns what was found into attributes. Everything is judged from
//! the images alone; where a detector can be expected to succeed is declared
//! in `primitives`.

mod account;
mod beside;
mod cloud;
mod colour;
mod contour;
mod evidence;
mod faces;
mod instance;
mod join;
mod marker;
mod mask;
mod normals;
mod outline;
mod plane_fit;
mod qr;
mod scan;
mod segment;
#[cfg(test)]
mod tests;

pub use account::{Account, Condition, Test, Unit};
pub use evidence::{Evidence, FaceEvidence, Look, MarkerEvidence};
pub use instance::Measurement;
pub use scan::Scan;

use crate::geometry::Point;
use crate::map::Map;
use crate::primitives::Arguments;
use crate::rules::{BadArgument, Colour};
use outline::Begin;

/// proof() of a polygon or marker rule on one view: every instance it finds,
/// the surest first, and what it looked at.
///
/// # Errors
/// `primitive` is no detector of single views, or an argument is missing or of another type.
pub fn detect(primitive: &str, arguments: &Arguments, scan: &Scan) -> Result<(Vec<Evidence>, Account), BadArgument> {
    let face = |(found, account): (Vec<FaceEvidence>, Account)| -> (Vec<Evidence>, Account) {
        (found.into_iter().map(Evidence::Face).collect(), account)
    };
    match primitive {
        "planar_region" => Ok(face(faces::planar_region(
            scan,
            colour(arguments)?,
            arguments.length("smallest")?,
        ))),
        "plane_beside" => {
            let dihedral = beside::Dihedral {
                angle: arguments.angle("dihedral")?,
                within: arguments.angle("within")?,
            };
            Ok(face(beside::plane_beside(
                scan,
                &arguments.edge("edge")?,
                dihedral,
                colour(arguments)?,
            )))
        }
        "qr" => {
            let (found, account) = qr::qr(scan, arguments.text("text")?, arguments.length("size")?);
            Ok((found.into_iter().map(Evidence::Marker).collect(), account))
        }
        other => Err(BadArgument::new(other, "a detector of single views")),
    }
}

/// proof() of a shell rule: whether at least `share` of the predicted points
/// have a measured point within twice `near` metres, as the one condition on it.
/// Nothing predicted is not proven.
///
/// # Errors
/// `primitive` is no detector of shells, or an argument is missing or of another type.
pub fn shell_proven(
    primitive: &str,
    arguments: &Arguments,
    predicted: &[Point],
    map: &Map,
    near: f64,
) -> Result<Condition, BadArgument> {
    if primitive != "mostly_seen" {
        return Err(BadArgument::new(primitive, "a detector of shells"));
    }
    let share = arguments.share("share")?;
    let seen = predicted.iter().filter(|p| map.measured_within(p, 2.0 * near)).count();
    let proven = !predicted.is_empty() && seen as f64 >= share * predicted.len() as f64;
    let found = seen as f64 / predicted.len() as f64;
    Ok(Condition::quantity(
        "seen",
        Unit::Share,
        found,
        (Some(share), None),
        proven,
    ))
}

/// cal(): the attributes of what was found; `None` where the evidence is too
/// poor or of another kind. A shell has no evidence of its own: its measure is
/// [`Measurement::Shell`] of its predicted faces.
///
/// # Errors
/// `primitive` is no measure, or an argument is missing or of another type.
pub fn measure(
    primitive: &str,
    arguments: &Arguments,
    evidence: &Evidence,
) -> Result<Option<Measurement>, BadArgument> {
    match (primitive, evidence) {
        ("outline", Evidence::Face(face)) => {
            let first = if arguments.has("first") {
                Some(arguments.edge("first")?)
            } else {
                None
            };
            let polygon = outline::outline(face, begin(arguments)?, first.as_ref());
            Ok(polygon.map(Measurement::Face))
        }
        ("marker_pose", Evidence::Marker(marker)) => Ok(marker::marker_pose(marker).map(|pose| Measurement::Marker {
            pose,
            size: marker.size,
        })),
        ("outline" | "marker_pose" | "rough_shape", _) => Ok(None),
        (other, _) => Err(BadArgument::new(other, "a measure")),
    }
}

fn colour(arguments: &Arguments) -> Result<Option<Colour>, BadArgument> {
    if arguments.has("colour") {
        arguments.colour("colour").map(Some)
    } else {
        Ok(None)
    }
}

fn begin(arguments: &Arguments) -> Result<Begin, BadArgument> {
    if !arguments.has("begin") {
        return Ok(Begin::Any);
    }
    match arguments.text("begin")? {
        "any" => Ok(Begin::Any),
        "lowest" => Ok(Begin::Base),
        "apex" => Ok(Begin::Apex),
        _ => Err(BadArgument::new("begin", "`any`, `lowest` or `apex`")),
    }
}
