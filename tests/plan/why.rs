//! `vpl why`: answers from the logs of real runs, and from bad ones.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::support::*;

const PARCELS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/plan/parcels.vpl");
const PRISMS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/plan/prisms.vpl");

/// A run of a program of the examples in a folder of its own, where it is named
/// without a path; logged to `run.jsonl`.
fn ran(test: &str, program: &str, object: &str) -> PathBuf {
    ran_to(0, test, program, &["--object", object])
}

/// As [`ran`], with options and the exit status that they lead to.
fn ran_to(status: i32, test: &str, program: &str, options: &[&str]) -> PathBuf {
    let folder = folder(test);
    let name = Path::new(program).file_name().unwrap().to_str().unwrap();
    fs::copy(program, folder.join(name)).unwrap();
    plan(&folder, &[&[name, "--log", "run.jsonl"], options].concat()).expect(status, &[]);
    folder
}

fn why(folder: &Path, arguments: &[&str]) -> Ran {
    let all = [&["why"], arguments].concat();
    command(folder, &all).output().unwrap().into()
}

/// Snapshots of the answers about some subjects of a folder's run.
fn answers(folder: &Path, suite: &str, subjects: &[&str]) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("why");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    for subject in subjects {
        let words: Vec<&str> = subject.split(' ').collect();
        let answer = why(folder, &[&["run.jsonl"][..], &words].concat());
        answer.expect(0, &[]);
        let name: String = subject.chars().filter(char::is_ascii_alphanumeric).collect();
        settings.bind(|| insta::assert_snapshot!(format!("{suite}_{name}"), answer.out));
        let data = why(folder, &[&["run.jsonl", "--format", "json"][..], &words].concat());
        let data: Value = serde_json::from_str(&data.out).unwrap();
        assert!(data["about"].is_string() && data["at"].is_u64(), "{data}");
    }
}

/// A rule that found nothing, one that had company, an absent feature, an
/// excluded class, a view won by a tie, and the last view.
#[test]
fn a_recognition_can_be_asked_about() {
    let folder = ran("why_tank", TANKS, "tk9");
    let subjects = [
        "r1", "r3", "r9", "code[4]", "tk3", "tk9", "view 1", "view 3", "view 6", "view #45",
    ];
    answers(&folder, "tank", &subjects);
    let then = why(&folder, &["run.jsonl", "tk3", "--at", "2"]);
    assert!(
        then.expect(0, &[]).out.starts_with("tk3  possible, p = 0.091"),
        "{}",
        then.out
    );
}

/// A rule for each edge, one whose colour is nowhere, a shell proven at the
/// second look, and a run that ends because nothing is left to see.
#[test]
fn a_reconstruction_can_be_asked_about() {
    let folder = ran("why_solid", SOLIDS, "m1");
    let subjects = [
        "r4",
        "r6",
        "r7",
        "prism_shape",
        "pyramid_side",
        "pyramid",
        "bottom.1/edge.3",
        "view 2",
        "view 10",
    ];
    answers(&folder, "solid", &subjects);
    let said = plan(&folder, &["solids.vpl", "--log", "run.jsonl"]);
    said.expect(0, &["stop: no view can show more"]);
    assert!(said.out.contains("vpl why run.jsonl SUBJECT"), "{}", said.out);
}

/// Nothing left to see, and a library that does not fit: the last view says which.
#[test]
fn a_run_that_ends_without_its_goal_says_why() {
    let bare = ran_to(3, "why_bare", PARCELS, &["--object", "bare"]);
    let last = records(&bare.join("run.jsonl")).last().unwrap()["views"].to_string();
    let answer = why(&bare, &["run.jsonl", "view", &last]).out;
    for words in [
        "the run stopped: no view can gain anything",
        "✗ confident `",
        "✓ nothing to gain",
    ] {
        assert!(answer.contains(words), "no `{words}` in {answer}");
    }
    let foreign = ran_to(3, "why_foreign", PRISMS, &["--task", "crate", "--object", "pyramid"]);
    let last = records(&foreign.join("run.jsonl")).last().unwrap()["views"].to_string();
    let answer = why(&foreign, &["run.jsonl", "view", &last]).out;
    for words in [
        "the run stopped: side contradicts the library",
        "✓ contradiction `side`",
        "were inspected and it was not found",
    ] {
        assert!(answer.contains(words), "no `{words}` in {answer}");
    }
    let answer = why(&foreign, &["run.jsonl", "prism"]).out;
    assert!(
        answer.contains("no class is left, for the library is contradicted"),
        "{answer}"
    );
}

