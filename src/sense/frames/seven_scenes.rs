//! 7-Scenes, 3DMatch and tsdf-fusion: `frame-000000.depth.png` with
//! `frame-000000.pose.txt` and `frame-000000.color.png` (or `.jpg`).
//!
//! A pose is 4 × 4 rows, camera to world, metres, OpenCV axes. Depth is 16-bit
//! PNG, 1000 units a metre; 0 and 65535 are no reading. Intrinsics are the rows
//! of K in `camera-intrinsics.txt`, in the folder or the one above; without it
//! they are 7-Scenes' (585, 585, 320, 240). A pose that is not finite marks a
//! frame that was not tracked; it is left out.

use std::path::Path;

use super::calibration::{Known, Pinhole, Stated};
use super::error::FrameError;
use super::shots::{self, Cameras, Shot};
use super::{Layout, Recording, files, pose};
use crate::geometry::Pose;

/// The file that 3DMatch and tsdf-fusion put K into.
const INTRINSICS: &str = "camera-intrinsics.txt";

pub(super) fn open(path: &Path, stated: &Stated) -> Result<Recording, FrameError> {
    let (mut shots, mut lost) = (Vec::new(), 0);
    for depth in files::listed(path, &[".depth.png"])? {
        let name = files::stem(&depth).trim_end_matches(".depth").to_owned();
        let file = path.join(format!("{name}.pose.txt"));
        let Some(world_from_camera) = pose_in(&file)? else {
            lost += 1;
            continue;
        };
        shots.push(Shot {
            colour: files::with_ending(path, &name, &[".color.png", ".color.jpg"]),
            name,
            depth,
            world_from_camera,
        });
    }
    let mut notes = Vec::new();
    if lost > 0 {
        notes.push(format!("{lost} frames whose pose is not finite are left out"));
    }
    let cameras = Cameras {
        depth: Some(intrinsics(path)?),
        colour: None,
        scale: Known::new(1000.0, "7-Scenes' and 3DMatch's"),
        poses_of_colour: false,
    };
    shots::recording(path, Layout::SevenScenes, stated, shots, cameras, notes)
}

/// The pose in a file; `None` where it is not finite.
fn pose_in(path: &Path) -> Result<Option<Pose>, FrameError> {
    let wrong = |what: String| FrameError::malformed(path, what);
    let numbers = pose::numbers(&files::text(path)?).map_err(wrong)?;
    let rows = pose::rows(&numbers).map_err(wrong)?;
    if rows.iter().flatten().any(|x| !x.is_finite()) {
        return Ok(None);
    }
    pose::from_rows(&rows).map(Some).map_err(wrong)
}

fn intrinsics(path: &Path) -> Result<Known<Pinhole>, FrameError> {
    let above = path.parent().unwrap_or(path);
    let Some(file) = [path, above]
        .map(|f| f.join(INTRINSICS))
        .into_iter()
        .find(|f| f.is_file())
    else {
        return Ok(Known::new(Pinhole::of(585.0, 585.0, 320.0, 240.0), "7-Scenes' default"));
    };
    let wrong = |what: String| FrameError::malformed(&file, what);
    let k = pose::numbers(&files::text(&file)?).map_err(wrong)?;
    if k.len() != 9 {
        return Err(wrong(format!("{} numbers; expected the 9 of K, row by row", k.len())));
    }
    Ok(Known::new(Pinhole::of(k[0], k[4], k[2], k[5]), INTRINSICS))
}
