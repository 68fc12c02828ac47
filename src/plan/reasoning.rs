//! The flow of Fig. 3, once after each measurement, to a fixed point.
//!
//! map → features → candidates → features → predictions → inspection → features.
//! The arrows of Fig. 6: −1→1 and 2→1 (detected), −1→2 and −1→3 (by the
//! classes left), −1→0 and 2→0 (inspected and not found; from 2 a
//! contradiction), and the mark +4 with −1 and with 2 (predicted).
//! States 0, 1 and 3 are final: rules with such a consequent are not tried,
//! save that a detected feature's definite rules go on measuring it.

use super::candidates::{posterior, settled};
use super::error::PlanError;
use super::expansion::{Expansion, expansions};
use super::features::{Existence, Found, Pin};
use super::instances::{self, Detection, Finding, Matching};
use super::knowledge::Knowledge;
use super::predictions;
use super::status::{Contradiction, Status};
use super::trace::{Proof, Trace};
use super::world::World;
use crate::detect::{Account, Condition, Measurement};
use crate::geometry::Point;
use crate::primitives::Arguments;
use crate::rules::{BadArgument, FeatureId, FeatureKind, Rule};

/// The proof functions, on what has been measured.
pub trait Proofs {
    /// Every instance that a rule's detector finds in the current measurement.
    ///
    /// # Errors
    /// The arguments are not what the primitives need.
    fn find(&self, rule: &Rule, detect: &Arguments, measure: &Arguments) -> Result<Proof, BadArgument>;

    /// Whether enough of a shell's predicted surface (voxel centres) was
    /// measured in all views: the condition that proves it.
    ///
    /// # Errors
    /// The arguments are not what the primitive needs.
    fn shell(&self, rule: &Rule, detect: &Arguments, predicted: &[Point], near: f64) -> Result<Condition, BadArgument>;
}

/// Calls that were made on the current measurement; each is made once.
#[derive(Default)]
struct Tried(Vec<TriedCall>);

/// A call, and the rule that made it first.
struct TriedCall {
    consequent: FeatureId,
    primitive: String,
    arguments: Arguments,
    rule: usize,
}

/// Draws every conclusion from a measurement that is in the world by now and
/// whose view is the last in `status.visited`, and tells how it went.
///
/// # Errors
/// A rule's arguments do not fit together.
pub fn conclude<W: World + ?Sized>(
    status: &mut Status,
    knowledge: &Knowledge,
    world: &W,
    proofs: &dyn Proofs,
) -> Result<Trace, PlanError> {
    let (mut tried, mut trace) = (Tried::default(), Trace::default());
    loop {
        let mut changed = detect(status, knowledge, proofs, &mut tried, &mut trace)?;
        changed |= reason(status, knowledge);
        predictions::refresh(status, knowledge, world, &mut trace)?;
        changed |= prove_shells(status, knowledge, proofs, &mut trace)?;
        changed |= rule_out(status, knowledge, &mut trace);
        if !changed {
            break;
        }
    }
    status.weigh(knowledge);
    Ok(trace)
}

/// Eq. 1: runs the rules that can be run and have not been. Definite rules
/// come first, for they measure what others build on.
fn detect(
    status: &mut Status,
    knowledge: &Knowledge,
    proofs: &dyn Proofs,
    tried: &mut Tried,
    trace: &mut Trace,
) -> Result<bool, PlanError> {
    let rules = &knowledge.library.rules;
    let definite = (0..rules.len()).filter(|k| rules[*k].antecedents.is_empty());
    let others = (0..rules.len()).filter(|k| !rules[*k].antecedents.is_empty());
    let mut changed = false;
    for k in definite.chain(others) {
        if knowledge.library.feature(rules[k].consequent).kind != FeatureKind::Shell {
            changed |= run(k, status, knowledge, proofs, tried, trace).map_err(|source| PlanError::Rule {
                rule: rules[k].id.clone(),
                source,
            })?;
        }
    }
    Ok(changed)
}

