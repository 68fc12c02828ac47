//! The compiled rule set: the wall between language and planner.
//!
//! Plain data in SI units, fully resolved and in a stable order. The language
//! half writes it, the planning half reads it, and neither sees the other.
//! Every entry names the place in the source that it came from.

mod artefact;
mod expr;
mod facts;
mod library;
mod scene;
#[cfg(test)]
mod schema;
mod study;
mod task;

pub(crate) use artefact::hex;
pub use artefact::{FORMAT, LANGUAGE, Place, ReadError, RuleSet, Source};
pub use expr::{BadArgument, Call, Colour, Expr, Value};
pub use facts::{Expectation, Expected, Fact, Flag, Given, State};
pub use library::{Class, Each, Feature, FeatureId, FeatureKind, Library, Presence, Rule};
pub use scene::{Backdrop, Marker, Scene, SceneObject};
pub use study::{Settings, Study, Subject, Variant};
#[cfg(test)]
pub(crate) use task::BYTES_PER_VOXEL;
pub use task::{Goal, Insertion, Inspected, METHODS, SensorModel, Space, Task, Thresholds, Visibility};
