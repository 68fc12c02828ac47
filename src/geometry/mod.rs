//! Points, poses, planar polygons, pinhole cameras and boxes.
//!
//! Thin over nalgebra. Everything is in metres and radians, right-handed, z up;
//! cameras use OpenCV axes (x right, y down, z forward). A transform is named by
//! what it maps: `world_from_camera` turns camera coordinates into world ones.

pub mod bounds;
pub mod camera;
pub mod frame;
pub mod polygon;

pub use bounds::Bounds;
pub use camera::{Camera, DepthRange, Intrinsics};
pub use frame::{Point, Pose, Rotation, Vector, axis_word, frame_facing, look_at};
pub use polygon::{Edge, Polygon};