/// Runs one rule in all its combinations.
fn run(
    k: usize,
    status: &mut Status,
    knowledge: &Knowledge,
    proofs: &dyn Proofs,
    tried: &mut Tried,
    trace: &mut Trace,
) -> Result<bool, BadArgument> {
    let rule = &knowledge.library.rules[k];
    let detected = |id: &FeatureId| status.feature(*id).state == Existence::Detected;
    if !rule.antecedents.iter().all(detected) {
        return Ok(false);
    }
    let mut changed = false;
    trace.runs_anew(k);
    for expansion in expansions(k, knowledge, &status.features)? {
        if !is_wanted(rule, &expansion, status, knowledge) {
            continue;
        }
        let mut arguments = |name, call| {
            let known = expansion.arguments(call, &status.features)?;
            if known.is_none() {
                trace.waits(k, name);
            }
            Ok(known)
        };
        let (Some(detect), Some(measure)) = (arguments("detect", &rule.detect)?, arguments("measure", &rule.measure)?)
        else {
            continue;
        };
        if let Err(first) = tried.first_time(k, rule, &detect) {
            trace.asked_again(first, k, &rule.id);
            continue;
        }
        let proof = proofs.find(rule, &detect, &measure)?;
        let found = proof.findings.len();
        if found > 0 || is_open(rule, status, knowledge) {
            trace.tried(k, &expansion.key, &proof.account, found);
        }
        changed |= found > 0;
        take(proof.findings, rule, &expansion, &measure, status, knowledge);
    }
    Ok(changed)
}

/// Whether it matters that a rule finds nothing: its feature is not found yet,
/// or may have more instances where the rule looks.
fn is_open(rule: &Rule, status: &Status, knowledge: &Knowledge) -> bool {
    let further = knowledge.library.feature(rule.consequent).many && !rule.antecedents.is_empty();
    status.feature(rule.consequent).state.is_open() || further
}

/// A rule with antecedents is for what is not yet found ("the rule can only be
/// used when the consequence is unknown"), unless it is the only one that can
/// measure the feature in further views.
fn is_wanted(rule: &Rule, expansion: &Expansion, status: &Status, knowledge: &Knowledge) -> bool {
    let feature = status.feature(rule.consequent);
    let at_key = || feature.found.iter().any(|f| f.key == expansion.key);
    let needed = rule.antecedents.is_empty() || !knowledge.has_definite_rule(rule.consequent) || !at_key();
    needed && (feature.state.is_open() || feature.state == Existence::Detected)
}

fn take(
    findings: Vec<Finding>,
    rule: &Rule,
    expansion: &Expansion,
    measure: &Arguments,
    status: &mut Status,
    knowledge: &Knowledge,
) {
    let matching = matching(rule.consequent, knowledge);
    let pin = (matching.many && !rule.antecedents.is_empty()).then(|| Pin {
        key: expansion.key.clone(),
        revisions: expansion.revisions.clone(),
    });
    for finding in findings {
        let detection = Detection {
            finding,
            measure: (rule.measure.primitive.clone(), measure.clone()),
            pin: pin.clone(),
        };
        let feature = &mut status.features[rule.consequent.index()];
        instances::take(feature, detection, &matching, &mut status.next_revision);
        status.decide(rule.consequent, Existence::Detected);
    }
}

/// How the instances of a feature are told apart.
pub(super) fn matching(feature: FeatureId, knowledge: &Knowledge) -> Matching {
    Matching {
        many: knowledge.library.feature(feature).many,
        near: knowledge.criteria.near,
        moved: knowledge.task.space.voxel / 2.0,
        reach: knowledge.task.space.size.norm() / 2.0,
    }
}

/// Eqs. 4, 5 and 7: excludes classes, and settles features that the classes
/// left agree on. What was excluded wholly is a contradiction.
fn reason(status: &mut Status, knowledge: &Knowledge) -> bool {
    let library = &knowledge.library;
    status.posterior = posterior(library, &status.states());
    if status.contradiction.is_none() && status.posterior.iter().all(|p| *p <= 0.0) {
        status.contradiction = culprit(status, knowledge);
    }
    let mut changed = false;
    for id in library.feature_ids() {
        let feature = &mut status.features[id.index()];
        if feature.state == Existence::Unknown
            && let Some(has) = settled(library, &status.posterior, id)
        {
            feature.state = if has { Existence::Present } else { Existence::Excluded };
            changed = true;
        }
    }
    changed
}

/// The decided feature that left no class, in the order of deciding.
fn culprit(status: &Status, knowledge: &Knowledge) -> Option<Contradiction> {
    let mut states = vec![Existence::Unknown; status.features.len()];
    for &feature in &status.decided {
        states[feature.index()] = status.feature(feature).state;
        if posterior(&knowledge.library, &states).iter().all(|p| *p <= 0.0) {
            let evidence = match status.feature(feature).state {
                Existence::Absent => "inspected and not found, but every class left has it",
                _ => "detected, but no class left has it",
            };
            return Some(Contradiction {
                feature,
                evidence: evidence.to_owned(),
            });
        }
    }
    None
}

