//! Files that a run writes: where it may, where it cannot, what is kept.

use std::fs;
use std::path::Path;
use std::process::Stdio;

use super::support::*;

#[test]
fn the_map_is_an_octomap_file() {
    let folder = folder("map");
    plan(&folder, &[SOLIDS, "--object", "m2", "--map", "run.bt"]).expect(0, &[]);
    let map = fs::read(folder.join("run.bt")).unwrap();
    let text = String::from_utf8_lossy(&map[..200]).into_owned();
    assert!(text.starts_with("# Octomap OcTree binary file\n"), "{text}");
    assert!(text.contains("\nid OcTree\n") && text.contains("\nres 0.01\n") && text.contains("\ndata\n"));
}

/// Noticed before the first view; the other file is not begun either.
#[test]
fn what_cannot_be_written_is_said_at_once() {
    let folder = folder("unwritable");
    for option in ["--log", "--map"] {
        let ran = plan(&folder, &[SOLIDS, option, "no/such/folder/run"]);
        ran.expect(1, &["error[E0601]: `no/such/folder/run` cannot be written"]);
        assert!(!ran.err.contains("view") && ran.out.is_empty());
        plan(&folder, &[SOLIDS, option, "."]).expect(1, &["error[E0601]"]);
    }
}

/// The log and the summary of a run are not lost to a map on a full disk.
#[test]
fn a_full_disk_loses_nothing_that_was_written() {
    if !Path::new("/dev/full").exists() {
        eprintln!("skipped: there is no /dev/full here");
        return;
    }
    let folder = folder("full");
    plan(&folder, &[SOLIDS, "--log", "/dev/full"]).expect(1, &["error[E0601]", "`/dev/full`"]);
    let ran = plan(
        &folder,
        &[SOLIDS, "--object", "m2", "--log", "run.jsonl", "--map", "/dev/full"],
    );
    ran.expect(1, &["error[E0601]", "`/dev/full`"]);
    assert!(ran.out.contains("m2 is of class pyramid"), "{}", ran.out);
    assert_eq!(records(&folder.join("run.jsonl")).last().unwrap()["outcome"], "goal");
}

#[test]
fn no_file_of_the_run_is_overwritten() {
    let folder = folder("overwrite");
    fs::copy(SOLIDS, folder.join("my.vpl")).unwrap();
    fs::write(folder.join("part.stl"), "solid part").unwrap();
    for options in [
        &["my.vpl", "--log", "my.vpl"][..],
        &["my.vpl", "--map", "./my.vpl"],
        &["my.vpl", "--object", "part.stl", "--log", "../overwrite/part.stl"],
        &["my.vpl", "--log", "new", "--map", "./new"],
        &["my.vpl", "--log", "-", "--map", "-"],
    ] {
        plan(&folder, options).expect(2, &["would overwrite"]);
    }
    assert_eq!(fs::read(folder.join("my.vpl")).unwrap(), fs::read(SOLIDS).unwrap());
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 2);
}

#[test]
fn a_log_on_standard_output_stands_alone_there() {
    let folder = folder("stdout");
    let ran = plan(&folder, &[SOLIDS, "--object", "m2", "--log", "-"]);
    ran.expect(0, &["m2 is of class pyramid"]);
    assert_eq!(records_in(&ran.out).last().unwrap()["event"], "end");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0);
}

/// Nobody reads the progress, as in `vpl plan … 2>&1 | head -1`.
#[test]
fn a_run_outlives_the_readers_of_its_progress() {
    let folder = folder("broken_pipe");
    let mut command = command(&folder, &["plan", SOLIDS, "--object", "m2", "--log", "run.jsonl"]);
    let mut child = command.stderr(Stdio::piped()).stdout(Stdio::null()).spawn().unwrap();
    drop(child.stderr.take());
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert_eq!(records(&folder.join("run.jsonl")).last().unwrap()["outcome"], "goal");
}
