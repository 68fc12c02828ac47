//! A run on hand-made worlds, with symbolic detections in the place of images,
//! and the demand that fast planner and reference agree on everything.

use rand_pcg::Pcg64;
use vpl::detect::{Account, Condition, Measurement, Unit};
use vpl::geometry::{Edge, Point, Polygon, Pose, look_at};
use vpl::plan::features::Predicted;
use vpl::plan::instances::Finding;
use vpl::plan::methods::{self, Choice, Situation};
use vpl::plan::score::{self, Gains};
use vpl::plan::{
    Existence, Knowledge, Look, Proof, Proofs, Status, Targets, Trace, Viewpoint, World, predictions, reasoning,
};
use vpl::primitives::Arguments;
use vpl::rules::{BadArgument, FeatureId, Library, Rule, Task};

use super::reference::{self, Instance, Scene};

/// What detectors find in a measurement.
#[derive(Clone, Default)]
pub struct Seen {
    /// By definite rules: consequent and measurement.
    pub definite: Vec<(u32, Measurement)>,
    /// By rules along an edge: the rule's id and a face that begins with that
    /// edge reversed.
    pub beside: Vec<(&'static str, Polygon)>,
}

impl Seen {
    pub fn nothing() -> Self {
        Self::default()
    }

    pub fn face(feature: u32, face: Polygon) -> Self {
        Self::faces(vec![(feature, face)])
    }

    pub fn faces(faces: Vec<(u32, Polygon)>) -> Self {
        Self {
            definite: faces.into_iter().map(|(f, p)| (f, Measurement::Face(p))).collect(),
            beside: Vec::new(),
        }
    }
}

struct Symbolic<'a, W: World> {
    seen: &'a Seen,
    world: &'a W,
}

impl<W: World> Proofs for Symbolic<'_, W> {
    fn find(&self, rule: &Rule, detect: &Arguments, _: &Arguments) -> Result<Proof, BadArgument> {
        let finding = |measurement: Measurement| Finding {
            evidence: None,
            measurement,
        };
        if rule.antecedents.is_empty() {
            let own = self
                .seen
                .definite
                .iter()
                .filter(|(f, _)| FeatureId(*f) == rule.consequent);
            return Ok(self.proof(own.map(|(_, m)| finding(m.clone())).collect()));
        }
        let Ok(edge) = detect.edge("edge") else {
            return Ok(Proof::default());
        };
        let at_edge = |face: &Polygon| {
            let Edge { start, end, .. } = face.edge(0);
            (start - edge.end).norm() < 1e-6 && (end - edge.start).norm() < 1e-6
        };
        let own = self
            .seen
            .beside
            .iter()
            .filter(|(id, face)| *id == rule.id && at_edge(face));
        let findings = own.map(|(_, face)| finding(Measurement::Face(face.clone()))).collect();
        Ok(self.proof(findings))
    }

    fn shell(&self, _: &Rule, detect: &Arguments, predicted: &[Point], near: f64) -> Result<Condition, BadArgument> {
        let seen = predicted
            .iter()
            .filter(|p| self.world.measured_within(p, 2.0 * near))
            .count();
        let share = seen as f64 / predicted.len() as f64;
        Ok(Condition::at_least("seen", Unit::Share, share, detect.share("share")?))
    }
}

impl<W: World> Symbolic<'_, W> {
    /// What is shown is looked at; where it is not what was asked for, that is what failed.
    fn proof(&self, findings: Vec<Finding>) -> Proof {
        let mut account = Account::of(self.seen.definite.len() + self.seen.beside.len());
        if findings.is_empty() {
            account.failed = vec![Condition::plain("shown", false)];
        }
        Proof { findings, account }
    }
}

pub struct Trial {
    pub knowledge: Knowledge,
    pub status: Status,
    pub poses: Vec<Pose>,
    pub candidates: Vec<Viewpoint>,
    pub visited: Vec<usize>,
    /// Of the last look.
    pub trace: Trace,
}

impl Trial {
    /// Candidate views at some eyes, looking at (2, 2, ½).
    pub fn new(library: Library, task: Task, eyes: &[[f64; 3]]) -> Self {
        let target = Point::new(2.0, 2.0, 0.5);
        let poses = eyes.iter().map(|e| look_at(Point::from(*e), target)).collect();
        Self::at(library, task, poses)
    }

