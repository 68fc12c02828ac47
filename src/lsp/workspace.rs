//! The programs that are open: what is known about each, and what became stale.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use super::documents::Documents;
use super::position::{Encoding, Positions};
use crate::ide::Snapshot;
use crate::lang::{SourceFile, Span, World, normal};

/// Most files that are looked at for uses of a name.
const MOST_FILES: usize = 2_000;
/// Deepest folder that is looked into.
const DEEPEST: usize = 12;

/// Everything that the server knows.
pub(super) struct Workspace {
    pub documents: Documents,
    pub encoding: Encoding,
    /// Folders that are open.
    pub roots: Vec<String>,
    snapshots: BTreeMap<String, Snapshot>,
    /// Open files whose diagnostics are to be published.
    pub unpublished: BTreeSet<String>,
}

impl Workspace {
    pub fn new(disk: Box<dyn World>, encoding: Encoding, roots: Vec<String>) -> Self {
        Self {
            documents: Documents {
                open: BTreeMap::new(),
                disk,
            },
            encoding,
            roots,
            snapshots: BTreeMap::new(),
            unpublished: BTreeSet::new(),
        }
    }

    /// The program of an open file, looked at again where it is stale.
    pub fn snapshot(&mut self, path: &str) -> Option<&Snapshot> {
        if !self.documents.open.contains_key(path) {
            return None;
        }
        if !self.snapshots.contains_key(path) {
            let snapshot = Snapshot::new(path, &self.documents);
            self.snapshots.insert(path.to_owned(), snapshot);
        }
        self.snapshots.get(path)
    }

    /// A program that is known.
    pub fn known(&self, path: &str) -> Option<&Snapshot> {
        self.snapshots.get(path)
    }

    /// The text of a file changed: every open program that reads it is stale.
    pub fn changed(&mut self, path: &str) {
        let reads = |snapshot: &Snapshot| {
            snapshot
                .sources()
                .files()
                .any(|(_, file)| normal(&file.display) == path)
        };
        let stale: Vec<String> = self
            .snapshots
            .iter()
            .filter(|(main, snapshot)| *main == path || reads(snapshot))
            .map(|(main, _)| main.clone())
            .collect();
        for main in stale {
            self.snapshots.remove(&main);
            self.unpublished.insert(main);
        }
        if self.documents.open.contains_key(path) {
            self.unpublished.insert(path.to_owned());
        }
    }

    /// Files came or went: every import may lead elsewhere.
    pub fn all_changed(&mut self) {
        self.snapshots.clear();
        self.unpublished.extend(self.documents.open.keys().cloned());
    }

    /// The lines of a file.
    pub fn positions<'t>(&self, file: &'t SourceFile) -> Positions<'t> {
        Positions::new(&file.text, self.encoding)
    }

    /// The path of the file under a span, and its text; none where it is in no file.
    pub fn file<'s>(&self, snapshot: &'s Snapshot, span: Span) -> Option<(String, &'s SourceFile)> {
        let file = snapshot.sources().get(span.file)?;
        Some((normal(&file.display), file))
    }

    /// All open programs, that of `path` first, and those in the open folders that name
    /// `word` and import files.
    pub fn programs(&mut self, path: &str, word: &str) -> Vec<Snapshot> {
        let mut mains = vec![path.to_owned()];
        mains.extend(self.documents.open.keys().filter(|p| *p != path).cloned());
        for file in self.roots.iter().flat_map(|root| files(root)) {
            let importing = |text: &str| text.contains(word) && text.contains("use \"");
            if !mains.contains(&file) && fs::read_to_string(&file).is_ok_and(|text| importing(&text)) {
                mains.push(file);
            }
        }
        mains.iter().map(|main| Snapshot::new(main, &self.documents)).collect()
    }
}

/// The programs in a folder, in order.
fn files(root: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut folders = vec![(PathBuf::from(root), 0)];
    while let Some((folder, depth)) = folders.pop() {
        let entries = fs::read_dir(folder).into_iter().flatten().flatten();
        for entry in entries {
            let Ok(kind) = entry.file_type() else { continue };
            let path = entry.path();
            if kind.is_dir() && depth < DEEPEST && !is_passed_over(&path) {
                folders.push((path, depth + 1));
            } else if kind.is_file() && path.extension().is_some_and(|e| e == "vpl") {
                found.push(path.to_string_lossy().replace('\\', "/"));
            }
            if found.len() >= MOST_FILES {
                break;
            }
        }
    }
    found.sort();
    found
}

fn is_passed_over(folder: &Path) -> bool {
    let name = folder
        .file_name()
        .map(|n| n.to_string_lossy().into_owned())
        .unwrap_or_default();
    name.starts_with('.') || name == "target" || name == "node_modules"
}
