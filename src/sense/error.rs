//! Why a scene object cannot be shown.

use super::mesh::MeshError;
use crate::rules::BadArgument;

/// Why a scene object cannot be shown.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// An argument is missing or of the wrong kind: the artefact was edited.
    #[error("in a call of `{primitive}`: {source}")]
    Argument {
        /// The shape or deformation.
        primitive: String,
        /// Which argument.
        source: BadArgument,
    },
    /// An argument is out of range, or the shape it asks for cannot be.
    #[error("`{parameter}` of `{primitive}` is {found}; expected {expected}")]
    Range {
        /// The shape or deformation.
        primitive: String,
        /// The argument.
        parameter: &'static str,
        /// What it is, with its unit.
        found: String,
        /// What would do.
        expected: String,
    },
    /// Not a shape.
    #[error("`{0}` is not a shape; expected `prism`, `pyramid`, `tank` or `mesh`")]
    UnknownShape(String),
    /// A marker that cannot be printed.
    #[error("the marker `{text}` cannot be shown: {reason}")]
    Marker {
        /// Its text.
        text: String,
        /// Why not.
        reason: String,
    },
    /// The mesh file.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

impl SceneError {
    /// A stable word for the kind of error, for logs and exit statuses.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Argument { .. } => "bad_argument",
            Self::Range { .. } => "out_of_range",
            Self::UnknownShape(_) => "unknown_shape",
            Self::Marker { .. } => "bad_marker",
            Self::Mesh(error) => error.code(),
        }
    }

    pub(super) fn argument(primitive: &str) -> impl FnOnce(BadArgument) -> Self + use<'_> {
        move |source| Self::Argument {
            primitive: primitive.to_owned(),
            source,
        }
    }
}
