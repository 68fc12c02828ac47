//! Why a study cannot be run, kept or summed up.

use std::io;

use crate::plan::PlanError;
use crate::sense::SceneError;

/// Why a study cannot be run, kept or summed up.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// More runs than anybody waits for.
    #[error("study `{study}` has {runs} runs, and at most {most} can be kept: leave out objects, starts or seeds")]
    TooMany {
        /// The study.
        study: String,
        /// Its runs.
        runs: u128,
        /// How many there can be.
        most: u64,
    },
    /// A variant of the task cannot be run.
    #[error("{what}: {source}")]
    Plan {
        /// Which arm.
        what: String,
        /// Why.
        source: PlanError,
    },
    /// A noise model that this build lacks.
    #[error(transparent)]
    Noise(#[from] crate::sense::UnknownNoise),
    /// More starts than views.
    #[error("{starts} starts, and the task has {views} views: a start is one of them")]
    Starts {
        /// Asked for.
        starts: u32,
        /// Candidate views.
        views: usize,
    },
    /// An object cannot be shown.
    #[error("object `{object}`: {source}")]
    Object {
        /// Which.
        object: String,
        /// Why.
        source: SceneError,
    },
    /// An object outside the space, or of the wrong size for it.
    #[error("object `{object}` {reason}")]
    Unfit {
        /// Which.
        object: String,
        /// Why, after its name.
        reason: String,
    },
    /// A folder that cannot be used.
    #[error("`{folder}` {reason}")]
    Folder {
        /// The folder.
        folder: String,
        /// Why, after its name.
        reason: String,
    },
    /// A table of published numbers that cannot be read.
    #[error("the published table `{file}` {reason}")]
    Published {
        /// The file.
        file: String,
        /// Why, after its name.
        reason: String,
    },
    /// A file cannot be written.
    #[error("`{0}` cannot be written: {1}")]
    Write(String, io::Error),
    /// A plot cannot be drawn.
    #[error("a plot cannot be drawn: {0}")]
    Plot(String),
}
