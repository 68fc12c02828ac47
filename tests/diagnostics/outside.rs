//! Diagnostics that no single text gives: files, bytes, objects and runs. A snapshot a
//! code, with the command and everything that is said.

use std::fs;
use std::path::Path;

use super::support::{err, folder, vpl_in};

const TANKS: &str = include_str!("../../examples/tanks/tanks.vpl");
const SOLIDS: &str = include_str!("../../examples/solids/solids.vpl");

/// Runs a command in a folder and holds what it says of `code`.
#[track_caller]
fn says(code: &str, folder: &Path, given: &str, command: &str) {
    let arguments: Vec<&str> = command.split(' ').collect();
    let output = vpl_in(folder, &arguments, b"");
    let said = err(&output);
    assert!(said.contains(code), "{said}");
    let status = output.status.code().unwrap();
    let mut settings = insta::Settings::clone_current();
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(code, format!("{given}\n\n$ vpl {command}\n{said}exit status {status}")));
}

fn check(code: &str, given: &str, bytes: &[u8]) {
    let folder = folder(code);
    fs::write(folder.join("a.vpl"), bytes).unwrap();
    says(code, &folder, given, "check --format plain a.vpl");
}

#[test]
fn files_that_cannot_be_read() {
    check("E0106", "a.vpl: 9 MB of blanks", &vec![b' '; 9_000_000]);
    check("E0107", "a.vpl: vpl 1, and a byte 0xff", b"vpl 1\nlet a = \xff 2\n");
    let deep = format!("vpl 1\nlet a = {}1{}\n", "(".repeat(200), ")".repeat(200));
    check("E0108", "a.vpl: a number in 200 parentheses", deep.as_bytes());
}

#[test]
fn objects_that_cannot_be_shown() {
    let at = folder("E0503");
    let near = SOLIDS.replace("sphere(radius: 1.4 m", "sphere(radius: 500 mm");
    let large = near.replace("radius: 150 mm, height: 280 mm", "radius: 560 mm, height: 1.1 m");
    fs::write(at.join("a.vpl"), large).unwrap();
    let given = "a.vpl: the solids as prisms of 560 mm, seen from 500 mm";
    says("E0503", &at, given, "plan a.vpl --object m1");

    let at = folder("E0504");
    fs::write(at.join("a.vpl"), SOLIDS).unwrap();
    fs::write(at.join("part.stl"), "solid part\nfacet normal").unwrap();
    says(
        "E0504",
        &at,
        "part.stl: cut off in a facet",
        "plan a.vpl --object part.stl --units mm --up z",
    );
}

#[test]
fn results_and_runs() {
    let at = folder("runs");
    fs::write(at.join("a.vpl"), TANKS).unwrap();
    says("E0601", &at, "no folder `out`", "compile a.vpl -o out/a.json");

    fs::write(at.join("other.jsonl"), "{\"event\": \"start\"}\n").unwrap();
    says(
        "E0602",
        &at,
        "other.jsonl: a start without its keys",
        "plan a.vpl --resume other.jsonl",
    );

    let run = "plan a.vpl --object tk9 --start 40 --log run.jsonl";
    assert!(vpl_in(&at, &run.split(' ').collect::<Vec<_>>(), b"").status.success());
    let log = fs::read_to_string(at.join("run.jsonl")).unwrap();
    let second = log.lines().nth(2).unwrap();
    let view: serde_json::Value = serde_json::from_str(second).unwrap();
    let (taken, other) = (format!("\"view\":{}", view["view"]), "\"view\":0");
    let elsewhere = second.replacen(&taken, other, 1);
    assert_ne!(second, elsewhere);
    fs::write(at.join("moved.jsonl"), log.replace(second, &elsewhere)).unwrap();
    let given = "moved.jsonl: the log of a run, its second view replaced by view 0";
    says(
        "E0603",
        &at,
        given,
        "plan a.vpl --object tk9 --start 40 --resume moved.jsonl",
    );

    says("E0711", &at, "no file `gone.jsonl`", "why gone.jsonl tk4");
    says("E0712", &at, "a.vpl: a program", "why a.vpl tk4");
    says("E0713", &at, "run.jsonl: tk9 recognised", "why run.jsonl tk44");
    says(
        "E0714",
        &at,
        "run.jsonl: tk9 recognised in three views",
        "why run.jsonl view 12",
    );
}

#[test]
fn folders_of_studies() {
    let at = folder("E0605");
    let study = "\nstudy few {\n  task    recognise\n  methods gn\n  starts  1\n}\n";
    fs::write(at.join("a.vpl"), format!("{TANKS}{study}")).unwrap();
    fs::create_dir_all(at.join("out")).unwrap();
    fs::write(at.join("out/thesis.tex"), "").unwrap();
    says(
        "E0605",
        &at,
        "out: a folder with a file of somebody's own",
        "study a.vpl --out out",
    );
}

#[test]
fn facts_that_do_not_hold() {
    let at = folder("E0701");
    let fact = "\ntest \"a tank without code 1 is tk1\" {\n  library tanks\n  given  code[1] absent\n  expect classes tk1\n}\n";
    fs::write(at.join("a.vpl"), format!("{TANKS}{fact}")).unwrap();
    says("E0701", &at, fact, "test a.vpl");
}

#[test]
fn recordings_and_maps() {
    let at = folder("recordings");
    fs::create_dir_all(at.join("desk")).unwrap();
    fs::write(at.join("desk/notes.txt"), "frames to come").unwrap();
    says("E0611", &at, "desk: a folder with a text file", "inspect desk");
    fs::write(
        at.join("half.bt"),
        "# Octomap OcTree binary file\nid OcTree\nsize 3\nres 0.1\ndata\n\u{1}",
    )
    .unwrap();
    says(
        "E0612",
        &at,
        "half.bt: a tree of three nodes that ends in the first",
        "inspect half.bt",
    );
}