/// With the overlap asked for, the table says which share each view has.
#[test]
fn a_view_that_the_overlap_allowed_says_so() {
    let folder = folder("why_overlap");
    fs::copy(SOLIDS, folder.join("solids.vpl")).unwrap();
    let options = [
        "solids.vpl",
        "--method",
        "gno",
        "--max-views",
        "3",
        "--log",
        "run.jsonl",
    ];
    plan(&folder, &options).expect(3, &["stop: the limit of views"]);
    let answer = why(&folder, &["run.jsonl", "view", "2"]).out;
    assert!(
        answer.contains("✓ overlap ") && answer.contains("(at least 20 %)"),
        "{answer}"
    );
    let random = [
        "solids.vpl",
        "--method",
        "random",
        "--max-views",
        "2",
        "--log",
        "random.jsonl",
    ];
    plan(&folder, &random).expect(3, &[]);
    let answer = why(&folder, &["random.jsonl", "view", "2"]).out;
    assert!(answer.contains("this method does not rank"), "{answer}");
}

/// A short run to ask wrongly about.
fn short(test: &str) -> PathBuf {
    let folder = folder(test);
    fs::copy(TANKS, folder.join("tanks.vpl")).unwrap();
    plan(&folder, &["tanks.vpl", "--max-views", "2", "--log", "run.jsonl"]).expect(3, &[]);
    folder
}

#[test]
fn what_the_run_does_not_know_is_said_with_what_was_meant() {
    let folder = short("why_unknown");
    for (subject, words) in [
        (
            &["cod[3]"][..],
            "error[E0713]: the run knows no `cod[3]`; it has 49 rules, 7 features and 12 classes",
        ),
        (&["cod[3]"], "did you mean `code[3]`?"),
        (&["R4"], "did you mean `r4`?"),
        (&["class", "tk13"], "knows no `tk13`"),
        (&["elephant"], "name a rule (`r4`), a feature"),
        (&[""], "E0713"),
        (
            &["view", "9"],
            "error[E0714]: there is no view `9`; the log tells of 2 measurements",
        ),
        (&["view", "0"], "E0714"),
        (&["view", "-1"], "unexpected argument"),
        (&["view", "99999999999999999999"], "E0714"),
        (&["view", "#64"], "the candidate views are #0 to #63"),
        (&["r4", "--at", "3"], "there is no measurement 3; the log tells of 2"),
        (&["view", "2", "--at", "1"], "view 2 comes after measurement 1"),
        (&["r4", "--at", "0"], "0 is not in 1.."),
        (&["r4", "--format", "xml"], "possible values: human, json"),
        (&[], "required arguments"),
    ] {
        let answer = why(&folder, &[&["run.jsonl"][..], subject].concat());
        answer.expect(2, &[words]);
        assert!(answer.out.is_empty());
    }
}

#[test]
fn what_is_no_log_is_refused_with_a_code() {
    let folder = short("why_bad");
    why(&folder, &["nowhere.jsonl", "r4"]).expect(1, &["error[E0711]: `nowhere.jsonl` cannot be read"]);
    why(&folder, &[".", "r4"]).expect(1, &["E0711"]);
    let log = fs::read_to_string(folder.join("run.jsonl")).unwrap();
    let lines: Vec<&str> = log.lines().collect();
    let twice = format!("{log}{log}");
    let swapped = [lines[0], lines[2], lines[1]].join("\n");
    let long = format!("{}\n{}", lines[0], "a".repeat(17 << 20));
    let deep = format!("{}\n{}\n{}", lines[0], "[".repeat(1 << 20), lines[1]);
    for (text, words) in [
        ("", "it does not begin with a start record"),
        ("\n\n", "it does not begin with a start record"),
        ("rubbish", "line 1 is no record of a run log"),
        ("{}", "line 1 is no record of a run log"),
        ("\u{0}\n\u{0}\n", "line 1 is no record"),
        (lines[1], "it does not begin with a start record"),
        (&twice, "line 5 stands in no order"),
        (&swapped, "line 2 stands in no order"),
        (&long, "line 2 is longer than any record"),
        (&deep, "line 2 is no record of a run log"),
    ] {
        fs::write(folder.join("bad.jsonl"), text).unwrap();
        why(&folder, &["bad.jsonl", "r4"]).expect(1, &["error[E0712]: `bad.jsonl` is no run log", words]);
    }
    let mut bytes = log.clone().into_bytes();
    bytes[40] = 0xff;
    fs::write(folder.join("bad.jsonl"), bytes).unwrap();
    why(&folder, &["bad.jsonl", "r4"]).expect(1, &["E0712"]);
    let huge = fs::File::create(folder.join("huge.jsonl")).unwrap();
    huge.set_len(300 << 20).unwrap();
    why(&folder, &["huge.jsonl", "r4"]).expect(1, &["E0711", "larger than 256 MiB"]);
}

