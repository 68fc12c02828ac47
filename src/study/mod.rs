//! Experiments: the runs of a study, their rows, and what they say.
//!
//! A [`Design`] lists the runs of a study in one order; [`run`] makes them and gives a
//! [`Row`] each; [`Ledger`] keeps the rows in a folder, so that a study goes on where it
//! stopped; [`summary`] and [`report`] say what they mean. Rows hold no times: they are
//! the same bytes whatever the machine, the threads or the shards.

pub mod bounds;
mod design;
mod error;
mod execute;
mod ledger;
pub mod published;
pub mod report;
mod row;
mod run;
mod stage;
mod statistics;
pub mod summary;
mod truth;

pub use design::{Arm, Design, Job, Kind, MOST_RUNS};
pub use error::StudyError;
pub use execute::{Shard, execute};
pub use ledger::{Ledger, Manifest};
pub use row::Row;
pub use stage::Stage;
pub use statistics::{Interval, bootstrap, mean};
