//! The artefact as a whole: version, sources, reading and writing.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::{Library, Scene, Task};

/// The version of the rule-set format that this build writes and reads.
pub const FORMAT: u32 = 1;

/// The newest language edition whose rule sets this build reads.
pub const LANGUAGE: u32 = 1;

/// A compiled VPL program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
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
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// The file's name for the main file, its module path for others (`std/views.vpl`).
    pub path: String,
    /// SHA-256 of its bytes, in hexadecimal.
    pub sha256: String,
}

/// A span of a source file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
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
    /// It was written by a compiler of another format.
    #[error(
        "the rule set has format {found}, and this vpl reads format {FORMAT}: compile the program again, or update vpl"
    )]
    Format {
        /// The version found.
        found: u64,
    },
    /// Its program is of a newer edition of the language.
    #[error("the rule set is of VPL edition {found}, which this vpl does not know: update vpl")]
    Language {
        /// The edition found.
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
        // The versions first: what a newer one holds must not be called malformed.
        let version = |key: &str| value.get(key).and_then(serde_json::Value::as_u64);
        if let Some(found) = version("format").filter(|found| *found != u64::from(FORMAT)) {
            return Err(ReadError::Format { found });
        }
        if let Some(found) = version("language").filter(|found| *found > u64::from(LANGUAGE)) {
            return Err(ReadError::Language { found });
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

#[cfg(test)]
mod tests {
    use super::*;

    fn of(head: &str) -> Result<RuleSet, ReadError> {
        RuleSet::from_json(&format!(
            "{{{head}, \"sources\": [], \"libraries\": [], \"tasks\": [], \"scenes\": []}}"
        ))
    }

    #[test]
    fn other_formats_and_newer_editions_are_refused_by_name() {
        assert!(of(r#""format": 1, "language": 1"#).is_ok());
        let said = |head: &str| of(head).unwrap_err().to_string();
        assert!(
            said(r#""format": 2, "language": 1, "news": {}"#).contains("has format 2, and this vpl reads format 1")
        );
        assert!(said(r#""format": 0, "language": 1"#).contains("has format 0"));
        assert!(said(r#""format": 1, "language": 2, "news": {}"#).contains("VPL edition 2"));
        assert!(said(r#""format": 1.5, "language": 1"#).starts_with("this is not a rule set"));
        assert!(said(r#""format": 1"#).starts_with("this is not a rule set"));
    }
}
