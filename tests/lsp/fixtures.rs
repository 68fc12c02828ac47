//! Programs with cursors: what the server answers at each `‸`.
//!
//! The first line of a fixture says what is asked, `// ask: hover, definition`. Cursors
//! are taken out before the text is sent, and stand in the answers as they were.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::client::{Client, URI, at, position};

fn fixtures() -> Vec<PathBuf> {
    let entries = std::fs::read_dir("tests/lsp/fixtures").unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == "vpl"));
    paths.sort();
    paths
}

#[test]
fn the_server_answers_as_it_should() {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("fixtures");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    for path in fixtures() {
        let said = said(&path);
        let name = path.file_stem().unwrap().to_str().unwrap();
        settings.bind(|| insta::assert_snapshot!(name, said));
    }
}

fn said(path: &Path) -> String {
    let written = std::fs::read_to_string(path).unwrap();
    let text = written.replace('‸', "");
    let cursors: Vec<usize> = written
        .match_indices('‸')
        .enumerate()
        .map(|(k, (at, c))| at - k * c.len())
        .collect();
    let asked = written.lines().next().unwrap().strip_prefix("// ask: ").unwrap();
    let mut client = Client::new();
    client.open(URI, &text);
    let diagnostics = client.diagnostics(URI);
    let mut out = String::new();
    for what in asked.split(", ") {
        match what {
            "diagnostics" => out.push_str(&list(&diagnostics, &text, diagnostic)),
            "format" => {
                let answer = client.request("textDocument/formatting", json!({ "textDocument": { "uri": URI } }));
                out.push_str(&edits(&json!({ URI: answer }), &text));
            }
            "tokens" => out.push_str(&tokens(&mut client, &text)),
            "symbols" | "folds" | "hints" => out.push_str(&whole(&mut client, &text, what)),
            _ => {
                for cursor in &cursors {
                    let answer = answer(&mut client, &text, what, *cursor);
                    let _ = write!(out, "{what} at {}\n{answer}\n", shown(&text, *cursor));
                }
            }
        }
    }
    out
}

/// The line of a cursor with the cursor in it.
fn shown(text: &str, cursor: usize) -> String {
    let start = text[..cursor].rfind('\n').map_or(0, |n| n + 1);
    let end = text[cursor..].find('\n').map_or(text.len(), |n| cursor + n);
    format!("`{}‸{}`", text[start..cursor].trim_start(), &text[cursor..end])
}

fn answer(client: &mut Client, text: &str, what: &str, cursor: usize) -> String {
    let mut params = at(URI, text, cursor);
    match what {
        "hover" => {
            let answer = client.request("textDocument/hover", params);
            indented(answer["contents"]["value"].as_str().unwrap_or("nothing"))
        }
        "definition" => place(&client.request("textDocument/definition", params), text),
        "references" => {
            params["context"] = json!({ "includeDeclaration": true });
            list(&client.request("textDocument/references", params), text, place)
        }
        "highlight" => list(
            &client.request("textDocument/documentHighlight", params),
            text,
            |h, text| range(&h["range"], text),
        ),
        "completion" => completions(&client.request("textDocument/completion", params), text),
        "signature" => signature(&client.request("textDocument/signatureHelp", params)),
        "rename" => {
            params["newName"] = json!("renamed");
            renamed(&client.request("textDocument/rename", params), text)
        }
        "actions" => {
            let range = json!({ "start": position(text, cursor), "end": position(text, cursor) });
            let params = json!({ "textDocument": { "uri": URI }, "range": range, "context": { "diagnostics": [] } });
            list(
                &client.request("textDocument/codeAction", params),
                text,
                |action, text| {
                    format!(
                        "{}: {}",
                        action["title"].as_str().unwrap(),
                        edits(&action["edit"]["changes"], text)
                    )
                },
            )
        }
        _ => panic!("nothing is called {what}"),
    }
}

