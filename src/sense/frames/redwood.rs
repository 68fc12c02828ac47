//! Redwood: `depth/`, `color/` (or `rgb/`, `image/`) and `trajectory.log`.
//!
//! The log has five lines a frame: three whole numbers, of which the first is the
//! frame's place in the listing, and a 4 × 4 matrix, camera to world, metres,
//! OpenCV axes. Depth is 16-bit PNG, 1000 units a metre, registered to colour.
//! Intrinsics default to the PrimeSense ones of the data set (525, 525, 319.5,
//! 239.5).

use std::path::{Path, PathBuf};

use super::calibration::{Known, Pinhole, Stated};
use super::error::FrameError;
use super::shots::{self, Cameras, Shot};
use super::slambook::COLOUR;
use super::{Layout, Recording, files, pose};
use crate::geometry::Pose;

/// The trajectory of a Redwood folder.
pub(super) fn trajectory(path: &Path) -> Option<PathBuf> {
    let depth = path.join("depth").is_dir();
    ["trajectory.log", "traj.log", "scene/trajectory.log"]
        .iter()
        .map(|name| path.join(name))
        .find(|file| depth && file.is_file())
}

pub(super) fn open(path: &Path, stated: &Stated) -> Result<Recording, FrameError> {
    let log = trajectory(path).ok_or_else(|| FrameError::UnknownLayout(path.to_owned()))?;
    let depth = files::listed(&path.join("depth"), &[".png", ".pgm"])?;
    let colour = match files::folder(path, &["color", "rgb", "image", "colour"]) {
        Some(folder) => files::listed(&folder, COLOUR)?,
        None => Vec::new(),
    };
    let mut shots = Vec::new();
    for (k, world_from_camera) in poses(&log)? {
        let Some(depth) = depth.get(k).cloned() else {
            let what = format!(
                "it has a pose of picture {k}, and `depth/` has {} pictures, from 0",
                depth.len()
            );
            return Err(FrameError::malformed(&log, what));
        };
        shots.push(Shot {
            name: files::stem(&depth),
            depth,
            colour: colour.get(k).cloned(),
            world_from_camera,
        });
    }
    let cameras = Cameras {
        depth: Some(Known::new(Pinhole::of(525.0, 525.0, 319.5, 239.5), "Redwood's default")),
        colour: None,
        scale: Known::new(1000.0, "Redwood's"),
        poses_of_colour: false,
    };
    shots::recording(path, Layout::Redwood, stated, shots, cameras, Vec::new())
}

fn poses(path: &Path) -> Result<Vec<(usize, Pose)>, FrameError> {
    let text = files::text(path)?;
    let lines: Vec<(usize, &str)> = text.lines().enumerate().filter(|(_, l)| !l.trim().is_empty()).collect();
    let one = |block: &[(usize, &str)]| {
        let line = block[0].0 + 1;
        let wrong = |what: String| FrameError::malformed(path, format!("the pose at line {line}: {what}"));
        if block.len() < 5 {
            return Err(wrong(format!("it ends after {} of 5 lines", block.len())));
        }
        let head = pose::numbers(block[0].1).map_err(wrong)?;
        let Some(place) = head
            .first()
            .filter(|x| head.len() == 3 && x.fract() == 0.0 && **x >= 0.0)
        else {
            return Err(wrong("expected three whole numbers, then 4 rows of 4".to_owned()));
        };
        let matrix: Vec<&str> = block[1..].iter().map(|(_, l)| *l).collect();
        let numbers = pose::numbers(&matrix.join(" ")).map_err(wrong)?;
        let rows = pose::rows(&numbers).map_err(wrong)?;
        Ok((*place as usize, pose::from_rows(&rows).map_err(wrong)?))
    };
    lines.chunks(5).map(one).collect()
}
