//! A run: measurements in, next best views out.
//!
//! A session is a function of the rule set, its options and the observations
//! in order; replaying them restores it. It reads no clock: a caller that
//! wants times marks the ends of phases itself.

use std::collections::BTreeSet;

use rand::RngExt;
use rand_pcg::Pcg64;

use super::completion::{self, Completion, Outcome};
use super::error::PlanError;
use super::instances::Finding;
use super::knowledge::Knowledge;
use super::look::Targets;
use super::methods::{self, Choice, Method, Rank, Situation, Worth};
use super::reasoning::{self, Proofs};
use super::report::{self, Decision, Next, Standing, Terms, Update};
use super::score::{self, Gains};
use super::status::Status;
use super::trace::{Proof, Trace};
use super::viewpoint::Viewpoint;
use crate::detect::{self, Condition, Scan};
use crate::geometry::{Camera, Point, Pose};
use crate::map::{Map, Tag};
use crate::primitives::{Arguments, poses};
use crate::rules::{BadArgument, Insertion, Library, Rule, RuleSet, Task};
use crate::sense::Observation;

/// How a run differs from what its task says.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The method of choosing views; the task's where `None`.
    pub method: Option<String>,
    /// Seed of the start view and of random methods.
    pub seed: u64,
    /// Most measurements; the task's where `None`.
    pub limit: Option<u32>,
    /// Candidate views, each with its camera and `world_from_camera`; the task's
    /// where `None`.
    pub views: Option<Vec<(Camera, Pose)>>,
}

/// The parts of taking in a measurement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Insertion into the map.
    Map,
    /// Detection, reasoning, prediction and inspection.
    Detect,
    /// Scores and the next best view.
    Score,
}

/// A run in progress.
#[derive(Clone)]
pub struct Session {
    knowledge: Knowledge,
    method: &'static dyn Method,
    random: Pcg64,
    seed: u64,
    limit: u32,
    poses: Vec<Pose>,
    candidates: Vec<Viewpoint>,
    visited: Vec<bool>,
    map: Map,
    status: Status,
    tags: BTreeSet<Tag>,
    gains: Vec<(usize, f64)>,
    decision: Decision,
}

/// Streams of the generator, so that no use of chance disturbs another.
const START_STREAM: u128 = 1;
const METHOD_STREAM: u128 = 2;

impl Session {
    /// A session before its first measurement.
    ///
    /// # Errors
    /// No such task or method, arguments that do not fit, no candidate view, or
    /// a space that is too large.
    pub fn new(rules: &RuleSet, task: &str, options: Options) -> Result<Self, PlanError> {
        let knowledge = Knowledge::new(rules, task)?;
        let task = &knowledge.task;
        let views = match options.views {
            Some(views) => views,
            None => candidates(task)?,
        };
        if views.is_empty() {
            return Err(PlanError::NoViews(task.name.clone()));
        }
        let poses: Vec<Pose> = views.iter().map(|(_, pose)| *pose).collect();
        let start = start_of(options.seed, poses.len());
        Ok(Self {
            method: methods::method(options.method.as_deref().unwrap_or(&task.method))?,
            random: Pcg64::new(u128::from(options.seed), METHOD_STREAM),
            seed: options.seed,
            limit: options.limit.unwrap_or(task.limit),
            candidates: views
                .iter()
                .map(|(camera, pose)| Viewpoint::new(*camera, pose))
                .collect(),
            visited: vec![false; poses.len()],
            map: Map::new(&task.space, task.sensor_model)?,
            status: Status::new(&knowledge),
            tags: BTreeSet::new(),
            gains: Vec::new(),
            decision: Decision::Next(first(start)),
            poses,
            knowledge,
        })
    }

    /// Candidate views, `world_from_camera`, in the task's order.
    pub fn views(&self) -> &[Pose] {
        &self.poses
    }

    /// The task.
    pub fn task(&self) -> &Task {
        &self.knowledge.task
    }

    /// The library.
    pub fn library(&self) -> &Library {
        &self.knowledge.library
    }

    /// The map.
    pub fn map(&self) -> &Map {
        &self.map
    }

    /// Features, classes and visited views.
    pub fn status(&self) -> &Status {
        &self.status
    }

    /// Unvisited views, and G_fd + W · G_so of each after the last measurement.
    pub fn gains(&self) -> Vec<(usize, f64)> {
        self.gains.clone()
    }

