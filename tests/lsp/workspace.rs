//! Several files: imports, their diagnostics, and names that cross them.

use std::path::PathBuf;

use serde_json::{Value, json};

use super::client::{Client, at};

const PARTS: &str = "vpl 1\n\n/// As high as a box.\nlet height = 300 mm\n";
const MAIN: &str = "vpl 1\nuse \"parts.vpl\".height\nlet double = height * 2\n";

/// A folder of its own with two files.
fn folder(name: &str) -> (PathBuf, String, String) {
    let folder = std::env::temp_dir().join(format!("vpl-lsp-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("parts.vpl"), PARTS).unwrap();
    std::fs::write(folder.join("main.vpl"), MAIN).unwrap();
    let uri = |file: &str| format!("file://{}", folder.join(file).display());
    let (main, parts) = (uri("main.vpl"), uri("parts.vpl"));
    (folder, main, parts)
}

fn rooted(folder: &std::path::Path) -> Client {
    let uri = format!("file://{}", folder.display());
    Client::with(json!({ "capabilities": {}, "workspaceFolders": [{ "uri": uri, "name": "f" }] }))
}

#[test]
fn an_edit_of_an_import_checks_what_imports_it() {
    let (folder, main, parts) = folder("import");
    let mut client = Client::new();
    client.open(&main, MAIN);
    assert_eq!(client.diagnostics(&main), json!([]));
    client.open(&parts, PARTS);
    client.diagnostics(&parts);
    client.change(&parts, 2, None, "vpl 1\nlet width = 1 mm\n");
    let said = client.diagnostics(&main);
    assert_eq!(said[0]["code"], "E0204", "{said}");
    // Closed, the file on disk counts again.
    client.notify("textDocument/didClose", json!({ "textDocument": { "uri": parts } }));
    assert_eq!(client.diagnostics(&main), json!([]));
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn what_is_wrong_in_an_import_is_published_there_and_taken_back() {
    let (folder, main, parts) = folder("published");
    std::fs::write(
        folder.join("parts.vpl"),
        "vpl 1\nlet height = 300 mm\nlet x = nowhere\n",
    )
    .unwrap();
    let mut client = Client::new();
    client.open(&main, MAIN);
    assert_eq!(client.diagnostics(&parts)[0]["code"], "E0201");
    client.notify("textDocument/didClose", json!({ "textDocument": { "uri": main } }));
    assert_eq!(client.diagnostics(&parts), json!([]));
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_file_that_vanishes_is_said_to() {
    let (folder, main, _) = folder("vanishes");
    let mut client = Client::new();
    client.open(&main, MAIN);
    assert_eq!(client.diagnostics(&main), json!([]));
    std::fs::remove_dir_all(&folder).unwrap();
    client.notify("workspace/didChangeWatchedFiles", json!({ "changes": [] }));
    assert_eq!(client.diagnostics(&main)[0]["code"], "E0105");
}

#[test]
fn names_are_found_and_renamed_across_files_that_are_not_open() {
    let (folder, main, parts) = folder("renamed");
    let mut client = rooted(&folder);
    client.open(&parts, PARTS);
    let declared = PARTS.find("height =").unwrap();
    let mut params = at(&parts, PARTS, declared);
    params["context"] = json!({ "includeDeclaration": false });
    let found = client.request("textDocument/references", params);
    let uris: Vec<&str> = found
        .as_array()
        .unwrap()
        .iter()
        .map(|l| l["uri"].as_str().unwrap())
        .collect();
    assert_eq!(uris, [main.as_str(), main.as_str()]);
    let mut params = at(&parts, PARTS, declared);
    params["newName"] = json!("tallness");
    let changes = client.request("textDocument/rename", params)["changes"].clone();
    let edits = |uri: &str| changes[uri].as_array().map_or(0, Vec::len);
    assert_eq!((edits(&parts), edits(&main)), (1, 2), "{changes}");
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_name_that_means_something_in_another_file_is_refused() {
    let (folder, main, parts) = folder("refused");
    let mut client = Client::new();
    client.open(&main, MAIN);
    client.open(&parts, PARTS);
    let mut params = at(&parts, PARTS, PARTS.find("height =").unwrap());
    params["newName"] = json!("double");
    let refused: Value = client.request("textDocument/rename", params);
    assert!(
        refused["message"].as_str().unwrap().contains("already means something"),
        "{refused}"
    );
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_module_of_the_standard_library_opens_as_a_file() {
    let (folder, main, _) = folder("standard");
    let text = "vpl 1\nuse std.views.sphere\nlet v = sphere(radius: 1 m, count: 8)\n";
    let mut client = Client::new();
    client.open(&main, text);
    let found = client.request(
        "textDocument/definition",
        at(&main, text, text.find("sphere(").unwrap()),
    );
    let path = found["uri"].as_str().unwrap().strip_prefix("file://").unwrap();
    let copy = std::fs::read_to_string(path).unwrap();
    let line = copy
        .lines()
        .nth(found["range"]["start"]["line"].as_u64().unwrap() as usize)
        .unwrap();
    assert!(line.starts_with("let sphere("), "{line}");
    assert!(copy.lines().next().unwrap().contains("a copy to read"));
    assert!(std::fs::metadata(path).unwrap().permissions().readonly());
    // The copy itself is no program to change.
    let uri = found["uri"].as_str().unwrap();
    client.open(uri, &copy);
    let mut params = at(uri, &copy, copy.find("sphere(").unwrap());
    params["newName"] = json!("ball");
    assert!(client.request("textDocument/rename", params)["message"].is_string());
    std::fs::remove_dir_all(folder).unwrap();
}
