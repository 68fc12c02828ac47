//! stub
use super::{Mesh, MeshError, MeshOptions};
use std::path::Path;
/// stub
pub fn read(path: &Path, _options: &MeshOptions) -> Result<Mesh, MeshError> {
    Err(MeshError::UnknownFormat(path.to_owned()))
}
