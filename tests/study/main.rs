//! `vpl study` end to end: what it writes, that nothing it does is lost, and what it
//! refuses.

mod suites;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use suites::{RECOGNITION, SOLIDS, TANKS};

/// A folder with programs, and a place for results.
struct Bench(tempfile::TempDir);

impl Bench {
    fn new() -> Self {
        let bench = Self(tempfile::tempdir().unwrap());
        bench.write("solids.vpl", SOLIDS);
        bench.write("boxes.vpl", TANKS);
        bench.write("recognition.vpl", RECOGNITION);
        bench.write("table.csv", "# From a book.\nmethod,a,b\nGN,5,8\n");
        bench
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    fn study(&self, arguments: &[&str]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_vpl"));
        command.current_dir(self.0.path()).arg("study").args(arguments);
        command.output().unwrap()
    }

    #[track_caller]
    fn done(&self, arguments: &[&str]) -> String {
        let out = self.study(arguments);
        let said = String::from_utf8_lossy(&out.stderr).into_owned();
        assert_eq!(out.status.code(), Some(0), "{said}");
        assert!(!said.contains("panicked"), "{said}");
        said
    }

    #[track_caller]
    fn refused(&self, arguments: &[&str], status: i32, expected: &str) {
        let out = self.study(arguments);
        let said = String::from_utf8_lossy(&out.stderr).into_owned();
        assert_eq!(out.status.code(), Some(status), "{said}");
        assert!(said.contains(expected), "{said}");
    }

    fn bytes(&self, folder: &str) -> BTreeMap<String, Vec<u8>> {
        let entries = fs::read_dir(self.path(folder)).unwrap();
        let files = entries.map(|e| e.unwrap().path()).filter(|p| !is_shard(p));
        files
            .map(|p| {
                (
                    p.file_name().unwrap().to_string_lossy().into_owned(),
                    fs::read(&p).unwrap(),
                )
            })
            .collect()
    }

    fn rows(&self, folder: &str) -> Vec<serde_json::Value> {
        let text = fs::read_to_string(self.path(folder).join("runs.jsonl")).unwrap();
        text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
    }
}

fn is_shard(path: &Path) -> bool {
    path.file_name().unwrap().to_string_lossy().starts_with("runs-")
}

#[test]
fn threads_shards_and_interruptions_leave_the_same_bytes() {
    let bench = Bench::new();
    bench.done(&["solids.vpl", "--out", "whole", "--threads", "1"]);
    let whole = bench.bytes("whole");
    assert!(whole.keys().map(String::as_str).eq([
        "coverage.svg",
        "index.html",
        "runs.jsonl",
        "study.json",
        "summary.csv",
        "tables.md",
        "views-to-97.svg",
        "views.svg",
    ]));
    bench.done(&["solids.vpl", "--out", "threads", "--threads", "3"]);
    assert_eq!(bench.bytes("threads"), whole);

    // In one folder, and in folders of their own.
    for shard in ["2/3", "1/3", "3/3"] {
        bench.done(&["solids.vpl", "--out", "shards", "--shard", shard]);
    }
    assert_eq!(bench.bytes("shards"), whole);
    bench.done(&["solids.vpl", "--out", "one", "--shard", "1/2"]);
    assert!(!bench.path("one").join("summary.csv").exists());
    bench.done(&["solids.vpl", "--out", "two", "--shard", "2/2"]);
    bench.done(&["solids.vpl", "--out", "merged", "--merge", "one", "two"]);
    assert_eq!(bench.bytes("merged"), whole);

    // Stopped in the middle of a row.
    fs::create_dir(bench.path("torn")).unwrap();
    fs::write(bench.path("torn").join("study.json"), &whole["study.json"]).unwrap();
    let rows = &whole["runs.jsonl"];
    fs::write(bench.path("torn").join("runs.jsonl"), &rows[..rows.len() * 2 / 3]).unwrap();
    let said = bench.done(&["solids.vpl", "--out", "torn"]);
    assert!(said.contains("of them made before"), "{said}");
    assert_eq!(bench.bytes("torn"), whole);
}

#[test]
fn bounds_bound_and_rows_say_what_the_columns_mean() {
    let bench = Bench::new();
    bench.done(&["solids.vpl", "--out", "out"]);
    let rows = bench.rows("out");
    let number = |row: &serde_json::Value, key: &str| row[key].as_u64();
    let of = |method: &str| {
        rows.iter()
            .filter(|r| r["method"] == method)
            .cloned()
            .collect::<Vec<_>>()
    };
    let (bounds, oracles) = (of("bound"), of("oracle"));
    // Two objects, four starts.
    assert_eq!((bounds.len(), oracles.len(), of("gn").len()), (8, 8, 8));
    for row in rows.iter().filter(|r| r["method"] != "bound") {
        let same = |r: &&serde_json::Value| r["object"] == row["object"] && r["start"] == row["start"];
        let bound = bounds.iter().find(same).unwrap();
        assert_eq!(bound["closed"], true);
        for share in ["to95", "to97", "to99"] {
            let reached = number(row, share);
            assert!(reached.is_none() || number(bound, share) <= reached, "{share} {row}");
        }
    }
    // Starts ⌊k · 12 / 4⌋.
    let starts: std::collections::BTreeSet<u64> = rows.iter().filter_map(|r| number(r, "start")).collect();
    assert!(starts.into_iter().eq([0, 3, 6, 9]));
    let csv = fs::read_to_string(bench.path("out").join("summary.csv")).unwrap();
    let mut lines = csv.lines();
    assert_eq!(
        lines.next().unwrap(),
        "suite,method,object,starts,views_mean,views_lo,views_hi,unfinished,to95_mean,to97_mean,to99_mean,missing97,\
         coverage_mean,right,wrong,undecided"
    );
    let all: Vec<&str> = lines.filter(|l| l.contains(",all,")).collect();
    assert_eq!(all.len(), 4);
    assert!(
        all[0].starts_with("solids,gn,all,4,") && all[3].starts_with("solids,oracle,all,4,"),
        "{csv}"
    );
    let page = fs::read_to_string(bench.path("out").join("index.html")).unwrap();
    for loads in ["src=", "href=", "@import", "url("] {
        assert!(!page.contains(loads), "{loads}");
    }
    assert!(page.contains("From a book.") && page.contains("Not ours"));
}

#[test]
fn recognition_is_told_apart_and_held_against_the_best_policy() {
    let bench = Bench::new();
    bench.done(&["recognition.vpl", "--out", "out"]);
    let rows = bench.rows("out");
    for row in &rows {
        if row["object"] == "stranger" {
            assert_eq!(row["truth"], serde_json::Value::Null);
            continue;
        }
        assert_eq!(row["truth"], row["object"], "{row}");
        assert!(row["outcome"] != "goal" || row["class"] == row["object"], "{row}");
    }
    let bound: Vec<&serde_json::Value> = rows.iter().filter(|r| r["outcome"] == "bound").collect();
    assert!(!bound.is_empty());
    for row in bound {
        assert!(
            row["expected"].as_f64().unwrap() >= 1.0 && row["closed"] == true,
            "{row}"
        );
    }
    let known = rows.iter().filter(|r| r["method"] == "gn" && r["first"].is_u64());
    let best: Vec<f64> = known.filter_map(|r| r["best_from_first"].as_f64()).collect();
    assert!(!best.is_empty() && best.iter().all(|b| *b >= 1.0));
    let table = fs::read_to_string(bench.path("out").join("tables.md")).unwrap();
    assert!(
        table.contains("from first code") && table.contains("| wrong |"),
        "{table}"
    );
}

#[test]
fn folders_of_others_are_refused() {
    let bench = Bench::new();
    bench.done(&["recognition.vpl", "--out", "out"]);
    bench.refused(&["solids.vpl", "--out", "out"], 1, "E0605");
    bench.write("recognition.vpl", &RECOGNITION.replace("starts 2", "starts 3"));
    bench.refused(&["recognition.vpl", "--out", "out"], 1, "another state of this study");
    fs::create_dir(bench.path("mine")).unwrap();
    bench.write("mine/letter.txt", "dear");
    bench.refused(&["solids.vpl", "--out", "mine"], 1, "holds `letter.txt` and no study");
    bench.refused(&["solids.vpl", "--out", "solids.vpl"], 1, "E0601");
    bench.refused(
        &["solids.vpl", "--out", "new", "--merge", "mine"],
        1,
        "holds no `study.json`",
    );
    fs::create_dir(bench.path("bad")).unwrap();
    bench.write("bad/study.json", "{\"vpl\": ");
    bench.refused(&["solids.vpl", "--out", "bad"], 1, "E0605");
}

#[test]
fn rows_that_are_none_are_refused_by_their_line() {
    let bench = Bench::new();
    bench.done(&["recognition.vpl", "--out", "out"]);
    let path = bench.path("out").join("runs.jsonl");
    let rows = fs::read_to_string(&path).unwrap();
    let (first, rest) = rows.split_once('\n').unwrap();
    fs::write(&path, format!("{first}\n\u{0}\n{rest}")).unwrap();
    bench.refused(&["recognition.vpl", "--out", "out"], 1, "no row in line 2");
}

#[test]
fn wrong_usage_and_endless_studies_are_told_before_anything_runs() {
    let bench = Bench::new();
    for shard in ["0/2", "3/2", "1", "a/b", "1/0"] {
        bench.refused(&["solids.vpl", "--shard", shard], 2, "like `2/8`");
    }
    bench.refused(&["solids.vpl", "--study", "other"], 2, "the file has `solids`");
    bench.refused(&["boxes.vpl"], 2, "the file has no study");
    let many = SOLIDS.replace("starts 4", "starts 12; seeds 1000000");
    bench.write("many.vpl", &many.replace("methods gn, random", "methods random"));
    bench.refused(&["many.vpl", "--out", "out"], 1, "at most 1000000");
    bench.write("starts.vpl", &SOLIDS.replace("starts 4", "starts 13"));
    bench.refused(
        &["starts.vpl", "--out", "out"],
        1,
        "13 starts, and the task has 12 views",
    );
    assert!(!bench.path("out").exists());
    let planned = bench.study(&["solids.vpl", "--dry-run", "--shard", "2/5"]);
    let said = String::from_utf8_lossy(&planned.stdout).into_owned();
    assert!(said.contains("runs        7 of 32"), "{said}");
}

#[test]
fn suites_name_what_is_wrong_with_them() {
    let bench = Bench::new();
    let all = "vpl 1\n\nstudy s {\n  program \"boxes.vpl\"\n  task recognize\n  objects front, bak\n  methods gn, best, gn\n  noise fog\n  starts 16 views 2\n}\n";
    bench.write("wrong.vpl", all);
    let out = bench.study(&["wrong.vpl"]);
    let said = String::from_utf8_lossy(&out.stderr).into_owned();
    assert_eq!(out.status.code(), Some(1));
    insta::assert_snapshot!(said);
    bench.write(
        "none.vpl",
        "vpl 1\n\nstudy s {\n  program \"missing.vpl\"\n  methods gn\n}\n",
    );
    bench.refused(&["none.vpl"], 1, "there is no file `missing.vpl`");
    bench.write("broken.vpl", "vpl 1\n\nlet a = b\n");
    bench.write(
        "of_broken.vpl",
        "vpl 1\n\nstudy s {\n  program \"broken.vpl\"\n  methods gn\n}\n",
    );
    bench.refused(&["of_broken.vpl"], 1, "E0506");
}

#[test]
fn meshes_are_objects_and_a_changed_mesh_is_another_study() {
    let bench = Bench::new();
    // A tetrahedron of 200 mm.
    let corners = [[0.0, 0.0, 0.0], [200.0, 0.0, 0.0], [0.0, 200.0, 0.0], [0.0, 0.0, 200.0]];
    let faces = [[1, 3, 2], [1, 2, 4], [1, 4, 3], [2, 3, 4]];
    let mesh = |scale: f64| {
        let points: String = corners
            .iter()
            .map(|[x, y, z]| format!("v {} {} {}\n", x * scale, y * scale, z * scale))
            .collect();
        points
            + &faces
                .iter()
                .map(|[a, b, c]| format!("f {a} {b} {c}\n"))
                .collect::<String>()
    };
    bench.write("part.obj", &mesh(1.0));
    let objects = "objects mesh(file: \"part.obj\", units: mm, up: z)";
    bench.write("mesh.vpl", &SOLIDS.replace("objects crate, spire", objects));
    bench.done(&["mesh.vpl", "--out", "out"]);
    let rows = bench.rows("out");
    assert!(rows.iter().all(|r| r["object"] == "part"));
    bench.write("part.obj", &mesh(1.1));
    bench.refused(&["mesh.vpl", "--out", "out"], 1, "meshes have changed");
    bench.write("part.obj", &mesh(0.001));
    bench.refused(&["mesh.vpl", "--out", "small"], 1, "in other units?");
}

#[test]
fn the_suites_of_the_examples_can_be_run() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    for folder in ["examples/studies", "examples/campaign"] {
        for entry in fs::read_dir(here.join(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|e| e == "vpl") {
                let mut command = Command::new(env!("CARGO_BIN_EXE_vpl"));
                let out = command.arg("study").arg(&path).arg("--dry-run").output().unwrap();
                assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
            }
        }
    }
}
