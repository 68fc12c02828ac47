//! Why a plan cannot be made or an observation not be used.

use crate::map::TooLarge;
use crate::rules::BadArgument;

/// Why a plan cannot be made or an observation not be used.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// The rule set has no such task.
    #[error("there is no task `{name}`; the file has {known}")]
    UnknownTask {
        /// The name asked for.
        name: String,
        /// The names there are.
        known: String,
    },
    /// The task's library is missing.
    #[error("task `{task}` names library `{library}`, which is not here")]
    NoLibrary {
        /// The task.
        task: String,
        /// The library it names.
        library: String,
    },
    /// There is no such method of choosing views.
    #[error("there is no method `{name}`; use one of {known}")]
    UnknownMethod {
        /// The name asked for.
        name: String,
        /// The names there are.
        known: String,
    },
    /// A rule's call is not what its primitive needs.
    #[error("rule {rule}: {source}")]
    Rule {
        /// The rule's id.
        rule: String,
        /// What is wrong.
        source: BadArgument,
    },
    /// The candidate views cannot be made.
    #[error("the views of task `{task}`: {source}")]
    Views {
        /// The task.
        task: String,
        /// What is wrong.
        source: BadArgument,
    },
    /// The task has no candidate view.
    #[error("task `{0}` has no candidate view; give it a count above zero")]
    NoViews(String),
    /// The map does not fit.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
    /// An observation from a view that the task does not have.
    #[error("view {view} is not among the task's {count} views, which are numbered from 0")]
    NoSuchView {
        /// The view.
        view: usize,
        /// Number of views.
        count: usize,
    },
    /// The sensor gave no measurement.
    #[error("the sensor gave no measurement: {0}")]
    Sensor(String),
    /// An observation that is no measurement.
    #[error("the observation cannot be used: {0}")]
    BadObservation(&'static str),
}
