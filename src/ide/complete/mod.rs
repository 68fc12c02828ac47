//! What can stand at a place, while it is being typed.
//!
//! [`context`] reads the statement before the cursor, [`due`] says what it waits for,
//! [`offers`] lists what fits. The text may be broken in any way: names come from the
//! analysis of the whole file and, where its library cannot be read, of the part
//! before the cursor with its braces closed.

mod context;
mod due;
mod imports;
mod offers;
mod snippets;
mod standard;

use std::ops::Range;

pub(super) use context::{Context, Word};
pub(super) use due::{Frame, Reading};

use super::{MAIN, Snapshot};
use crate::lang::{MOST_BYTES, ReadFailure, World};

/// Most offers; more would not be read.
const MOST: usize = 500;

/// Something that can stand at the cursor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completion {
    /// What is shown, and inserted where nothing else is said.
    pub label: String,
    /// What it is.
    pub kind: CompletionKind,
    /// A few words beside the label.
    pub detail: String,
    /// Documentation in Markdown.
    pub docs: String,
    /// What is inserted, with `$1` for what is to be filled in.
    pub snippet: Option<String>,
    /// A line to insert elsewhere, with its byte.
    pub import: Option<(usize, String)>,
    /// Offers of a lower rank come first.
    pub rank: u8,
}

/// What an offer is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "they say what they are")]
pub enum CompletionKind {
    Keyword,
    Function,
    Constant,
    Feature,
    Class,
    Library,
    Layout,
    Module,
    Attribute,
    Argument,
    Variable,
    Unit,
    Colour,
    Type,
    Word,
}

impl Completion {
    fn new(label: impl Into<String>, kind: CompletionKind) -> Self {
        Self {
            label: label.into(),
            kind,
            detail: String::new(),
            docs: String::new(),
            snippet: None,
            import: None,
            rank: 1,
        }
    }

    fn detail(mut self, text: impl Into<String>) -> Self {
        self.detail = text.into();
        self
    }

    fn docs(mut self, text: impl Into<String>) -> Self {
        self.docs = text.into();
        self
    }

    fn snippet(mut self, text: impl Into<String>) -> Self {
        self.snippet = Some(text.into());
        self
    }

    fn rank(mut self, rank: u8) -> Self {
        self.rank = rank;
        self
    }
}

/// What can stand at a byte of the main file, and the bytes that it replaces.
pub fn complete(snapshot: &Snapshot, world: &dyn World, offset: usize) -> (Range<usize>, Vec<Completion>) {
    let text = snapshot.text();
    let context = Context::at(text, offset);
    let prefix = context.prefix.clone();
    let mut offers = match readable(snapshot, world, &context) {
        Some(closed) => offers::offers(&closed, world, &context),
        None => offers::offers(snapshot, world, &context),
    };
    let typed = text.get(prefix.clone()).unwrap_or("").to_ascii_lowercase();
    offers.retain(|offer| starts_alike(&offer.label, &typed));
    offers.sort_by(|a, b| (a.rank, &a.label).cmp(&(b.rank, &b.label)));
    offers.dedup_by(|a, b| a.label == b.label);
    offers.truncate(MOST);
    (prefix, offers)
}

/// Whether a label has the letters that were typed, in their order.
fn starts_alike(label: &str, typed: &str) -> bool {
    let mut letters = label.chars().map(|c| c.to_ascii_lowercase());
    typed.chars().all(|c| letters.any(|l| l == c))
}

/// The program with the braces before the cursor closed, where its library cannot be
/// read as it stands.
fn readable(snapshot: &Snapshot, world: &dyn World, context: &Context<'_>) -> Option<Snapshot> {
    let library = context.library.as_ref()?;
    if snapshot.library(library).is_some() {
        return None;
    }
    let before = snapshot.text().get(..context.statement_start)?;
    let text = format!("{before}\n{}\n", "}".repeat(context.depth));
    let closed = Overlay {
        path: snapshot.path(),
        text: &text,
        world,
    };
    Some(Snapshot::new(snapshot.path(), &closed))
}

/// A world in which one file is another.
struct Overlay<'a> {
    path: &'a str,
    text: &'a str,
    world: &'a dyn World,
}

impl World for Overlay<'_> {
    fn read(&self, path: &str) -> Result<Vec<u8>, ReadFailure> {
        if path != self.path {
            return self.world.read(path);
        }
        match self.text.len() {
            n if n > MOST_BYTES => Err(ReadFailure::TooLarge),
            _ => Ok(self.text.as_bytes().to_vec()),
        }
    }
}

impl Snapshot {
    /// The library of a name in the main file.
    pub(super) fn library(&self, name: &str) -> Option<&crate::lang::syntax::tree::Library> {
        let items = self.tree(MAIN)?.items.iter();
        items
            .filter_map(|item| match item {
                crate::lang::syntax::tree::Item::Library(library) => Some(library),
                _ => None,
            })
            .find(|library| library.name.text == name)
    }
}
