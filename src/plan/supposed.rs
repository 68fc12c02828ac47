//! Reasoning from what is stated instead of measured.
//!
//! The statuses are those that a run would have whose detectors had found just
//! this, in a space of which nothing else is known. Tests of the language use it;
//! a run never does.

use super::error::PlanError;
use super::evaluate::Context;
use super::features::Existence;
use super::instances::{self, Detection, Finding};
use super::knowledge::Knowledge;
use super::reasoning::{self, Proofs};
use super::status::Status;
use super::trace::Proof;
use super::world::World;
use crate::detect::{Account, Condition, Measurement};
use crate::geometry::Point;
use crate::map::{Grid, Occupancy, TooLarge, Voxel};
use crate::primitives::{Arguments, Datum};
use crate::rules::{BadArgument, Call, Expr, FeatureId, Rule};

/// What is stated of a feature.
#[derive(Clone, Debug)]
pub enum Supposed {
    /// Detected; its place is not known, so that nothing is predicted from it.
    Detected,
    /// Inspected and not found.
    Absent,
    /// An instance of it was measured.
    Measured(Measurement),
}

/// The statuses that follow from evidence, taken in its order.
///
/// # Errors
/// A rule's arguments do not fit together, or the task's space is too large.
pub fn suppose(knowledge: &Knowledge, evidence: &[(FeatureId, Supposed)]) -> Result<Status, PlanError> {
    let space = &knowledge.task.space;
    let voxels = space.size.map(|extent| extent / space.voxel).product();
    let world = Unseen(Grid::covering(space).ok_or(TooLarge(voxels))?);
    let mut status = Status::new(knowledge);
    for (feature, supposed) in evidence {
        take(*feature, supposed, &mut status, knowledge);
    }
    reasoning::conclude(&mut status, knowledge, &world, &Nothing)?;
    Ok(status)
}

fn take(id: FeatureId, supposed: &Supposed, status: &mut Status, knowledge: &Knowledge) {
    if let Supposed::Measured(measurement) = supposed {
        let detection = Detection {
            finding: Finding {
                evidence: None,
                measurement: measurement.clone(),
            },
            measure: (String::new(), Arguments::default()),
            pin: None,
        };
        let matching = reasoning::matching(id, knowledge);
        let feature = &mut status.features[id.index()];
        instances::take(feature, detection, &matching, &mut status.next_revision);
    }
    let state = match supposed {
        Supposed::Absent => Existence::Absent,
        Supposed::Detected | Supposed::Measured(_) => Existence::Detected,
    };
    status.decide(id, state);
}

/// The value of an expression that reads no feature; `None` where it is degenerate.
///
/// # Errors
/// An argument does not fit together.
pub fn constant(expr: &Expr) -> Result<Option<Datum>, BadArgument> {
    no_rule(|context| context.value(expr))
}

/// The arguments of a call that reads no feature; `None` where one is degenerate.
///
/// # Errors
/// An argument does not fit together.
pub fn constant_arguments(call: &Call) -> Result<Option<Arguments>, BadArgument> {
    no_rule(|context| context.arguments(call))
}

fn no_rule<T>(evaluate: impl FnOnce(&Context<'_>) -> T) -> T {
    evaluate(&Context {
        antecedents: Default::default(),
        variables: &Default::default(),
        measured: &|_| Vec::new(),
    })
}

/// Detectors that find nothing more than what was stated.
struct Nothing;

impl Proofs for Nothing {
    fn find(&self, _: &Rule, _: &Arguments, _: &Arguments) -> Result<Proof, BadArgument> {
        Ok(Proof {
            findings: Vec::new(),
            account: Account::of(0),
        })
    }

    fn shell(&self, _: &Rule, _: &Arguments, _: &[Point], _: f64) -> Result<Condition, BadArgument> {
        Ok(Condition::plain("measured", false))
    }
}

/// A space of which nothing was measured.
struct Unseen(Grid);

impl World for Unseen {
    fn grid(&self) -> &Grid {
        &self.0
    }

    fn occupancy(&self, _: Voxel) -> Occupancy {
        Occupancy::Unknown
    }

    fn probability(&self, _: Voxel) -> Option<f64> {
        None
    }

    fn measured_within(&self, _: &Point, _: f64) -> bool {
        false
    }

    fn visible(&self, _: &Point, _: Voxel, _: f64) -> bool {
        true
    }

    fn occupied(&self) -> Vec<Voxel> {
        Vec::new()
    }

    fn rear_side(&self) -> Vec<Voxel> {
        Vec::new()
    }
}
