//! Colours by name: the one table is with the primitives.

pub(super) use crate::primitives::colours::{named, names};
