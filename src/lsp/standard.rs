//! The standard library as files, so that an editor can open what a name leads to.
//!
//! It is part of the program and on no disk. A module that is asked for is written to
//! the user's cache, once a version, read-only and with a note on its first line; lines
//! and columns are those of the module.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::lang::vocabulary;

/// The path of a module's copy, which is made now if it is not there.
pub(super) fn copy(module: &str) -> Option<String> {
    let (_, text) = vocabulary::modules().find(|(name, _)| *name == module)?;
    let path = folder()?.join(format!("{module}.vpl"));
    let text = noted(text);
    if fs::read_to_string(&path).ok().as_ref() != Some(&text) {
        write(&path, &text).ok()?;
    }
    Some(path.to_string_lossy().replace('\\', "/"))
}

/// Whether a file is such a copy.
pub(super) fn is_copy(path: &str) -> bool {
    let folder = folder().map(|f| f.to_string_lossy().replace('\\', "/"));
    folder.is_some_and(|folder| path.starts_with(&folder))
}

fn folder() -> Option<PathBuf> {
    let given = |name: &str| std::env::var_os(name).filter(|v| !v.is_empty()).map(PathBuf::from);
    let cache = given("XDG_CACHE_HOME")
        .or_else(|| given("LOCALAPPDATA"))
        .or_else(|| Some(given("HOME")?.join(".cache")))?;
    Some(cache.join("vpl").join(env!("CARGO_PKG_VERSION")).join("std"))
}

/// With a note behind the edition, which moves no line and no name.
fn noted(text: &str) -> String {
    let (edition, rest) = text.split_once('\n').unwrap_or((text, ""));
    format!(
        "{edition}  // the standard library of vpl {}, a copy to read: changes have no effect\n{rest}",
        env!("CARGO_PKG_VERSION")
    )
}

fn write(path: &Path, text: &str) -> io::Result<()> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    if path.exists() {
        fs::remove_file(path)?;
    }
    fs::write(path, text)?;
    let mut permissions = fs::metadata(path)?.permissions();
    permissions.set_readonly(true);
    fs::set_permissions(path, permissions)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_note_moves_nothing() {
        for (name, text) in vocabulary::modules() {
            let copy = noted(text);
            let lines = || text.lines().skip(1).zip(copy.lines().skip(1));
            assert!(lines().all(|(a, b)| a == b), "{name}");
            assert_eq!(text.lines().count(), copy.lines().count(), "{name}");
        }
    }
}
