//! The run log, held to its contract in `docs/cli.md`.

use serde_json::Value;

use super::support::*;

const VOXELS: u64 = 60 * 60 * 60;

#[track_caller]
fn has(record: &Value, expected: &[&str]) {
    let missing: Vec<_> = expected.iter().filter(|k| !keys(record).contains(k)).collect();
    assert!(missing.is_empty(), "{missing:?} in {record}");
}

#[track_caller]
fn is_a_view(view: &Value, n: usize, last: bool) {
    let whole = [
        "n",
        "view",
        "pose",
        "points",
        "features",
        "classes",
        "voxels",
        "completion",
        "next",
        "ms",
    ];
    has(view, &whole);
    has(&view["pose"], &["position", "rotation"]);
    has(&view["completion"], &["confident", "exhausted"]);
    has(&view["ms"], &["sense", "detect", "map", "score"]);
    assert_eq!(view["n"], n);
    assert_eq!(view["next"].is_null(), last);
    let sum = |o: &Value| {
        o.as_object()
            .unwrap()
            .values()
            .map(|v| v.as_f64().unwrap())
            .sum::<f64>()
    };
    assert!((sum(&view["classes"]) - 1.0).abs() < 1e-9, "{}", view["classes"]);
    assert_eq!(sum(&view["voxels"]), VOXELS as f64);
    for feature in view["features"].as_object().unwrap().values() {
        has(feature, &["state", "predicted", "weight", "instances"]);
        for instance in feature["instances"].as_array().unwrap() {
            has(
                instance,
                &["key", "state", "inspected", "predicted_voxels", "predicted_by"],
            );
        }
    }
    if !last {
        has(&view["next"], &["view", "score", "terms", "relaxed"]);
        has(&view["next"]["terms"], &["overlap", "feature", "surface", "w"]);
    }
}

#[track_caller]
fn is_a_run(records: &[Value], task: &str, object: &str) {
    let (start, end) = (&records[0], records.last().unwrap());
    assert_eq!(start["event"], "start");
    has(
        start,
        &["vpl", "file", "seed", "noise", "insertion", "limit", "rules", "weights"],
    );
    assert_eq!((&start["task"], &start["object"]), (&task.into(), &object.into()));
    assert_eq!((&start["method"], &start["candidates"]), (&"gn".into(), &64.into()));
    let views: Vec<&Value> = views(records).collect();
    for (k, view) in views.iter().enumerate() {
        is_a_view(view, k + 1, k + 1 == views.len());
    }
    for pair in views.windows(2) {
        assert_eq!(pair[0]["next"]["view"], pair[1]["view"]);
    }
    assert_eq!(end["event"], "end");
    has(end, &["outcome", "class", "confidence", "coverage", "contradiction"]);
    assert_eq!(end["views"], views.len());
    assert_eq!(records.len(), views.len() + 2);
}

#[test]
fn a_tank_is_recognised_and_logged() {
    let folder = folder("a_tank");
    plan(&folder, &[TANKS, "--object", "tk9", "--log", "run.jsonl"]).expect(0, &["view 1"]);
    let records = records(&folder.join("run.jsonl"));
    is_a_run(&records, "recognise", "tk9");
    assert_eq!(records.last().unwrap()["class"], "tk9");
    // H(p) of p = 11, 4, 5, 5, 9, 9 and 10 of 12 classes.
    let weights = [0.4138, 0.9183, 0.9799, 0.9799, 0.8113, 0.8113, 0.6500];
    for (k, bits) in weights.into_iter().enumerate() {
        let weight = records[0]["weights"][format!("code[{}]", k + 1)].as_f64().unwrap();
        assert!((weight - bits).abs() < 5e-5, "code[{}]: {weight}", k + 1);
    }
}

#[test]
fn a_solid_is_reconstructed_and_logged() {
    let folder = folder("a_solid");
    let ran = plan(&folder, &[SOLIDS, "--log", "run.jsonl"]);
    ran.expect(0, &[]);
    let records = records(&folder.join("run.jsonl"));
    is_a_run(&records, "reconstruct", "m1");
    let end = records.last().unwrap();
    assert_eq!((&end["outcome"], &end["class"]), (&"goal".into(), &"prism".into()));
    assert!(end["coverage"].as_f64().unwrap() > 0.97);
    assert!(ran.out.contains("m1 is of class prism"), "{}", ran.out);
}

#[test]
fn a_run_cut_short_by_its_limit_has_a_status_of_its_own() {
    let folder = folder("view_limit");
    let ran = plan(&folder, &[SOLIDS, "--max-views", "1", "--log", "run.jsonl"]);
    ran.expect(3, &[]);
    assert!(
        ran.out
            .contains("the limit of views is used up (class prism, p = 1.000)"),
        "{}",
        ran.out
    );
    let records = records(&folder.join("run.jsonl"));
    assert_eq!(records.len(), 3);
    assert_eq!(records[2]["outcome"], "view_limit");
    assert!(records[1]["next"].is_null());
}

/// Threads change nothing, with and without noise.
#[test]
fn one_thread_and_two_give_the_same_bytes() {
    let folder = folder("threads");
    for options in [
        [TANKS, "--object", "tk4", "--noise", "structured_light"],
        [SOLIDS, "--object", "m2", "--seed", "7"],
    ] {
        let run = |threads: &str, log: &str| {
            let more = ["--threads", threads, "--log", log];
            plan(&folder, &[&options[..], &more].concat());
            timeless(&folder.join(log))
        };
        let (one, two) = (run("1", "one.jsonl"), run("2", "two.jsonl"));
        assert!(one.lines().count() > 3);
        assert_eq!(one, two);
    }
}
