//! One frame: where its pictures are and how they become an observation.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::error::FrameError;
use super::{picture, register, visp};
use crate::geometry::{Intrinsics, Pose};
use crate::sense::{ColourImage, DepthImage};

/// A recorded frame.
#[derive(Clone)]
pub struct Frame {
    /// What the recording calls it.
    pub name: String,
    /// Where its depth camera stood.
    pub world_from_camera: Pose,
    /// Its depth camera.
    pub depth_camera: Intrinsics,
    pub(super) depth: Depth,
    pub(super) colour: Option<Colour>,
}

/// Where depth comes from.
#[derive(Clone)]
pub(super) enum Depth {
    /// A 16-bit PNG or PGM picture, raw units a metre.
    Picture(PathBuf, f64),
    /// ViSP's raw file, raw units a metre.
    Visp(PathBuf, f64),
    /// A message of a log.
    Held(Arc<DepthImage>),
}

/// Where colour comes from.
#[derive(Clone)]
pub(super) enum Picture {
    File(PathBuf),
    Held(Arc<ColourImage>),
}

/// A colour picture and its camera.
#[derive(Clone)]
pub(super) struct Colour {
    pub picture: Picture,
    pub camera: Intrinsics,
    /// `None` where both cameras share one optical centre and axes.
    pub colour_from_depth: Option<Pose>,
}

impl Frame {
    /// Intrinsics of the colour image of its observation.
    pub(super) fn colour_camera(&self) -> Intrinsics {
        match &self.colour {
            Some(colour) if colour.colour_from_depth.is_none() => colour.camera,
            _ => self.depth_camera,
        }
    }

    pub(super) fn read_depth(&self) -> Result<DepthImage, FrameError> {
        let (image, path) = match &self.depth {
            Depth::Picture(path, scale) => (picture::depth(path)?.metres(*scale), path.as_path()),
            Depth::Visp(path, scale) => (visp::depth(path)?.metres(*scale), path.as_path()),
            Depth::Held(image) => (DepthImage::clone(image), Path::new(&self.name)),
        };
        sized(path, [image.width, image.height], &self.depth_camera)?;
        Ok(image)
    }

    /// The colour picture, as the depth camera sees it where the two stand
    /// apart; black where there is none.
    pub(super) fn read_colour(&self, depth: &DepthImage) -> Result<ColourImage, FrameError> {
        let Some(colour) = &self.colour else {
            return Ok(ColourImage {
                width: depth.width,
                height: depth.height,
                pixels: vec![[0; 3]; depth.metres.len()],
            });
        };
        let (image, path) = match &colour.picture {
            Picture::File(path) => (picture::colour(path)?, path.as_path()),
            Picture::Held(image) => (ColourImage::clone(image), Path::new(&self.name)),
        };
        sized(path, [image.width, image.height], &colour.camera)?;
        Ok(match &colour.colour_from_depth {
            None => image,
            Some(from_depth) => register::colours(depth, &self.depth_camera, &image, &colour.camera, from_depth),
        })
    }
}

fn sized(path: &Path, found: [u32; 2], camera: &Intrinsics) -> Result<(), FrameError> {
    if found == [camera.width, camera.height] {
        return Ok(());
    }
    let ([w, h], Intrinsics { width, height, .. }) = (found, camera);
    let what = format!("it has {w} × {h} pixels; the first picture of the recording has {width} × {height}");
    Err(FrameError::malformed(path, what))
}
