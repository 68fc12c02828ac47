//! ROS logs: bags of ROS 1 and MCAP files, with PointCloud2 or Image messages.
//!
//! An organised PointCloud2 becomes a depth image through the intrinsics that
//! its own points obey. An Image of depth (`16UC1` in mm, `32FC1` in metres) goes
//! with the CameraInfo beside it and the nearest colour image. Poses come from
//! tf: the optical frame in the root of its tree, at the time of the image.
//! Optical frames have OpenCV axes, and CameraInfo has its pixels centred at
//! whole numbers. Without tf the camera's own axes are the world.

mod bag;
mod cloud;
mod collect;
mod cursor;
mod images;
mod mcap;
mod messages;
mod tf;

use std::path::Path;

use super::calibration::Stated;
use super::error::FrameError;
use super::{Layout, Recording};
use collect::Collection;

/// Largest log, bytes.
const MOST_BYTES: u64 = 4 << 30;
/// Most bytes of pictures that are held.
const MOST_HELD: usize = 2 << 30;

pub(super) fn open(path: &Path, layout: Layout, stated: &Stated) -> Result<Recording, FrameError> {
    let mut collection = Collection::default();
    let mut take = |message: &Message| {
        collection
            .take(message)
            .map_err(|what| FrameError::malformed(path, what))
    };
    match layout {
        Layout::Mcap => mcap::read(path, &mut take)?,
        _ => bag::read(path, &mut take)?,
    }
    collection.recording(path, layout, stated)
}

/// A message of a log.
struct Message<'a> {
    topic: &'a str,
    /// `sensor_msgs/Image`, without ROS 2's `/msg`.
    kind: &'a str,
    /// Whether it is serialised as CDR (ROS 2).
    cdr: bool,
    data: &'a [u8],
}
