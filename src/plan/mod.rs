//! The planner: statuses, their update after each measurement, the next best view.
//!
//! [`Session`] is what others call: measurements in, decisions out, no I/O and
//! no clock. `reasoning` is the flow of Fig. 3; it works on a [`World`], of
//! which the map is one, and on [`Proofs`], the rules' proof functions, so that
//! every status can be checked on worlds made by hand.

mod attributes;
pub mod candidates;
mod closed_loop;
pub mod completion;
mod error;
mod evaluate;
mod expansion;
pub mod features;
pub mod inspection;
pub mod instances;
mod knowledge;
mod look;
pub mod methods;
pub mod predictions;
pub mod reasoning;
pub mod report;
pub mod score;
mod session;
mod simulated;
mod status;
mod supposed;
pub mod trace;
mod viewpoint;
pub mod weights;
mod world;

pub use closed_loop::{ClosedLoop, Part, Sensor, Step};
pub use completion::{Completion, Outcome};
pub use error::PlanError;
pub use features::Existence;
pub use knowledge::Knowledge;
pub use look::{Look, Targets};
pub use reasoning::Proofs;
pub use report::{
    ContradictionReport, Decision, End, FeatureReport, InstanceReport, Next, Standing, TargetName, Terms, Update,
};
pub use session::{Options, Phase, Session};
pub use simulated::Simulated;
pub use status::{Contradiction, Status};
pub use supposed::{Supposed, constant, constant_arguments, suppose};
pub use trace::{Absence, Proof, RuleTrace, Trace};
pub use viewpoint::Viewpoint;
pub use world::World;
