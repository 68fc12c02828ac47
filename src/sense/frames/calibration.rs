//! What a recording does not say of itself: intrinsics, depth scale, the
//! transform between its two cameras.
//!
//! Stated by options, by `calibration.json` beside the recording, or by the
//! layout's own files and customs, in that order.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::error::FrameError;
use super::files;
use super::pose;
use crate::geometry::{Intrinsics, Pose};

/// The side file that is looked for in the folder of a recording.
pub const CALIBRATION: &str = "calibration.json";

/// What is stated of a recording from outside.
#[derive(Clone, Debug, Default)]
pub struct FrameOptions {
    /// A calibration file; `calibration.json` in the recording's folder where `None`.
    pub calibration: Option<PathBuf>,
    /// fx, fy, cx, cy of the depth image, pixels, OpenCV's convention.
    pub intrinsics: Option<[f64; 4]>,
    /// Raw units of depth a metre.
    pub depth_scale: Option<f64>,
    /// Readings of this z-depth (metres) or more count as none.
    pub max_depth: Option<f64>,
}

/// A pinhole in OpenCV's convention: whole numbers are the centres of pixels,
/// half a pixel less than in [`Intrinsics`].
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pinhole {
    /// Columns, where stated.
    pub width: Option<u32>,
    /// Rows, where stated.
    pub height: Option<u32>,
    /// Horizontal focal length, pixels.
    pub fx: f64,
    /// Vertical focal length, pixels.
    pub fy: f64,
    /// Column of the principal point.
    pub cx: f64,
    /// Row of the principal point.
    pub cy: f64,
}

impl Pinhole {
    /// Of an image whose size is not stated.
    pub const fn of(fx: f64, fy: f64, cx: f64, cy: f64) -> Self {
        let (width, height) = (None, None);
        #[rustfmt::skip]
        let pinhole = Self { width, height, fx, fy, cx, cy };
        pinhole
    }

    /// The intrinsics of an image of `size`; what is wrong otherwise.
    pub fn sized(self, [width, height]: [u32; 2]) -> Result<Intrinsics, String> {
        let stated = [self.width.unwrap_or(width), self.height.unwrap_or(height)];
        if stated != [width, height] {
            let [w, h] = stated;
            return Err(format!(
                "intrinsics are of {w} × {h} pixels and the image has {width} × {height}"
            ));
        }
        let finite = [self.fx, self.fy, self.cx, self.cy].iter().all(|x| x.is_finite());
        if !(finite && self.fx > 0.0 && self.fy > 0.0) {
            return Err("focal lengths must be above 0 and all intrinsics finite".to_owned());
        }
        Ok(Intrinsics {
            width,
            height,
            fx: self.fx,
            fy: self.fy,
            cx: self.cx + 0.5,
            cy: self.cy + 0.5,
        })
    }
}

/// The content of a calibration file.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct Calibration {
    depth: Option<Pinhole>,
    colour: Option<Pinhole>,
    depth_scale: Option<f64>,
    depth_from_colour: Option<[[f64; 4]; 4]>,
}

/// A value and where it comes from.
#[derive(Clone, Debug)]
pub struct Known<T> {
    /// The value.
    pub value: T,
    /// Where it comes from, for people.
    pub source: String,
}

impl<T> Known<T> {
    pub(super) fn new(value: T, source: impl Into<String>) -> Self {
        Self {
            value,
            source: source.into(),
        }
    }
}

/// Everything stated of a recording from outside.
pub(super) struct Stated {
    root: PathBuf,
    options: FrameOptions,
    calibration: Calibration,
    file: PathBuf,
}

impl Stated {
    /// Reads the calibration file, if there is one.
    pub fn of(root: &Path, options: &FrameOptions) -> Result<Self, FrameError> {
        let folder = if root.is_dir() {
            root
        } else {
            root.parent().unwrap_or(Path::new(""))
        };
        let beside = folder.join(CALIBRATION);
        let file = options
            .calibration
            .clone()
            .or_else(|| beside.is_file().then_some(beside));
        let calibration = match &file {
            Some(file) => {
                let text = files::text(file)?;
                serde_json::from_str(&text).map_err(|e| FrameError::malformed(file, e.to_string()))?
            }
            None => Calibration::default(),
        };
        Ok(Self {
            root: root.to_owned(),
            options: options.clone(),
            calibration,
            file: file.unwrap_or_default(),
        })
    }

    fn in_file<T>(&self, value: Option<T>) -> Option<Known<T>> {
        Some(Known::new(value?, format!("{}", self.file.display())))
    }

    /// Readings of this z-depth (metres) or more count as none.
    pub fn max_depth(&self) -> f64 {
        self.options.max_depth.unwrap_or(f64::INFINITY)
    }

    /// Intrinsics of the depth image; `own` are the layout's.
    pub fn depth(&self, size: [u32; 2], own: Option<Known<Pinhole>>) -> Result<Known<Intrinsics>, FrameError> {
        let option = self.options.intrinsics.map(|[fx, fy, cx, cy]| {
            let pinhole = Pinhole::of(fx, fy, cx, cy);
            Known::new(pinhole, "--intrinsics")
        });
        let known = option.or_else(|| self.in_file(self.calibration.depth)).or(own);
        let known = known.ok_or_else(|| {
            let example = r#"{"depth": {"fx": 525, "fy": 525, "cx": 319.5, "cy": 239.5}, "depth_scale": 1000}"#;
            let what = format!(
                "the camera's intrinsics; give `--intrinsics fx,fy,cx,cy`, or write them into `{CALIBRATION}` beside it, as in {example}"
            );
            FrameError::not_stated(&self.root, what)
        })?;
        self.sized(known, size)
    }

    /// Intrinsics of the colour image: the file's, the layout's, or those of the depth image.
    pub fn colour(&self, size: [u32; 2], own: Option<Known<Pinhole>>) -> Result<Option<Known<Intrinsics>>, FrameError> {
        let known = self.in_file(self.calibration.colour).or(own);
        known.map(|known| self.sized(known, size)).transpose()
    }

    fn sized(&self, known: Known<Pinhole>, size: [u32; 2]) -> Result<Known<Intrinsics>, FrameError> {
        let wrong = |what: String| FrameError::malformed(&self.root, format!("{what} ({})", known.source));
        let intrinsics = known.value.sized(size).map_err(wrong)?;
        Ok(Known::new(intrinsics, known.source))
    }

    /// Raw units of depth a metre; `own` is the layout's.
    pub fn scale(&self, own: Known<f64>) -> Result<Known<f64>, FrameError> {
        let option = self.options.depth_scale.map(|s| Known::new(s, "--depth-scale"));
        let known = option
            .or_else(|| self.in_file(self.calibration.depth_scale))
            .unwrap_or(own);
        if known.value.is_finite() && known.value > 0.0 {
            return Ok(known);
        }
        let what = format!(
            "the depth scale is {} ({}); expected a number above 0",
            known.value, known.source
        );
        Err(FrameError::malformed(&self.root, what))
    }

    /// The transform from colour camera axes to depth camera axes, if stated.
    pub fn depth_from_colour(&self) -> Result<Option<Known<Pose>>, FrameError> {
        let Some(rows) = self.calibration.depth_from_colour else {
            return Ok(None);
        };
        let wrong = |what| FrameError::malformed(&self.file, format!("`depth_from_colour`: {what}"));
        let pose = pose::from_rows(&rows).map_err(wrong)?;
        Ok(self.in_file(Some(pose)))
    }
}
