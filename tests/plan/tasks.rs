//! Tasks that the examples do not show, and the wall between task and scene.

use std::fs;

use serde_json::Value;
use vpl::lang::{self, ReadFailure, World};
use vpl::plan::{ClosedLoop, Options, Session, Simulated};
use vpl::rules::RuleSet;
use vpl::sense::{Noise, Simulator};

use super::support::*;

const PARCELS: &str = include_str!("parcels.vpl");
const PRISMS: &str = include_str!("prisms.vpl");

/// How the run of a program's object ended.
fn end_of(program: &str, test: &str, options: &[&str], status: i32) -> Value {
    let folder = folder(test);
    let all = [options, &["--log", "run.jsonl"]].concat();
    plan_of(program, &folder, &all).expect(status, &[]);
    records(&folder.join("run.jsonl")).pop().unwrap()
}

/// Two markers, a ring of views, another camera, `verify all`.
#[test]
fn parcels_are_told_apart_by_two_markers() {
    for class in ["both", "left", "right"] {
        let end = end_of(PARCELS, class, &["--object", class], 0);
        assert_eq!((&end["outcome"], &end["class"]), (&"goal".into(), &class.into()));
        assert!(end["views"].as_u64().unwrap() <= 6, "{end}");
    }
}

#[test]
fn a_parcel_without_markers_stays_undecided() {
    let end = end_of(PARCELS, "bare", &["--object", "bare"], 3);
    assert_eq!((&end["outcome"], &end["class"]), (&"exhausted".into(), &Value::Null));
}

/// A pyramid before a library of prisms: its red bottom promises green sides.
#[test]
fn an_object_of_no_class_contradicts_the_library() {
    let end = end_of(PRISMS, "pyramid", &["--task", "crate", "--object", "pyramid"], 3);
    assert_eq!(
        (&end["outcome"], &end["class"]),
        (&"contradiction".into(), &Value::Null)
    );
    assert_eq!(end["contradiction"]["feature"], "side");
}

/// Both goals; views on a grid and on half a sphere; priors; GNO.
#[test]
fn a_prism_reaches_every_goal() {
    for task in ["crate", "dome"] {
        let end = end_of(PRISMS, task, &["--task", task, "--object", "prism"], 0);
        assert_eq!((&end["outcome"], &end["class"]), (&"goal".into(), &"prism".into()));
        assert!(end["coverage"].as_f64().unwrap() > 0.97, "{end}");
    }
}

struct Disk;

impl World for Disk {
    fn read(&self, path: &str) -> Result<Vec<u8>, ReadFailure> {
        fs::read(path).map_err(|_| ReadFailure::Missing)
    }
}

/// The views of a run of the first task and object, by a session that is given `rules`.
fn views_of(rules: &RuleSet, whole: &RuleSet) -> Vec<usize> {
    let (task, scene) = (&whole.tasks[0], &whole.scenes[0]);
    let simulator = Simulator::new(&scene.objects[0], scene.backdrop, &task.space, ".".as_ref()).unwrap();
    let mut session = Session::new(rules, &task.name, Options::default()).unwrap();
    let start = session.start();
    let sensor = Simulated {
        simulator: &simulator,
        camera: task.camera,
        noise: Noise::None,
        seed: 0,
    };
    let mut turn = ClosedLoop::new(&mut session, sensor, start);
    let steps = std::iter::from_fn(|| turn.step(&mut |_| {}).unwrap());
    steps.map(|step| step.update.view).collect()
}

/// What the simulator shows is nothing that the planner could look up.
#[test]
fn the_planner_plans_without_the_scenes() {
    let whole = lang::compile(TANKS, &Disk).rules.unwrap();
    let mut blind = whole.clone();
    blind.scenes.clear();
    let views = views_of(&blind, &whole);
    assert!(views.len() > 1);
    assert_eq!(views, views_of(&whole, &whole));
}
