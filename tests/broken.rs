//! A corpus of broken programs, as people write them: one kind of mistake a file.
//!
//! A file begins with what must be said about it, a line each in the order of the text:
//! `// line 9: E0302 needs a unit`. That and nothing else is said, so that the first
//! message names the true cause, independent mistakes are all found, and no mistake is
//! reported by its consequences.

use std::path::PathBuf;

use vpl::lang::{self, Diagnostic, Memory, Severity, SourceMap};

/// Something that must be said.
#[derive(Debug)]
struct Expectation {
    line: usize,
    code: String,
    phrase: String,
}

fn corpus() -> Vec<PathBuf> {
    let entries = std::fs::read_dir("tests/broken").unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == "vpl"));
    paths.sort();
    paths
}

fn expectations(text: &str) -> Vec<Expectation> {
    let lines = text.trim_start_matches('\u{feff}').lines();
    lines
        .map_while(|line| expectation(line.strip_prefix("// line ")?))
        .collect()
}

fn expectation(rest: &str) -> Option<Expectation> {
    let (line, rest) = rest.split_once(": ")?;
    let (code, phrase) = rest.split_once(' ')?;
    Some(Expectation {
        line: line.parse().ok()?,
        code: code.to_owned(),
        phrase: phrase.to_owned(),
    })
}

fn meets(found: &Diagnostic, expected: &Expectation, sources: &SourceMap) -> bool {
    let at = found.primary.span;
    let line = sources.get(at.file).map(|f| f.line_column(at.start).0);
    let help = found.help.as_deref().unwrap_or("");
    line == Some(expected.line)
        && found.code.to_string() == expected.code
        && (found.message.contains(&expected.phrase) || help.contains(&expected.phrase))
}

#[test]
fn the_true_cause_is_named_and_nothing_else() {
    let mut wrong = Vec::new();
    for path in corpus() {
        let name = path.display().to_string();
        let text = String::from_utf8(std::fs::read(&path).unwrap()).unwrap();
        let expected = expectations(&text);
        assert!(!expected.is_empty(), "{name} expects nothing");
        let compiled = lang::compile("main.vpl", &Memory::of("main.vpl", &text));
        let said: Vec<&Diagnostic> = (compiled.diagnostics.iter())
            .filter(|d| d.severity != Severity::Note)
            .collect();
        let right =
            said.len() == expected.len() && said.iter().zip(&expected).all(|(d, e)| meets(d, e, &compiled.sources));
        if !right {
            let short = lang::render(&compiled.diagnostics, &compiled.sources, lang::Format::Short);
            wrong.push(format!("{name} expects {expected:#?}, and this is said:\n{short}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_corpus_is_large_and_its_kinds_are_many() {
    let texts: Vec<String> = (corpus().iter()).map(|p| std::fs::read_to_string(p).unwrap()).collect();
    assert!(texts.len() >= 60);
    let kinds: std::collections::BTreeSet<(String, String)> = (texts.iter())
        .filter_map(|text| expectations(text).into_iter().next())
        .map(|e| (e.code, e.phrase))
        .collect();
    assert!(kinds.len() >= 60, "{} kinds", kinds.len());
}
