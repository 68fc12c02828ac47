//! Facts: whether what the tests of a program expect follows from what they give.
//!
//! The planner's own reasoning is run from stated evidence ([`crate::plan::suppose`]);
//! nothing of it is done a second time here. Reads the rule set and the lowered
//! tests, never the source; `vpl test` shows what it finds.

mod compare;
mod coverage;
mod expectations;
mod ground;
mod values;
mod words;

pub use coverage::{Coverage, RuleCoverage};

use rayon::prelude::*;

use crate::plan::{Knowledge, PlanError, Status, Supposed, suppose};
use crate::rules::{Fact, FeatureId, Given, Library, Place, RuleSet};

/// What running one fact showed.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// Expectations that do not hold; none where the fact does.
    pub failures: Vec<Failure>,
    /// By rule of its library: how the fact used it.
    pub used: Vec<Use>,
}

/// An expectation that does not hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// Where it stands.
    pub place: Place,
    /// What was expected and what was found.
    pub message: String,
    /// What may be the matter.
    pub help: Option<String>,
}

/// How a fact used a rule.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Use {
    /// Its antecedents and its consequent were detected.
    pub detected: bool,
    /// It predicted an instance.
    pub predicted: bool,
}

impl Verdict {
    /// Whether every expectation holds.
    pub fn holds(&self) -> bool {
        self.failures.is_empty()
    }
}

/// Runs facts; the verdicts are in their order, whatever the number of threads.
pub fn run(rules: &RuleSet, facts: &[Fact]) -> Vec<Verdict> {
    facts.par_iter().map(|fact| one(rules, fact)).collect()
}

/// How facts used the rules of each library, given their verdicts in order.
pub fn coverage(rules: &RuleSet, facts: &[Fact], verdicts: &[Verdict]) -> Vec<Coverage> {
    coverage::of(rules, facts, verdicts)
}

fn one(rules: &RuleSet, fact: &Fact) -> Verdict {
    let library = fact.library.and_then(|k| rules.libraries.get(k));
    let concluded = library.map(|library| conclude(rules, library, fact)).transpose();
    match concluded {
        Err(error) => Verdict {
            failures: vec![Failure {
                place: fact.place,
                message: format!("this fact cannot be run: {error}"),
                help: None,
            }],
            used: Vec::new(),
        },
        Ok(concluded) => Verdict {
            failures: expectations::failures(fact, concluded.as_ref()),
            used: concluded.map_or_else(Vec::new, |c| coverage::used(&c)),
        },
    }
}

/// What follows from the evidence of a fact.
struct Concluded {
    knowledge: Knowledge,
    status: Status,
}

fn conclude(rules: &RuleSet, library: &Library, fact: &Fact) -> Result<Concluded, PlanError> {
    let task = ground::task(rules, library, fact);
    let knowledge = Knowledge::of(library.clone(), task)?;
    let evidence: Vec<(FeatureId, Supposed)> = fact.given.iter().map(|(id, g)| (*id, supposed(g))).collect();
    let status = suppose(&knowledge, &evidence)?;
    Ok(Concluded { knowledge, status })
}

fn supposed(given: &Given) -> Supposed {
    use crate::detect::Measurement;
    match given {
        Given::Detected => Supposed::Detected,
        Given::Absent => Supposed::Absent,
        Given::Face(face) => Supposed::Measured(Measurement::Face(face.clone())),
        Given::Marker { pose, size } => Supposed::Measured(Measurement::Marker {
            pose: *pose,
            size: *size,
        }),
    }
}
