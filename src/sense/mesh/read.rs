//! From a file to a mesh: what all formats share.

use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use super::options::{Axis, MeshOptions, Units};
use super::{Mesh, MeshError, MeshWarning, Paint, Texture, gltf, obj, open_edges, ply, stl};
use crate::geometry::{Bounds, Point};

/// Largest file, bytes.
const MOST_BYTES: u64 = 512 << 20;
/// Most triangles.
pub(super) const MOST_TRIANGLES: usize = 4_000_000;
/// What has no colour.
pub(super) const GREY: [u8; 3] = [180, 180, 180];

/// Reads a mesh file into metres, z up. The name's ending tells the format.
///
/// # Errors
/// The file is missing, of no known format, malformed, empty, too large, has
/// coordinates that are not finite, or needs units or an up axis that
/// `options` does not state.
pub fn read(path: &Path, options: &MeshOptions) -> Result<Mesh, MeshError> {
    let format = Format::of(path).ok_or_else(|| MeshError::UnknownFormat(path.to_owned()))?;
    let bytes = load(path)?;
    let mut soup = Soup::new(path);
    // The readers of other crates are known to panic on broken files; this is
    // the last resort behind the checks of each format.
    catch_unwind(AssertUnwindSafe(|| format.read(&bytes, &mut soup)))
        .unwrap_or_else(|_| Err(soup.malformed("the file is broken in a way that its reader cannot name")))?;
    soup.finish(format, options)
}

/// The bytes of a file.
///
/// # Errors
/// It cannot be read or is over the limit.
pub(super) fn load(path: &Path) -> Result<Vec<u8>, MeshError> {
    let unreadable = |error: std::io::Error| MeshError::Unreadable {
        path: path.to_owned(),
        reason: error.to_string().to_lowercase(),
    };
    let size = std::fs::metadata(path).map_err(unreadable)?.len();
    if size > MOST_BYTES {
        return Err(MeshError::TooLarge {
            path: path.to_owned(),
            what: format!("{size} bytes; the limit is {MOST_BYTES}"),
        });
    }
    std::fs::read(path).map_err(unreadable)
}

#[derive(Clone, Copy, PartialEq)]
enum Format {
    Stl,
    Obj,
    Ply,
    Gltf,
}

impl Format {
    fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "stl" => Some(Self::Stl),
            "obj" => Some(Self::Obj),
            "ply" => Some(Self::Ply),
            "gltf" | "glb" => Some(Self::Gltf),
            _ => None,
        }
    }

    fn read(self, bytes: &[u8], soup: &mut Soup) -> Result<(), MeshError> {
        match self {
            Self::Stl => stl::read(bytes, soup),
            Self::Obj => obj::read(bytes, soup),
            Self::Ply => ply::read(bytes, soup),
            Self::Gltf => gltf::read(bytes, soup),
        }
    }
}

/// Triangles as a reader finds them, in the file's units and axes.
pub(super) struct Soup {
    pub(super) path: PathBuf,
    corners: Vec<[Point; 3]>,
    paints: Vec<Paint>,
    pub(super) textures: Vec<Texture>,
    pub(super) warnings: Vec<MeshWarning>,
}

impl Soup {
    fn new(path: &Path) -> Self {
        Self {
            path: path.to_owned(),
            corners: Vec::new(),
            paints: Vec::new(),
            textures: Vec::new(),
            warnings: Vec::new(),
        }
    }

    /// Adds a triangle.
    pub(super) fn push(&mut self, corners: [Point; 3], paint: Paint) -> Result<(), MeshError> {
        if self.corners.len() == MOST_TRIANGLES {
            return Err(self.too_many(self.corners.len() + 1));
        }
        self.corners.push(corners);
        self.paints.push(paint);
        Ok(())
    }

    /// The error of a file that breaks its format.
    pub(super) fn malformed(&self, what: impl Into<String>) -> MeshError {
        MeshError::Malformed {
            path: self.path.clone(),
            what: what.into(),
        }
    }

    /// The error of too many triangles.
    pub(super) fn too_many(&self, triangles: usize) -> MeshError {
        MeshError::TooLarge {
            path: self.path.clone(),
            what: format!("{triangles} triangles or more; the limit is {MOST_TRIANGLES}"),
        }
    }

    /// A file named beside this one.
    pub(super) fn beside(&self, name: &str) -> PathBuf {
        self.path.parent().unwrap_or(Path::new("")).join(name)
    }

    fn finish(mut self, format: Format, options: &MeshOptions) -> Result<Mesh, MeshError> {
        let not_finite = |p: &Point| !p.coords.iter().all(|c| c.is_finite());
        if let Some(corner) = self.corners.iter().flatten().position(not_finite) {
            let path = self.path;
            return Err(MeshError::NotFinite { path, corner });
        }
        let (units, up) = self.placement(format, options)?;
        for p in self.corners.iter_mut().flatten() {
            *p = up.upright(p) * units.metres();
        }
        let mesh = self.weld();
        if mesh.triangles.is_empty() {
            return Err(MeshError::Empty(self.path));
        }
        Ok(mesh)
    }

    /// Units and up axis: stated, or the format's own.
    fn placement(&self, format: Format, options: &MeshOptions) -> Result<(Units, Axis), MeshError> {
        let native = (format == Format::Gltf).then_some((Units::Metres, Axis::Y));
        let extents = Bounds::around(self.corners.iter().flatten())
            .filter(|extents| extents.size().max() > 0.0)
            .ok_or_else(|| MeshError::Empty(self.path.clone()))?;
        let path = || self.path.clone();
        let units = options
            .units
            .or(native.map(|n| n.0))
            .ok_or_else(|| MeshError::UnitsNeeded {
                path: path(),
                extents: extents.size(),
            })?;
        let up = options.up.or(native.map(|n| n.1)).ok_or_else(|| MeshError::UpNeeded {
            path: path(),
            extents: extents.size(),
        })?;
        Ok((units, up))
    }

    /// The mesh, equal corners made one and faces without area dropped.
    fn weld(&mut self) -> Mesh {
        let mut mesh = Mesh {
            textures: std::mem::take(&mut self.textures),
            warnings: std::mem::take(&mut self.warnings),
            ..Mesh::default()
        };
        // Before faces without area go: they may be what joins their neighbours.
        let bounds = Bounds::around(self.corners.iter().flatten());
        let open = bounds.map_or(0, |bounds| open_edges(self.corners.iter().copied(), &bounds));
        let mut index: HashMap<[u64; 3], u32> = HashMap::new();
        let mut dropped = 0;
        for (corners, paint) in self.corners.drain(..).zip(self.paints.drain(..)) {
            let [a, b, c] = corners;
            if (b - a).cross(&(c - a)).norm_squared() == 0.0 {
                dropped += 1;
                continue;
            }
            let triangle = corners.map(|p| {
                let next = mesh.vertices.len() as u32;
                let id = *index
                    .entry([p.x, p.y, p.z].map(|c| (c + 0.0).to_bits()))
                    .or_insert(next);
                if id == next {
                    mesh.vertices.push(p);
                }
                id
            });
            mesh.triangles.push(triangle);
            mesh.paints.push(paint);
        }
        if dropped > 0 {
            mesh.warnings.push(MeshWarning::DegenerateFaces(dropped));
        }
        if open > 0 {
            mesh.warnings.push(MeshWarning::OpenEdges(open));
        }
        mesh
    }
}

#[cfg(test)]
mod tests;
