//! The language server answers or refuses whatever arrives, and ends when the input does.
//!
//! Input: pieces with a zero byte between. The first is the text of an open document,
//! the others are bodies of messages; those that are no JSON go out as they are.

#![no_main]

use std::io::Cursor;

use libfuzzer_sys::fuzz_target;
use serde_json::json;
use vpl::lang::Memory;

fn framed(body: &str) -> String {
    format!("Content-Length: {}\r\n\r\n{body}", body.len())
}

fuzz_target!(|text: &str| {
    let mut pieces = text.split('\0');
    let document = pieces.next().unwrap_or_default();
    let uri = "file:///fuzz/main.vpl";
    let mut input = String::new();
    for message in [
        json!({"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": {"capabilities": {}}}),
        json!({"jsonrpc": "2.0", "method": "initialized", "params": {}}),
        json!({"jsonrpc": "2.0", "method": "textDocument/didOpen", "params":
            {"textDocument": {"uri": uri, "languageId": "vpl", "version": 1, "text": document}}}),
    ] {
        input += &framed(&message.to_string());
    }
    let lines = document.lines().count() as u32;
    let asked = ["hover", "completion", "definition", "references", "documentHighlight", "signatureHelp"];
    for (k, method) in asked.iter().enumerate() {
        let position = json!({"line": lines / (k as u32 + 1), "character": 3 * k});
        let mut params = json!({"textDocument": {"uri": uri}, "position": position});
        params["context"] = json!({"includeDeclaration": true});
        let method = format!("textDocument/{method}");
        input += &framed(&json!({"jsonrpc": "2.0", "id": 10 + k, "method": method, "params": params}).to_string());
    }
    for (k, method) in ["documentSymbol", "foldingRange", "semanticTokens/full"].iter().enumerate() {
        let params = json!({"textDocument": {"uri": uri}});
        let method = format!("textDocument/{method}");
        input += &framed(&json!({"jsonrpc": "2.0", "id": 30 + k, "method": method, "params": params}).to_string());
    }
    for piece in pieces {
        match serde_json::from_str::<serde_json::Value>(piece) {
            Ok(_) => input += &framed(piece),
            Err(_) => input += piece,
        }
    }
    let mut output = Vec::new();
    let _ = vpl::lsp::serve(Cursor::new(input.into_bytes()), &mut output, Box::new(Memory::default()));
    assert!(!output.is_empty(), "`initialize` is answered");
});
