//! Wrong usage (2) and wrong input (1).

use std::fs;

use super::support::*;

/// Nothing runs, and the message names what would do.
#[test]
fn wrong_usage_is_refused_with_what_would_do() {
    let folder = folder("usage");
    for (options, words) in [
        (&["--task", "nope"][..], "no task `nope`; the file has `reconstruct`"),
        (&["--object", "nope"], "no object `nope`; the file has `m1`"),
        (&["--method", "nope"], "no method `nope`; use one of `gn`"),
        (&["--noise", "nope"], "known: `none`, `structured_light`"),
        (&["--start", "64"], "numbered from 0 to 63"),
        (&["--start", "-1"], "unexpected argument"),
        (&["--threads", "0"], "0 is not in 1..=1024"),
        (&["--max-views", "0"], "0 is not in 1..="),
        (&["--seed", "one"], "invalid digit"),
        (&["--units", "furlong"], "possible values: mm, cm, m, in"),
        (
            &["--units", "mm"],
            "are for a mesh file, and `m1` is an object of the scene",
        ),
        (&["--nope"], "unexpected argument '--nope'"),
    ] {
        let all = [&[SOLIDS, "--log", "run.jsonl"], options].concat();
        let ran = plan(&folder, &all);
        ran.expect(2, &[words]);
        assert!(ran.out.is_empty());
    }
    assert!(!folder.join("run.jsonl").exists());
}

/// Each with its code, in bounded time.
#[test]
fn wrong_programs_are_refused_with_a_code() {
    let folder = folder("programs");
    let deep = format!("vpl 1\nlet f() = {}1{}\n", "(".repeat(200_000), ")".repeat(200_000));
    for (text, code) in [
        (String::new(), "E0104"),
        ("}{ \u{0} rubbish".to_owned(), "E01"),
        (deep, "E0108"),
        ("a".repeat(50 << 20), "E0106"),
    ] {
        fs::write(folder.join("bad.vpl"), text).unwrap();
        plan(&folder, &["bad.vpl"]).expect(1, &[code, "bad.vpl:"]);
    }
    plan(&folder, &["nowhere.vpl"]).expect(1, &["E0105"]);
    plan(&folder, &["."]).expect(1, &["E0105", "it is a folder"]);
}

#[test]
fn a_program_without_task_or_object_says_so() {
    let folder = folder("without");
    let text = fs::read_to_string(SOLIDS).unwrap();
    let (tasks, _) = text.split_once("/// Thirteen").unwrap();
    plan_of("vpl 1\n", &folder, &[]).expect(2, &["the file has no task; add `task NAME { … }`"]);
    plan_of(tasks, &folder, &[]).expect(2, &["no scene with an object; name a mesh"]);
}

#[test]
fn views_inside_the_object_are_refused() {
    let text = fs::read_to_string(SOLIDS).unwrap();
    let near = |radius: &str| text.replace("sphere(radius: 1.4 m", &format!("sphere(radius: {radius}"));
    let large = near("500 mm").replace("radius: 150 mm, height: 280 mm", "radius: 560 mm, height: 1.1 m");
    let folder = folder("inside");
    plan_of(&large, &folder, &[]).expect(1, &["E0503", "inside `m1`", "larger radius"]);
    plan_of(&near("50 mm"), &folder, &[]).expect(1, &["E0403", "inside the object space"]);
}

#[test]
fn an_object_outside_the_space_is_refused() {
    let text = fs::read_to_string(SOLIDS).unwrap();
    let text = text.replace("[10 mm, -15 mm, 308 mm]", "[10 m, -15 m, 308 m]");
    plan_of(&text, &folder("outside"), &[]).expect(1, &["E0505", "`m1` stands outside the space"]);
}

/// ξ of 20 voxels: slow would be for ever.
#[test]
fn a_coarse_threshold_is_no_burden() {
    let text = fs::read_to_string(SOLIDS)
        .unwrap()
        .replace("near: 10 mm", "near: 200 mm");
    plan_of(&text, &folder("coarse"), &["--max-views", "2"]).expect(3, &[]);
}

#[test]
fn a_dry_run_prints_and_writes_nothing() {
    let folder = folder("dry_run");
    let files = ["--log", "run.jsonl", "--map", "run.bt", "--dry-run"];
    let ran = plan(&folder, &[&[TANKS][..], &files].concat());
    ran.expect(0, &[]);
    for row in ["recognise", "tk1", "64 candidates", "20 mm", "0.4138"] {
        assert!(ran.out.contains(row), "no `{row}` in {}", ran.out);
    }
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
}

#[test]
fn a_program_may_come_on_standard_input() {
    let folder = folder("stdin");
    let text = fs::read_to_string(SOLIDS).unwrap();
    let piped = plan_of(&text, &folder, &["--object", "m2", "--log", "piped.jsonl"]);
    piped.expect(0, &[]);
    plan(&folder, &[SOLIDS, "--object", "m2", "--log", "named.jsonl"]).expect(0, &[]);
    let views = |log: &str| {
        timeless(&folder.join(log))
            .lines()
            .skip(1)
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    assert_eq!(views("piped.jsonl"), views("named.jsonl"));
}

/// No colour, no live line: neither in a pipe nor where colour is unwanted.
#[test]
fn piped_output_holds_no_escape_sequences() {
    let folder = folder("escapes");
    for colour in [None, Some("1")] {
        let mut command = command(&folder, &["plan", SOLIDS, "--max-views", "2"]);
        command.env_remove("NO_COLOR");
        command.envs(colour.map(|c| ("NO_COLOR", c)));
        let ran = Ran::from(command.output().unwrap());
        ran.expect(3, &["view 1", "view 2"]);
        assert!(!(ran.out + &ran.err).contains(['\u{1b}', '\r']));
    }
}
