//! Why a recording cannot be used.

use std::path::{Path, PathBuf};

/// Why a recording cannot be used. Every message names the file and a way out.
#[derive(Debug, thiserror::Error)]
pub enum FrameError {
    /// A file or folder cannot be opened or read.
    #[error("`{}` cannot be read: {reason}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The system's word.
        reason: String,
    },
    /// Neither a file nor a folder that an importer knows.
    #[error("`{}` is no recording in a known layout", .0.display())]
    UnknownLayout(PathBuf),
    /// The content breaks the rules of its format.
    #[error("`{}` is malformed: {what}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// What is wrong, and where.
        what: String,
    },
    /// Something that the layout does not carry was not stated.
    #[error("`{}` does not state {what}", path.display())]
    NotStated {
        /// The recording.
        path: PathBuf,
        /// What is missing, and how to state it.
        what: String,
    },
    /// Nothing to see.
    #[error("`{}` has no frame: {why}", path.display())]
    Empty {
        /// The recording.
        path: PathBuf,
        /// What was looked for.
        why: String,
    },
    /// More than should be held.
    #[error("`{}` is too large: {what}", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// What, and the limit.
        what: String,
    },
}

impl FrameError {
    pub(super) fn unreadable(path: &Path, error: &std::io::Error) -> Self {
        let reason = match error.kind() {
            std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
            std::io::ErrorKind::IsADirectory => "it is a folder".to_owned(),
            std::io::ErrorKind::PermissionDenied => "permission denied".to_owned(),
            _ => error.to_string(),
        };
        Self::Unreadable {
            path: path.to_owned(),
            reason,
        }
    }

    pub(super) fn malformed(path: &Path, what: impl Into<String>) -> Self {
        Self::Malformed {
            path: path.to_owned(),
            what: what.into(),
        }
    }

    pub(super) fn not_stated(path: &Path, what: impl Into<String>) -> Self {
        Self::NotStated {
            path: path.to_owned(),
            what: what.into(),
        }
    }

    pub(super) fn empty(path: &Path, why: impl Into<String>) -> Self {
        Self::Empty {
            path: path.to_owned(),
            why: why.into(),
        }
    }
}
