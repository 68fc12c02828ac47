//! `vpl new` and `vpl completions`.

use std::fs;
use std::process::Command;

use super::support::*;

#[test]
fn a_new_task_checks_without_warnings_and_reaches_its_goal() {
    let folder = folder("new").join("boxes and more");
    let ran = vpl(&["new", folder.to_str().unwrap()]);
    assert_eq!(ran.status.code(), Some(0), "{}", err(&ran));
    let file = folder.join("recognise.vpl");
    let file = file.to_str().unwrap();
    let check = vpl(&["check", "--deny", "warnings", file]);
    assert_eq!(check.status.code(), Some(0), "{}", err(&check));
    let plan = vpl(&["plan", file]);
    assert_eq!(plan.status.code(), Some(0), "{}{}", out(&plan), err(&plan));
    assert!(out(&plan).contains("bolts is of class bolts"), "{}", out(&plan));
}

#[test]
fn a_new_reconstruction_checks_without_warnings_and_can_be_run() {
    let folder = folder("new-reconstruction");
    let ran = vpl(&["new", folder.to_str().unwrap(), "--kind", "reconstruction"]);
    assert_eq!(ran.status.code(), Some(0), "{}", err(&ran));
    let file = folder.join("reconstruct.vpl");
    let file = file.to_str().unwrap();
    let check = vpl(&["check", "--deny", "warnings", file]);
    assert_eq!(check.status.code(), Some(0), "{}", err(&check));
    let plan = vpl(&["plan", file, "--dry-run"]);
    assert_eq!(plan.status.code(), Some(0), "{}", err(&plan));
}

/// The commands that are printed are commands, their words quoted for a shell.
#[cfg(unix)]
#[test]
fn the_next_commands_can_be_pasted() {
    let folder = folder("new-next").join("it's here");
    let ran = vpl(&["new", folder.to_str().unwrap()]);
    let commands: Vec<&str> = out(&ran)
        .lines()
        .filter_map(|line| line.strip_prefix("  vpl "))
        .collect();
    assert_eq!(commands.len(), 3, "{}", out(&ran));
    let line = format!("{} {}", env!("CARGO_BIN_EXE_vpl"), commands[0]);
    let check = Command::new("sh").args(["-c", &line]).output().unwrap();
    assert_eq!(check.status.code(), Some(0), "{line}: {}", err(&check));
}

#[test]
fn a_folder_with_something_in_it_is_left_alone() {
    let folder = folder("new-taken");
    fs::write(folder.join("mine.txt"), "mine").unwrap();
    let ran = vpl(&["new", folder.to_str().unwrap()]);
    assert_eq!(ran.status.code(), Some(2));
    assert!(err(&ran).contains("is not empty"), "{}", err(&ran));
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
    let file = folder.join("mine.txt");
    let ran = vpl(&["new", file.to_str().unwrap()]);
    assert_eq!(ran.status.code(), Some(1));
    assert!(err(&ran).contains("error[E0601]"), "{}", err(&ran));
}

#[test]
fn every_shell_is_told_every_verb() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let ran = vpl(&["completions", shell]);
        assert_eq!(ran.status.code(), Some(0));
        for verb in ["check", "explain", "new", "completions"] {
            assert!(out(&ran).contains(verb), "{shell}: {verb}");
        }
    }
    assert_eq!(vpl(&["completions", "cmd"]).status.code(), Some(2));
}

#[test]
fn the_help_of_each_verb_has_an_example() {
    for verb in ["check", "explain", "new", "completions"] {
        let ran = vpl(&[verb, "--help"]);
        assert!(out(&ran).contains(&format!("Examples:\n  vpl {verb}")), "{}", out(&ran));
    }
}
