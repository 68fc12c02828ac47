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
