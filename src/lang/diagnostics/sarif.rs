//! SARIF 2.1.0: one log of one run, for code hosts and dashboards. Places are in
//! lines and columns of code points, from 1, and in bytes.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::{Code, Diagnostic, Fix, Label, page, title};
use crate::lang::source::{FileId, SourceFile, SourceMap, Span};

const SCHEMA: &str = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json";
/// Names the folder of the files that are shipped inside the program.
const SHIPPED: &str = "STDLIB";

pub(super) fn log(diagnostics: &[Diagnostic], sources: &SourceMap) -> String {
    let log = Log::new(diagnostics, sources);
    let results: Vec<Value> = diagnostics.iter().map(|d| log.result(d)).collect();
    let value = json!({
        "$schema": SCHEMA,
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": {
                "name": "vpl",
                "fullName": "vpl, View Planning Language",
                "version": env!("CARGO_PKG_VERSION"),
                "semanticVersion": env!("CARGO_PKG_VERSION"),
                "rules": log.rules.iter().map(|code| rule(*code)).collect::<Vec<_>>(),
            }},
            "originalUriBaseIds": {
                SHIPPED: { "description": text("the standard library, shipped inside the program") },
            },
            "columnKind": "unicodeCodePoints",
            "artifacts": log.artifacts.iter().map(|file| artifact(file)).collect::<Vec<_>>(),
            "results": results,
        }],
    });
    format!("{value:#}\n")
}

/// The codes and files that results point to by their number.
struct Log<'a> {
    sources: &'a SourceMap,
    rules: Vec<Code>,
    artifacts: Vec<&'a SourceFile>,
    /// Programs that share a module have it once each in the sources, here once in all.
    indices: BTreeMap<FileId, usize>,
}

impl<'a> Log<'a> {
    fn new(diagnostics: &[Diagnostic], sources: &'a SourceMap) -> Self {
        let mut rules: Vec<Code> = diagnostics.iter().map(|d| d.code).collect();
        rules.sort();
        rules.dedup();
        let mut log = Self {
            sources,
            rules,
            artifacts: Vec::new(),
            indices: BTreeMap::new(),
        };
        for (id, file) in sources.files() {
            let same = |known: &&SourceFile| known.display == file.display && known.is_shipped() == file.is_shipped();
            let index = log.artifacts.iter().position(same);
            log.indices.insert(id, index.unwrap_or(log.artifacts.len()));
            if index.is_none() {
                log.artifacts.push(file);
            }
        }
        log
    }

    fn result(&self, d: &Diagnostic) -> Value {
        let help = d
            .help
            .as_ref()
            .map(|help| format!("\nhelp: {help}"))
            .unwrap_or_default();
        let mut result = json!({
            "ruleId": d.code.as_str(),
            "ruleIndex": self.rules.binary_search(&d.code).unwrap_or_default(),
            "level": d.severity.word(),
            "message": text(&format!("{}{help}", d.message)),
            "locations": [self.location(&d.primary)],
        });
        if !d.related.is_empty() {
            result["relatedLocations"] = d.related.iter().map(|label| self.location(label)).collect();
        }
        if !d.fixes.is_empty() {
            result["fixes"] = d.fixes.iter().map(|fix| self.fix(fix)).collect();
        }
        result
    }

    fn location(&self, label: &Label) -> Value {
        let mut physical = json!({ "artifactLocation": self.artifact_location(label.span.file) });
        if let Some(region) = self.region(label.span) {
            physical["region"] = region;
        }
        let mut location = json!({ "physicalLocation": physical });
        if !label.text.is_empty() {
            location["message"] = text(&label.text);
        }
        location
    }

    fn artifact_location(&self, file: FileId) -> Value {
        let index = self.indices.get(&file).copied().unwrap_or_default();
        let Some(file) = self.artifacts.get(index) else {
            return json!({});
        };
        let mut location = uri_of(file);
        location["index"] = json!(index);
        location
    }

    fn region(&self, span: Span) -> Option<Value> {
        let file = self.sources.get(span.file)?;
        let (line, column) = file.line_column(span.start);
        let (end_line, end_column) = file.line_column(span.end);
        Some(json!({
            "startLine": line,
            "startColumn": column,
            "endLine": end_line,
            "endColumn": end_column,
            "byteOffset": span.start,
            "byteLength": span.end.saturating_sub(span.start),
        }))
    }

    /// The edits of a fix, those of one file together.
    fn fix(&self, fix: &Fix) -> Value {
        let mut changes: BTreeMap<FileId, Vec<Value>> = BTreeMap::new();
        for edit in &fix.edits {
            let mut replacement = json!({ "deletedRegion": self.region(edit.span).unwrap_or_default() });
            if !edit.text.is_empty() {
                // The new text is data, no message: braces stand for themselves.
                replacement["insertedContent"] = json!({ "text": edit.text });
            }
            changes.entry(edit.span.file).or_default().push(replacement);
        }
        let change = |(file, replacements): (FileId, Vec<Value>)| json!({ "artifactLocation": self.artifact_location(file), "replacements": replacements });
        json!({
            "description": text(&fix.message),
            "artifactChanges": changes.into_iter().map(change).collect::<Vec<_>>(),
        })
    }
}

fn rule(code: Code) -> Value {
    let page = page(code);
    json!({
        "id": code.as_str(),
        "shortDescription": text(title(code)),
        "help": { "text": escaped(page), "markdown": escaped(page) },
        "defaultConfiguration": { "level": code.severity().word() },
    })
}

fn artifact(file: &SourceFile) -> Value {
    json!({
        "location": uri_of(file),
        "length": file.text.len(),
        "encoding": "UTF-8",
        "sourceLanguage": "vpl",
        "hashes": { "sha-256": file.sha256() },
    })
}

fn uri_of(file: &SourceFile) -> Value {
    let uri = uri(&file.display);
    if file.is_shipped() {
        return json!({ "uri": uri, "uriBaseId": SHIPPED });
    }
    json!({ "uri": uri })
}

/// A path as a reference: relative as it is, absolute with its scheme.
fn uri(path: &str) -> String {
    let path = path.replace('\\', "/");
    let drive = path.as_bytes().get(1) == Some(&b':');
    let mut out = String::from(match path.starts_with('/') {
        true => "file://",
        false if drive => "file:///",
        false => "",
    });
    for byte in path.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' | b'/' => out.push(char::from(byte)),
            _ => out.push_str(&format!("%{byte:02X}")),
        }
    }
    out
}

/// A message. Braces mark placeholders in one (§3.11.5), so literal ones are doubled.
fn text(text: &str) -> Value {
    json!({ "text": escaped(text) })
}

fn escaped(text: &str) -> String {
    text.replace('{', "{{").replace('}', "}}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_become_references() {
        assert_eq!(uri("a b/ä.vpl"), "a%20b/%C3%A4.vpl");
        assert_eq!(uri("/tmp/a.vpl"), "file:///tmp/a.vpl");
        assert_eq!(uri("C:\\parts\\a.vpl"), "file:///C%3A/parts/a.vpl");
        assert_eq!(uri("-"), "-");
    }

    #[test]
    fn braces_of_messages_are_no_placeholders() {
        assert_eq!(
            text("add `rule -> a { … }`"),
            json!({ "text": "add `rule -> a {{ … }}`" })
        );
    }
}