fn whole(client: &mut Client, text: &str, what: &str) -> String {
    let document = json!({ "textDocument": { "uri": URI } });
    match what {
        "symbols" => symbols(&client.request("textDocument/documentSymbol", document), 1),
        "folds" => list(
            &client.request("textDocument/foldingRange", document),
            text,
            |fold, _| {
                let kind = fold["kind"].as_str().unwrap_or("block");
                format!("{}..{} {kind}", fold["startLine"], fold["endLine"])
            },
        ),
        _ => {
            let all = json!({ "start": position(text, 0), "end": position(text, text.len()) });
            let params = json!({ "textDocument": { "uri": URI }, "range": all });
            list(&client.request("textDocument/inlayHint", params), text, |hint, text| {
                let line = hint["position"]["line"].as_u64().unwrap() as usize;
                format!(
                    "{} ⟵ {}",
                    text.lines().nth(line).unwrap().trim(),
                    hint["label"].as_str().unwrap()
                )
            })
        }
    }
}

fn list(all: &Value, text: &str, one: impl Fn(&Value, &str) -> String) -> String {
    match all.as_array() {
        Some(all) if all.is_empty() => "  nothing\n".to_owned(),
        Some(all) => all.iter().map(|item| format!("  {}\n", one(item, text))).collect(),
        None => format!("  {}\n", all["message"].as_str().unwrap_or("nothing")),
    }
}

fn indented(text: &str) -> String {
    text.lines().map(|line| format!("  {line}\n")).collect()
}

/// Lines and characters with the text under them.
fn range(range: &Value, text: &str) -> String {
    let (a, b) = (&range["start"], &range["end"]);
    let line = a["line"].as_u64().unwrap() as usize;
    let units: Vec<u16> = text.lines().nth(line).unwrap_or("").encode_utf16().collect();
    let (from, to) = (
        a["character"].as_u64().unwrap() as usize,
        b["character"].as_u64().unwrap() as usize,
    );
    let under = match b["line"].as_u64().unwrap() as usize {
        last if last == line => String::from_utf16_lossy(units.get(from..to).unwrap_or(&[])),
        _ => "…".to_owned(),
    };
    format!("{line}:{from} `{under}`")
}

fn place(location: &Value, text: &str) -> String {
    let Some(uri) = location["uri"].as_str() else {
        return format!("  {}\n", location["message"].as_str().unwrap_or("nothing"));
    };
    if uri == URI {
        return range(&location["range"], text);
    }
    let path = uri.strip_prefix("file://").unwrap();
    let text = std::fs::read_to_string(path).unwrap();
    let name = path.rsplit_once("/std/").map_or(path, |(_, name)| name);
    format!("std/{name} {}", range(&location["range"], &text))
}

fn diagnostic(diagnostic: &Value, text: &str) -> String {
    let severity = ["", "error", "warning", "information", "hint"][diagnostic["severity"].as_u64().unwrap() as usize];
    let related = diagnostic["relatedInformation"].as_array();
    let related = related.into_iter().flatten();
    let related: String = related
        .map(|r| {
            format!(
                "\n    related {} {}",
                place(&r["location"], text),
                r["message"].as_str().unwrap()
            )
        })
        .collect();
    let message = diagnostic["message"].as_str().unwrap().replace('\n', "\n    ");
    let tags = if diagnostic["tags"].is_null() {
        ""
    } else {
        " unnecessary"
    };
    format!(
        "{severity}[{}]{tags} {} {message}{related}",
        diagnostic["code"].as_str().unwrap(),
        range(&diagnostic["range"], text)
    )
}

fn completions(answer: &Value, text: &str) -> String {
    list(&answer["items"], text, |item, text| {
        let inserted = item["textEdit"]["newText"].as_str().unwrap();
        let label = item["label"].as_str().unwrap();
        let inserted = if inserted == label {
            String::new()
        } else {
            format!(" inserts {inserted:?}")
        };
        let import = item["additionalTextEdits"][0]["newText"].as_str();
        let import = import.map_or(String::new(), |line| format!(" and {line:?}"));
        let detail = item["detail"].as_str().map_or(String::new(), |d| format!("  {d}"));
        let replaced = range(&item["textEdit"]["range"], text);
        let replaced = if replaced.ends_with("``") {
            String::new()
        } else {
            format!(" for {replaced}")
        };
        format!("{label}{detail}{inserted}{import}{replaced}")
    })
}

