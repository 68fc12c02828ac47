//! Colours by name: the one table is with the primitives.

pub(in crate::lang) use crate::primitives::colours::{all, named, names};
