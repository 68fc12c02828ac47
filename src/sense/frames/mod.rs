//! Recorded RGB-D frames with poses: importers, one file a layout.
//!
//! An importer finds the pictures and poses of a recording and states its
//! conventions: what a raw unit of depth is, whether a pose maps camera to world
//! or back, which way camera axes point, where pixels are centred. What comes
//! out is one kind of thing, a [`Recording`] of [`Observation`]s in the
//! project's own conventions. `docs/data.md` lists them all.
//!
//! 0, 65535, NaN and infinity are no reading. Poses must be rigid motions.

mod agreement;
mod bop;
mod calibration;
mod error;
mod files;
mod frame;
mod layout;
mod picture;
mod pose;
mod redwood;
mod register;
mod ros;
mod seven_scenes;
mod shots;
mod slambook;
mod suspicion;
mod transforms;
mod tum;
mod visp;

pub use agreement::{Pair, agreement};
pub use calibration::{CALIBRATION, FrameOptions, Known, Pinhole};
pub use error::FrameError;
pub use frame::Frame;
pub use layout::Layout;
pub use suspicion::{Better, Poses, Suspicion, suspicion};

use std::path::{Path, PathBuf};

use super::Observation;
use crate::geometry::{Bounds, Camera, DepthRange, Intrinsics, Pose};
use calibration::Stated;

/// Frames that were really taken, in the order in which they were.
///
/// INVARIANT: there is at least one frame.
pub struct Recording {
    /// Its folder or file.
    pub path: PathBuf,
    /// What it was taken for.
    pub taken: Taken,
    /// The frames.
    pub frames: Vec<Frame>,
    /// What a user should know: defaults that were used, frames left out.
    pub notes: Vec<String>,
    /// Readings of this z-depth (metres) or more count as none.
    max_depth: f64,
}

/// What a recording was taken for.
pub struct Taken {
    /// The layout.
    pub layout: Layout,
    /// Intrinsics of the first depth image, in the project's convention.
    pub depth: Known<Intrinsics>,
    /// Raw units of depth a metre; `None` where readings are metres already.
    pub depth_scale: Option<Known<f64>>,
    /// The colour pictures and how they stand to depth, for people.
    pub colour: String,
}

impl Recording {
    /// Opens a recording. What it is tells its content.
    ///
    /// # Errors
    /// The layout is unknown, malformed or empty, or something that it does not
    /// carry is not stated.
    pub fn open(path: &Path, options: &FrameOptions) -> Result<Self, FrameError> {
        let layout = Layout::of(path)?;
        let stated = Stated::of(path, options)?;
        let recording = layout.open(path, &stated)?;
        if recording.frames.is_empty() {
            return Err(FrameError::empty(path, "no frame has both a depth image and a pose"));
        }
        Ok(recording)
    }

    /// The camera of frame `k`; its range ends at the largest depth asked for.
    pub fn camera(&self, k: usize) -> Camera {
        let frame = &self.frames[k];
        Camera {
            depth: frame.depth_camera,
            colour: frame.colour_camera(),
            range: DepthRange {
                min: 0.0,
                max: self.max_depth,
            },
        }
    }

    /// Where the depth camera of each frame stood, `world_from_camera`.
    pub fn poses(&self) -> Vec<Pose> {
        self.frames.iter().map(|f| f.world_from_camera).collect()
    }

    /// Reads frame `k`.
    ///
    /// # Errors
    /// A picture is missing, broken, or not of the camera's size.
    pub fn observe(&self, k: usize) -> Result<Observation, FrameError> {
        let frame = &self.frames[k];
        let mut depth = frame.read_depth()?;
        for z in &mut depth.metres {
            if !(z.is_finite() && *z > 0.0 && f64::from(*z) < self.max_depth) {
                *z = 0.0;
            }
        }
        Ok(Observation {
            camera: self.camera(k),
            world_from_camera: frame.world_from_camera,
            colour: frame.read_colour(&depth)?,
            depth,
        })
    }
}

/// The box around what an observation measured and where it stood.
pub fn bounds_of(observation: &Observation) -> Option<Bounds> {
    let (width, height) = (observation.depth.width, observation.depth.height);
    let pixels = (0..height).flat_map(|v| (0..width).map(move |u| (u, v)));
    let mut points: Vec<_> = pixels.filter_map(|(u, v)| observation.point(u, v)).collect();
    points.push(observation.eye());
    Bounds::around(&points)
}
