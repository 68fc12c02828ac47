//! Interrupted runs and `--resume`.

use std::fs;
use std::io::{BufRead, BufReader};
use std::process::Stdio;

use super::support::*;

/// Killed once the second view is on the screen, which comes after the first
/// view's line in the log.
#[test]
fn an_interrupted_run_leaves_whole_views_and_can_be_resumed() {
    let folder = folder("interrupted");
    let options = ["plan", SOLIDS, "--object", "m13", "--log", "run.jsonl"];
    let mut child = command(&folder, &options)
        .stderr(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let lines = BufReader::new(child.stderr.take().unwrap()).lines();
    assert_eq!(lines.take(2).count(), 2);
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(views(&records(&folder.join("run.jsonl"))).count() >= 1);
    let resumed = ["--object", "m13", "--resume", "run.jsonl", "--log", "again.jsonl"];
    plan(&folder, &[&[SOLIDS][..], &resumed].concat());
    plan(&folder, &[SOLIDS, "--object", "m13", "--log", "whole.jsonl"]);
    assert_eq!(
        timeless(&folder.join("again.jsonl")),
        timeless(&folder.join("whole.jsonl"))
    );
}

/// Wherever the log was cut after its first line, within a character even.
#[test]
fn a_log_cut_anywhere_continues_to_the_same_end() {
    let folder = folder("cut");
    plan(&folder, &[SOLIDS, "--object", "m2", "--log", "whole.jsonl"]).expect(0, &[]);
    let whole = fs::read(folder.join("whole.jsonl")).unwrap();
    let first = whole.iter().position(|b| *b == b'\n').unwrap();
    for cut in [first + 1, first + 40, whole.len() / 2, whole.len() - 1] {
        fs::write(folder.join("cut.jsonl"), &whole[..cut]).unwrap();
        let options = ["--object", "m2", "--resume", "cut.jsonl", "--log", "cut.jsonl"];
        plan(&folder, &[&[SOLIDS][..], &options].concat()).expect(0, &[]);
        assert_eq!(
            timeless(&folder.join("cut.jsonl")),
            timeless(&folder.join("whole.jsonl")),
            "cut at {cut}"
        );
    }
}

#[test]
fn the_log_of_another_run_is_refused_and_kept() {
    let folder = folder("another");
    plan(&folder, &[SOLIDS, "--max-views", "2", "--log", "run.jsonl"]).expect(3, &[]);
    let before = fs::read(folder.join("run.jsonl")).unwrap();
    let resume = |options: &[&str]| {
        plan(
            &folder,
            &[options, &["--resume", "run.jsonl", "--log", "run.jsonl"]].concat(),
        )
    };
    for (options, words) in [
        (&[SOLIDS, "--seed", "1"][..], "its seed is `0`, and this one's is `1`"),
        (
            &[SOLIDS, "--object", "m2"],
            "its object is `m1`, and this one's is `m2`",
        ),
        (&[SOLIDS, "--method", "random"], "its method is `gn`"),
        (&[SOLIDS, "--noise", "structured_light"], "its noise is `none`"),
        (&[SOLIDS, "--max-views", "3"], "its limit of views is `2`"),
        (&[SOLIDS, "--max-views", "2", "--start", "3"], "say `--start"),
        (&[TANKS], "its rule set is"),
    ] {
        resume(options).expect(1, &["error[E0602]", words]);
    }
    assert_eq!(fs::read(folder.join("run.jsonl")).unwrap(), before);
    for text in ["", "rubbish", "{}", "{\"event\":\"end\"}", "\u{0}\n\u{0}\n"] {
        fs::write(folder.join("bad.jsonl"), text).unwrap();
        plan(&folder, &[SOLIDS, "--resume", "bad.jsonl"]).expect(1, &["error[E0602]"]);
    }
    plan(&folder, &[SOLIDS, "--resume", "nowhere.jsonl"]).expect(1, &["error[E0602]"]);
}
