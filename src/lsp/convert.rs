//! From what `crate::ide` says to the protocol's words.

use std::collections::BTreeMap;

use gen_lsp_types::{
    Code, CompletionItem, CompletionItemKind, CompletionItemLabelDetails, Diagnostic, DiagnosticRelatedInformation,
    DiagnosticSeverity, DiagnosticTag, DocumentSymbol, FoldingRange, FoldingRangeKind, InsertTextFormat, Location,
    MarkupContent, MarkupKind, SemanticToken, SymbolKind, TextEdit, Uri,
};

use super::capabilities::MEANINGS;
use super::position::Positions;
use super::standard;
use super::workspace::Workspace;
use crate::ide::{self, Completion, CompletionKind, Fold, FoldKind, Piece, Snapshot, Symbol};
use crate::lang::{self, Severity, Span};

pub(super) fn markdown(value: String) -> MarkupContent {
    MarkupContent {
        kind: MarkupKind::Markdown,
        value,
    }
}

// ---- Places -----------------------------------------------------------------

/// A span as a place that an editor can open.
pub(super) fn location(workspace: &Workspace, snapshot: &Snapshot, span: Span) -> Option<Location> {
    let (path, file) = workspace.file(snapshot, span)?;
    let range = workspace.positions(file).range(span.start..span.end);
    Some(Location {
        uri: address(workspace, snapshot, span, &path)?,
        range,
    })
}

/// Files of the standard library are opened as copies.
fn address(workspace: &Workspace, snapshot: &Snapshot, span: Span, path: &str) -> Option<Uri> {
    match ide::standard_module(snapshot, span.file) {
        Some(module) => Some(workspace.documents.uri(&standard::copy(module)?)),
        None => Some(workspace.documents.uri(path)),
    }
}

// ---- Diagnostics ------------------------------------------------------------

/// Everything there is to say about a program, by the path of the file.
pub(super) fn diagnostics(workspace: &Workspace, main: &str) -> BTreeMap<String, Vec<Diagnostic>> {
    let mut found: BTreeMap<String, Vec<Diagnostic>> = BTreeMap::new();
    let Some(snapshot) = workspace.known(main) else {
        return found;
    };
    let mut known: BTreeMap<lang::FileId, Positions<'_>> = BTreeMap::new();
    for diagnostic in &snapshot.expansion().diagnostics {
        let span = diagnostic.primary.span;
        let Some((path, file)) = workspace.file(snapshot, span) else {
            continue;
        };
        if ide::standard_module(snapshot, span.file).is_some() {
            continue;
        }
        let positions = known.entry(span.file).or_insert_with(|| workspace.positions(file));
        let said = self::diagnostic(workspace, snapshot, diagnostic, positions);
        found.entry(path).or_default().push(said);
    }
    found
}

pub(super) fn diagnostic(
    workspace: &Workspace,
    snapshot: &Snapshot,
    diagnostic: &lang::Diagnostic,
    positions: &Positions<'_>,
) -> Diagnostic {
    let help = diagnostic.help.iter().map(|help| format!("\nhelp: {help}"));
    let message: String = std::iter::once(diagnostic.message.clone()).chain(help).collect();
    let related: Vec<DiagnosticRelatedInformation> = diagnostic
        .related
        .iter()
        .filter_map(|label| {
            Some(DiagnosticRelatedInformation {
                location: location(workspace, snapshot, label.span)?,
                message: label.text.clone(),
            })
        })
        .collect();
    let span = diagnostic.primary.span;
    Diagnostic {
        range: positions.range(span.start..span.end),
        severity: Some(severity(diagnostic.severity)),
        code: Some(Code::String(diagnostic.code.to_string())),
        source: Some("vpl".to_owned()),
        message: message.into(),
        tags: is_unnecessary(diagnostic.code).then(|| vec![DiagnosticTag::Unnecessary]),
        related_information: (!related.is_empty()).then_some(related),
        ..Default::default()
    }
}

fn severity(severity: Severity) -> DiagnosticSeverity {
    match severity {
        Severity::Error => DiagnosticSeverity::Error,
        Severity::Warning => DiagnosticSeverity::Warning,
        Severity::Note => DiagnosticSeverity::Hint,
    }
}

/// What could as well not be there.
fn is_unnecessary(code: lang::Code) -> bool {
    matches!(code, lang::Code::W0402 | lang::Code::W0405)
}

// ---- Completion -------------------------------------------------------------

