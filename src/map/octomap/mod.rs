//! OctoMap's files: `.bt`, states only, and `.ot`, log-odds.
//!
//! Voxels keep their places exactly, since a grid's borders lie at multiples of
//! the voxel. Both formats are a text header and then the tree in pre-order. In
//! `.bt` an inner node is 2 bits a child (01 free, 10 occupied, 11 inner, 00
//! unknown); in `.ot` every node is a 32-bit float, the data of its kind and a
//! byte that says which children follow. Eight equal leaves are one.

mod read;
mod write;

pub use read::{BadOctoMap, Leaf, OctoMap};
pub use write::{write_bt, write_ot};

/// Levels of OctoMap's tree below its root.
const DEPTH: u32 = 16;
/// The key of the voxel whose smallest corner is the origin of the world.
const ORIGIN_KEY: i64 = 1 << (DEPTH - 1);
/// First lines of the files.
const BINARY: &str = "# Octomap OcTree binary file";
const FULL: &str = "# Octomap OcTree file";
