//! Every text compiles or says why not, in every form; fixes never make it worse to read.

#![no_main]

use libfuzzer_sys::fuzz_target;
use vpl::lang::{Format, Memory, compile, render};

fuzz_target!(|text: &str| {
    let compiled = compile("main.vpl", &Memory::of("main.vpl", text));
    assert_eq!(compiled.rules.is_some(), !compiled.has_errors());
    let human = Format::Human { colour: true, width: 80 };
    for format in [human, Format::Plain, Format::Short, Format::Json, Format::Sarif] {
        let _ = render(&compiled.diagnostics, &compiled.sources, format);
    }
    if let Some(rules) = compiled.rules {
        let again = vpl::rules::RuleSet::from_json(&rules.to_json()).expect("what is written can be read");
        assert_eq!(again, rules);
    }
});
