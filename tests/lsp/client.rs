//! A small client: requests, notifications, and what the server publishes.

use std::collections::BTreeMap;
use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};

use serde_json::{Value, json};

/// A running server and what it published, by address.
pub struct Client {
    process: Child,
    input: Option<ChildStdin>,
    output: BufReader<ChildStdout>,
    next: i64,
    pub published: BTreeMap<String, Value>,
}

pub const URI: &str = "file:///nowhere/main.vpl";

impl Client {
    /// A server that was greeted with some capabilities.
    pub fn with(params: Value) -> Self {
        let mut client = Self::started();
        let answer = client.request("initialize", params);
        assert!(answer["capabilities"]["hoverProvider"].as_bool().unwrap());
        client.notify("initialized", json!({}));
        client
    }

    /// A server for a client that understands snippets and UTF-16 alone.
    pub fn new() -> Self {
        Self::with(json!({ "capabilities": {
            "textDocument": { "completion": { "completionItem": { "snippetSupport": true } } }
        } }))
    }

    /// A server that nobody spoke to.
    pub fn started() -> Self {
        let mut process = Command::new(env!("CARGO_BIN_EXE_vpl"))
            .arg("lsp")
            .env("XDG_CACHE_HOME", std::env::temp_dir().join("vpl-lsp-tests"))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        Self {
            input: process.stdin.take(),
            output: BufReader::new(process.stdout.take().unwrap()),
            process,
            next: 0,
            published: BTreeMap::new(),
        }
    }

    pub fn raw(&mut self, bytes: &[u8]) {
        let input = self.input.as_mut().unwrap();
        input.write_all(bytes).unwrap();
        input.flush().unwrap();
    }

    fn send(&mut self, message: &Value) {
        let body = message.to_string();
        self.raw(format!("Content-Length: {}\r\n\r\n{body}", body.len()).as_bytes());
    }

    pub fn notify(&mut self, method: &str, params: Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    /// Sends a request without waiting; gives its number.
    pub fn ask(&mut self, method: &str, params: Value) -> i64 {
        self.next += 1;
        self.send(&json!({ "jsonrpc": "2.0", "id": self.next, "method": method, "params": params }));
        self.next
    }

    /// The whole answer to the request of a number; answers come in order.
    pub fn answer(&mut self, id: i64) -> Value {
        loop {
            let message = self.read().expect("the server is there");
            match message.get("id") {
                Some(answered) => {
                    assert_eq!(answered, &json!(id), "{message}");
                    return message;
                }
                None => self.take(message),
            }
        }
    }

    /// The result of a request; the refusal where it is refused.
    pub fn request(&mut self, method: &str, params: Value) -> Value {
        let id = self.ask(method, params);
        let answer = self.answer(id);
        answer.get("result").or(answer.get("error")).cloned().unwrap()
    }

    fn take(&mut self, message: Value) {
        assert_eq!(message["method"], "textDocument/publishDiagnostics");
        let params = message["params"].clone();
        self.published
            .insert(params["uri"].as_str().unwrap().to_owned(), params);
    }

    /// Waits until something is published about an address.
    pub fn diagnostics(&mut self, uri: &str) -> Value {
        self.published.remove(uri);
        while !self.published.contains_key(uri) {
            let message = self.read().expect("the server is there");
            self.take(message);
        }
        self.published[uri]["diagnostics"].clone()
    }

    fn read(&mut self) -> Option<Value> {
        let mut length = 0;
        loop {
            let mut line = String::new();
            if self.output.read_line(&mut line).unwrap() == 0 {
                return None;
            }
            match line.trim_end().strip_prefix("Content-Length: ") {
                Some(number) => length = number.parse().unwrap(),
                None if line.trim_end().is_empty() => break,
                None => {}
            }
        }
        let mut body = vec![0; length];
        self.output.read_exact(&mut body).unwrap();
        Some(serde_json::from_slice(&body).unwrap())
    }

    pub fn open(&mut self, uri: &str, text: &str) {
        self.notify(
            "textDocument/didOpen",
            json!({ "textDocument": { "uri": uri, "languageId": "vpl", "version": 1, "text": text } }),
        );
    }

    /// Replaces a range, or everything.
    pub fn change(&mut self, uri: &str, version: i64, range: Option<Value>, text: &str) {
        let change = match range {
            Some(range) => json!({ "range": range, "text": text }),
            None => json!({ "text": text }),
        };
        self.notify(
            "textDocument/didChange",
            json!({ "textDocument": { "uri": uri, "version": version }, "contentChanges": [change] }),
        );
    }

    /// Ends the input; how the server ended.
    pub fn end(&mut self) -> ExitStatus {
        self.input = None;
        while self.read().is_some() {}
        self.process.wait().unwrap()
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// The position of a byte, in UTF-16.
pub fn position(text: &str, offset: usize) -> Value {
    let line = text[..offset].matches('\n').count();
    let start = text[..offset].rfind('\n').map_or(0, |n| n + 1);
    let character: usize = text[start..offset].chars().map(char::len_utf16).sum();
    json!({ "line": line, "character": character })
}

/// A document and a position in it.
pub fn at(uri: &str, text: &str, offset: usize) -> Value {
    json!({ "textDocument": { "uri": uri }, "position": position(text, offset) })
}
