//! `color/`, `depth/` and `pose.txt`, as in chapter 5 of slambook.
//!
//! Line i of `pose.txt` is the pose of the i-th picture: `tx ty tz qx qy qz qw`,
//! camera to world, metres, OpenCV axes. Depth is 16-bit PGM or PNG, usually 1000
//! units a metre, registered to colour. Intrinsics are not part of the layout.

use std::path::{Path, PathBuf};

use super::calibration::{Known, Stated};
use super::error::FrameError;
use super::shots::{self, Cameras, Shot};
use super::{Layout, Recording, files, pose};
use crate::geometry::Pose;

/// Endings of colour pictures.
pub(super) const COLOUR: &[&str] = &[".png", ".jpg", ".jpeg", ".ppm", ".pgm"];

pub(super) fn open(path: &Path, stated: &Stated) -> Result<Recording, FrameError> {
    let poses = poses(&path.join("pose.txt"))?;
    let depth = files::listed(&path.join("depth"), &[".pgm", ".png"])?;
    let colour = match files::folder(path, &["color", "colour", "rgb"]) {
        Some(folder) => files::listed(&folder, COLOUR)?,
        None => Vec::new(),
    };
    if depth.len() != poses.len() || !(colour.is_empty() || colour.len() == depth.len()) {
        let what = format!(
            "it has {} poses for {} depth and {} colour pictures; expected one a picture",
            poses.len(),
            depth.len(),
            colour.len()
        );
        return Err(FrameError::malformed(&path.join("pose.txt"), what));
    }
    let colour = colour.into_iter().map(Some).chain(std::iter::repeat(None));
    let shot = |((depth, colour), world_from_camera): ((PathBuf, _), _)| Shot {
        name: files::stem(&depth),
        depth,
        colour,
        world_from_camera,
    };
    let shots = depth.into_iter().zip(colour).zip(poses).map(shot).collect();
    let cameras = Cameras {
        depth: None,
        colour: None,
        scale: Known::new(1000.0, "usual for this layout"),
        poses_of_colour: false,
    };
    shots::recording(path, Layout::Slambook, stated, shots, cameras, Vec::new())
}

fn poses(path: &Path) -> Result<Vec<Pose>, FrameError> {
    let text = files::text(path)?;
    let lines = text
        .lines()
        .enumerate()
        .filter(|(_, l)| !l.trim().is_empty() && !l.starts_with('#'));
    let pose = |(k, line): (usize, &str)| {
        let wrong = |what: String| FrameError::malformed(path, format!("line {}: {what}", k + 1));
        let numbers = pose::numbers(line).map_err(wrong)?;
        let &[x, y, z, qx, qy, qz, qw] = numbers.as_slice() else {
            let what = format!("{} numbers; expected the 7 of `tx ty tz qx qy qz qw`", numbers.len());
            return Err(wrong(what));
        };
        pose::from_quaternion([x, y, z], [qx, qy, qz, qw]).map_err(wrong)
    };
    lines.map(pose).collect()
}
