//! Recorded frames and map files: every layout is written here from rendered
//! frames, read back, broken and mistaken for another; and what others recorded
//! is read where it is at hand.

mod layouts;
mod meshes;
mod octomap;
mod outputs;
mod plan;
mod refused;
mod ros;
mod scene;
mod shared;
mod support;
