//! What can be folded: blocks, imports that follow each other, and comments.

use super::Snapshot;
use super::braces::blocks;

/// A run of lines, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Fold {
    /// The line that stays.
    pub first: usize,
    /// The last line that is hidden.
    pub last: usize,
    /// What it is.
    pub kind: FoldKind,
}

/// What is folded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FoldKind {
    /// A block in braces; its last line stays, too.
    Block,
    /// Lines that begin with `use`.
    Imports,
    /// Lines that begin with `//`.
    Comment,
}

/// All folds of the main file, in order.
pub fn folds(snapshot: &Snapshot) -> Vec<Fold> {
    let text = snapshot.text();
    let line = Lines::new(text);
    let blocks = blocks(text).into_iter().filter_map(|block| {
        let (first, last) = (line.of(block.open), line.of(block.close).checked_sub(1)?);
        let kind = FoldKind::Block;
        (first < last).then_some(Fold { first, last, kind })
    });
    let mut folds: Vec<Fold> = blocks.collect();
    folds.extend(runs(text, "use ", FoldKind::Imports));
    folds.extend(runs(text, "//", FoldKind::Comment));
    folds.sort();
    folds
}

/// Runs of at least two lines that begin alike.
fn runs(text: &str, start: &str, kind: FoldKind) -> Vec<Fold> {
    let mut found: Vec<Fold> = Vec::new();
    for (k, line) in text.lines().enumerate() {
        if !line.trim_start().starts_with(start) {
            continue;
        }
        match found.last_mut() {
            Some(run) if run.last + 1 == k => run.last = k,
            _ => found.push(Fold {
                first: k,
                last: k,
                kind,
            }),
        }
    }
    found.retain(|run| run.first < run.last);
    found
}

/// The line of a byte.
struct Lines(Vec<usize>);

impl Lines {
    fn new(text: &str) -> Self {
        Self(text.match_indices('\n').map(|(at, _)| at).collect())
    }

    fn of(&self, offset: usize) -> usize {
        self.0.partition_point(|end| *end < offset)
    }
}
