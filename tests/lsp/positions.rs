//! Positions: UTF-16 unless the client asks for UTF-8, any line end, any number.

use serde_json::{Value, json};

use super::client::{Client, URI};

const TEXT: &str = "vpl 1\r\n/// Größe 😀\r\nlet größe = 1\r\nlet b😀 = 2\r\n";

fn hover(client: &mut Client, line: u64, character: u64) -> Value {
    let params = json!({ "textDocument": { "uri": URI }, "position": { "line": line, "character": character } });
    client.request("textDocument/hover", params)
}

#[test]
fn edits_count_code_units() {
    let text = "vpl 1\n// 😀ä x\nlet a = 1 mm\n";
    for (encoding, before) in [("utf-16", 7), ("utf-8", 10)] {
        let mut client = Client::with(json!({ "capabilities": { "general": { "positionEncodings": [encoding] } } }));
        client.open(URI, text);
        assert_eq!(client.diagnostics(URI), json!([]));
        // The `x` of the comment becomes a line with a mistake.
        let range =
            json!({ "start": { "line": 1, "character": before }, "end": { "line": 1, "character": before + 1 } });
        client.change(URI, 2, Some(range), "y\nlet b = nowhere");
        let said = client.diagnostics(URI);
        assert_eq!(
            said[0]["range"]["start"],
            json!({ "line": 2, "character": 8 }),
            "{encoding}"
        );
        let name = hover(&mut client, 3, 4);
        assert_eq!(name["range"]["end"], json!({ "line": 3, "character": 5 }), "{encoding}");
    }
}

#[test]
fn lines_end_in_every_way() {
    let mut client = Client::new();
    client.open(URI, "vpl 1\rlet a = 1 mm\r\nlet b = a\n");
    assert_eq!(client.diagnostics(URI), json!([]));
    let name = hover(&mut client, 2, 8);
    assert!(
        name["contents"]["value"].as_str().unwrap().contains("let a -> length"),
        "{name}"
    );
}

#[test]
fn positions_out_of_range_are_harmless() {
    let mut client = Client::new();
    client.open(URI, TEXT);
    for (line, character) in [(0, 99), (99, 0), (4_294_967_295, 4_294_967_295), (3, 6)] {
        let answer = hover(&mut client, line, character);
        assert!(answer["code"].is_null(), "{answer}");
    }
    let beyond = json!({ "start": { "line": 9, "character": 9 }, "end": { "line": 0, "character": 4 } });
    client.change(URI, 2, Some(beyond), " 1\n");
    assert!(hover(&mut client, 0, 0)["contents"].is_object());
}
