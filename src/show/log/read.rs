//! A run log read back, whole or cut off by an interruption.

use super::{End, Record, Start, View};

/// Longest line of a log, bytes: no record comes near it.
pub const MOST_LINE: usize = 16 << 20;

/// A run as its log tells it.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// What was run.
    pub start: Start,
    /// The measurements in order; the `k`-th has number k + 1.
    pub views: Vec<View>,
    /// The outcome; `None` where the log ends before it.
    pub end: Option<End>,
}

/// Why a text is no run log.
#[derive(Debug, thiserror::Error)]
pub enum BadLog {
    /// A line is no record.
    #[error("line {line} is no record of a run log: {source}")]
    Line {
        /// The line, from 1.
        line: usize,
        /// What is wrong with it.
        source: serde_json::Error,
    },
    /// A line is longer than any record.
    #[error("line {0} is longer than any record of a run log")]
    TooLong(usize),
    /// It begins otherwise.
    #[error("it does not begin with a start record")]
    NoStart,
    /// A record stands where none of its kind can.
    #[error("line {0} stands in no order: a log is one start, its views from 1, one end")]
    Disorder(usize),
}

impl Run {
    /// Reads a log. An interrupted run may end within a line: that line is left out.
    ///
    /// # Errors
    /// It is no log of a run.
    pub fn read(bytes: &[u8]) -> Result<Self, BadLog> {
        let bytes = bytes.strip_suffix(b"\n").unwrap_or(bytes);
        let mut lines = bytes.split(|b| *b == b'\n').enumerate().peekable();
        let start = lines.next().map(|(k, line)| record(k, line)).transpose()?;
        let Some(Record::Start(start)) = start else {
            return Err(BadLog::NoStart);
        };
        let mut run = Self {
            start,
            views: Vec::new(),
            end: None,
        };
        while let Some((k, line)) = lines.next() {
            match record(k, line) {
                Ok(record) => run.add(k, record)?,
                Err(BadLog::Line { .. }) if lines.peek().is_none() => break,
                Err(error) => return Err(error),
            }
        }
        Ok(run)
    }

    fn add(&mut self, k: usize, record: Record) -> Result<(), BadLog> {
        match record {
            Record::View(view) if self.end.is_none() && view.n as usize == self.views.len() + 1 => {
                self.views.push(*view);
            }
            Record::End(end) if self.end.is_none() => self.end = Some(end),
            _ => return Err(BadLog::Disorder(k + 1)),
        }
        Ok(())
    }
}

fn record(k: usize, line: &[u8]) -> Result<Record, BadLog> {
    if k == 0 && line.is_empty() {
        return Err(BadLog::NoStart);
    }
    if line.len() > MOST_LINE {
        return Err(BadLog::TooLong(k + 1));
    }
    serde_json::from_slice(line).map_err(|source| BadLog::Line { line: k + 1, source })
}
