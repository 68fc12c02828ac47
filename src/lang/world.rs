//! Where files come from. The language reads through this trait and does no I/O.

use std::collections::BTreeMap;

/// Largest source file, bytes.
pub const MOST_BYTES: usize = 8 << 20;

/// A source of files.
pub trait World {
    /// The bytes of a file. `path` is relative to the same place as the path given
    /// to [`super::compile`], its folders separated by `/`.
    ///
    /// # Errors
    /// No such file, a file over [`MOST_BYTES`] (which need not be read to its
    /// end), or one that cannot be read.
    fn read(&self, path: &str) -> Result<Vec<u8>, ReadFailure>;
}

/// Why a file could not be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ReadFailure {
    /// There is none.
    Missing,
    /// It is larger than [`MOST_BYTES`].
    TooLarge,
    /// Something else, said in a few words.
    Failed(String),
}

/// Files in memory, by path.
#[derive(Clone, Debug, Default)]
pub struct Memory(pub BTreeMap<String, Vec<u8>>);

impl Memory {
    /// A world of one file.
    pub fn of(path: &str, text: &str) -> Self {
        Self([(path.to_owned(), text.as_bytes().to_vec())].into())
    }
}

impl World for Memory {
    fn read(&self, path: &str) -> Result<Vec<u8>, ReadFailure> {
        match self.0.get(path) {
            None => Err(ReadFailure::Missing),
            Some(bytes) if bytes.len() > MOST_BYTES => Err(ReadFailure::TooLarge),
            Some(bytes) => Ok(bytes.clone()),
        }
    }
}

/// A path without `.` and without `..` behind a folder: two spellings of one file are
/// then the same.
pub fn normal(path: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for (k, part) in path.split('/').enumerate() {
        match part {
            "" if k > 0 => {}
            "." => {}
            ".." if parts.last().is_some_and(|p| !p.is_empty() && *p != "..") => drop(parts.pop()),
            _ => parts.push(part),
        }
    }
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::normal;

    #[test]
    fn paths_are_compared_without_detours() {
        assert_eq!(normal("a/./b/../c.vpl"), "a/c.vpl");
        assert_eq!(normal("../../x.vpl"), "../../x.vpl");
        assert_eq!(normal("a/../../x.vpl"), "../x.vpl");
        assert_eq!(normal("/a//b/../x.vpl"), "/a/x.vpl");
        assert_eq!(normal("/../x.vpl"), "/../x.vpl");
    }
}
