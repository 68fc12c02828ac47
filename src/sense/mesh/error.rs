//! What can be wrong with a mesh file.

use std::fmt;
use std::path::PathBuf;

use super::options::EXTENTS_UNITS;
use crate::geometry::Vector;

/// Why a mesh file cannot be used. The variants are stable.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// The file cannot be opened or read.
    #[error("the mesh `{}` cannot be read: {reason}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The system's word.
        reason: String,
    },
    /// The name ends in nothing that a reader knows.
    #[error("the mesh `{}` is of an unknown format; expected a name that ends in .stl, .obj, .ply, .gltf or .glb", .0.display())]
    UnknownFormat(PathBuf),
    /// The content breaks the rules of its format.
    #[error("the mesh `{}` is malformed: {what}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// What is wrong, and where.
        what: String,
    },
    /// Nothing to show.
    #[error("the mesh `{}` has no faces", .0.display())]
    Empty(PathBuf),
    /// A coordinate is NaN or infinite.
    #[error("the mesh `{}` has a corner whose coordinates are not finite (corner {corner})", path.display())]
    NotFinite {
        /// The file.
        path: PathBuf,
        /// Which corner, from 0.
        corner: usize,
    },
    /// More than a simulator should load.
    #[error("the mesh `{}` is too large: {what}", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// What, and the limit.
        what: String,
    },
    /// The format has no units, and none were stated.
    #[error("the mesh `{}` has no units of its own; state them: {}", path.display(), in_each_unit(extents))]
    UnitsNeeded {
        /// The file.
        path: PathBuf,
        /// Extents along x, y and z in the file's numbers.
        extents: Vector,
    },
    /// The format does not say which way is up, and nobody did.
    #[error("the mesh `{}` does not say which axis points up; state `up: x`, `up: y` or `up: z` (its extents are {:.4} by {:.4} by {:.4} along x, y and z)", path.display(), extents.x, extents.y, extents.z)]
    UpNeeded {
        /// The file.
        path: PathBuf,
        /// Extents along x, y and z in the file's numbers.
        extents: Vector,
    },
}

impl MeshError {
    /// A stable word for the kind of error.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Unreadable { .. } => "mesh_unreadable",
            Self::UnknownFormat(_) => "mesh_format",
            Self::Malformed { .. } => "mesh_malformed",
            Self::Empty(_) => "mesh_empty",
            Self::NotFinite { .. } => "mesh_not_finite",
            Self::TooLarge { .. } => "mesh_too_large",
            Self::UnitsNeeded { .. } => "mesh_units",
            Self::UpNeeded { .. } => "mesh_up",
        }
    }
}

/// What was amiss in a mesh that can be used all the same.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MeshWarning {
    /// Faces without area were left out.
    DegenerateFaces(usize),
    /// The mesh is not closed: edges with a face on one side only.
    OpenEdges(usize),
    /// A material or image that the file refers to cannot be used.
    MissingFile(PathBuf),
}

impl fmt::Display for MeshWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::DegenerateFaces(n) => write!(f, "{n} faces without area were left out"),
            Self::OpenEdges(n) => write!(f, "the mesh is not closed: {n} edges are open"),
            Self::MissingFile(path) => write!(
                f,
                "`{}` is missing or cannot be used; its faces have no texture",
                path.display()
            ),
        }
    }
}

/// `units: mm gives 0.04 by 0.04 by 0.04 m, …`.
fn in_each_unit(extents: &Vector) -> String {
    EXTENTS_UNITS
        .iter()
        .map(|unit| {
            let e = extents * unit.metres();
            format!(
                "`units: {}` gives {:.4} by {:.4} by {:.4} m",
                unit.name(),
                e.x,
                e.y,
                e.z
            )
        })
        .collect::<Vec<_>>()
        .join(", ")
}
