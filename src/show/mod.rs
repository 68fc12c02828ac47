//! What a run shows: the run log, lines on a terminal, the closing summary, a page.
//!
//! Turns updates and decisions into records and text. It writes nothing itself.

mod configuration;
pub mod export;
mod lines;
pub mod log;
pub mod recording;
mod report;
pub mod why;

pub use configuration::configuration;
pub use lines::{summary, view_line};
pub use report::Report;
