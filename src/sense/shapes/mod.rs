//! Shapes of scene objects as triangle meshes.
//!
//! One file a shape; each reads its call, checks ranges and builds a closed,
//! outward-wound mesh in the object's frame. `marker` adds printed codes.

mod builder;
mod cuboid;
mod deform;
mod marker;
mod outline;
mod prism;
mod pyramid;
mod range;
mod simple;
mod tank;
mod triangulate;

pub use marker::plate;

use std::path::Path;

use super::error::SceneError;
use super::mesh::{self, Axis, Mesh, MeshOptions, Units};
use crate::rules::Call;

/// The mesh of a shape call, object frame, metres.
///
/// `base` is the folder that mesh paths are relative to.
///
/// # Errors
/// Not a shape, arguments missing or out of range, or an unreadable mesh file.
pub fn mesh(shape: &Call, base: &Path) -> Result<Mesh, SceneError> {
    match shape.primitive.as_str() {
        "box" => cuboid::build(shape),
        "prism" => prism::build(shape),
        "pyramid" => pyramid::build(shape),
        "tank" => tank::build(shape),
        "mesh" => from_file(shape, base),
        other => Err(SceneError::UnknownShape(other.to_owned())),
    }
}

fn from_file(shape: &Call, base: &Path) -> Result<Mesh, SceneError> {
    let file = shape.text("file").map_err(SceneError::argument("mesh"))?;
    let options = MeshOptions {
        units: shape.text("units").ok().and_then(Units::named),
        up: shape.text("up").ok().and_then(Axis::named),
    };
    Ok(mesh::read(&base.join(file), &options)?)
}

#[cfg(test)]
pub(in crate::sense) mod testing;
#[cfg(test)]
mod tests;
