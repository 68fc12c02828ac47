//! `vpl fmt`: programs laid out in their one form. A file is replaced as a whole or
//! not at all.

use std::io;
use std::time::Duration;

use clap::Args;
use similar::TextDiff;

use super::files::{Disk, STDIN, human, replace};
use super::{Failure, Outcome, print, report};
use crate::lang::{self, Formatted, SourceFile, SourceMap, render};

/// Lay out programs: spaces, columns, line breaks. Comments and meaning stay.
#[derive(Args)]
#[command(after_help = "Examples:
  vpl fmt task.vpl            lay out a file in place
  vpl fmt --check *.vpl       show what would change, and fail where something would
  vpl fmt - < task.vpl        from standard input to standard output")]
pub(crate) struct Fmt {
    /// The programs; `-` is standard input, written to standard output.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<String>,
    /// Change nothing; print what would change, and fail where something would.
    #[arg(long)]
    check: bool,
}

pub(crate) fn run(options: &Fmt) -> Result<Outcome, Failure> {
    let mut outcome = Outcome::Done;
    for path in &options.files {
        match one(path, options.check) {
            Ok(true) => {}
            Ok(false) => outcome = Outcome::WrongInput,
            // Whoever reads the result reads no more of it.
            Err(Failure::Write(place, error)) if error.kind() == io::ErrorKind::BrokenPipe => {
                return Err(Failure::Write(place, error));
            }
            Err(failure) => {
                report(&format!("{failure}\n"))?;
                outcome = Outcome::WrongInput;
            }
        }
    }
    Ok(outcome)
}

/// Lays out one file; whether all is well with it.
fn one(path: &str, check: bool) -> Result<bool, Failure> {
    let mut sources = SourceMap::default();
    let read = lang::read(path, &Disk, &mut sources);
    let file = match &read {
        Ok(id) => sources.get(*id),
        Err(found) => {
            report(&render(std::slice::from_ref(found), &sources, human()))?;
            None
        }
    };
    let Some(file) = file else {
        return Ok(false);
    };
    let formatted = lang::format(&file.text);
    if formatted.refused {
        return Err(Failure::Layout(format!("`{path}`")));
    }
    report(&note(file, &formatted))?;
    let changed = formatted.text != file.text;
    if check {
        print(&diff(path, &file.text, &formatted.text))?;
        return Ok(!changed);
    }
    match path {
        STDIN => print(&formatted.text)?,
        _ if changed => replace(path, &formatted.text)?,
        _ => {}
    }
    Ok(true)
}

/// What is said about parts that stay as they are.
fn note(file: &SourceFile, formatted: &Formatted) -> String {
    let Some(first) = formatted.untouched.first().filter(|span| span.end > span.start) else {
        return String::new();
    };
    let (line, _) = file.line_column(first.start);
    let parts = match formatted.untouched.len() {
        1 => "a part that cannot be read stays as it is".to_owned(),
        n => format!("{n} parts that cannot be read stay as they are"),
    };
    format!("{}:{line}: note: {parts}; `vpl check` says why\n", file.display)
}

/// A diff as `patch` takes it; empty where nothing changes.
fn diff(path: &str, old: &str, new: &str) -> String {
    // Only texts that are made to be slow are ever cut short, and their diff stays right.
    let diff = TextDiff::configure()
        .timeout(Duration::from_secs(5))
        .diff_lines(old, new);
    diff.unified_diff().header(path, path).to_string()
}
