//! Files of results: in which form, whether they may be written, and written
//! whole or not at all.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use super::Failure;
use crate::map::{Map, write_bt, write_ot};

/// The form of a map file, by its ending.
#[derive(Clone, Copy)]
pub(crate) enum MapForm {
    /// States.
    Bt,
    /// Log-odds.
    Ot,
}

impl MapForm {
    /// Standard output takes states.
    pub fn of(path: &Path) -> Result<Self, Failure> {
        by_ending("--map", path, Self::Bt, &[(".bt", Self::Bt), (".ot", Self::Ot)])
    }

    pub fn write(self, map: &Map, mut to: &mut dyn Write) -> io::Result<()> {
        match self {
            Self::Bt => write_bt(map, &mut to),
            Self::Ot => write_ot(map, &mut to),
        }
    }
}

/// The form that a file's ending names. Standard output, devices and names
/// without an ending take `standard`.
///
/// # Errors
/// A usage failure that lists the endings.
pub(crate) fn by_ending<T: Copy>(option: &str, path: &Path, standard: T, endings: &[(&str, T)]) -> Result<T, Failure> {
    if is_stdout(path) || is_device(path) || path.extension().is_none() {
        return Ok(standard);
    }
    let name = path.to_string_lossy().to_lowercase();
    let found = endings.iter().find(|(ending, _)| name.ends_with(ending));
    found.map(|(_, form)| *form).ok_or_else(|| {
        let known: Vec<String> = endings.iter().map(|(ending, _)| format!("`{ending}`")).collect();
        let path = path.display();
        Failure::Usage(format!(
            "`{option} {path}` names no form that is known; end it in {}",
            known.join(" or ")
        ))
    })
}

/// Whether a path is `-`, standard output.
pub(crate) fn is_stdout(path: &Path) -> bool {
    path == Path::new("-")
}

fn is_device(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|m| !m.is_file() && !m.is_dir())
}

/// Whether a file can be written; nothing is left of the attempt.
///
/// # Errors
/// It cannot.
pub(crate) fn writable(path: &Path) -> Result<(), Failure> {
    let failed = |error| Failure::Write(quoted(path), error);
    if is_stdout(path) {
        return Ok(());
    }
    if path.exists() {
        return OpenOptions::new().append(true).open(path).map(drop).map_err(failed);
    }
    tempfile::tempfile_in(folder(path)).map(drop).map_err(failed)
}

/// Writes a file: all of it or, where that fails, none of it.
///
/// # Errors
/// The disk is full, or the file may not be written.
pub(crate) fn write(path: &Path, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Failure> {
    if is_stdout(path) {
        let mut out = BufWriter::new(io::stdout().lock());
        return content(&mut out)
            .and_then(|()| out.flush())
            .map_err(|error| Failure::Write("standard output".into(), error));
    }
    let written = match is_device(path) {
        true => into_device(path, content),
        false => beside(path, content),
    };
    written.map_err(|error| Failure::Write(quoted(path), error))
}

fn into_device(path: &Path, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut out = BufWriter::new(File::create(path)?);
    content(&mut out)?;
    out.flush()
}

/// Writes a new file beside the old one and puts it in its place; a link keeps
/// pointing to it.
fn beside(path: &Path, content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let path = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let mut new = tempfile::Builder::new();
    let mut new = new
        .prefix(".vpl-")
        .permissions(permissions(&path)?)
        .tempfile_in(folder(&path))?;
    let mut out = BufWriter::new(new.as_file_mut());
    content(&mut out)?;
    out.flush()?;
    drop(out);
    new.persist(&path)?;
    Ok(())
}

/// Those of the file that is replaced, or of a new one.
fn permissions(path: &Path) -> io::Result<fs::Permissions> {
    match fs::metadata(path) {
        Ok(old) => Ok(old.permissions()),
        Err(_) => {
            // A new file's, after the process's mask.
            let probe = tempfile::tempdir_in(folder(path))?;
            let file = File::create(probe.path().join("new"))?;
            Ok(file.metadata()?.permissions())
        }
    }
}

fn folder(path: &Path) -> &Path {
    path.parent()
        .filter(|f| !f.as_os_str().is_empty())
        .unwrap_or(Path::new("."))
}

/// Refuses a result inside the folder of a recording, or in place of its file.
///
/// # Errors
/// A usage failure that names the option and the file.
pub(crate) fn outside(option: &str, out: &Path, recording: &Path) -> Result<(), Failure> {
    let (place, recording) = (settled(out), settled(recording));
    if is_stdout(out) || !place.starts_with(&recording) {
        return Ok(());
    }
    let (out, recording) = (out.display(), recording.display());
    Err(Failure::Usage(format!(
        "`{option} {out}` would write into the recording `{recording}`; name a file elsewhere"
    )))
}

/// A path without links and `..`, whether the file exists or not.
pub(crate) fn settled(path: &Path) -> PathBuf {
    let beside = || {
        let folder = fs::canonicalize(folder(path)).ok()?;
        Some(folder.join(path.file_name()?))
    };
    fs::canonicalize(path)
        .ok()
        .or_else(beside)
        .unwrap_or_else(|| path.to_owned())
}

pub(crate) fn quoted(path: &Path) -> String {
    format!("`{}`", path.display())
}
