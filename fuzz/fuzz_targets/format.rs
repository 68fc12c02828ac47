//! A formatted program is formatted already, and means what it meant.

#![no_main]

use libfuzzer_sys::fuzz_target;
use vpl::lang::{Memory, TokenClass, compile, format, tokens};

/// What a program says, without its layout. A semicolon may become a line's end, and a
/// comma that only trails may come and go.
fn words(text: &str) -> Vec<&str> {
    let kept = tokens(text).into_iter().filter(|t| t.class != TokenClass::Newline);
    kept.map(|t| text[t.start..t.end].trim()).filter(|word| ![",", ";"].contains(word)).collect()
}

fuzz_target!(|text: &str| {
    let formatted = format(text);
    assert_eq!(format(&formatted.text).text, formatted.text, "formatted twice");
    assert_eq!(words(text), words(&formatted.text), "another program");
    let meaning = |text: &str| {
        let compiled = compile("main.vpl", &Memory::of("main.vpl", text));
        (compiled.has_errors(), compiled.rules.map(|rules| (rules.libraries.len(), rules.tasks.len())))
    };
    assert_eq!(meaning(text), meaning(&formatted.text));
});
