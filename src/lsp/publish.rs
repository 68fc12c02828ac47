//! Diagnostics, file by file: what open programs have to say about each of their files.

use std::collections::{BTreeMap, BTreeSet};

use gen_lsp_types::{Diagnostic, PublishDiagnosticsParams};

use super::convert;
use super::workspace::Workspace;

/// What was said last.
#[derive(Debug, Default)]
pub(super) struct Published {
    /// By program, then by file.
    said: BTreeMap<String, BTreeMap<String, Vec<Diagnostic>>>,
}

impl Published {
    /// Looks at one program whose diagnostics are stale; none where there is none left.
    pub fn next(&mut self, workspace: &mut Workspace) -> Option<Vec<PublishDiagnosticsParams>> {
        let main = workspace.unpublished.pop_first()?;
        let mut files = BTreeSet::from([main.clone()]);
        files.extend(self.said.remove(&main).into_iter().flat_map(BTreeMap::into_keys));
        if workspace.snapshot(&main).is_some() {
            let said = convert::diagnostics(workspace, &main);
            files.extend(said.keys().cloned());
            self.said.insert(main, said);
        }
        let messages = files.into_iter().map(|file| self.message(workspace, &file));
        Some(messages.collect())
    }

    /// Everything that is said about a file, each thing once.
    fn message(&self, workspace: &Workspace, file: &str) -> PublishDiagnosticsParams {
        let mut diagnostics: Vec<Diagnostic> = Vec::new();
        for diagnostic in self.said.values().filter_map(|said| said.get(file)).flatten() {
            if !diagnostics.contains(diagnostic) {
                diagnostics.push(diagnostic.clone());
            }
        }
        diagnostics.sort_by_key(|d| d.range.start);
        PublishDiagnosticsParams {
            uri: workspace.documents.uri(file),
            version: workspace.documents.open.get(file).map(|d| d.version),
            diagnostics,
        }
    }
}
