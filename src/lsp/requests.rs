//! Which method gets which answer.

use gen_lsp_types::{Range, TextDocumentIdentifier, TextDocumentPositionParams};
use lsp_server::ErrorCode;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::answers::{self, Open, open, open_at};
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

/// What requests ask about. Of what clients send beside it nothing is needed, and so
/// nothing there can be malformed.
#[derive(Deserialize)]
struct Document {
    #[serde(rename = "textDocument")]
    text_document: TextDocumentIdentifier,
}

#[derive(Deserialize)]
struct Part {
    #[serde(rename = "textDocument")]
    text_document: TextDocumentIdentifier,
    range: Range,
}

/// Answers a request about a document; `null` where there is nothing to say.
pub(super) fn answer(workspace: &mut Workspace, greeting: &Greeting, method: &str, params: &Value) -> Answer {
    let Some(method) = method.strip_prefix("textDocument/") else {
        return unknown(method);
    };
    match method {
        "documentSymbol" | "foldingRange" | "semanticTokens/full" | "formatting" => {
            let asked: Document = read(params)?;
            let open = open(workspace, &asked.text_document);
            open.map_or(Ok(Value::Null), |open| about_document(&open, method))
        }
        "inlayHint" | "codeAction" => {
            let asked: Part = read(params)?;
            let open = open(workspace, &asked.text_document);
            open.map_or(Ok(Value::Null), |open| {
                about_part(&open, greeting, method, asked.range, params)
            })
        }
        "references" => {
            let at: TextDocumentPositionParams = read(params)?;
            let declaration = params.pointer("/context/includeDeclaration") != Some(&Value::Bool(false));
            written(answers::references(workspace, &at, declaration))
        }
        "rename" => {
            let at: TextDocumentPositionParams = read(params)?;
            let new = params.get("newName").and_then(Value::as_str).unwrap_or_default();
            written(answers::rename(workspace, &at, new).map_err(failed)?)
        }
        "hover" | "completion" | "signatureHelp" | "definition" | "documentHighlight" | "prepareRename" => {
            let at: TextDocumentPositionParams = read(params)?;
            let open = open_at(workspace, &at);
            open.map_or(Ok(Value::Null), |(open, at)| about_place(&open, greeting, method, at))
        }
        _ => unknown(method),
    }
}

fn about_document(open: &Open<'_>, method: &str) -> Answer {
    match method {
        "documentSymbol" => written(open.symbols()),
        "foldingRange" => written(open.folds()),
        "formatting" => written(open.formatted()),
        _ => written(open.semantic_tokens()),
    }
}

fn about_part(open: &Open<'_>, greeting: &Greeting, method: &str, range: Range, params: &Value) -> Answer {
    if method == "inlayHint" {
        return written(open.inlay_hints(range, greeting.every_quantity));
    }
    let kinds = params.pointer("/context/only").and_then(Value::as_array);
    match kinds.is_some_and(|kinds| !kinds.iter().any(|kind| kind == "quickfix" || kind == "")) {
        true => written(Vec::<Value>::new()),
        false => written(open.code_actions(range)),
    }
}

fn about_place(open: &Open<'_>, greeting: &Greeting, method: &str, at: usize) -> Answer {
    match method {
        "hover" => written(open.hover(at)),
        "completion" => written(open.completion(at, greeting.snippets)),
        "signatureHelp" => written(open.signature_help(at)),
        "definition" => written(open.definition(at)),
        "documentHighlight" => written(open.highlights(at)),
        _ => written(open.renameable(at).map_err(failed)?),
    }
}

fn unknown(method: &str) -> Answer {
    Err(Refused::new(
        ErrorCode::MethodNotFound,
        format!("there is no method `{method}`"),
    ))
}

fn read<'p, P: Deserialize<'p>>(params: &'p Value) -> Result<P, Refused> {
    P::deserialize(params).map_err(|error| Refused::new(ErrorCode::InvalidParams, error.to_string()))
}

pub(super) fn written(answer: impl Serialize) -> Answer {
    serde_json::to_value(answer).map_err(|error| Refused::new(ErrorCode::InternalError, error.to_string()))
}

fn failed(why: String) -> Refused {
    Refused::new(ErrorCode::RequestFailed, why)
}
