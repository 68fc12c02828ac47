//! Instructions of the kernels, by Valgrind: see `../README.md`.
//!
//! Every kernel works on a view of the tanks' first object. Threads would not be
//! counted, so there is one, this one.

use std::hint::black_box;
use std::path::Path;
use std::sync::LazyLock;

use gungraun::{Callgrind, EventKind, LibraryBenchmarkConfig, library_benchmark, library_benchmark_group, main};
use vpl::detect::Scan;
use vpl::geometry::{Point, Pose};
use vpl::lang::{Memory, compile};
use vpl::map::{Map, Voxel};
use vpl::plan::{Options, Session};
use vpl::rules::{RuleSet, SensorModel, Space};
use vpl::sense::{Noise, Observation, Simulator};

const TANKS: &str = include_str!("../../../examples/tanks/tanks.vpl");
const BASELINE: &str = include_str!("../baseline.json");
/// Most instructions, of those in the baseline.
const MOST: f64 = 1.10;

/// Fails where a kernel needs more instructions than the baseline allows; one
/// that the baseline lacks is only counted.
fn limited(kernel: &str) -> LibraryBenchmarkConfig {
    let baseline: serde_json::Value = serde_json::from_str(BASELINE).unwrap();
    let mut callgrind = Callgrind::default();
    if let Some(count) = baseline[kernel].as_f64() {
        callgrind.hard_limits([(EventKind::Ir, (count * MOST) as u64)]);
    }
    let mut config = LibraryBenchmarkConfig::default();
    config.tool(callgrind);
    config
}

/// A run of the first object before its first measurement.
struct Scene {
    rules: RuleSet,
    simulator: Simulator,
    poses: Vec<Pose>,
}

static SCENE: LazyLock<Scene> = LazyLock::new(|| {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread();
    one.build_global().unwrap();
    let rules = compile("tanks.vpl", &Memory::of("tanks.vpl", TANKS)).rules.unwrap();
    let (scene, task) = (&rules.scenes[0], &rules.tasks[0]);
    let simulator = Simulator::new(&scene.objects[0], scene.backdrop, &task.space, Path::new("")).unwrap();
    let poses = session(&rules).views().to_vec();
    Scene {
        rules,
        simulator,
        poses,
    }
});

fn session(rules: &RuleSet) -> Session {
    Session::new(rules, &rules.tasks[0].name, Options::default()).unwrap()
}

fn space() -> &'static Space {
    &SCENE.rules.tasks[0].space
}

fn measured(view: usize) -> Observation {
    let camera = &SCENE.rules.tasks[0].camera;
    SCENE.simulator.observe(camera, &SCENE.poses[view], Noise::None, 0, 0)
}

fn empty() -> (Map, Observation) {
    (Map::new(space(), SensorModel::default()).unwrap(), measured(0))
}

/// A map of three views, and up to 2,000 of its voxels at surfaces and behind them.
fn known() -> (Map, Vec<Voxel>) {
    let mut map = empty().0;
    [0, 13, 26].map(|view| map.insert(&measured(view)));
    let mut voxels = [map.occupied(), map.rear_side()].concat();
    voxels.sort_unstable();
    let step = voxels.len().div_ceil(2_000).max(1);
    let some = voxels.into_iter().step_by(step).collect();
    (map, some)
}

#[library_benchmark(config = limited("check"))]
#[bench::tanks(Memory::of("tanks.vpl", TANKS))]
fn check(world: Memory) -> usize {
    black_box(compile("tanks.vpl", &world)).diagnostics.len()
}

#[library_benchmark(config = limited("render"))]
#[bench::tanks(LazyLock::force(&SCENE))]
fn render(scene: &Scene) -> Observation {
    let camera = &scene.rules.tasks[0].camera;
    black_box(scene.simulator.observe(camera, &scene.poses[0], Noise::None, 0, 0))
}

#[library_benchmark(config = limited("insert"))]
#[bench::tanks(empty())]
fn insert((mut map, frame): (Map, Observation)) -> Map {
    map.insert(black_box(&frame));
    map
}

#[library_benchmark(config = limited("insert_projected"))]
#[bench::tanks(empty())]
fn insert_projected((mut map, frame): (Map, Observation)) -> Map {
    map.insert_projected(black_box(&frame));
    map
}

#[library_benchmark(config = limited("sight"))]
#[bench::tanks(known())]
fn sight((map, voxels): (Map, Vec<Voxel>)) -> usize {
    let visibility = map.visibility();
    let eyes = SCENE.poses.iter().map(|pose| Point::from(pose.translation.vector));
    let seen = eyes.map(|eye| {
        let sight = visibility.from(&eye, 0.02);
        voxels.iter().filter(|voxel| sight.sees(**voxel)).count()
    });
    seen.sum()
}

#[library_benchmark(config = limited("scan"))]
#[bench::tanks(measured(0))]
fn scan(frame: Observation) -> Scan {
    Scan::new(black_box(&frame), space())
}

#[library_benchmark(config = limited("decide"))]
#[bench::tanks((session(&SCENE.rules), measured(0)))]
fn decide((mut session, frame): (Session, Observation)) -> Session {
    session.observe(0, black_box(&frame)).unwrap();
    session
}

library_benchmark_group!(
    name = kernels;
    benchmarks = check, render, insert, insert_projected, sight, scan, decide
);

main!(library_benchmark_groups = kernels);
