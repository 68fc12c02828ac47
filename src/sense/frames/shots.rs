//! From files and poses to a recording: what layouts of one camera pair share.

use std::path::{Path, PathBuf};

use super::calibration::{Known, Pinhole, Stated};
use super::error::FrameError;
use super::frame::{Colour, Depth, Frame, Picture};
use super::{Layout, Recording, Taken, picture, visp};
use crate::geometry::{Intrinsics, Pose};

/// A depth file, the colour file taken with it, and where the camera stood.
pub(super) struct Shot {
    pub name: String,
    pub depth: PathBuf,
    pub colour: Option<PathBuf>,
    /// Of the depth camera; of the colour camera where the layout says so.
    pub world_from_camera: Pose,
}

/// What a layout says of its cameras.
pub(super) struct Cameras {
    pub depth: Option<Known<Pinhole>>,
    pub colour: Option<Known<Pinhole>>,
    pub scale: Known<f64>,
    /// Whether poses are the colour camera's.
    pub poses_of_colour: bool,
}

/// The recording of some shots.
pub(super) fn recording(
    path: &Path,
    layout: Layout,
    stated: &Stated,
    shots: Vec<Shot>,
    cameras: Cameras,
    notes: Vec<String>,
) -> Result<Recording, FrameError> {
    let first = shots
        .first()
        .ok_or_else(|| FrameError::empty(path, layout.description()))?;
    let depth_size = match layout {
        Layout::Visp => visp::depth(&first.depth)?.size,
        _ => picture::depth(&first.depth)?.size,
    };
    let depth = stated.depth(depth_size, cameras.depth)?;
    let scale = stated.scale(cameras.scale)?;
    let depth_from_colour = stated.depth_from_colour()?;
    let colour = match shots.iter().find_map(|s| s.colour.as_ref()) {
        Some(file) => Some(colour_camera(path, stated, file, &depth.value, cameras.colour)?),
        None => None,
    };
    let taken = Taken {
        layout,
        colour: described(colour.as_ref(), depth_from_colour.as_ref()),
        depth_scale: Some(scale.clone()),
        depth: depth.clone(),
    };
    let from_colour = depth_from_colour.map(|k| k.value);
    let frame = |shot: Shot| {
        let moved = from_colour.filter(|_| cameras.poses_of_colour).map(|d| d.inverse());
        let source = match layout {
            Layout::Visp => Depth::Visp(shot.depth, scale.value),
            _ => Depth::Picture(shot.depth, scale.value),
        };
        let colour = colour.zip(shot.colour).map(|(camera, file)| Colour {
            picture: Picture::File(file),
            camera,
            colour_from_depth: from_colour.map(|d| d.inverse()),
        });
        Frame {
            name: shot.name,
            world_from_camera: shot.world_from_camera * moved.unwrap_or_else(Pose::identity),
            depth_camera: depth.value,
            depth: source,
            colour,
        }
    };
    Ok(Recording {
        path: path.to_owned(),
        taken,
        frames: shots.into_iter().map(frame).collect(),
        notes,
        max_depth: stated.max_depth(),
    })
}

/// The colour camera: as stated, or the depth camera at another resolution.
fn colour_camera(
    path: &Path,
    stated: &Stated,
    file: &Path,
    depth: &Intrinsics,
    own: Option<Known<Pinhole>>,
) -> Result<Intrinsics, FrameError> {
    let size = picture::size(file)?;
    if let Some(known) = stated.colour(size, own)? {
        return Ok(known.value);
    }
    resized(depth, size).ok_or_else(|| {
        let what = format!(
            "the colour camera's intrinsics, and its {} × {} pixels are not of the shape of the depth image; write `\"colour\": {{\"fx\": …}}` into `calibration.json`",
            size[0], size[1]
        );
        FrameError::not_stated(path, what)
    })
}

/// The same field of view at another resolution; `None` for another aspect ratio.
pub(super) fn resized(camera: &Intrinsics, [width, height]: [u32; 2]) -> Option<Intrinsics> {
    let across = f64::from(width) / f64::from(camera.width);
    let down = f64::from(height) / f64::from(camera.height);
    ((across - down).abs() < 1e-3 * across).then_some(Intrinsics {
        width,
        height,
        fx: camera.fx * across,
        fy: camera.fy * down,
        cx: camera.cx * across,
        cy: camera.cy * down,
    })
}

/// What the colour pictures are, for people.
pub(super) fn described(colour: Option<&Intrinsics>, depth_from_colour: Option<&Known<Pose>>) -> String {
    let Some(camera) = colour else {
        return "none: every pixel counts as black".to_owned();
    };
    let size = format!("{} × {}", camera.width, camera.height);
    match depth_from_colour {
        None => format!("{size}, taken to be registered to depth"),
        Some(known) => {
            let t = known.value.translation.vector;
            format!(
                "{size}, its camera at [{:.3}, {:.3}, {:.3}] m in depth axes ({})",
                t.x, t.y, t.z, known.source
            )
        }
    }
}
