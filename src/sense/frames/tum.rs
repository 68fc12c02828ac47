//! TUM RGB-D: `rgb.txt`, `depth.txt`, `groundtruth.txt`.
//!
//! Lists of `timestamp file` and `timestamp tx ty tz qx qy qz qw`; `#` begins a
//! comment. Poses are camera to world, metres, OpenCV axes. Depth is 16-bit PNG,
//! 5000 units a metre, registered to colour. A depth picture goes with the
//! nearest colour picture and the nearest pose within 20 ms. Intrinsics are the
//! published ones of freiburg1, 2 and 3 where the folder's name tells, otherwise
//! ROS's default that the data set's page recommends.

use std::path::{Path, PathBuf};

use super::calibration::{Known, Pinhole, Stated};
use super::error::FrameError;
use super::shots::{self, Cameras, Shot};
use super::{Layout, Recording, files, pose};
use crate::geometry::Pose;

/// Most seconds between what belongs together.
const APART: f64 = 0.02;

const PUBLISHED: [(&str, Pinhole); 3] = [
    ("freiburg1", Pinhole::of(517.3, 516.5, 318.6, 255.3)),
    ("freiburg2", Pinhole::of(520.9, 521.0, 325.1, 249.7)),
    ("freiburg3", Pinhole::of(535.4, 539.2, 320.1, 247.6)),
];

pub(super) fn open(path: &Path, stated: &Stated) -> Result<Recording, FrameError> {
    let depth = list(&path.join("depth.txt"), path)?;
    let colour = match path.join("rgb.txt") {
        file if file.is_file() => list(&file, path)?,
        _ => Vec::new(),
    };
    let poses = trajectory(&path.join("groundtruth.txt"))?;
    let all = depth.len();
    let shot = |(time, depth): (f64, PathBuf)| {
        Some(Shot {
            name: files::stem(&depth),
            depth,
            colour: nearest(&colour, time).cloned(),
            world_from_camera: *nearest(&poses, time)?,
        })
    };
    let shots: Vec<Shot> = depth.into_iter().filter_map(shot).collect();
    if shots.is_empty() {
        return Err(FrameError::empty(
            path,
            "no depth picture has a pose within 20 ms; are both in the same clock?",
        ));
    }
    let mut notes = Vec::new();
    if shots.len() < all {
        notes.push(format!(
            "{} of {all} depth pictures have no pose within 20 ms and are left out",
            all - shots.len()
        ));
    }
    let cameras = Cameras {
        depth: Some(published(path)),
        colour: None,
        scale: Known::new(5000.0, "TUM's"),
        poses_of_colour: false,
    };
    shots::recording(path, Layout::Tum, stated, shots, cameras, notes)
}

fn published(path: &Path) -> Known<Pinhole> {
    let name = path.to_string_lossy().to_lowercase();
    match PUBLISHED.iter().find(|(camera, _)| name.contains(camera)) {
        Some((camera, pinhole)) => Known::new(*pinhole, format!("published for {camera}")),
        None => Known::new(
            Pinhole::of(525.0, 525.0, 319.5, 239.5),
            "ROS's default, which TUM recommends",
        ),
    }
}

/// What is nearest in time, within [`APART`]; the list is in order of time.
fn nearest<T>(list: &[(f64, T)], time: f64) -> Option<&T> {
    let after = list.partition_point(|(t, _)| *t < time);
    let near = list[after.saturating_sub(1)..list.len().min(after + 1)].iter();
    let nearest = near.min_by(|a, b| (a.0 - time).abs().total_cmp(&(b.0 - time).abs()))?;
    ((nearest.0 - time).abs() <= APART).then_some(&nearest.1)
}

fn list(path: &Path, root: &Path) -> Result<Vec<(f64, PathBuf)>, FrameError> {
    lines(path, |words| match words {
        [_, file, ..] => Ok(root.join(file)),
        _ => Err("expected `timestamp file`".to_owned()),
    })
}

fn trajectory(path: &Path) -> Result<Vec<(f64, Pose)>, FrameError> {
    lines(path, |words| {
        let numbers = pose::numbers(&words.join(" "))?;
        let &[_, x, y, z, qx, qy, qz, qw] = numbers.as_slice() else {
            return Err(format!(
                "{} numbers; expected the 8 of `timestamp tx ty tz qx qy qz qw`",
                numbers.len()
            ));
        };
        pose::from_quaternion([x, y, z], [qx, qy, qz, qw])
    })
}

/// The lines of a list in order of time.
fn lines<T>(path: &Path, read: impl Fn(&[&str]) -> Result<T, String>) -> Result<Vec<(f64, T)>, FrameError> {
    let text = files::text(path)?;
    let mut entries = Vec::new();
    for (k, line) in text.lines().enumerate() {
        let words: Vec<&str> = line.split_whitespace().collect();
        if words.is_empty() || line.starts_with('#') {
            continue;
        }
        let entry = pose::numbers(words[0]).and_then(|time| Ok((time[0], read(&words)?)));
        entries.push(entry.map_err(|what| FrameError::malformed(path, format!("line {}: {what}", k + 1)))?);
    }
    entries.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(entries)
}