    /// The name of the method, lower case.
    pub fn method(&self) -> &'static str {
        self.method.name()
    }

    /// Most measurements.
    pub fn limit(&self) -> u32 {
        self.limit
    }

    /// w_i in bits, in the library's order.
    pub fn weights(&self) -> Vec<f64> {
        self.status.weights.clone()
    }

    /// The first view, drawn from the seed alone.
    pub fn start(&self) -> usize {
        start_of(self.seed, self.poses.len())
    }

    /// Takes in a measurement from candidate `view`.
    ///
    /// # Errors
    /// No such view, an observation whose images do not fit its camera, or a
    /// rule whose arguments do not fit together.
    pub fn observe(&mut self, view: usize, observation: &Observation) -> Result<Update, PlanError> {
        self.observe_in_phases(view, observation, &mut |_| {})
    }

    /// As [`Session::observe`], calling `ended` at the end of every phase.
    ///
    /// # Errors
    /// As [`Session::observe`].
    pub fn observe_in_phases(
        &mut self,
        view: usize,
        observation: &Observation,
        ended: &mut dyn FnMut(Phase),
    ) -> Result<Update, PlanError> {
        self.check(view, observation)?;
        let points = match self.task().insertion {
            Insertion::Exact => self.map.insert(observation),
            Insertion::Projective => self.map.insert_projected(observation),
        };
        self.visited[view] = true;
        let pose = &observation.world_from_camera;
        self.status.visited.push(Viewpoint::new(observation.camera, pose));
        ended(Phase::Map);
        let trace = self.reason(observation)?;
        ended(Phase::Detect);
        let completion = self.decide();
        ended(Phase::Score);
        Ok(Update {
            n: self.status.visited.len(),
            view,
            points,
            features: report::features(&self.status, &self.knowledge),
            classes: report::classes(&self.status, &self.knowledge),
            voxels: self.map.counts(),
            completion,
            rules: trace.rules(&self.knowledge.library),
            absent: trace.absent(&self.knowledge.library),
        })
    }

    /// What to do now: the start view before the first measurement.
    pub fn next_view(&mut self) -> Decision {
        self.decision.clone()
    }

    fn check(&self, view: usize, observation: &Observation) -> Result<(), PlanError> {
        let count = self.poses.len();
        if view >= count {
            return Err(PlanError::NoSuchView { view, count });
        }
        usable(observation).map_err(PlanError::BadObservation)
    }

    fn reason(&mut self, observation: &Observation) -> Result<Trace, PlanError> {
        let scan = Scan::new(observation, &self.knowledge.task.space);
        let proofs = Measured {
            scan: &scan,
            map: &self.map,
        };
        let trace = reasoning::conclude(&mut self.status, &self.knowledge, &self.map, &proofs)?;
        self.retag();
        Ok(trace)
    }

    /// Brings the map's tags in line with the predictions. A replaced
    /// prediction has another tag.
    fn retag(&mut self) {
        let predictions = self.status.features.iter().flat_map(|f| f.predicted.values());
        let mut wanted = BTreeSet::new();
        for predicted in predictions {
            wanted.insert(predicted.tag);
            if !self.tags.contains(&predicted.tag) {
                self.map.tag(predicted.tag, predicted.tagged.clone());
            }
        }
        for gone in self.tags.difference(&wanted) {
            self.map.untag(*gone);
        }
        self.tags = wanted;
    }

    fn decide(&mut self) -> Completion {
        let unvisited: Vec<usize> = (0..self.visited.len()).filter(|v| !self.visited[*v]).collect();
        let gains = score::gains(&self.map, &self.candidates, &unvisited, &self.status, &self.knowledge);
        let choice = self.choose(&gains);
        let worth = choice.as_ref().and_then(|c| c.worth);
        let completion = Completion {
            confident: completion::confident(&self.status, &self.knowledge),
            exhausted: choice.is_none() || worth.map_or_else(|| gains.exhausted(), |w| w.exhausted()),
        };
        let totals = gains.views.iter().enumerate().map(|(k, view)| (*view, gains.total(k)));
        self.gains = totals.collect();
        let contradicted = self.status.contradiction.is_some();
        let views = self.status.visited.len();
        let ended = completion::outcome(completion, self.knowledge.task.goal, contradicted, views, self.limit);
        self.decision = match (ended, choice) {
            (None, Some(choice)) => self.next(&gains, &choice),
            (ended, _) => self.end(ended.unwrap_or(Outcome::Exhausted), completion, &gains, worth),
        };
        completion
    }

    fn end(&self, outcome: Outcome, completion: Completion, gains: &Gains, worth: Option<Worth>) -> Decision {
        let mut end = report::end(outcome, completion, &self.status, &self.knowledge);
        end.because = completion::because(&self.status, &self.knowledge, gains, worth, self.limit);
        Decision::End(end)
    }

    fn choose(&mut self, gains: &Gains) -> Option<Choice> {
        let mut random = self.random.clone();
        let choice = self.method.choose(&self.situation(gains), &mut random);
        self.random = random;
        choice
    }

    fn situation<'a>(&'a self, gains: &'a Gains) -> Situation<'a> {
        Situation {
            world: &self.map,
            knowledge: &self.knowledge,
            status: &self.status,
            candidates: &self.candidates,
            gains,
            current: self.status.visited.last().map_or_else(Point::origin, |v| *v.eye()),
        }
    }

    fn next(&self, gains: &Gains, choice: &Choice) -> Decision {
        let situation = self.situation(gains);
        let rear = Targets::of(&self.map, self.map.rear_side());
        let standing = |rank: &Rank| {
            let (view, gain) = (gains.views[rank.position], &gains.feature[rank.position]);
            Standing {
                view,
                score: rank.score,
                terms: Terms {
                    overlap: rank.overlap,
                    feature: gain.bits,
                    surface: score::surface_gain(&situation.look(rank.position), &rear, &self.knowledge),
                    w: gains.w,
                },
                share: rank.share,
                distance: situation.distance(rank.position),
                target: gain.target.as_ref().map(|t| report::named(t, &self.knowledge)),
            }
        };
        Decision::Next(Next {
            chosen: standing(&choice.best),
            relaxed: choice.relaxed,
            runners_up: choice.rivals.iter().map(standing).collect(),
        })
    }
}

