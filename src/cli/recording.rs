//! Options that say of recorded frames what they do not say themselves.

use std::path::{Path, PathBuf};

use clap::Args;

use super::Failure;
use crate::sense::frames::{FrameError, FrameOptions, Layout, Recording};

/// What is stated of a recording.
#[derive(Args)]
pub(crate) struct RecordingOptions {
    /// Intrinsics, depth scale and extrinsics of a recording that lacks them
    /// (JSON); `calibration.json` beside it where left out.
    #[arg(long, value_name = "FILE.json")]
    pub calibration: Option<PathBuf>,
    /// Focal lengths and principal point of the depth image, pixels, as OpenCV counts them.
    #[arg(long, value_name = "FX,FY,CX,CY", value_parser = intrinsics)]
    pub intrinsics: Option<[f64; 4]>,
    /// Raw units of depth a metre: 1000 for millimetres.
    #[arg(long, value_name = "N", value_parser = positive)]
    pub depth_scale: Option<f64>,
    /// Readings of this depth or more count as none, as in `7m`.
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub max_depth: Option<f64>,
}

impl RecordingOptions {
    /// Opens a recording.
    pub fn open(&self, path: &Path) -> Result<Recording, Failure> {
        let options = FrameOptions {
            calibration: self.calibration.clone(),
            intrinsics: self.intrinsics,
            depth_scale: self.depth_scale,
            max_depth: self.max_depth,
        };
        Recording::open(path, &options).map_err(refused)
    }

    /// The first of these options that is set.
    pub fn first_set(&self) -> Option<&'static str> {
        let set = [
            ("--calibration", self.calibration.is_some()),
            ("--intrinsics", self.intrinsics.is_some()),
            ("--depth-scale", self.depth_scale.is_some()),
            ("--max-depth", self.max_depth.is_some()),
        ];
        set.into_iter().find(|(_, set)| *set).map(|(name, _)| name)
    }
}

/// A recording's error; where the layout is unknown, with those that are known.
pub(crate) fn refused(error: FrameError) -> Failure {
    let known = match &error {
        FrameError::UnknownLayout(_) => {
            let lines = Layout::ALL.iter().map(|l| format!("\n  {}", l.description()));
            format!("; known are:{}", lines.collect::<String>())
        }
        _ => String::new(),
    };
    Failure::Recording(format!("{error}{known}"))
}

/// A length with its unit, metres.
pub(crate) fn length(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let metres = match text[digits.len()..].trim() {
        "mm" => 0.001,
        "cm" => 0.01,
        "m" => 1.0,
        "in" => 0.0254,
        _ => return Err("expected a length with a unit, as in `50mm` (mm, cm, m or in)".to_owned()),
    };
    Ok(positive(digits.trim_end())? * metres)
}

fn positive(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|n| n.is_finite() && *n > 0.0);
    number.ok_or_else(|| format!("`{text}` is no number above 0"))
}

fn intrinsics(text: &str) -> Result<[f64; 4], String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|n| n.trim().parse::<f64>()).collect();
    let four = numbers.ok().and_then(|n| <[f64; 4]>::try_from(n).ok());
    four.ok_or_else(|| "expected four numbers, as in `525,525,319.5,239.5`".to_owned())
}
