//! JSON: one array of objects. Offsets in bytes, lines and columns from 1.

use serde_json::{Value, json};

use super::Diagnostic;
use crate::lang::source::{SourceMap, Span};

pub(super) fn array(diagnostics: &[Diagnostic], sources: &SourceMap) -> String {
    let all: Vec<Value> = diagnostics.iter().map(|d| one(d, sources)).collect();
    format!("{:#}\n", Value::Array(all))
}

fn one(d: &Diagnostic, sources: &SourceMap) -> Value {
    let mut value = json!({
        "code": d.code.as_str(),
        "severity": d.severity.word(),
        "message": d.message,
        "help": d.help,
    });
    merge(&mut value, place(d.primary.span, sources));
    value["label"] = json!(d.primary.text);
    value["related"] = d
        .related
        .iter()
        .map(|l| with(place(l.span, sources), "message", &l.text))
        .collect();
    value["fixes"] = d
        .fixes
        .iter()
        .map(|fix| {
            let edits: Vec<Value> = fix
                .edits
                .iter()
                .map(|e| with(place(e.span, sources), "text", &e.text))
                .collect();
            json!({ "message": fix.message, "edits": edits })
        })
        .collect();
    value
}

fn place(span: Span, sources: &SourceMap) -> Value {
    let Some(file) = sources.get(span.file) else {
        return json!({ "file": null });
    };
    let point = |offset: usize| {
        let (line, column) = file.line_column(offset);
        json!({ "line": line, "column": column, "offset": offset })
    };
    json!({ "file": file.display, "start": point(span.start), "end": point(span.end) })
}

fn with(mut value: Value, key: &str, text: &str) -> Value {
    value[key] = json!(text);
    value
}

fn merge(into: &mut Value, from: Value) {
    if let (Value::Object(into), Value::Object(from)) = (into, from) {
        into.extend(from);
    }
}
