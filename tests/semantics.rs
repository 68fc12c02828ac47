//! The planner held to the settled semantics: worlds of a few voxels worked by
//! hand, and a naive reference planner on random ones.

#[path = "semantics/mod.rs"]
mod semantics;
