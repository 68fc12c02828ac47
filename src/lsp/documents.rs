//! The texts that editors hold, before those on disk.

use std::collections::BTreeMap;

use gen_lsp_types::{TextDocumentContentChangeEvent as Change, Uri};

use super::paths;
use super::position::{Encoding, Positions};
use crate::lang::{MOST_BYTES, ReadFailure, World, normal};

/// A document that is open.
#[derive(Debug)]
pub(super) struct Document {
    /// Its address as the editor writes it.
    pub uri: Uri,
    pub version: i32,
    pub text: String,
}

/// The documents that are open, by path, before the files behind them.
pub(super) struct Documents {
    pub open: BTreeMap<String, Document>,
    pub disk: Box<dyn World>,
}

impl Document {
    /// Takes changes over, each in the text that the one before it left.
    pub fn change(&mut self, changes: Vec<Change>, encoding: Encoding) {
        for change in changes {
            match change {
                Change::TextDocumentContentChangePartial(part) => {
                    let bytes = Positions::new(&self.text, encoding).bytes(part.range);
                    self.text.replace_range(bytes, &part.text);
                }
                Change::TextDocumentContentChangeWholeDocument(whole) => self.text = whole.text,
            }
        }
    }
}

impl Documents {
    /// The address of a file: as its editor writes it, where it is open.
    pub fn uri(&self, path: &str) -> Uri {
        let open = self.open.get(path).map(|d| d.uri.clone());
        open.unwrap_or_else(|| paths::uri(path))
    }
}

impl World for Documents {
    fn read(&self, path: &str) -> Result<Vec<u8>, ReadFailure> {
        match self.open.get(&normal(path)) {
            Some(open) if open.text.len() > MOST_BYTES => Err(ReadFailure::TooLarge),
            Some(open) => Ok(open.text.as_bytes().to_vec()),
            None => self.disk.read(path),
        }
    }
}
