//! `vpl new`: a folder with a small, complete task to begin from.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use super::{Failure, Outcome, print};

/// Make a folder with a small task that checks and plans at once.
#[derive(Args)]
#[command(after_help = "Examples:
  vpl new boxes
  vpl new bracket --kind reconstruction")]
pub(crate) struct New {
    /// The folder; made where there is none, and empty otherwise.
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// What the task is to find out.
    #[arg(long, value_enum, default_value_t = Kind::Recognition)]
    kind: Kind,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// Which of several classes an object is of.
    Recognition,
    /// What all of an object looks like.
    Reconstruction,
}

impl Kind {
    /// The name of the program and its text.
    fn program(self) -> (&'static str, &'static str) {
        match self {
            Self::Recognition => ("recognise.vpl", include_str!("new/recognise.vpl")),
            Self::Reconstruction => ("reconstruct.vpl", include_str!("new/reconstruct.vpl")),
        }
    }
}

pub(crate) fn run(options: &New) -> Result<Outcome, Failure> {
    let (name, text) = options.kind.program();
    let folder = &options.folder;
    let failed = |error| Failure::Write(format!("`{}`", folder.display()), error);
    if !is_free(folder).map_err(failed)? {
        let message = format!("`{}` is not empty; name a new or an empty folder", folder.display());
        return Err(Failure::Usage(message));
    }
    fs::create_dir_all(folder).map_err(failed)?;
    let file = folder.join(name);
    fs::write(&file, text).map_err(failed)?;
    print(&next(&file))?;
    Ok(Outcome::Done)
}

/// Whether there is no such folder, or nothing in it.
fn is_free(folder: &Path) -> io::Result<bool> {
    match fs::read_dir(folder) {
        Ok(mut entries) => Ok(entries.next().is_none()),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(true),
        Err(error) => Err(error),
    }
}

/// What was made, and three commands to go on with.
fn next(file: &Path) -> String {
    let file = file.display().to_string();
    let word = quoted(&file);
    format!("made {file}\n\nnext:\n  vpl check {word}\n  vpl plan {word}\n  vpl plan {word} --method random\n")
}

/// A word for a shell.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "._-+/\\:".contains(c);
    match word.chars().all(plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}