fn signature(answer: &Value) -> String {
    let Some(signature) = answer["signatures"].get(0) else {
        return "  nothing\n".to_owned();
    };
    let label = signature["label"].as_str().unwrap();
    let active = answer["activeParameter"]
        .as_u64()
        .map(|k| &signature["parameters"][k as usize]);
    let active = active.map_or(String::from("none"), |parameter| {
        let at = |k: usize| parameter["label"][k].as_u64().unwrap() as usize;
        let docs = parameter["documentation"]["value"].as_str().unwrap_or("");
        format!("`{}` {docs}", &label[at(0)..at(1)])
    });
    format!("  {label}\n  {active}\n")
}

fn renamed(answer: &Value, text: &str) -> String {
    match answer["message"].as_str() {
        Some(why) => format!("  refused: {why}\n"),
        None => format!("  {}\n", edits(&answer["changes"], text)),
    }
}

fn edits(changes: &Value, text: &str) -> String {
    let Some(files) = changes.as_object() else {
        return "nothing".to_owned();
    };
    let edits = files
        .iter()
        .flat_map(|(uri, edits)| edits.as_array().unwrap().iter().map(move |e| (uri, e)));
    let edits = edits.map(|(uri, edit)| {
        assert_eq!(uri, URI);
        format!(
            "{} → {:?}",
            range(&edit["range"], text),
            edit["newText"].as_str().unwrap()
        )
    });
    edits.collect::<Vec<_>>().join(", ")
}

fn symbols(all: &Value, depth: usize) -> String {
    let all = all.as_array().into_iter().flatten();
    all.map(|symbol| {
        let (a, b) = (&symbol["range"]["start"]["line"], &symbol["range"]["end"]["line"]);
        let detail = symbol["detail"].as_str().map_or(String::new(), |d| format!(" : {d}"));
        let name = symbol["name"].as_str().unwrap();
        let children = symbols(&symbol["children"], depth + 1);
        format!(
            "{}{name}{detail}, kind {}, lines {a}..{b}\n{children}",
            "  ".repeat(depth),
            symbol["kind"]
        )
    })
    .collect()
}

/// Every word with its meaning, a line each.
fn tokens(client: &mut Client, text: &str) -> String {
    let legend = [
        "keyword",
        "type",
        "namespace",
        "property",
        "class",
        "struct",
        "function",
        "parameter",
        "variable",
        "enumMember",
        "unit",
        "number",
        "string",
        "comment",
        "operator",
    ];
    let answer = client.request(
        "textDocument/semanticTokens/full",
        json!({ "textDocument": { "uri": URI } }),
    );
    let data: Vec<usize> = answer["data"]
        .as_array()
        .unwrap()
        .iter()
        .map(|n| n.as_u64().unwrap() as usize)
        .collect();
    let (mut line, mut start) = (0, 0);
    let mut out = String::new();
    for token in data.chunks(5) {
        start = if token[0] == 0 { start + token[1] } else { token[1] };
        line += token[0];
        let units: Vec<u16> = text.lines().nth(line).unwrap().encode_utf16().collect();
        let word = String::from_utf16_lossy(&units[start..start + token[2]]);
        let modifiers = [(1, " declared"), (2, " standard"), (4, " documents")];
        let modifiers = modifiers
            .iter()
            .filter(|(bit, _)| token[4] & bit != 0)
            .map(|(_, name)| *name);
        let _ = writeln!(
            out,
            "  {line} {word:?} {}{}",
            legend[token[3]],
            modifiers.collect::<String>()
        );
    }
    out
}
