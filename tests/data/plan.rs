//! `vpl plan --frames`: the planner chooses among the views that were taken.

use std::fs;
use std::path::Path;

use serde_json::Value;
use vpl::geometry::Pose;

use crate::ros;
use crate::scene;
use crate::support::{Ran, folder, vpl};

pub const BLOCKS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/blocks.vpl");

/// A run on recorded frames with its log.
pub fn plan(program: &str, frames: &Path, log: &Path, options: &[&str]) -> Ran {
    let (frames, log) = (frames.to_str().unwrap(), log.to_str().unwrap());
    vpl(&[&["plan", program, "--frames", frames, "--log", log], options].concat())
}

pub fn records(log: &Path) -> Vec<Value> {
    let text = fs::read_to_string(log).unwrap();
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// Without times and the recording's name.
fn story(log: &Path) -> Vec<Value> {
    let mut records = records(log);
    for record in &mut records {
        let record = record.as_object_mut().unwrap();
        record.remove("ms");
        record.remove("object");
    }
    records
}

#[test]
fn a_run_goes_among_the_views_that_were_taken() {
    let (base, frames) = (folder("plan"), scene::frames());
    let path = base.join("set");
    scene::write("transforms", &path, &frames, Pose::clone);
    let log = base.join("run.jsonl");
    let ran = plan(BLOCKS, &path, &log, &["--start", "1"]);
    assert!(matches!(ran.status, Some(0 | 3)), "{} {}", ran.out, ran.err);
    assert!(
        ran.err
            .contains("note: the camera is the recording's, 96 × 72 with fx 90.0, fy 93.0"),
        "{}",
        ran.err
    );
    let records = records(&log);
    assert_eq!(records[0]["candidates"], 4);
    assert_eq!(records[0]["object"], path.to_str().unwrap());
    let views: Vec<&Value> = records.iter().filter(|r| r["event"] == "view").collect();
    assert_eq!(views[0]["view"], 1);
    assert!(views.len() > 1 && views.len() <= 4);
    for view in &views {
        let frame = &frames[view["view"].as_u64().unwrap() as usize];
        let x = view["pose"]["position"][0].as_f64().unwrap();
        assert!((x - frame.world_from_camera.translation.vector.x).abs() < 1e-9);
        assert!(view["points"].as_u64().unwrap() > 100);
    }
    // Some face was found on the real readings, and nothing is known of the whole surface.
    assert_eq!(views[0]["features"]["face"]["state"], 1);
    let end = records.last().unwrap();
    assert_eq!(end["event"], "end");
    assert!(end["coverage"].is_null());
    assert_eq!(ran.status, Some(if end["outcome"] == "goal" { 0 } else { 3 }));
}

/// The layout is no part of what is planned.
#[test]
fn a_run_does_not_depend_on_the_layout() {
    let (base, frames) = (folder("plan_layouts"), scene::frames());
    let mut stories = Vec::new();
    for layout in ["seven_scenes", "bop", "bag"] {
        let path = base
            .join(layout)
            .with_extension(if layout == "bag" { "bag" } else { "d" });
        if layout == "bag" {
            ros::write_bag(&path, &ros::images(&frames, false, Pose::clone));
        } else {
            scene::write(layout, &path, &frames, Pose::clone);
        }
        let log = base.join(format!("{layout}.jsonl"));
        let ran = plan(
            BLOCKS,
            &path,
            &log,
            scene::options(if layout == "bag" { "bop" } else { layout }),
        );
        assert!(matches!(ran.status, Some(0 | 3)), "{}", ran.err);
        let views: Vec<Value> = story(&log)
            .iter()
            .filter(|r| r["event"] == "view")
            .map(|r| r["view"].clone())
            .collect();
        stories.push(views);
    }
    assert!(stories.iter().all(|s| *s == stories[0] && !s.is_empty()), "{stories:?}");
}

#[test]
fn a_run_on_frames_can_be_resumed() {
    let (base, path) = (folder("plan_resume"), folder("plan_resume/set"));
    scene::write("transforms", &path, &scene::frames(), Pose::clone);
    let [first, whole] = ["first.jsonl", "whole.jsonl"].map(|name| base.join(name));
    plan(BLOCKS, &path, &whole, &[]);
    let text = fs::read_to_string(&whole).unwrap();
    let two: Vec<&str> = text.lines().take(3).collect();
    fs::write(&first, two.join("\n") + "\n").unwrap();
    plan(BLOCKS, &path, &first, &["--resume", first.to_str().unwrap()]);
    assert_eq!(story(&first), story(&whole));
}

/// What cannot work is said before the first view, or at the frame that is broken.
#[test]
fn what_is_wrong_with_frames_is_said() {
    let base = folder("plan_wrong");
    let frames = scene::frames();
    let log = base.join("run.jsonl");
    let inverse = base.join("inverse");
    scene::write("transforms", &inverse, &frames, Pose::inverse);
    let ran = plan(BLOCKS, &inverse, &log, &["--max-views", "1"]);
    assert!(
        ran.err
            .contains("warning: likely mistake: the poses are the other way round"),
        "{}",
        ran.err
    );
    let far = base.join("far");
    scene::write("transforms", &far, &frames, |p| Pose::translation(20.0, 0.0, 0.0) * p);
    let ran = plan(BLOCKS, &far, &log, &["--max-views", "1"]);
    assert!(
        ran.err.contains("warning: no reading lies in the space of task `look`"),
        "{}",
        ran.err
    );
    let near = base.join("near");
    scene::write("transforms", &near, &frames, Pose::clone);
    let ran = plan(BLOCKS, &near, &log, &["--max-views", "1", "--max-depth", "310mm"]);
    assert!(ran.err.contains("no reading lies in the space"), "{}", ran.err);
    let broken = base.join("broken");
    scene::write("transforms", &broken, &frames, Pose::clone);
    fs::write(broken.join("images/0.png"), "no picture").unwrap();
    plan(BLOCKS, &broken, &log, &[]).expect(1, &["error[E0611]", "images/0.png"]);
    for (options, words) in [
        (&["--object", "m1"][..], "`--object` is for the simulator"),
        (&["--noise", "structured_light"], "`--noise` is for the simulator"),
    ] {
        plan(BLOCKS, &near, &log, options).expect(2, &[words]);
    }
    vpl(&["plan", BLOCKS, "--depth-scale", "1000"]).expect(2, &["`--depth-scale` is for recorded frames"]);
    plan(BLOCKS, &base.join("nowhere"), &log, &[]).expect(1, &["error[E0611]", "there is no such file"]);
    let inside = near.join("run.jsonl");
    plan(BLOCKS, &near, &inside, &[]).expect(2, &["would write into the recording"]);
    assert!(!inside.exists());
}
