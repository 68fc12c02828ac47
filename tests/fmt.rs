//! `vpl fmt`: the command's contract.

use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

const LOOSE: &str = "vpl 1\nlet a=f( 1mm )\n";
const LAID_OUT: &str = "vpl 1\n\nlet a = f(1 mm)\n";

fn run(arguments: &[&str], input: &[u8]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_vpl"))
        .arg("fmt")
        .args(arguments)
        .env("NO_COLOR", "1")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let _ = child.stdin.take().unwrap().write_all(input);
    child.wait_with_output().unwrap()
}

fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// An empty folder of a test's own.
fn folder(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("fmt").join(name);
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    path
}

fn names(folder: &PathBuf) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn examples_and_the_standard_library_pass_the_check() {
    let mut files = Vec::new();
    for folder in ["examples/solids", "examples/tanks", "stdlib/std"] {
        let entries = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path());
        files.extend(entries.filter(|p| p.extension().is_some_and(|e| e == "vpl")));
    }
    let mut arguments = vec!["--check"];
    arguments.extend(files.iter().map(|p| p.to_str().unwrap()));
    assert!(arguments.len() > 7);
    let output = run(&arguments, b"");
    assert_eq!((out(&output).as_str(), said(&output).as_str()), ("", ""));
    assert_eq!(output.status.code(), Some(0));
}

#[test]
fn files_are_laid_out_in_place_and_only_once() {
    let folder = folder("in_place");
    let file = folder.join("a.vpl");
    std::fs::write(&file, LOOSE).unwrap();
    let path = file.to_str().unwrap();
    for _ in 0..2 {
        let output = run(&[path], b"");
        assert_eq!(output.status.code(), Some(0), "{}", said(&output));
        assert!(output.stdout.is_empty() && output.stderr.is_empty());
        assert_eq!(std::fs::read_to_string(&file).unwrap(), LAID_OUT);
    }
    assert_eq!(names(&folder), ["a.vpl"]);
}

#[test]
fn standard_input_goes_to_standard_output() {
    let output = run(&["-"], LOOSE.as_bytes());
    assert_eq!((out(&output).as_str(), output.status.code()), (LAID_OUT, Some(0)));
    let output = run(&["-"], LAID_OUT.as_bytes());
    assert_eq!(out(&output), LAID_OUT);
}

#[test]
fn the_check_shows_a_diff_and_changes_nothing() {
    let folder = folder("check");
    let (loose, good) = (folder.join("loose.vpl"), folder.join("good.vpl"));
    std::fs::write(&loose, LOOSE).unwrap();
    std::fs::write(&good, LAID_OUT).unwrap();
    let output = run(&["--check", loose.to_str().unwrap(), good.to_str().unwrap()], b"");
    assert_eq!(output.status.code(), Some(1));
    let expected = "--- F\n+++ F\n@@ -1,2 +1,3 @@\n vpl 1\n-let a=f( 1mm )\n+\n+let a = f(1 mm)\n";
    assert_eq!(out(&output).replace(loose.to_str().unwrap(), "F"), expected);
    assert_eq!(std::fs::read_to_string(&loose).unwrap(), LOOSE);
    assert_eq!(run(&["--check", good.to_str().unwrap()], b"").status.code(), Some(0));
}

#[test]
fn what_cannot_be_read_is_named_and_stays() {
    let output = run(&["-"], b"vpl 1\ntask t {\nlimit   20 views\n  lmit   20 views\n}\n");
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(
        out(&output),
        "vpl 1\n\ntask t {\n  limit 20 views\n  lmit   20 views\n}\n"
    );
    let note = "-:4: note: a part that cannot be read stays as it is; `vpl check` says why\n";
    assert_eq!(said(&output), note);
}

#[test]
fn one_file_that_cannot_be_read_does_not_hinder_the_others() {
    let folder = folder("others");
    let (bytes, file) = (folder.join("bytes.vpl"), folder.join("a.vpl"));
    std::fs::write(&bytes, b"vpl 1\nlet  a = \xff\n").unwrap();
    std::fs::write(&file, LOOSE).unwrap();
    let missing = folder.join("missing.vpl");
    let paths = [&bytes, &missing, &file].map(|p| p.to_str().unwrap());
    let output = run(&paths, b"");
    assert_eq!(output.status.code(), Some(1));
    assert!(
        said(&output).contains("E0107") && said(&output).contains("E0105"),
        "{}",
        said(&output)
    );
    assert_eq!(std::fs::read_to_string(&file).unwrap(), LAID_OUT);
    assert_eq!(std::fs::read(&bytes).unwrap(), b"vpl 1\nlet  a = \xff\n");
    assert_eq!(names(&folder), ["a.vpl", "bytes.vpl"]);
}

#[test]
fn a_file_that_cannot_be_written_is_whole_afterwards() {
    let folder = folder("unwritable");
    let locked = folder.join("locked.vpl");
    std::fs::write(&locked, LOOSE).unwrap();
    let mut permissions = std::fs::metadata(&locked).unwrap().permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(&locked, permissions).unwrap();
    let output = run(&[locked.to_str().unwrap(), folder.to_str().unwrap()], b"");
    assert_eq!(output.status.code(), Some(1));
    let said = said(&output);
    assert!(
        said.contains("error[E0601]") && said.contains("it is a folder"),
        "{said}"
    );
    assert_eq!(std::fs::read_to_string(&locked).unwrap(), LOOSE);
    assert_eq!(names(&folder), ["locked.vpl"]);
}

#[cfg(unix)]
#[test]
fn links_and_permissions_stay() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = folder("links");
    let (file, link) = (folder.join("a.vpl"), folder.join("link.vpl"));
    std::fs::write(&file, LOOSE).unwrap();
    std::fs::set_permissions(&file, std::fs::Permissions::from_mode(0o640)).unwrap();
    symlink("a.vpl", &link).unwrap();
    assert_eq!(run(&[link.to_str().unwrap()], b"").status.code(), Some(0));
    assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(std::fs::read_to_string(&file).unwrap(), LAID_OUT);
    assert_eq!(std::fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o640);
}

#[test]
fn usage() {
    assert_eq!(run(&[], b"").status.code(), Some(2));
    let help = run(&["--help"], b"");
    assert_eq!(help.status.code(), Some(0));
    assert!(out(&help).contains("vpl fmt --check"));
}
