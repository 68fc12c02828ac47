//! The artefact as a whole: version, sources, reading and writing.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::{Library, Scene, Task};

/// The version of the rule-set format that this build writes and reads.
pub const FORMAT: u32 = 1;

/// A compiled VPL program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RuleSet {
    /// Version of this format.
    pub format: u32,
    /// The language edition of the source (`vpl 1`).
    pub language: u32,
    /// The files it was compiled from; [`Place::file`] indexes this list.
    pub sources: Vec<Source>,
    /// Libraries in the order of the file.
    pub libraries: Vec<Library>,
    /// Tasks in the order of the file.
    pub tasks: Vec<Task>,
    /// What the simulator shows. A planning session has no access to it.
    pub scenes: Vec<Scene>,
}

/// A source file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// The file's name for the main file, its module path for others (`std/views.vpl`).
    pub path: String,
    /// SHA-256 of its bytes, in hexadecimal.
    pub sha256: String,
}

/// A span of a source file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// Index into [`RuleSet::sources`].
    pub file: u32,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
    /// Line of the first byte, from 1.
    pub line: u32,
    /// Column of the first byte in characters, from 1.
    pub column: u32,
}

/// Why a rule set could not be read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// It was written by a newer compiler.
    #[error("the rule set has format {found}, and this program reads up to {FORMAT}; compile it again or update vpl")]
    Newer {
        /// The version found.
        found: u64,
    },
    /// It is not a rule set.
    #[error("this is not a rule set: {0}")]
    Malformed(#[from] serde_json::Error),
    /// Its parts do not fit each other.
    #[error("the rule set is inconsistent: {0}")]
    Inconsistent(String),
}

impl RuleSet {
    /// The artefact as JSON: the same bytes for the same program.
    pub fn to_json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self)
            .unwrap_or_else(|error| unreachable!("a rule set is plain data: {error}"));
        text.push('\n');
        text
    }

    /// Reads an artefact.
    ///
    /// # Errors
    /// Malformed JSON, a newer format, or indices that point nowhere.
    pub fn from_json(text: &str) -> Result<Self, ReadError> {
        let value: serde_json::Value = serde_json::from_str(text)?;
        if let Some(found) = value.get("format").and_then(serde_json::Value::as_u64)
            && found > u64::from(FORMAT)
        {
            return Err(ReadError::Newer { found });
        }
        let rules: Self = serde_json::from_value(value)?;
        rules.validate()?;
        Ok(rules)
    }

    /// SHA-256 of [`RuleSet::to_json`], in hexadecimal.
    pub fn digest(&self) -> String {
        hex(&Sha256::digest(self.to_json().as_bytes()))
    }

    /// The library of a task.
    pub fn library(&self, task: &Task) -> Option<&Library> {
        self.libraries.iter().find(|l| l.name == task.library)
    }

    fn validate(&self) -> Result<(), ReadError> {
        for library in &self.libraries {
            library.validate().map_err(ReadError::Inconsistent)?;
        }
        match self.tasks.iter().find(|t| self.library(t).is_none()) {
            None => Ok(()),
            Some(t) => Err(ReadError::Inconsistent(format!(
                "task `{}` names library `{}`, which is not here",
                t.name, t.library
            ))),
        }
    }
}

/// Lower-case hexadecimal.
pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|b| format!("{b:02x}")).collect()
}
