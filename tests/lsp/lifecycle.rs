//! Beginning, ending, and what is no request at all.

use serde_json::json;

use super::client::{Client, URI, at};

#[test]
fn shutdown_and_exit_end_it_with_zero() {
    let mut client = Client::new();
    assert!(client.request("shutdown", json!(null)).is_null());
    assert_eq!(client.request("textDocument/hover", at(URI, "", 0))["code"], -32600);
    client.notify("exit", json!(null));
    assert_eq!(client.end().code(), Some(0));
}

#[test]
fn exit_or_the_end_of_the_input_alone_is_one() {
    let mut client = Client::new();
    client.notify("exit", json!(null));
    assert_eq!(client.end().code(), Some(1));
    assert_eq!(Client::new().end().code(), Some(1));
    assert_eq!(Client::started().end().code(), Some(1));
}

#[test]
fn nothing_is_answered_before_initialize() {
    let mut client = Client::started();
    client.open(URI, "vpl 1\n");
    assert_eq!(client.request("textDocument/hover", at(URI, "", 0))["code"], -32002);
    assert!(client.request("initialize", json!([]))["capabilities"].is_object());
    assert_eq!(client.request("initialize", json!({}))["code"], -32600);
}

#[test]
fn what_is_malformed_is_passed_over() {
    let mut client = Client::new();
    client.raw(b"nonsense\r\n\r\n");
    client.raw(b"Content-Length: 3\r\n\r\n{]}");
    client.raw(b"Content-Length: x\r\n\r\n");
    client.raw("Content-Length: 7\r\n\r\n{\"é\":1".as_bytes());
    client.notify("textDocument/didOpen", json!({ "textDocument": 7 }));
    client.notify("textDocument/didChange", json!(null));
    client.notify("no/such", json!([1, 2]));
    assert_eq!(client.request("no/such", json!({}))["code"], -32601);
    assert_eq!(client.request("textDocument/hover", json!({ "x": 1 }))["code"], -32602);
    assert!(
        client
            .request("textDocument/hover", at("file:///closed.vpl", "", 0))
            .is_null()
    );
    assert!(client.request("shutdown", json!(null)).is_null());
}
