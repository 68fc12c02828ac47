//! Runs of the binary and what they leave.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;

pub const SOLIDS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/solids/solids.vpl");
pub const TANKS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/tanks/tanks.vpl");

/// An empty folder of a test's own.
pub fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("plan").join(test);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// `vpl` in a folder.
pub fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_vpl"));
    command.args(arguments).current_dir(folder).env("RUST_BACKTRACE", "1");
    command
}

/// How a run of the binary went.
pub struct Ran {
    pub status: Option<i32>,
    pub out: String,
    pub err: String,
}

impl From<Output> for Ran {
    fn from(output: Output) -> Self {
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let err = text(&output.stderr);
        assert!(!err.contains("panicked"), "{err}");
        Self {
            status: output.status.code(),
            out: text(&output.stdout),
            err,
        }
    }
}

impl Ran {
    /// Holds the run to an exit status and to words on standard error.
    #[track_caller]
    pub fn expect(&self, status: i32, words: &[&str]) -> &Self {
        let said = self.err.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(self.status, Some(status), "{said}");
        for word in words {
            assert!(said.contains(word), "no `{word}` in: {said}");
        }
        self
    }
}

pub fn plan(folder: &Path, arguments: &[&str]) -> Ran {
    let all: Vec<&str> = ["plan"].into_iter().chain(arguments.iter().copied()).collect();
    command(folder, &all).output().unwrap().into()
}

/// As [`plan`], with text on standard input.
pub fn plan_of(text: &str, folder: &Path, arguments: &[&str]) -> Ran {
    let all: Vec<&str> = ["plan", "-"].into_iter().chain(arguments.iter().copied()).collect();
    let mut command = command(folder, &all);
    let pipes = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let mut child = pipes.spawn().unwrap();
    child.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
    child.wait_with_output().unwrap().into()
}

/// The records of a log: every line parses.
#[track_caller]
pub fn records(log: &Path) -> Vec<Value> {
    records_in(&fs::read_to_string(log).unwrap())
}

#[track_caller]
pub fn records_in(text: &str) -> Vec<Value> {
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// A log without its times.
#[track_caller]
pub fn timeless(log: &Path) -> String {
    let text = fs::read_to_string(log).unwrap();
    let less = |line: &str| {
        let end = line.find(",\"ms\":").unwrap_or(line.len());
        line[..end].to_owned() + "\n"
    };
    text.lines().map(less).collect()
}

/// The view records.
pub fn views(records: &[Value]) -> impl Iterator<Item = &Value> {
    records.iter().filter(|r| r["event"] == "view")
}

/// A record's keys, as they stand in it or in order where the parser sorts them.
pub fn keys(record: &Value) -> Vec<&str> {
    record.as_object().unwrap().keys().map(String::as_str).collect()
}
