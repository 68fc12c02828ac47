//! Files for the language: the file system and standard input.

use std::fs::{self, File};
use std::io::{self, IsTerminal, Read, Write};
use std::path::Path;

use super::Failure;
use crate::lang::{Format, MOST_BYTES, ReadFailure, World};

/// The path that means standard input.
pub(crate) const STDIN: &str = "-";

/// The file system; the path `-` is standard input.
pub struct Disk;

impl World for Disk {
    fn read(&self, path: &str) -> Result<Vec<u8>, ReadFailure> {
        let read = if path == STDIN {
            at_most(io::stdin().lock())
        } else {
            File::open(path).and_then(at_most)
        };
        match read {
            Ok(bytes) if bytes.len() > MOST_BYTES => Err(ReadFailure::TooLarge),
            Ok(bytes) => Ok(bytes),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Err(ReadFailure::Missing),
            Err(error) => Err(ReadFailure::Failed(reason(&error))),
        }
    }
}

/// Reads one byte more than is allowed, and no further.
fn at_most(from: impl Read) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    from.take(MOST_BYTES as u64 + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::IsADirectory => "it is a folder".into(),
        io::ErrorKind::PermissionDenied => "permission denied".into(),
        _ => error.to_string(),
    }
}

/// Gives a file another text: all of it or, where that fails, none of it. The file
/// keeps its permissions, and a link keeps pointing to it.
///
/// # Errors
/// The file is no plain file, may not be written, or its folder has no room.
pub(crate) fn replace(path: &str, text: &str) -> Result<(), Failure> {
    let failed = |error| Failure::Write(format!("`{path}`"), error);
    beside(Path::new(path), text).map_err(failed)
}

/// Writes a new file beside the old one, and puts it in its place.
fn beside(path: &Path, text: &str) -> io::Result<()> {
    let path = path.canonicalize()?;
    let held = fs::metadata(&path)?;
    if !held.is_file() {
        return Err(io::Error::other("it is no plain file"));
    }
    if held.permissions().readonly() {
        return Err(io::ErrorKind::PermissionDenied.into());
    }
    let folder = path.parent().unwrap_or(Path::new("."));
    let mut new = tempfile::Builder::new().prefix(".vpl-").tempfile_in(folder)?;
    new.write_all(text.as_bytes())?;
    new.as_file().set_permissions(held.permissions())?;
    new.as_file().sync_all()?;
    new.persist(&path)?;
    Ok(())
}

/// Whether to colour what goes to a stream: on a terminal, where none is not asked for.
pub(crate) fn coloured(stream: &impl IsTerminal) -> bool {
    stream.is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty())
}

/// The form for people on standard error: drawn, as wide as the terminal.
pub(crate) fn human() -> Format {
    let width = terminal_size::terminal_size_of(io::stderr()).map_or(100, |(width, _)| usize::from(width.0));
    Format::Human {
        colour: coloured(&io::stderr()),
        width,
    }
}