    pub fn at(library: Library, task: Task, poses: Vec<Pose>) -> Self {
        let knowledge = Knowledge::of(library, task).unwrap();
        Self {
            status: Status::new(&knowledge),
            candidates: poses.iter().map(|p| Viewpoint::new(knowledge.task.camera, p)).collect(),
            knowledge,
            poses,
            visited: Vec::new(),
            trace: Trace::default(),
        }
    }

    /// A measurement from a view after which the world is as given.
    pub fn look<W: World>(&mut self, view: usize, world: &W, seen: &Seen) {
        self.status.visited.push(self.candidates[view].clone());
        self.visited.push(view);
        let proofs = Symbolic { seen, world };
        self.trace = reasoning::conclude(&mut self.status, &self.knowledge, world, &proofs).unwrap();
    }

    pub fn state(&self, feature: u32) -> i8 {
        self.status.feature(FeatureId(feature)).state.code()
    }

    /// The mark +4.
    pub fn is_predicted(&self, feature: u32) -> bool {
        self.status.feature(FeatureId(feature)).is_predicted()
    }

    pub fn predicted(&self, feature: u32) -> &Predicted {
        self.status
            .feature(FeatureId(feature))
            .predicted
            .values()
            .next()
            .unwrap()
    }

    pub fn unvisited(&self) -> Vec<usize> {
        (0..self.poses.len()).filter(|v| !self.visited.contains(v)).collect()
    }

    pub fn gains<W: World>(&self, world: &W) -> Gains {
        score::gains(
            world,
            &self.candidates,
            &self.unvisited(),
            &self.status,
            &self.knowledge,
        )
    }

    fn look_from<'a, W: World>(&'a self, world: &'a W, view: usize) -> Look<'a, W> {
        Look::of(world, &self.candidates[view], self.knowledge.criteria.visibility)
    }

    /// n_ij(v) of a feature's only prediction.
    pub fn n<W: World>(&self, world: &W, feature: u32, view: usize) -> u64 {
        score::reachable_count(&self.look_from(world, view), self.predicted(feature), &self.knowledge)
    }

    /// G_so(v).
    pub fn surface<W: World>(&self, world: &W, view: usize) -> u64 {
        let rear = Targets::of(world, world.rear_side());
        score::surface_gain(&self.look_from(world, view), &rear, &self.knowledge)
    }

    /// The share that G_ovlp judges.
    pub fn overlap<W: World>(&self, world: &W, view: usize) -> f64 {
        let parts = score::OverlapParts::of(world, &self.status);
        score::overlap_share(&self.look_from(world, view), &parts, self.knowledge.criteria.near)
    }

    /// The next view of a method, and whether the overlap was relaxed.
    pub fn next<W: World>(&self, world: &W, method: &str) -> Option<(usize, bool)> {
        let gains = self.gains(world);
        if gains.exhausted() {
            return None;
        }
        let choice = self.choice(world, method, &gains)?;
        Some((gains.views[choice.best.position], choice.relaxed))
    }

    /// What a method values a view at, were it the only one left.
    pub fn value<W: World>(&self, world: &W, method: &str, view: usize) -> f64 {
        self.only(world, method, view).best.score
    }

    /// What a method would choose, were a view the only one left.
    pub fn only<W: World>(&self, world: &W, method: &str, view: usize) -> Choice {
        let gains = score::gains(world, &self.candidates, &[view], &self.status, &self.knowledge);
        self.choice(world, method, &gains).unwrap()
    }

    fn choice<W: World>(&self, world: &W, method: &str, gains: &Gains) -> Option<Choice> {
        let situation = Situation {
            world,
            knowledge: &self.knowledge,
            status: &self.status,
            candidates: &self.candidates,
            gains,
            current: *self.status.visited.last().unwrap().eye(),
        };
        let method = methods::method(method).unwrap();
        method.choose(&situation, &mut Pcg64::new(0, 0))
    }

    /// Holds every count and the next views to the reference. `measured` says
    /// which eye measured which occupied voxel.
    pub fn agree<W: World>(&self, world: &W, points: &[Point], measured: &[(Point, vpl::map::Voxel)]) {
        let grid = *world.grid();
        let states: Vec<_> = (0..grid.len()).map(|v| world.occupancy(vpl::map::Voxel(v))).collect();
        let scene = Scene {
            grid,
            rear_side: reference::rear_side(&grid, &states, measured),
            states,
            points: points.to_vec(),
            task: &self.knowledge.task,
            visited: self.visited.iter().map(|v| self.poses[*v]).collect(),
        };
        assert_eq!(world.rear_side(), scene.rear_side.iter().copied().collect::<Vec<_>>());
        self.agree_on_features();
        let instances = self.agree_on_instances(&scene, world);
        self.agree_on_views(&scene, &instances, world);
    }