/// Killed within a line: what is whole is told, and that the rest is missing.
#[test]
fn a_log_that_was_cut_off_is_told_as_far_as_it_goes() {
    let folder = short("why_cut");
    let log = fs::read(folder.join("run.jsonl")).unwrap();
    let ends: Vec<usize> = (0..log.len()).filter(|k| log[*k] == b'\n').collect();
    for (cut, views) in [(ends[1] + 1, 1), (ends[1] + 300, 1), (ends[2] + 1, 2), (ends[0], 0)] {
        fs::write(folder.join("cut.jsonl"), &log[..cut]).unwrap();
        let answer = why(&folder, &["cut.jsonl", "r1"]);
        let note = format!("note: the log ends after view {views} without an outcome");
        assert!(answer.expect(0, &[]).out.contains(&note), "{}", answer.out);
    }
    let mut file = fs::OpenOptions::new()
        .append(true)
        .open(folder.join("cut.jsonl"))
        .unwrap();
    file.write_all(b"\n{\"event\":\"vi").unwrap();
    why(&folder, &["cut.jsonl", "view", "1"]).expect(2, &["the log tells of 0 measurements"]);
}

/// The keys that came later are left out.
#[test]
fn an_older_log_is_told_as_far_as_it_knows() {
    let folder = short("why_old");
    let mut old = String::new();
    for mut record in records(&folder.join("run.jsonl")) {
        let object = record.as_object_mut().unwrap();
        if object["event"] == "view" {
            object.remove("rules");
        }
        for key in ["absent", "stop", "criteria", "library"] {
            object.remove(key);
        }
        if let Some(next) = object.get_mut("next").and_then(Value::as_object_mut) {
            next.retain(|key, _| ["view", "score", "terms", "relaxed"].contains(&key.as_str()));
        }
        old += &format!("{record}\n");
    }
    fs::write(folder.join("old.jsonl"), old).unwrap();
    for (subject, words) in [
        ("r8", "the log does not tell what this rule did"),
        ("code[1]", "code[1]"),
        ("tk4", "probability"),
        ("view 2", "then        the run stopped: the limit of views"),
    ] {
        let words_of: Vec<&str> = subject.split(' ').collect();
        let answer = why(&folder, &[&["old.jsonl"][..], &words_of].concat());
        let out = &answer.expect(0, &[]).out;
        assert!(
            out.contains(words) && out.contains("note: this log was written before"),
            "{out}"
        );
    }
    let resumed = [
        "tanks.vpl",
        "--max-views",
        "2",
        "--resume",
        "old.jsonl",
        "--log",
        "new.jsonl",
    ];
    plan(&folder, &resumed).expect(3, &[]);
    assert_eq!(timeless(&folder.join("new.jsonl")), timeless(&folder.join("run.jsonl")));
}

#[test]
fn a_rule_is_shown_as_written_as_long_as_the_program_has_it() {
    let folder = short("why_changed");
    let shown = why(&folder, &["run.jsonl", "r1"]).out;
    assert!(
        shown.contains("rule -> code[i] {") && shown.contains("(tanks.vpl:28)"),
        "{shown}"
    );
    let elsewhere = why(Path::new("/"), &[folder.join("run.jsonl").to_str().unwrap(), "r1"]).out;
    assert!(elsewhere.contains("rule -> code[i] {"), "{elsewhere}");
    let text = fs::read_to_string(folder.join("tanks.vpl")).unwrap();
    // Another place, another number, other features before it: still the same rule.
    let moved = text
        .replacen("library tanks {", "// later\n\nlibrary tanks {\n  feature first : marker\n", 1)
        .replacen(
            "  rule -> code[i]",
            "  rule -> first {\n    detect  qr(text: \"f\", size: 20 mm)\n    measure marker_pose()\n  }\n\n  rule -> code[i]",
            1,
        );
    fs::write(folder.join("tanks.vpl"), moved).unwrap();
    let shown = why(&folder, &["run.jsonl", "r1"]).out;
    assert!(
        shown.contains("rule -> code[i] {") && shown.contains("(tanks.vpl:37)") && !shown.contains("note:"),
        "{shown}"
    );
    let changed = text.replacen("f{i}", "g{i}", 1);
    assert_ne!(changed, text);
    fs::write(folder.join("tanks.vpl"), changed).unwrap();
    let changed = why(&folder, &["run.jsonl", "r1"]).out;
    assert!(changed.starts_with("r1  → code[1]\n"), "{changed}");
    assert!(
        changed.contains("note: no rule of the program is what `r1` was in the run any more"),
        "{changed}"
    );
    fs::remove_file(folder.join("tanks.vpl")).unwrap();
    let gone = why(&folder, &["run.jsonl", "r1"]).out;
    assert!(
        gone.contains("note: `tanks.vpl`, which the log names, is not here"),
        "{gone}"
    );
}

#[test]
fn a_log_may_come_on_standard_input() {
    let folder = short("why_stdin");
    let log = fs::File::open(folder.join("run.jsonl")).unwrap();
    let piped: Ran = command(&folder, &["why", "-", "tk1"])
        .stdin(log)
        .output()
        .unwrap()
        .into();
    piped.expect(0, &[]);
    assert_eq!(piped.out, why(&folder, &["run.jsonl", "tk1"]).out);
}
