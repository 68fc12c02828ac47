//! The answer to each request.

use std::collections::BTreeMap;

use gen_lsp_types::{
    ActiveParameter, CodeAction, CodeActionKind, CompletionList, Contents, DocumentHighlight, DocumentHighlightKind,
    DocumentSymbol, FoldingRange, Hover, InlayHint, InlayHintKind, Location, ParameterInformation,
    PrepareRenamePlaceholder, Range, SemanticTokens, SignatureHelp, SignatureInformation, TextDocumentIdentifier,
    TextDocumentPositionParams, TextEdit, Uri, WorkspaceEdit,
};

use super::workspace::Workspace;
use super::{convert, paths, standard};
use crate::ide::{self, HintKind, MAIN, Snapshot};
use crate::lang::{Fix, Span};

/// A document as it is now.
pub(super) struct Open<'w> {
    pub workspace: &'w Workspace,
    pub snapshot: &'w Snapshot,
}

/// The document that a request is about, where it is open.
pub(super) fn open<'w>(workspace: &'w mut Workspace, document: &TextDocumentIdentifier) -> Option<Open<'w>> {
    let path = paths::path(&document.uri);
    workspace.snapshot(&path)?;
    let workspace = &*workspace;
    let snapshot = workspace.known(&path)?;
    Some(Open { workspace, snapshot })
}

/// The same with the byte of a position.
pub(super) fn open_at<'w>(workspace: &'w mut Workspace, at: &TextDocumentPositionParams) -> Option<(Open<'w>, usize)> {
    let open = open(workspace, &at.text_document)?;
    let offset = open.positions().offset(at.position);
    Some((open, offset))
}

impl<'w> Open<'w> {
    fn positions(&self) -> super::position::Positions<'w> {
        super::position::Positions::new(self.snapshot.text(), self.workspace.encoding)
    }

    fn range(&self, span: Span) -> Range {
        self.positions().range(span.start..span.end)
    }

    pub fn hover(&self, offset: usize) -> Option<Hover> {
        let hover = ide::hover(self.snapshot, offset)?;
        Some(Hover {
            contents: Contents::MarkupContent(convert::markdown(hover.markdown)),
            range: Some(self.range(hover.span)),
        })
    }

    pub fn completion(&self, offset: usize, snippets: bool) -> CompletionList {
        let (replaced, offers) = ide::complete(self.snapshot, &self.workspace.documents, offset);
        let positions = self.positions();
        let range = positions.range(replaced);
        let items = offers.into_iter();
        CompletionList {
            items: items
                .map(|offer| convert::completion(offer, &positions, range, snippets))
                .collect(),
            ..Default::default()
        }
    }

    pub fn definition(&self, offset: usize) -> Option<Location> {
        let (_, target) = ide::definition(self.snapshot, offset)?;
        convert::location(self.workspace, self.snapshot, target)
    }

    pub fn highlights(&self, offset: usize) -> Vec<DocumentHighlight> {
        let positions = self.positions();
        let here = ide::occurrences(self.snapshot, offset)
            .into_iter()
            .filter(|o| o.span.file == MAIN);
        here.map(|o| DocumentHighlight {
            range: positions.range(o.span.start..o.span.end),
            kind: Some(match o.declares {
                true => DocumentHighlightKind::Write,
                false => DocumentHighlightKind::Read,
            }),
        })
        .collect()
    }

    pub fn signature_help(&self, offset: usize) -> Option<SignatureHelp> {
        let help = ide::signature_help(self.snapshot, offset)?;
        let label = super::position::Positions::new(&help.label, self.workspace.encoding);
        let parameters = help.parameters.into_iter().map(|(bytes, docs)| {
            let range = label.range(bytes);
            ParameterInformation {
                label: (range.start.character, range.end.character).into(),
                documentation: (!docs.is_empty()).then(|| convert::markdown(docs).into()),
            }
        });
        let signature = SignatureInformation {
            parameters: Some(parameters.collect()),
            documentation: (!help.docs.is_empty()).then(|| convert::markdown(help.docs).into()),
            active_parameter: help.active.map(|k| ActiveParameter::Int(k as u32)),
            label: help.label,
        };
        Some(SignatureHelp {
            active_parameter: signature.active_parameter,
            signatures: vec![signature],
            active_signature: Some(0),
        })
    }

    pub fn symbols(&self) -> Vec<DocumentSymbol> {
        let positions = self.positions();
        let symbols = ide::outline(self.snapshot).into_iter();
        symbols.map(|symbol| convert::symbol(symbol, &positions)).collect()
    }

    pub fn folds(&self) -> Vec<FoldingRange> {
        ide::folds(self.snapshot).into_iter().map(convert::fold).collect()
    }

    pub fn semantic_tokens(&self) -> SemanticTokens {
        let pieces = ide::semantic(self.snapshot);
        SemanticTokens {
            data: convert::tokens(&pieces, self.snapshot.text(), &self.positions()),
            ..Default::default()
        }
    }

    pub fn inlay_hints(&self, range: Range, every: bool) -> Vec<InlayHint> {
        let positions = self.positions();
        let hints = ide::hints(self.snapshot, positions.bytes(range), every).into_iter();
        hints
            .map(|hint| InlayHint {
                position: positions.position(hint.at),
                label: hint.text.into(),
                kind: (hint.kind == HintKind::Value).then_some(InlayHintKind::Type),
                text_edits: None,
                tooltip: None,
                padding_left: Some(true),
                padding_right: None,
                data: None,
            })
            .collect()
    }

    /// The edits that lay the document out.
    pub fn formatted(&self) -> Vec<TextEdit> {
        let text = self.snapshot.text();
        let positions = self.positions();
        let edits = crate::lang::edits(text, &crate::lang::format(text).text).into_iter();
        edits
            .map(|edit| TextEdit {
                range: positions.range(edit.span.start..edit.span.end),
                new_text: edit.text,
            })
            .collect()
    }

    /// The repairs of every diagnostic that touches the range.
    pub fn code_actions(&self, range: Range) -> Vec<CodeAction> {
        let positions = self.positions();
        let asked = positions.bytes(range);
        let touches = |span: Span| span.file == MAIN && span.start <= asked.end && asked.start <= span.end;
        let diagnostics = self.snapshot.expansion().diagnostics.iter();
        let touched = diagnostics.filter(|d| touches(d.primary.span));
        touched
            .flat_map(|diagnostic| {
                let said = convert::diagnostic(self.workspace, self.snapshot, diagnostic, &positions);
                let only = diagnostic.fixes.len() == 1;
                diagnostic.fixes.iter().map(move |fix| (fix, said.clone(), only))
            })
            .map(|(fix, said, only)| CodeAction {
                title: fix.message.clone(),
                kind: Some(CodeActionKind::QuickFix),
                diagnostics: Some(vec![said]),
                is_preferred: Some(only),
                edit: Some(self.fix(fix)),
                ..Default::default()
            })
            .collect()
    }

    fn fix(&self, fix: &Fix) -> WorkspaceEdit {
        let edits = fix.edits.iter().filter_map(|edit| {
            let (path, file) = self.workspace.file(self.snapshot, edit.span)?;
            let range = self.workspace.positions(file).range(edit.span.start..edit.span.end);
            let text = edit.text.clone();
            Some((self.workspace.documents.uri(&path), TextEdit { range, new_text: text }))
        });
        edits_by_file(edits)
    }

    /// The name that would be renamed.
    ///
    /// # Errors
    /// Why it is not.
    pub fn renameable(&self, offset: usize) -> Result<PrepareRenamePlaceholder, String> {
        own(self.snapshot)?;
        let name = ide::renameable(self.snapshot, offset).map_err(|why| why.to_string())?;
        Ok(PrepareRenamePlaceholder {
            range: self.range(name.span),
            placeholder: self.snapshot.sources().text(name.span).to_owned(),
        })
    }

    /// The word at a byte, and the path of its document.
    pub fn word(&self, offset: usize) -> Option<(String, String)> {
        let name = self.snapshot.index().at(MAIN, offset)?;
        let word = self.snapshot.sources().text(name.span).to_owned();
        Some((self.snapshot.path().to_owned(), word))
    }
}

