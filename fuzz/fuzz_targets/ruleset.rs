//! What is read as a rule set is written as the same, and plans or says why not.

#![no_main]

use libfuzzer_sys::fuzz_target;
use vpl::rules::RuleSet;

fuzz_target!(|text: &str| {
    if let Ok(rules) = RuleSet::from_json(text) {
        let again = RuleSet::from_json(&rules.to_json()).expect("what is written can be read");
        assert_eq!(again.to_json(), rules.to_json());
    }
});