/// S_v of a task.
fn candidates(task: &Task) -> Result<Vec<(Camera, Pose)>, PlanError> {
    let poses = poses(&task.views, &task.space).map_err(|source| PlanError::Views {
        task: task.name.clone(),
        source,
    })?;
    Ok(poses.into_iter().map(|pose| (task.camera, pose)).collect())
}

/// The start view: a stream of its own, so that it depends on nothing but the
/// seed and the number of views.
fn start_of(seed: u64, count: usize) -> usize {
    Pcg64::new(u128::from(seed), START_STREAM).random_range(0..count)
}

fn first(view: usize) -> Next {
    Next {
        chosen: Standing {
            view,
            score: 0.0,
            terms: Terms::default(),
            share: None,
            distance: 0.0,
            target: None,
        },
        relaxed: false,
        runners_up: Vec::new(),
    }
}

/// Images of their camera's size, at a finite pose.
fn usable(observation: &Observation) -> Result<(), &'static str> {
    let (camera, depth, colour) = (&observation.camera, &observation.depth, &observation.colour);
    let pose = &observation.world_from_camera;
    let finite = pose
        .translation
        .vector
        .iter()
        .chain(pose.rotation.coords.iter())
        .all(|c| c.is_finite());
    let sized = |w: u32, h: u32, n: usize| w as usize * h as usize == n && n > 0;
    if !finite {
        Err("its pose is not finite")
    } else if (depth.width, depth.height) != (camera.depth.width, camera.depth.height)
        || !sized(depth.width, depth.height, depth.metres.len())
    {
        Err("its depth image is not of the camera's size")
    } else if (colour.width, colour.height) != (camera.colour.width, camera.colour.height)
        || !sized(colour.width, colour.height, colour.pixels.len())
    {
        Err("its colour image is not of the camera's size")
    } else {
        Ok(())
    }
}

/// The proof functions on a scan and a map.
struct Measured<'a> {
    scan: &'a Scan,
    map: &'a Map,
}

impl Proofs for Measured<'_> {
    fn find(&self, rule: &Rule, detect: &Arguments, measure: &Arguments) -> Result<Proof, BadArgument> {
        let (found, mut account) = detect::detect(&rule.detect.primitive, detect, self.scan)?;
        let mut findings = Vec::new();
        for evidence in found {
            let measurement = detect::measure(&rule.measure.primitive, measure, &evidence)?;
            account.measured(measurement.is_some());
            findings.extend(measurement.map(|measurement| Finding {
                evidence: Some(evidence),
                measurement,
            }));
        }
        Ok(Proof { findings, account })
    }

    fn shell(&self, rule: &Rule, detect: &Arguments, predicted: &[Point], near: f64) -> Result<Condition, BadArgument> {
        detect::shell_proven(&rule.detect.primitive, detect, predicted, self.map, near)
    }
}
