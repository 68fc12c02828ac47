//! stub
use std::path::Path;
use super::{Mesh, MeshError, MeshOptions};
/// stub
pub fn read(path: &Path, _options: &MeshOptions) -> Result<Mesh, MeshError> {
    Err(MeshError::UnknownFormat(path.to_owned()))
}
