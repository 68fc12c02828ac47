//! `vpl check`: every diagnostic with its source, and the command's contract.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use vpl::lang::{self, Format, MOST_BYTES, ReadFailure, Severity, World, render};

/// The files under `tests/ui`, by paths relative to it.
struct Cases;

impl World for Cases {
    fn read(&self, path: &str) -> Result<Vec<u8>, ReadFailure> {
        std::fs::read(Path::new("tests/ui").join(path)).map_err(|_| ReadFailure::Missing)
    }
}

fn cases() -> Vec<PathBuf> {
    let entries = std::fs::read_dir("tests/ui").unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == "vpl"));
    paths.sort();
    paths
}

/// Each file under `tests/ui` begins with the code that it is about, and its
/// snapshot holds the source and everything that is said about it.
#[test]
fn every_diagnostic_reads_as_it_should() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("ui");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    for path in cases() {
        let name = path.file_name().unwrap().to_str().unwrap();
        let compiled = lang::compile(name, &Cases);
        let code = &name[..5];
        assert!(
            compiled.diagnostics.iter().any(|d| d.code.to_string() == code),
            "{name} does not give {code}"
        );
        assert_eq!(compiled.rules.is_some(), !compiled.has_errors(), "{name}");
        let source = std::fs::read_to_string(&path).unwrap();
        let said = render(&compiled.diagnostics, &compiled.sources, Format::Plain);
        settings.bind(|| insta::assert_snapshot!(name.trim_end_matches(".vpl"), format!("{source}\n----\n{said}")));
    }
}

#[test]
fn every_code_has_a_case_or_comes_from_outside() {
    let snapshots = ["tests/ui", "tests/diagnostics/snapshots"].map(|folder| std::fs::read_dir(folder).unwrap());
    let names = snapshots
        .into_iter()
        .flatten()
        .map(|e| e.unwrap().file_name().into_string().unwrap());
    let names: Vec<String> = names.filter(|name| name.ends_with(".snap")).collect();
    for code in lang::Code::ALL {
        // The formatter's last resort has no input that leads to it.
        let held = *code == lang::Code::E0604
            || names
                .iter()
                .any(|n| n.starts_with(code.as_str()) || n.contains(&format!("outside__{code}")));
        assert!(held, "{code} has no snapshot of a source and its message");
    }
}

fn vpl(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_vpl"));
    command.args(arguments).env("NO_COLOR", "1");
    command
}

