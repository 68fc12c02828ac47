//! What holds for every program: the examples, the standard library, and broken ones.

use super::*;
use crate::lang::syntax::TokenClass;
use crate::lang::{Memory, vocabulary};

const EXAMPLES: [(&str, &str); 2] = [
    ("solids.vpl", include_str!("../../examples/solids/solids.vpl")),
    ("tanks.vpl", include_str!("../../examples/tanks/tanks.vpl")),
];

fn programs() -> impl Iterator<Item = (&'static str, &'static str)> {
    EXAMPLES.into_iter().chain(vocabulary::modules())
}

fn snapshot(name: &str, text: &str) -> Snapshot {
    Snapshot::new(name, &Memory::of(name, text))
}

#[test]
fn every_word_of_a_right_program_denotes_something() {
    for (name, text) in programs() {
        let snapshot = snapshot(name, text);
        let words = [TokenClass::Name, TokenClass::Callee, TokenClass::Type, TokenClass::Hole];
        for token in snapshot.tokens().iter().filter(|t| words.contains(&t.class)) {
            let word = token.text(text);
            let found = snapshot.index().at(MAIN, token.end - 1);
            let inside = found.is_some_and(|o| o.span.start <= token.end && token.start <= o.span.end);
            // `none` and `text "…"` are forms, and no names.
            assert!(inside || word == "none", "{name}: `{word}` at {}", token.start);
        }
    }
}

#[test]
fn names_do_not_overlap_and_stand_where_they_are_written() {
    for (name, text) in programs() {
        let snapshot = snapshot(name, text);
        for pair in snapshot.index().of(MAIN).windows(2) {
            assert!(pair[0].span.end <= pair[1].span.start, "{name}: {pair:?}");
        }
    }
}

#[test]
fn everything_declared_is_described() {
    for (name, text) in programs() {
        let snapshot = snapshot(name, text);
        for declared in snapshot.index().of(MAIN).iter().filter(|o| o.declares) {
            let word = snapshot.sources().text(declared.span);
            let hover = hover(&snapshot, declared.span.start);
            assert!(hover.is_some_and(|h| h.markdown.contains(word)), "{name}: `{word}`");
        }
    }
}

#[test]
fn a_renamed_program_is_the_same_program() {
    for (name, text) in EXAMPLES {
        let world = Memory::of(name, text);
        let snapshot = snapshot(name, text);
        let declared: Vec<_> = snapshot.index().of(MAIN).iter().filter(|o| o.declares).collect();
        for declared in declared.iter().step_by(7) {
            let places = rename(&[&snapshot], &world, declared.span.start, "renamed_1").unwrap();
            let mut changed = text.to_owned();
            for range in places[name].iter().rev() {
                changed.replace_range(range.clone(), "renamed_1");
            }
            let after = Snapshot::new(name, &Memory::of(name, &changed));
            assert_eq!(after.mistakes(), 0, "{name}: {changed}");
        }
    }
}

#[test]
fn an_unfinished_statement_costs_itself_alone() {
    let whole = EXAMPLES[1].1;
    let cut = whole.replace("    measure marker_pose()", "    measure ");
    let broken = snapshot("tanks.vpl", &cut);
    let known = |s: &Snapshot| s.index().of(MAIN).len();
    let lost = known(&snapshot("tanks.vpl", whole)) - known(&broken);
    assert!((1..=2).contains(&lost), "{lost} names are lost");
    let (_, offers) = complete(&broken, &Memory::default(), cut.find("    measure ").unwrap() + 12);
    let labels: Vec<&str> = offers.iter().map(|o| o.label.as_str()).collect();
    assert_eq!(labels, ["marker_pose"]);
}
