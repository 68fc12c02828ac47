//! Files for the language: the file system and standard input.

use std::fs::File;
use std::io::{self, IsTerminal, Read};

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

/// The form for people on standard error: drawn, and coloured only on a terminal
/// that does not ask for none.
pub(crate) fn human() -> Format {
    let terminal = io::stderr().is_terminal();
    let plain = std::env::var_os("NO_COLOR").is_some_and(|v| !v.is_empty());
    Format::Human {
        colour: terminal && !plain,
        width: 100,
    }
}
