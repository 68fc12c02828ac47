//! What a run learnt, in the formats of other tools: clouds, meshes, poses.
//!
//! Each writer is a pure function of plain values onto a stream. Lengths are
//! metres, axes the world's.

mod cloud;
mod mesh;
mod poses;

pub use cloud::{pcd, ply};
pub use mesh::{Face, obj, ply as mesh_ply};
pub use poses::{Stop, transforms, tum};