/// An offer that replaces a range.
pub(super) fn completion(
    offer: Completion,
    positions: &Positions<'_>,
    replaced: gen_lsp_types::Range,
    snippets: bool,
) -> CompletionItem {
    let (text, format) = match offer.snippet.filter(|_| snippets) {
        Some(snippet) => (snippet, Some(InsertTextFormat::Snippet)),
        None => (offer.label.clone(), None),
    };
    let edit = TextEdit {
        range: replaced,
        new_text: text,
    };
    let import = offer.import.map(|(at, line)| {
        vec![TextEdit {
            range: positions.range(at..at),
            new_text: line,
        }]
    });
    CompletionItem {
        kind: Some(completion_kind(offer.kind)),
        sort_text: Some(format!("{}{}", offer.rank, offer.label)),
        detail: (!offer.detail.is_empty()).then_some(offer.detail),
        documentation: (!offer.docs.is_empty()).then(|| markdown(offer.docs).into()),
        insert_text_format: format,
        text_edit: Some(edit.into()),
        label_details: import.is_some().then(|| CompletionItemLabelDetails {
            description: Some("import".to_owned()),
            ..Default::default()
        }),
        additional_text_edits: import,
        label: offer.label,
        ..Default::default()
    }
}

fn completion_kind(kind: CompletionKind) -> CompletionItemKind {
    match kind {
        CompletionKind::Keyword => CompletionItemKind::Keyword,
        CompletionKind::Function => CompletionItemKind::Function,
        CompletionKind::Constant => CompletionItemKind::Constant,
        CompletionKind::Feature | CompletionKind::Attribute => CompletionItemKind::Property,
        CompletionKind::Class => CompletionItemKind::Class,
        CompletionKind::Library | CompletionKind::Module => CompletionItemKind::Module,
        CompletionKind::Layout => CompletionItemKind::Struct,
        CompletionKind::Argument | CompletionKind::Variable => CompletionItemKind::Variable,
        CompletionKind::Unit => CompletionItemKind::Unit,
        CompletionKind::Colour => CompletionItemKind::Color,
        CompletionKind::Type => CompletionItemKind::TypeParameter,
        CompletionKind::Word => CompletionItemKind::EnumMember,
    }
}

// ---- Structure --------------------------------------------------------------

pub(super) fn symbol(symbol: Symbol, positions: &Positions<'_>) -> DocumentSymbol {
    let children: Vec<DocumentSymbol> = symbol
        .children
        .into_iter()
        .map(|c| self::symbol(c, positions))
        .collect();
    DocumentSymbol::new(
        symbol.name,
        (!symbol.detail.is_empty()).then_some(symbol.detail),
        symbol_kind(symbol.kind),
        None,
        None,
        positions.range(symbol.span.start..symbol.span.end),
        positions.range(symbol.at.start..symbol.at.end),
        (!children.is_empty()).then_some(children),
    )
}

fn symbol_kind(kind: ide::SymbolKind) -> SymbolKind {
    match kind {
        ide::SymbolKind::Function => SymbolKind::Function,
        ide::SymbolKind::Constant => SymbolKind::Constant,
        ide::SymbolKind::Library => SymbolKind::Namespace,
        ide::SymbolKind::Feature => SymbolKind::Property,
        ide::SymbolKind::Class => SymbolKind::Class,
        ide::SymbolKind::Rule => SymbolKind::Event,
        ide::SymbolKind::Layout | ide::SymbolKind::Task | ide::SymbolKind::Scene | ide::SymbolKind::Study => {
            SymbolKind::Struct
        }
        ide::SymbolKind::Object => SymbolKind::Object,
        ide::SymbolKind::Test => SymbolKind::Method,
    }
}

pub(super) fn fold(fold: Fold) -> FoldingRange {
    FoldingRange {
        start_line: fold.first as u32,
        end_line: fold.last as u32,
        kind: match fold.kind {
            FoldKind::Block => None,
            FoldKind::Imports => Some(FoldingRangeKind::Imports),
            FoldKind::Comment => Some(FoldingRangeKind::Comment),
        },
        ..Default::default()
    }
}

/// Pieces, each by its distance from the one before.
pub(super) fn tokens(pieces: &[Piece], text: &str, positions: &Positions<'_>) -> Vec<SemanticToken> {
    let (mut line, mut start) = (0, 0);
    pieces
        .iter()
        .map(|piece| {
            let at = positions.position(piece.start);
            let token = SemanticToken {
                delta_line: at.line - line,
                delta_start: if at.line == line {
                    at.character - start
                } else {
                    at.character
                },
                length: positions.length(text.get(piece.start..piece.end).unwrap_or("")) as u32,
                token_type: MEANINGS.iter().position(|(m, _)| *m == piece.meaning).unwrap_or(0) as u32,
                token_modifiers_bitset: u32::from(piece.declares)
                    | u32::from(piece.standard) << 1
                    | u32::from(piece.documents) << 2,
            };
            (line, start) = (at.line, at.character);
            token
        })
        .collect()
}
