//! ViSP's data sets: `Depth/*.bin`, `Images/`, `CameraPose/`, `Config/`.
//!
//! A `.bin` file is height and width as 32-bit numbers, then height × width
//! 16-bit ones, little-endian, 32768 units a metre, 0 no reading. A pose file is
//! 4 × 4 rows that map the object's axes to the colour camera's, metres, OpenCV
//! axes: world to camera. The depth camera stands beside the colour camera; the
//! transform between them is in no file, so `depth_from_colour` must be stated.
//! Intrinsics are those of the tracker configurations in `Config/`.

use std::path::{Path, PathBuf};

use super::calibration::{Known, Pinhole, Stated};
use super::error::FrameError;
use super::picture::{Raw, fits};
use super::shots::{self, Cameras, Shot};
use super::slambook::COLOUR;
use super::{Layout, Recording, files, pose};
use crate::geometry::Pose;

pub(super) fn open(path: &Path, stated: &Stated) -> Result<Recording, FrameError> {
    let poses = files::listed(&path.join("CameraPose"), &[".txt"])?;
    let depth = files::listed(&path.join("Depth"), &[".bin"])?;
    let colour = match path.join("Images") {
        folder if folder.is_dir() => files::listed(&folder, COLOUR)?,
        _ => Vec::new(),
    };
    let numbered = |list: &[PathBuf], n: u64| list.iter().find(|p| files::number(p) == Some(n)).cloned();
    let mut shots = Vec::new();
    for file in &poses {
        let Some((n, depth)) = files::number(file).and_then(|n| Some((n, numbered(&depth, n)?))) else {
            continue;
        };
        shots.push(Shot {
            name: n.to_string(),
            colour: numbered(&colour, n),
            depth,
            world_from_camera: camera_from_world(file)?.inverse(),
        });
    }
    let mut notes = Vec::new();
    if shots.len() < poses.len() {
        notes.push(format!(
            "{} poses have no depth file and are left out",
            poses.len() - shots.len()
        ));
    }
    if stated.depth_from_colour()?.is_none() {
        let text =
            "the poses are the colour camera's, and `depth_from_colour` is not stated: both cameras count as one";
        notes.push(text.to_owned());
    }
    let (of_colour, of_depth) = configured(path)?;
    let cameras = Cameras {
        depth: of_depth.or_else(|| of_colour.clone()),
        colour: of_colour,
        scale: Known::new(32768.0, "ViSP's"),
        poses_of_colour: true,
    };
    shots::recording(path, Layout::Visp, stated, shots, cameras, notes)
}

/// Reads ViSP's raw depth.
pub(super) fn depth(path: &Path) -> Result<Raw, FrameError> {
    let bytes = files::bytes(path)?;
    let wrong = |what: String| FrameError::malformed(path, what);
    let [h, w] = [0, 4].map(|at| {
        bytes
            .get(at..at + 4)
            .and_then(|b| b.try_into().ok())
            .map(u32::from_le_bytes)
    });
    let (Some(height), Some(width)) = (h, w) else {
        return Err(wrong(format!("it ends after {} bytes, within its size", bytes.len())));
    };
    fits([width, height]).map_err(wrong)?;
    let expected = 8 + 2 * width as usize * height as usize;
    if bytes.len() != expected {
        let what = format!(
            "it has {} bytes; {width} × {height} pixels take {expected}",
            bytes.len()
        );
        return Err(wrong(what));
    }
    let values = bytes[8..]
        .chunks_exact(2)
        .map(|b| u16::from_le_bytes([b[0], b[1]]))
        .collect();
    Ok(Raw {
        size: [width, height],
        values,
    })
}

fn camera_from_world(path: &Path) -> Result<Pose, FrameError> {
    let wrong = |what: String| FrameError::malformed(path, what);
    let numbers = pose::numbers(&files::text(path)?).map_err(wrong)?;
    pose::rows(&numbers)
        .and_then(|rows| pose::from_rows(&rows))
        .map_err(wrong)
}

type Of = Option<Known<Pinhole>>;

/// Intrinsics of the colour and the depth camera in the tracker configurations.
fn configured(path: &Path) -> Result<(Of, Of), FrameError> {
    let (mut of_colour, mut of_depth) = (None, None);
    let folder = path.join("Config");
    let configurations = if folder.is_dir() {
        files::listed(&folder, &[".xml"])?
    } else {
        Vec::new()
    };
    for file in configurations {
        let text = files::text(&file)?;
        let value = |tag: &str| {
            text.split_once(&format!("<{tag}>"))?
                .1
                .split_once('<')?
                .0
                .trim()
                .parse::<f64>()
                .ok()
        };
        let found = (|| Some(Pinhole::of(value("px")?, value("py")?, value("u0")?, value("v0")?)))();
        let name = files::stem(&file);
        let place = if name.contains("depth") {
            &mut of_depth
        } else {
            &mut of_colour
        };
        *place = found
            .map(|p| Known::new(p, format!("Config/{name}.xml")))
            .or_else(|| place.take());
    }
    Ok((of_colour, of_depth))
}
