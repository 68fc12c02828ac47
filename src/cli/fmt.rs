//! `vpl fmt`: programs laid out in their one form. A file is replaced as a whole or
//! not at all.

use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;
use similar::TextDiff;

use super::files::{Disk, STDIN, human};
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
        _ if changed => {
            replace(Path::new(path), &formatted.text).map_err(|error| Failure::Write(format!("`{path}`"), error))?
        }
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

/// Puts a text in a file's place: written beside it in full, then renamed.
fn replace(path: &Path, text: &str) -> io::Result<()> {
    // Behind a link it is the file that is replaced.
    let target = fs::canonicalize(path)?;
    let metadata = fs::metadata(&target)?;
    if !metadata.is_file() {
        return Err(io::Error::other("it is no regular file"));
    }
    if metadata.permissions().readonly() {
        return Err(io::Error::new(io::ErrorKind::PermissionDenied, "it is read-only"));
    }
    let beside = beside(&target);
    let mut file = OpenOptions::new().write(true).create_new(true).open(&beside)?;
    let written = file
        .write_all(text.as_bytes())
        .and_then(|()| file.set_permissions(metadata.permissions()))
        .and_then(|()| file.sync_all())
        .and_then(|()| fs::rename(&beside, &target));
    if written.is_err() {
        let _ = fs::remove_file(&beside);
    }
    written
}

fn beside(target: &Path) -> PathBuf {
    let name = target.file_name().unwrap_or_default().to_string_lossy();
    target.with_file_name(format!(".{name}.{}.tmp", std::process::id()))
}
