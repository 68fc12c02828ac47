//! Random edits of the examples, each followed by every request at a random place: no
//! crash, and every answer in its turn.

use serde_json::{Value, json};

use super::client::{Client, URI, position};

const EXAMPLES: [&str; 2] = [
    include_str!("../../examples/tanks/tanks.vpl"),
    include_str!("../../examples/solids/solids.vpl"),
];
const PIECES: &[&str] = &[
    "",
    "",
    "",
    "{",
    "}",
    "(",
    ")",
    "[",
    "]",
    "\"",
    "//",
    "\n",
    "\r\n",
    "\r",
    ";",
    ".",
    ",",
    ":",
    "->",
    "1",
    "10 mm",
    "😀",
    "ä",
    "\0",
    "library x {",
    "rule -> code[i] {",
    "feature",
    "for each e in ",
    "let a(",
    "use std.",
    "detect ",
    "code[",
    "test \"",
    "prior 3",
    "classes by",
    "{i}",
];
const METHODS: &[&str] = &[
    "hover",
    "completion",
    "signatureHelp",
    "definition",
    "references",
    "documentHighlight",
    "prepareRename",
    "rename",
    "documentSymbol",
    "foldingRange",
    "semanticTokens/full",
    "inlayHint",
    "codeAction",
    "formatting",
];

/// A small generator: the same numbers everywhere.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % n.max(1)
    }
}

fn boundary(text: &str, at: usize) -> usize {
    (at..=text.len())
        .find(|k| text.is_char_boundary(*k))
        .unwrap_or(text.len())
}

#[test]
fn random_edits_are_survived() {
    let mut random = Random(7);
    let mut client = Client::new();
    for (k, example) in EXAMPLES.iter().enumerate() {
        let mut text = (*example).to_owned();
        client.open(URI, &text);
        for round in 0..20 {
            let start = random.below(text.len());
            let start = boundary(&text, start);
            let end = boundary(&text, (start + random.below(12)).min(text.len()));
            let piece = PIECES[random.below(PIECES.len())];
            let range = json!({ "start": units(&text, start), "end": units(&text, end) });
            text.replace_range(start..end, piece);
            client.change(URI, round, Some(range), piece);
            let at = boundary(&text, random.below(text.len() + 1));
            let asked: Vec<i64> = METHODS
                .iter()
                .map(|m| client.ask(&format!("textDocument/{m}"), params(&text, at)))
                .collect();
            for (id, method) in asked.into_iter().zip(METHODS) {
                let answer = client.answer(id);
                let code = answer["error"]["code"].as_i64();
                let refused = matches!(*method, "rename" | "prepareRename") && code == Some(-32803);
                assert!(
                    code.is_none() || refused,
                    "example {k}, round {round}, {method}: {answer}\n{text}"
                );
            }
        }
    }
}

/// As the server counts: a lone `\r` ends a line, too.
fn units(text: &str, offset: usize) -> Value {
    let before = &text[..offset];
    if !text.contains('\r') {
        return position(text, offset);
    }
    let bytes = text.as_bytes();
    let ends = |k: &usize| bytes[*k] == b'\n' || (bytes[*k] == b'\r' && bytes.get(k + 1) != Some(&b'\n'));
    let lines: Vec<usize> = (0..before.len()).filter(ends).collect();
    let start = lines.last().map_or(0, |k| k + 1);
    let character: usize = before[start..].chars().map(char::len_utf16).sum();
    json!({ "line": lines.len(), "character": character })
}

fn params(text: &str, at: usize) -> Value {
    let here = units(text, at);
    json!({
        "textDocument": { "uri": URI },
        "position": here,
        "range": { "start": here, "end": units(text, text.len()) },
        "context": { "includeDeclaration": true, "diagnostics": [] },
        "newName": "renamed",
    })
}
