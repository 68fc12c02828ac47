//! Where observations come from: the simulator now, files and robots beside it.
//!
//! The simulator turns a scene object into a triangle mesh (`shapes`, `mesh`),
//! draws it (`raster`), and spoils the depth as a sensor would (`noise`).
//! `frames` reads recordings that others made. `coverage` measures what share of the object a run has seen. Nothing here
//! plans or detects.

mod coverage;
mod error;
pub mod frames;
pub mod mesh;
mod noise;
mod observation;
mod raster;
pub mod shapes;
mod simulator;

pub use coverage::{Coverage, least_views};
pub use error::SceneError;
pub use mesh::{Axis, Mesh, MeshError, MeshOptions, MeshWarning, Paint, Texture, Units};
pub use noise::{Noise, UnknownNoise};
pub use observation::{ColourImage, DepthImage, Observation};
pub use simulator::Simulator;
