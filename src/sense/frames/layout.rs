//! Which layout a recording is in, by its content, and what each stands for.

use std::fs;
use std::path::Path;

use super::calibration::Stated;
use super::error::FrameError;
use super::{Recording, bop, files, redwood, ros, seven_scenes, slambook, transforms, tum, visp};

/// A layout of recorded frames. All but the last three are folders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// `color/`, `depth/` and `pose.txt`, a pose a line (slambook, chapter 5).
    Slambook,
    /// `rgb.txt`, `depth.txt` and `groundtruth.txt`, associated by time.
    Tum,
    /// `frame-000000.depth.png`, `.color.png`, `.pose.txt`.
    SevenScenes,
    /// `depth/`, `color/` (or `rgb/`, `image/`) and `trajectory.log`.
    Redwood,
    /// `scene_camera.json` with `depth/`, `rgb/` (or `gray/`).
    Bop,
    /// `Depth/*.bin`, `Images/`, `CameraPose/` (ViSP's data sets).
    Visp,
    /// `transforms.json` with depth pictures.
    Transforms,
    /// A ROS 1 bag.
    RosBag,
    /// An MCAP file of ROS messages.
    Mcap,
}

/// How a layout's poses and pixels are to be read.
pub struct Conventions {
    /// What a pose maps.
    pub pose: &'static str,
    /// Which way camera axes point.
    pub axes: &'static str,
    /// Where pixels are centred.
    pub centres: &'static str,
}

const OPENCV: &str = "OpenCV: x right, y down, z forward";
const OPENGL: &str = "OpenGL: x right, y up, z backward";
const WHOLE: &str = "pixels are centred at whole numbers";
const HALVES: &str = "pixels are centred at halves";

impl Layout {
    /// The layouts in the order in which they are looked for.
    pub const ALL: [Self; 9] = [
        Self::RosBag,
        Self::Mcap,
        Self::Transforms,
        Self::Bop,
        Self::Tum,
        Self::SevenScenes,
        Self::Redwood,
        Self::Visp,
        Self::Slambook,
    ];

    /// The layout of a folder or file.
    pub(super) fn of(path: &Path) -> Result<Self, FrameError> {
        fs::metadata(path).map_err(|error| FrameError::unreadable(path, &error))?;
        let found = Self::ALL.into_iter().find(|layout| layout.fits(path));
        found.ok_or_else(|| FrameError::UnknownLayout(path.to_owned()))
    }

    fn fits(self, path: &Path) -> bool {
        let has = |name: &str| path.join(name).exists();
        let ends = |end: &str| path.is_file() && path.to_string_lossy().to_lowercase().ends_with(end);
        match self {
            Self::RosBag => ends(".bag"),
            Self::Mcap => ends(".mcap"),
            Self::Transforms => ends(".json") || has("transforms.json"),
            Self::Bop => has("scene_camera.json") || (has("camera.json") && has("depth.png")),
            Self::Tum => has("depth.txt"),
            Self::SevenScenes => {
                path.is_dir() && files::listed(path, &[".depth.png"]).is_ok_and(|found| !found.is_empty())
            }
            Self::Redwood => redwood::trajectory(path).is_some(),
            Self::Visp => has("CameraPose") && has("Depth"),
            Self::Slambook => has("pose.txt") && has("depth"),
        }
    }

    pub(super) fn open(self, path: &Path, stated: &Stated) -> Result<Recording, FrameError> {
        match self {
            Self::Slambook => slambook::open(path, stated),
            Self::Tum => tum::open(path, stated),
            Self::SevenScenes => seven_scenes::open(path, stated),
            Self::Redwood => redwood::open(path, stated),
            Self::Bop => bop::open(path, stated),
            Self::Visp => visp::open(path, stated),
            Self::Transforms => transforms::open(path, stated),
            Self::RosBag | Self::Mcap => ros::open(path, self, stated),
        }
    }

    /// What people call it, and what it consists of.
    pub fn description(self) -> &'static str {
        match self {
            Self::Slambook => "slambook: `color/`, `depth/` and `pose.txt`, a pose a line",
            Self::Tum => "TUM RGB-D: `rgb.txt`, `depth.txt` and `groundtruth.txt`",
            Self::SevenScenes => "7-Scenes, 3DMatch, tsdf-fusion: `frame-000000.depth.png` with `.pose.txt`",
            Self::Redwood => "Redwood: `depth/`, `color/` and `trajectory.log`",
            Self::Bop => "BOP: `scene_camera.json` with `depth/` and `rgb/`, or one frame beside `camera.json`",
            Self::Visp => "ViSP: `Depth/*.bin`, `Images/` and `CameraPose/`",
            Self::Transforms => "transforms.json: frames with a `depth_file_path`",
            Self::RosBag => "ROS 1 bag (`.bag`): PointCloud2, or Image with CameraInfo and tf",
            Self::Mcap => "MCAP (`.mcap`) of ROS messages: PointCloud2, or Image with CameraInfo and tf",
        }
    }

    /// How its poses and pixels are read.
    pub fn conventions(self) -> Conventions {
        let (pose, axes, centres) = match self {
            Self::Slambook | Self::Tum | Self::SevenScenes | Self::Redwood => ("camera to world", OPENCV, WHOLE),
            Self::Bop => ("world to camera", OPENCV, WHOLE),
            Self::Visp => ("object to colour camera", OPENCV, WHOLE),
            Self::Transforms => ("camera to world", OPENGL, HALVES),
            Self::RosBag | Self::Mcap => ("by tf, optical frame to fixed frame", OPENCV, WHOLE),
        };
        Conventions { pose, axes, centres }
    }
}
