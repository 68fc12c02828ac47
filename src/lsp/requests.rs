//! Which method gets which answer.

use gen_lsp_types::{
    CodeActionParams, CompletionParams, DefinitionParams, DocumentHighlightParams, DocumentSymbolParams,
    FoldingRangeParams, HoverParams, InlayHintParams, PrepareRenameParams, ReferenceParams, RenameParams,
    SemanticTokensParams, SignatureHelpParams,
};
use lsp_server::ErrorCode;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::answers::{self, open, open_at};
use super::capabilities::Greeting;
use super::workspace::Workspace;

/// A refused request.
#[derive(Debug)]
pub(super) struct Refused {
    pub code: ErrorCode,
    pub message: String,
}

impl Refused {
    pub fn new(code: ErrorCode, message: impl Into<String>) -> Self {
        Self {
            code,
            message: message.into(),
        }
    }
}

type Answer = Result<Value, Refused>;

/// Answers a request about a document; `null` where there is nothing to say.
pub(super) fn answer(workspace: &mut Workspace, greeting: &Greeting, method: &str, params: Value) -> Answer {
    match method {
        "textDocument/hover" => {
            let p: HoverParams = read(params)?;
            let at = open_at(workspace, &p.text_document_position_params);
            written(at.and_then(|(open, at)| open.hover(at)))
        }
        "textDocument/completion" => {
            let p: CompletionParams = read(params)?;
            let at = open_at(workspace, &p.text_document_position_params);
            written(at.map(|(open, at)| open.completion(at, greeting.snippets)))
        }
        "textDocument/signatureHelp" => {
            let p: SignatureHelpParams = read(params)?;
            let at = open_at(workspace, &p.text_document_position_params);
            written(at.and_then(|(open, at)| open.signature_help(at)))
        }
        "textDocument/definition" => {
            let p: DefinitionParams = read(params)?;
            let at = open_at(workspace, &p.text_document_position_params);
            written(at.and_then(|(open, at)| open.definition(at)))
        }
        "textDocument/references" => {
            let p: ReferenceParams = read(params)?;
            written(answers::references(
                workspace,
                &p.text_document_position_params,
                p.context,
            ))
        }
        "textDocument/documentHighlight" => {
            let p: DocumentHighlightParams = read(params)?;
            let at = open_at(workspace, &p.text_document_position_params);
            written(at.map(|(open, at)| open.highlights(at)))
        }
        "textDocument/prepareRename" => {
            let p: PrepareRenameParams = read(params)?;
            match open_at(workspace, &p.text_document_position_params) {
                Some((open, at)) => written(open.renameable(at).map_err(failed)?),
                None => Ok(Value::Null),
            }
        }
        "textDocument/rename" => {
            let p: RenameParams = read(params)?;
            written(answers::rename(workspace, &p.text_document_position_params, &p.new_name).map_err(failed)?)
        }
        "textDocument/documentSymbol" => {
            let p: DocumentSymbolParams = read(params)?;
            written(open(workspace, &p.text_document).map(|open| open.symbols()))
        }
        "textDocument/foldingRange" => {
            let p: FoldingRangeParams = read(params)?;
            written(open(workspace, &p.text_document).map(|open| open.folds()))
        }
        "textDocument/semanticTokens/full" => {
            let p: SemanticTokensParams = read(params)?;
            written(open(workspace, &p.text_document).map(|open| open.semantic_tokens()))
        }
        "textDocument/inlayHint" => {
            let p: InlayHintParams = read(params)?;
            let open = open(workspace, &p.text_document);
            written(open.map(|open| open.inlay_hints(&p, greeting.every_quantity)))
        }
        "textDocument/codeAction" => {
            let p: CodeActionParams = read(params)?;
            written(open(workspace, &p.text_document).map(|open| open.code_actions(&p)))
        }
        _ => Err(Refused::new(
            ErrorCode::MethodNotFound,
            format!("there is no method `{method}`"),
        )),
    }
}

pub(super) fn read<P: DeserializeOwned>(params: Value) -> Result<P, Refused> {
    serde_json::from_value(params).map_err(|error| Refused::new(ErrorCode::InvalidParams, error.to_string()))
}

pub(super) fn written(answer: impl Serialize) -> Answer {
    serde_json::to_value(answer).map_err(|error| Refused::new(ErrorCode::InternalError, error.to_string()))
}

fn failed(why: String) -> Refused {
    Refused::new(ErrorCode::RequestFailed, why)
}
