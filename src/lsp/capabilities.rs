//! What the server offers, and what it reads of the client's greeting.

use gen_lsp_types::{
    CodeActionKind, CodeActionOptions, CompletionOptions, Full, InitializeResult, PositionEncodingKind, RenameOptions,
    SemanticTokensLegend, SemanticTokensOptions, ServerCapabilities, ServerInfo, SignatureHelpOptions,
    TextDocumentSyncKind, TextDocumentSyncOptions, Uri,
};
use serde_json::Value;

use super::paths;
use super::position::Encoding;
use crate::ide::Meaning;

/// What a client asks for when it begins.
#[derive(Debug)]
pub(super) struct Greeting {
    pub encoding: Encoding,
    pub roots: Vec<String>,
    /// Whether it fills in `$1`.
    pub snippets: bool,
    /// Whether every quantity gets a hint.
    pub every_quantity: bool,
}

impl Greeting {
    /// Reads the parameters of `initialize`, whatever their shape.
    pub fn read(params: &Value) -> Self {
        let at = |path: &str| params.pointer(path);
        let encodings = at("/capabilities/general/positionEncodings").and_then(Value::as_array);
        let utf8 = encodings.is_some_and(|all| all.iter().any(|e| e == "utf-8"));
        let folders = at("/workspaceFolders").and_then(Value::as_array);
        let folders = folders.into_iter().flatten().filter_map(|f| f.get("uri"));
        let mut roots: Vec<&Value> = folders.collect();
        if roots.is_empty() {
            roots.extend(at("/rootUri"));
        }
        let roots = roots.into_iter().filter_map(Value::as_str);
        let flag = |path: &str| at(path).and_then(Value::as_bool) == Some(true);
        Self {
            encoding: if utf8 { Encoding::Utf8 } else { Encoding::Utf16 },
            roots: roots.map(|uri| paths::path(&Uri(uri.to_owned()))).collect(),
            snippets: flag("/capabilities/textDocument/completion/completionItem/snippetSupport"),
            every_quantity: at("/initializationOptions/hints").and_then(Value::as_str) == Some("every quantity"),
        }
    }
}

/// The kinds of semantic tokens in the order of their numbers.
pub(super) const MEANINGS: &[(Meaning, &str)] = &[
    (Meaning::Keyword, "keyword"),
    (Meaning::Type, "type"),
    (Meaning::Namespace, "namespace"),
    (Meaning::Property, "property"),
    (Meaning::Class, "class"),
    (Meaning::Struct, "struct"),
    (Meaning::Function, "function"),
    (Meaning::Parameter, "parameter"),
    (Meaning::Variable, "variable"),
    (Meaning::EnumMember, "enumMember"),
    (Meaning::Unit, "unit"),
    (Meaning::Number, "number"),
    (Meaning::String, "string"),
    (Meaning::Comment, "comment"),
    (Meaning::Operator, "operator"),
];
/// Modifiers in the order of their bits.
const MODIFIERS: &[&str] = &["declaration", "defaultLibrary", "documentation"];

/// The answer to `initialize`.
pub(super) fn greeting(greeting: &Greeting) -> InitializeResult {
    let words = |words: &[&str]| Some(words.iter().map(|w| (*w).to_owned()).collect());
    let encoding = match greeting.encoding {
        Encoding::Utf8 => PositionEncodingKind::UTF8,
        Encoding::Utf16 => PositionEncodingKind::UTF16,
    };
    let capabilities = ServerCapabilities {
        position_encoding: Some(encoding),
        text_document_sync: Some(
            TextDocumentSyncOptions {
                open_close: Some(true),
                change: Some(TextDocumentSyncKind::Incremental),
                ..Default::default()
            }
            .into(),
        ),
        completion_provider: Some(CompletionOptions {
            trigger_characters: words(&[".", "(", "[", "{", "\"", " "]),
            ..Default::default()
        }),
        hover_provider: Some(true.into()),
        signature_help_provider: Some(SignatureHelpOptions {
            trigger_characters: words(&["(", ","]),
            ..Default::default()
        }),
        definition_provider: Some(true.into()),
        references_provider: Some(true.into()),
        document_highlight_provider: Some(true.into()),
        document_formatting_provider: Some(true.into()),
        document_symbol_provider: Some(true.into()),
        code_action_provider: Some(
            CodeActionOptions {
                code_action_kinds: Some(vec![CodeActionKind::QuickFix]),
                ..Default::default()
            }
            .into(),
        ),
        rename_provider: Some(
            RenameOptions {
                prepare_provider: Some(true),
                ..Default::default()
            }
            .into(),
        ),
        folding_range_provider: Some(true.into()),
        semantic_tokens_provider: Some(
            SemanticTokensOptions {
                legend: SemanticTokensLegend {
                    token_types: MEANINGS.iter().map(|(_, name)| (*name).to_owned()).collect(),
                    token_modifiers: MODIFIERS.iter().map(|name| (*name).to_owned()).collect(),
                },
                full: Some(Full::Bool(true)),
                ..Default::default()
            }
            .into(),
        ),
        inlay_hint_provider: Some(true.into()),
        ..Default::default()
    };
    InitializeResult {
        capabilities,
        server_info: Some(ServerInfo {
            name: "vpl".to_owned(),
            version: Some(env!("CARGO_PKG_VERSION").to_owned()),
        }),
    }
}