    fn agree_on_instances<W: World>(&self, scene: &Scene<'_>, world: &W) -> Vec<Instance> {
        let mut instances = Vec::new();
        for (i, feature) in self.status.features.iter().enumerate() {
            for predicted in feature.predicted.values() {
                let instance = Instance {
                    weight: self.status.weights[i],
                    polygons: predicted.polygons.clone(),
                    envelope: predicted.envelope,
                };
                let pv: Vec<_> = predicted.voxels.iter().map(|v| v.voxel).collect();
                assert_eq!(pv, scene.pv(&instance).into_keys().collect::<Vec<_>>());
                let done = pv
                    .iter()
                    .zip(&predicted.inspected)
                    .filter(|(_, d)| **d)
                    .map(|(v, _)| *v);
                assert_eq!(
                    done.collect::<Vec<_>>(),
                    scene.inspected(&instance).into_iter().collect::<Vec<_>>()
                );
                for (view, pose) in self.poses.iter().enumerate() {
                    let n = score::reachable_count(&self.look_from(world, view), predicted, &self.knowledge);
                    assert_eq!(n, scene.n(&instance, pose) as u64, "n of view {view}");
                }
                instances.push(instance);
            }
        }
        instances
    }

    fn agree_on_views<W: World>(&self, scene: &Scene<'_>, instances: &[Instance], world: &W) {
        let views: Vec<(usize, Pose)> = self.unvisited().iter().map(|v| (*v, self.poses[*v])).collect();
        let values = scene.values(instances, &views);
        let gains = self.gains(world);
        for (k, value) in values.iter().enumerate() {
            assert!((gains.feature[k].bits - value.feature).abs() < 1e-12);
            assert_eq!(self.surface(world, value.view), value.surface as u64);
            assert!((self.overlap(world, value.view) - value.overlap).abs() < 1e-12);
        }
        let here = self.poses[*self.visited.last().unwrap()].translation.vector;
        let distance = |v: usize| (self.poses[v].translation.vector - here).norm();
        let least = Some(self.knowledge.task.overlap);
        assert_eq!(
            self.next(world, "gn"),
            reference::best(&values, None, distance).map(|(v, _)| (v, false))
        );
        assert_eq!(self.next(world, "gno"), reference::best(&values, least, distance));
    }

    /// States 2 and 3, posterior and weights from the definitions, given which
    /// features are detected or absent.
    fn agree_on_features(&self) {
        let library = &self.knowledge.library;
        let fits = |class: &&vpl::rules::Class| {
            library.feature_ids().all(|id| match self.status.feature(id).state {
                Existence::Detected => class.presence.has(id),
                Existence::Absent => !class.presence.has(id),
                _ => true,
            })
        };
        let left: Vec<_> = library.classes.iter().filter(fits).collect();
        let total: f64 = left.iter().map(|c| c.prior).sum();
        for id in library.feature_ids() {
            let feature = self.status.feature(id);
            let with = left.iter().filter(|c| c.presence.has(id)).count();
            if !left.is_empty() && matches!(feature.state.code(), -1 | 2 | 3) {
                let expected = match with {
                    0 => 3,
                    n if n == left.len() => 2,
                    _ => -1,
                };
                assert_eq!(feature.state.code(), expected, "{}", library.feature(id).name);
            }
            if !left.is_empty() && feature.state == Existence::Unknown {
                let p: f64 = left
                    .iter()
                    .filter(|c| c.presence.has(id))
                    .map(|c| c.prior / total)
                    .sum();
                let h = -p * p.log2() - (1.0 - p) * (1.0 - p).log2();
                assert!((self.status.weights[id.index()] - h).abs() < 1e-9);
            }
            let absent = self.knowledge.criteria.absent;
            let must_go = feature.is_predicted() && predictions::is_inspected(feature, absent);
            assert!(!must_go || feature.state == Existence::Present && !self.knowledge.has_definite_rule(id));
        }
    }
}
