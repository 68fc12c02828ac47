//! Source files, spans, and where a byte stands in lines and columns.

use sha2::{Digest, Sha256};

use crate::rules::{Place, Source};

/// Index of a file in a [`SourceMap`]. The main file is 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FileId(pub u32);

/// A range of bytes of a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Span {
    /// The file.
    pub file: FileId,
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

impl Span {
    /// Bytes `start..end` of a file.
    pub fn new(file: FileId, start: usize, end: usize) -> Self {
        Self { file, start, end }
    }

    /// From the beginning of this span to the end of another of the same file.
    pub fn to(self, last: Self) -> Self {
        Self {
            end: last.end.max(self.end),
            ..self
        }
    }

    /// The empty span where this one ends.
    pub fn after(self) -> Self {
        Self {
            start: self.end,
            ..self
        }
    }
}

impl From<Place> for Span {
    fn from(place: Place) -> Self {
        Self::new(FileId(place.file), place.start as usize, place.end as usize)
    }
}

/// A file that was read.
#[derive(Clone, Debug)]
pub struct SourceFile {
    /// Its name in diagnostics: the path as the user wrote it.
    pub display: String,
    /// Its name in the artefact: independent of the working directory.
    pub path: String,
    /// Its text, up to where it is no longer UTF-8.
    pub text: String,
    sha256: String,
    shipped: bool,
    line_starts: Vec<usize>,
}

impl SourceFile {
    /// A file of a text.
    pub fn new(display: String, path: String, text: String) -> Self {
        let line_starts = std::iter::once(0)
            .chain(
                text.bytes()
                    .enumerate()
                    .filter(|(_, b)| *b == b'\n')
                    .map(|(k, _)| k + 1),
            )
            .collect();
        let sha256 = crate::rules::hex(&Sha256::digest(text.as_bytes()));
        Self {
            display,
            path,
            text,
            sha256,
            shipped: false,
            line_starts,
        }
    }

    /// Line and column in characters of a byte, both from 1.
    pub fn line_column(&self, offset: usize) -> (usize, usize) {
        let line = self.line_starts.partition_point(|&start| start <= offset).max(1);
        let start = self.line_starts[line - 1];
        let column = self.text.get(start..offset).map_or(0, |before| before.chars().count());
        (line, column + 1)
    }

    /// The text of a line, from 1, without its end.
    pub fn line(&self, line: usize) -> &str {
        let rest = &self.text[self.line_start(line)..];
        rest.split(['\n', '\r']).next().unwrap_or(rest)
    }

    /// The first byte of a line, from 1; the text's end where it has fewer lines.
    pub(super) fn line_start(&self, line: usize) -> usize {
        self.line_starts.get(line - 1).copied().unwrap_or(self.text.len())
    }

    /// Its digest, in hexadecimal digits.
    pub(super) fn sha256(&self) -> &str {
        &self.sha256
    }

    /// The same file, as one that is shipped inside the program.
    pub(super) fn shipped(self) -> Self {
        Self { shipped: true, ..self }
    }

    /// Whether it is shipped inside the program, and is no file of the user's.
    pub fn is_shipped(&self) -> bool {
        self.shipped
    }
}

/// Every file of a program.
#[derive(Clone, Debug, Default)]
pub struct SourceMap {
    files: Vec<SourceFile>,
}

impl SourceMap {
    /// Adds a file.
    pub fn add(&mut self, file: SourceFile) -> FileId {
        self.files.push(file);
        FileId((self.files.len() - 1) as u32)
    }

    /// Adds all files of another map; its file 0 has the id that is returned.
    pub fn append(&mut self, other: &Self) -> FileId {
        let first = FileId(self.files.len() as u32);
        self.files.extend(other.files.iter().cloned());
        first
    }

    /// The file of an id; `None` where it is of another map.
    pub fn get(&self, id: FileId) -> Option<&SourceFile> {
        self.files.get(id.0 as usize)
    }

    /// All files with their ids.
    pub fn files(&self) -> impl Iterator<Item = (FileId, &SourceFile)> {
        (0..).map(FileId).zip(&self.files)
    }

    /// The text under a span; empty where there is none.
    pub fn text(&self, span: Span) -> &str {
        self.get(span.file)
            .and_then(|f| f.text.get(span.start..span.end))
            .unwrap_or("")
    }

    /// The files as the artefact lists them.
    pub(super) fn listed(&self) -> Vec<Source> {
        self.files
            .iter()
            .map(|f| Source {
                path: f.path.clone(),
                sha256: f.sha256.clone(),
            })
            .collect()
    }

    /// A span as the artefact writes it.
    pub(super) fn place(&self, span: Span) -> Place {
        let (line, column) = self.get(span.file).map_or((1, 1), |f| f.line_column(span.start));
        Place {
            file: span.file.0,
            start: span.start as u32,
            end: span.end as u32,
            line: line as u32,
            column: column as u32,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters_and_lines_start_at_one() {
        let file = SourceFile::new("a".into(), "a".into(), "ä b\r\nc\n".into());
        assert_eq!(file.line_column(0), (1, 1));
        assert_eq!(file.line_column(3), (1, 3));
        assert_eq!(file.line_column(6), (2, 1));
        assert_eq!(file.line_column(8), (3, 1));
        assert_eq!(file.line(1), "ä b");
        assert_eq!(file.line(3), "");
    }
}
