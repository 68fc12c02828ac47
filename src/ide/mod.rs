//! What an editor asks about a program: pure functions over a [`Snapshot`] and a byte
//! of its text. Nothing here knows a protocol or does I/O; `crate::lsp` calls it.
//!
//! Names come from the index that the checker recorded, so an answer and a diagnostic
//! never disagree. What needs no meaning (braces, the statement being typed) is read
//! from the text itself, and works while it is broken.

mod braces;
mod complete;
mod describe;
mod docs;
mod find;
mod folding;
mod hints;
mod hover;
mod navigate;
mod outline;
mod rename;
mod semantic;
mod signature;
#[cfg(test)]
mod tests;
mod values;
mod walk;

use std::cell::OnceCell;

use crate::lang::index::Index;
use crate::lang::syntax::{Token, tokens, tree};
use crate::lang::{Analysis, Expansion, FileId, Severity, SourceMap, World, analyse};

pub use complete::{Completion, CompletionKind, complete};
pub use folding::{Fold, FoldKind, folds};
pub use hints::{Hint, HintKind, hints};
pub use hover::{Hover, hover};
pub use navigate::{definition, occurrences, references};
pub use outline::{Symbol, SymbolKind, outline};
pub use rename::{Refusal, Renamed, rename, renameable};
pub use semantic::{Meaning, Piece, semantic, standard_module};
pub use signature::{Help, signature_help};

/// The file of a snapshot that its editor shows.
pub const MAIN: FileId = FileId(0);

/// A program as it is at one moment; what costs time is found out when first asked.
#[derive(Debug)]
pub struct Snapshot {
    path: String,
    analysis: Analysis,
    expansion: OnceCell<Expansion>,
    tokens: OnceCell<Vec<Token>>,
}

impl Snapshot {
    /// The program at a path.
    pub fn new(path: &str, world: &dyn World) -> Self {
        Self {
            path: path.to_owned(),
            analysis: analyse(path, world),
            expansion: OnceCell::new(),
            tokens: OnceCell::new(),
        }
    }

    /// The path of the main file.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// The text of the main file.
    pub fn text(&self) -> &str {
        self.sources().get(MAIN).map_or("", |file| &file.text)
    }

    /// The files of the program.
    pub fn sources(&self) -> &SourceMap {
        self.analysis.sources()
    }

    /// What its names denote.
    pub fn index(&self) -> &Index {
        self.analysis.index()
    }

    /// The tree of a file.
    pub fn tree(&self, file: FileId) -> Option<&tree::File> {
        self.analysis.tree(file)
    }

    /// The program as it expands, and everything there is to say about it.
    pub fn expansion(&self) -> &Expansion {
        self.expansion.get_or_init(|| self.analysis.expand())
    }

    /// How many mistakes there are in its names and types.
    fn mistakes(&self) -> usize {
        let found = self.analysis.found().iter();
        found.filter(|d| d.severity == Severity::Error).count()
    }

    /// The tokens of the main file.
    pub fn tokens(&self) -> &[Token] {
        self.tokens.get_or_init(|| tokens(self.text()))
    }
}
