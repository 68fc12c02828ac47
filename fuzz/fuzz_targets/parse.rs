//! The strict and the tolerant grammar agree, and spans and tokens cut no character.

#![no_main]

use libfuzzer_sys::fuzz_target;
use vpl::lang::{FileId, syntax, tokens};

fuzz_target!(|text: &str| {
    let strict = syntax::strictly_accepts(text);
    assert_eq!(strict, syntax::tolerantly_accepts(text));
    let (tree, found) = syntax::parse(FileId(0), text);
    assert!(!strict || (tree.bad.is_empty() && tree.edition.is_some()));
    assert!(strict || !found.is_empty() || tree.edition.is_none());
    for diagnostic in &found {
        let span = diagnostic.primary.span;
        assert!(text.get(span.start..span.end).is_some(), "{span:?} cuts a character");
    }
    let mut end = 0;
    for token in tokens(text) {
        assert!(token.start >= end && token.end > token.start);
        assert!(text.get(token.start..token.end).is_some());
        end = token.end;
    }
});
