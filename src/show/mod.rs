//! What a run shows: the run log, lines on a terminal, the closing summary, a page.
//!
//! Turns updates and decisions into records and text. It writes nothing itself.

mod configuration;
mod lines;
pub mod log;
mod report;
pub mod why;

pub use configuration::configuration;
pub use lines::{summary, view_line};
pub use report::Report;