/// Copies of the standard library are not changed.
fn own(snapshot: &Snapshot) -> Result<(), String> {
    match standard::is_copy(snapshot.path()) {
        true => Err("this is a copy of the standard library".into()),
        false => Ok(()),
    }
}

fn edits_by_file(edits: impl Iterator<Item = (Uri, TextEdit)>) -> WorkspaceEdit {
    let mut changes: BTreeMap<String, Vec<TextEdit>> = BTreeMap::new();
    for (uri, edit) in edits {
        changes.entry(uri.0).or_default().push(edit);
    }
    WorkspaceEdit {
        changes: Some(changes.into_iter().map(|(uri, edits)| (Uri(uri), edits)).collect()),
        ..Default::default()
    }
}

/// Every place in all programs of the workspace that names what stands at a position.
pub(super) fn references(
    workspace: &mut Workspace,
    at: &TextDocumentPositionParams,
    declaration: bool,
) -> Option<Vec<Location>> {
    let (open, offset) = open_at(workspace, at)?;
    let (path, word) = open.word(offset)?;
    let programs = workspace.programs(&path, &word);
    let programs: Vec<&Snapshot> = programs.iter().collect();
    let places = ide::references(&programs, offset, declaration);
    let mut found: Vec<Location> = places
        .into_iter()
        .filter_map(|(program, span)| convert::location(workspace, programs.get(program)?, span))
        .collect();
    found.sort_by(|a, b| (&a.uri.0, a.range.start).cmp(&(&b.uri.0, b.range.start)));
    found.dedup();
    Some(found)
}

/// The edits that rename what stands at a position, in all programs of the workspace.
///
/// # Errors
/// Why it is not renamed.
pub(super) fn rename(
    workspace: &mut Workspace,
    at: &TextDocumentPositionParams,
    new: &str,
) -> Result<Option<WorkspaceEdit>, String> {
    let Some((open, offset)) = open_at(workspace, at) else {
        return Ok(None);
    };
    open.renameable(offset)?;
    let Some((path, word)) = open.word(offset) else {
        return Ok(None);
    };
    let programs = workspace.programs(&path, &word);
    let programs: Vec<&Snapshot> = programs.iter().collect();
    let renamed = ide::rename(&programs, &workspace.documents, offset, new).map_err(|why| why.to_string())?;
    let files = programs.iter().flat_map(|p| p.sources().files().map(|(_, file)| file));
    let files: BTreeMap<String, _> = files.map(|file| (crate::lang::normal(&file.display), file)).collect();
    let edits = renamed.iter().flat_map(|(path, places)| {
        let positions = files.get(path).map(|file| workspace.positions(file));
        let uri = workspace.documents.uri(path);
        let edits = positions.into_iter().flat_map(move |positions| {
            let edit = |bytes: &std::ops::Range<usize>| TextEdit {
                range: positions.range(bytes.clone()),
                new_text: new.to_owned(),
            };
            places.iter().map(edit).collect::<Vec<_>>()
        });
        edits.map(move |edit| (uri.clone(), edit))
    });
    Ok(Some(edits_by_file(edits)))
}