/// Eq. 1 for shells: proven when enough of their predicted surface was measured.
fn prove_shells(
    status: &mut Status,
    knowledge: &Knowledge,
    proofs: &dyn Proofs,
    trace: &mut Trace,
) -> Result<bool, PlanError> {
    let library = &knowledge.library;
    let mut changed = false;
    for id in library
        .feature_ids()
        .filter(|id| library.feature(*id).kind == FeatureKind::Shell)
    {
        if !status.feature(id).state.is_open() {
            continue;
        }
        let proven = proven_shell(id, status, knowledge, proofs, trace)?;
        if let Some((key, found)) = proven {
            let feature = &mut status.features[id.index()];
            feature.predicted.remove(&key);
            feature.found.push(found);
            if !library.feature(id).many {
                feature.predicted.clear();
            }
            status.next_revision += 1;
            status.decide(id, Existence::Detected);
            changed = true;
        }
    }
    Ok(changed)
}

/// The first predicted instance of a shell that is proven.
fn proven_shell(
    id: FeatureId,
    status: &Status,
    knowledge: &Knowledge,
    proofs: &dyn Proofs,
    trace: &mut Trace,
) -> Result<Option<(String, Found)>, PlanError> {
    for (key, predicted) in &status.feature(id).predicted {
        let rule = &knowledge.library.rules[predicted.rule];
        let wrong = |source| PlanError::Rule {
            rule: rule.id.clone(),
            source,
        };
        let centres: Vec<Point> = predicted.voxels.iter().map(|v| v.centre).collect();
        let arguments = shell_arguments(predicted.rule, key, status, knowledge).map_err(wrong)?;
        let near = knowledge.criteria.near;
        let Some(arguments) = arguments else { continue };
        let seen = proofs.shell(rule, &arguments, &centres, near).map_err(wrong)?;
        let proven = seen.holds;
        let account = Account::single(centres.len(), seen);
        trace.tried(predicted.rule, key, &account, proven.into());
        if proven {
            let measurement = Measurement::Shell(predicted.polygons.clone());
            return Ok(Some((
                key.clone(),
                Found {
                    number: 1,
                    evidence: None,
                    anchor: measurement.clone(),
                    measurement,
                    revision: status.next_revision + 1,
                    measure: (rule.measure.primitive.clone(), Arguments::default()),
                    pin: None,
                    key: key.clone(),
                },
            )));
        }
    }
    Ok(None)
}

fn shell_arguments(
    rule: usize,
    key: &str,
    status: &Status,
    knowledge: &Knowledge,
) -> Result<Option<Arguments>, BadArgument> {
    let all = expansions(rule, knowledge, &status.features)?;
    match all.iter().find(|e| e.key == key) {
        Some(expansion) => expansion.arguments(&knowledge.library.rules[rule].detect, &status.features),
        None => Ok(None),
    }
}

/// Eq. 3: what was inspected and not found is not there. From state 2 that
/// contradicts the library where a definite rule could have found it; else the
/// feature stays in state 2 and weighs nothing.
fn rule_out(status: &mut Status, knowledge: &Knowledge, trace: &mut Trace) -> bool {
    let mut changed = false;
    for id in knowledge.library.feature_ids() {
        let feature = status.feature(id);
        if !feature.is_predicted() || !predictions::is_inspected(feature, knowledge.criteria.absent) {
            continue;
        }
        match feature.state {
            Existence::Present if !knowledge.has_definite_rule(id) => continue,
            Existence::Present => status.contradict(id),
            _ => {}
        }
        trace.ruled_out(id, status, &knowledge.library);
        status.features[id.index()].predicted.clear();
        status.decide(id, Existence::Absent);
        changed = true;
    }
    changed
}

impl Status {
    /// Makes a state final by detection.
    pub(super) fn decide(&mut self, id: FeatureId, state: Existence) {
        let feature = &mut self.features[id.index()];
        if feature.state.is_open() {
            feature.state = state;
            self.decided.push(id);
        }
    }

    fn contradict(&mut self, feature: FeatureId) {
        let (done, all) = self.feature(feature).inspected_union();
        let evidence = format!(
            "{done} of the {all} voxels of its place were inspected and it was not found, but every class left has it"
        );
        self.contradiction.get_or_insert(Contradiction { feature, evidence });
    }
}

impl Tried {
    /// Whether a detector has not yet been run with these arguments for this
    /// feature; else the rule that ran it.
    fn first_time(&mut self, index: usize, rule: &Rule, detect: &Arguments) -> Result<(), usize> {
        let same = |t: &&TriedCall| {
            t.consequent == rule.consequent && t.primitive == rule.detect.primitive && t.arguments == *detect
        };
        if let Some(first) = self.0.iter().find(same) {
            return Err(first.rule);
        }
        self.0.push(TriedCall {
            consequent: rule.consequent,
            primitive: rule.detect.primitive.clone(),
            arguments: detect.clone(),
            rule: index,
        });
        Ok(())
    }
}
