//! Where observations come from: the simulator now, files and robots beside it.

mod observation;

pub use observation::{ColourImage, DepthImage, Observation};