fn run(arguments: &[&str], input: &[u8]) -> Output {
    let mut child = vpl(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A program that stops reading early closes the pipe.
    let _ = child.stdin.take().unwrap().write_all(input);
    child.wait_with_output().unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

#[test]
fn examples_and_the_standard_library_are_right() {
    let mut files = vec![
        "examples/solids/solids.vpl".to_owned(),
        "examples/tanks/tanks.vpl".to_owned(),
    ];
    for module in ["cameras", "detect", "markers", "solids", "views"] {
        files.push(format!("stdlib/std/{module}.vpl"));
    }
    let mut arguments = vec!["check", "--deny", "warnings"];
    arguments.extend(files.iter().map(String::as_str));
    let output = run(&arguments, b"");
    let said = said(&output);
    // Notes say what the tanks cost; nothing else is said.
    assert!(said.ends_with("no errors in 7 files\n"), "{said}");
    assert!(!said.contains("W04") && said.contains("N0401"), "{said}");
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stdout.is_empty());
}

#[test]
fn exit_codes_and_streams() {
    let wrong = run(&["check", "--format", "short", "-"], b"vpl 1\nlet a = b\n");
    assert_eq!(wrong.status.code(), Some(1));
    assert!(wrong.stdout.is_empty());
    assert!(
        said(&wrong).starts_with("-:2:9: error[E0201]: there is no `b` here"),
        "{}",
        said(&wrong)
    );
    let usage = run(&["check"], b"");
    assert_eq!(usage.status.code(), Some(2));
    let help = run(&["check", "--help"], b"");
    assert_eq!(help.status.code(), Some(0));
    assert!(String::from_utf8_lossy(&help.stdout).contains("Examples:"));
    let missing = run(&["check", "--format", "short", "nowhere.vpl"], b"");
    assert_eq!(missing.status.code(), Some(1));
    assert!(said(&missing).contains("error[E0105]: there is no file `nowhere.vpl`"));
}

#[test]
fn warnings_fail_only_where_they_are_denied() {
    let file = "tests/ui/W0402_useless_features.vpl";
    assert_eq!(run(&["check", file], b"").status.code(), Some(0));
    assert_eq!(run(&["check", "--deny", "warnings", file], b"").status.code(), Some(1));
}

#[test]
fn json_is_one_array_over_all_files() {
    let files = ["tests/ui/E0201_unknown_name.vpl", "tests/ui/E0202_declared_twice.vpl"];
    let output = run(&["check", "--format", "json", files[0], files[1]], b"");
    assert_eq!(output.status.code(), Some(1));
    assert!(output.stderr.is_empty());
    let all: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let all = all.as_array().unwrap();
    let first = &all[0];
    for key in ["code", "severity", "message", "help", "file", "start", "end", "related"] {
        assert!(first.get(key).is_some(), "no `{key}`");
    }
    assert_eq!((&first["code"], &first["file"]), (&"E0201".into(), &files[0].into()));
    let offset = std::fs::read_to_string(files[0]).unwrap().find("reach").unwrap();
    assert_eq!(
        first["start"],
        serde_json::json!({ "line": 28, "column": 24, "offset": offset })
    );
    let related = all
        .iter()
        .find(|d| !d["related"].as_array().unwrap().is_empty())
        .unwrap();
    assert_eq!(related["file"], files[1]);
    assert_eq!(related["related"][0]["file"], files[1]);
}

#[test]
fn what_is_no_program_is_refused_in_bounded_time() {
    let refused = |input: &[u8], code: &str, what: &str| {
        let output = run(&["check", "--format", "short", "-"], input);
        let said = said(&output);
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(said.contains(code) && said.contains(what), "{said}");
        assert!(said.lines().count() < 60, "too much is said");
    };
    refused(&vec![b'a'; 6 * MOST_BYTES], "E0106", "larger than 8 MB");
    refused("(".repeat(10_000).as_bytes(), "E0108", "nested more than 128 deep");
    refused(b"vpl 1\nlet a = \xff\xfe\n", "E0107", "offset 14");
    refused(b"vpl 1\nlet a\0 = 1\n", "E0107", "NUL");
    refused(b"", "E0104", "empty");
    refused(b"\xef\xbb\xbf \r\n", "E0104", "empty");
    let sum = format!("vpl 1\nlet a = {}1 mm\n", "1 mm + ".repeat(20_000));
    refused(sum.as_bytes(), "E0108", "operators in a row");
    let many = format!("vpl 1\n{}", "nonsense!\n".repeat(2_000));
    refused(many.as_bytes(), "E0101", "nonsense");
    let unclosed = format!("vpl 1\n{}", "let a = f(\n".repeat(5_000));
    refused(unclosed.as_bytes(), "E0", "");
}

#[test]
fn marks_and_line_ends_of_other_systems_are_read() {
    let output = run(&["check", "-"], b"\xef\xbb\xbfvpl 1\r\n\r\nlet a = 1 mm\r\n");
    assert_eq!(said(&output), "no errors in 1 file\n");
}

#[test]
fn only_the_first_diagnostics_are_shown_to_people() {
    let text: String = (0..80).map(|k| format!("let a{k} = b{k}\n")).collect();
    let compiled = lang::compile("m", &lang::Memory::of("m", &format!("vpl 1\n{text}")));
    assert_eq!(compiled.diagnostics.len(), 80);
    assert!(compiled.diagnostics.iter().all(|d| d.severity == Severity::Error));
    let short = render(&compiled.diagnostics, &compiled.sources, Format::Short);
    assert_eq!(short.lines().count(), 51);
    assert!(short.ends_with("… and 30 more (30 of them errors)\n"), "{short}");
    let human = Format::Human {
        colour: false,
        width: 80,
    };
    assert!(!render(&compiled.diagnostics, &compiled.sources, human).contains('\u{1b}'));
}
