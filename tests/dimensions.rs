//! Every type where every other is due: the message names both.

use vpl::lang::{Code, Diagnostic, Memory, compile};

/// Types of parameters, in words, with a literal where there is one.
const TYPES: &[(&str, &str, Option<&str>)] = &[
    ("length", "a length", Some("12 mm")),
    ("angle", "an angle", Some("12 deg")),
    ("share", "a share", Some("12 %")),
    ("time", "a time", Some("12 ms")),
    ("number", "a number", Some("1.25")),
    ("count", "a whole number", Some("12")),
    ("colour", "a colour", Some("#ff8000")),
    ("text", "a text", Some("\"t\"")),
    ("direction", "a direction", Some("+x")),
    ("point", "a point", Some("[1 mm, 2 mm, 3 mm]")),
    ("edge", "an edge", None),
    ("edges", "the edges of a face", None),
    ("polygon", "a face", None),
    ("pose", "a pose", None),
    ("deformation", "a deformation", None),
    ("camera", "a camera", None),
    ("views", "a set of views", Some("positions(points: [[1 m, 0 m, 0 m]])")),
    ("shape", "a shape", Some("tank()")),
    ("detector", "a detector", Some("planar_region()")),
    ("measure", "a measure", Some("outline()")),
    ("predictor", "a predictor", None),
    ("[length]", "a list of lengths", Some("[12 mm]")),
    ("[angle]", "a list of angles", Some("[12 deg]")),
    ("[share]", "a list of shares", Some("[12 %]")),
    ("[time]", "a list of times", Some("[12 ms]")),
    ("[number]", "a list of numbers", Some("[1.25]")),
    ("[count]", "a list of whole numbers", None),
    ("[colour]", "a list of colours", Some("[#ff8000]")),
    ("[text]", "a list of texts", Some("[\"t\"]")),
    ("[direction]", "a list of directions", Some("[+x]")),
    ("[point]", "a list of points", Some("[[1 m, 0 m, 0 m]]")),
    ("[edge]", "a list of edges", None),
    ("[polygon]", "a list of faces", None),
    ("[pose]", "a list of poses", None),
    ("[deformation]", "a list of deformations", None),
];

/// What one type is to another.
fn serves(given: &str, due: &str) -> bool {
    given == due || (given, due) == ("count", "number") || (given, due) == ("edges", "[edge]")
}

fn said(program: &str) -> Vec<Diagnostic> {
    compile("m", &Memory::of("m", &format!("vpl 1\n{program}"))).diagnostics
}

/// Everything that a person reads of a diagnostic.
fn words(d: &Diagnostic) -> String {
    let labels = d.related.iter().map(|l| l.text.as_str());
    let parts = [
        d.message.as_str(),
        d.primary.text.as_str(),
        d.help.as_deref().unwrap_or(""),
    ];
    parts.into_iter().chain(labels).collect::<Vec<_>>().join("\n")
}

/// The one diagnostic of a program.
#[track_caller]
fn only(program: &str) -> Diagnostic {
    let mut all = said(program);
    assert_eq!(all.len(), 1, "{program}\n{all:#?}");
    all.remove(0)
}

#[test]
fn every_pair_of_types_names_both() {
    for (due, due_words, _) in TYPES {
        for (given, given_words, _) in TYPES {
            let program = format!("let want(x: {due}) = x\nlet give(y: {given}) = want(x: y)\n");
            if serves(given, due) {
                assert_eq!(said(&program), [], "{program}");
                continue;
            }
            let found = only(&program);
            assert_eq!(found.code, Code::E0301, "{program}");
            let words = words(&found);
            assert!(
                words.contains(due_words) && words.contains(given_words),
                "{program}\n{words}"
            );
        }
    }
}

/// A bare number lacks its unit, a list is looked at element by element: what is due
/// and what was found are named all the same.
#[test]
fn every_literal_where_every_type_is_due_names_both() {
    for (due, due_words, _) in TYPES {
        for (given, given_words, literal) in TYPES {
            let Some(literal) = literal else { continue };
            let program = format!("let want(x: {due}) = x\nlet give = want(x: {literal})\n");
            if serves(given, due) {
                assert_eq!(said(&program), [], "{program}");
                continue;
            }
            let lists = due.starts_with('[') || matches!(*due, "point" | "direction");
            if literal.starts_with('[') && lists {
                continue;
            }
            let words = words(&only(&program));
            let number = words.contains("a bare number") && given_words.contains("number");
            assert!(words.contains(due_words), "{program}\n{words}");
            assert!(words.contains(given_words) || number, "{program}\n{words}");
        }
    }
}

#[test]
fn elements_of_lists_name_both() {
    let due = |due: &str, literal: &str, both: [&str; 2]| {
        let program = format!("let want(x: {due}) = x\nlet give = want(x: {literal})\n");
        let words = words(&only(&program));
        assert!(both.iter().all(|b| words.contains(b)), "{program}\n{words}");
    };
    due("[length]", "[1 mm, 2 deg]", ["a length", "an angle"]);
    due("[count]", "[1, 2 %]", ["a whole number", "a share"]);
    due("point", "[1 mm, 2 mm, 3 s]", ["a length", "a time"]);
    due("direction", "[1 mm, 0, 0]", ["a number", "a length"]);
    due("point", "[1, 2, 3]", ["a length", "bare numbers"]);
    due("[colour]", "[red, 3]", ["a colour", "a whole number"]);
}

#[test]
fn sums_and_products_name_both_dimensions() {
    const QUANTITIES: &[usize] = &[0, 1, 2, 3];
    for (_, left_words, left) in QUANTITIES.iter().map(|k| TYPES[*k]) {
        for (_, right_words, right) in QUANTITIES.iter().map(|k| TYPES[*k]) {
            for op in ["+", "-", "*", "/"] {
                let (left, right) = (left.unwrap(), right.unwrap());
                let program = format!("let a = {left} {op} {right}\n");
                if left == right && matches!(op, "+" | "-") {
                    assert_eq!(said(&program), [], "{program}");
                    continue;
                }
                let found = only(&program);
                assert_eq!(found.code, Code::E0305, "{program}");
                assert!(found.message.contains(left_words) && found.message.contains(right_words));
            }
        }
    }
}

/// The unit that is offered, or none where two are as likely.
#[test]
fn a_bare_number_is_offered_its_obvious_unit() {
    let offered = |due: &str, literal: &str| {
        let program = format!("let want(x: {due}) = x\nlet give = want(x: {literal})\n");
        let found = only(&program);
        found.fixes.first().map(|f| f.edits[0].text.trim().to_owned())
    };
    let some = |unit: &str| Some(unit.to_owned());
    assert_eq!(offered("length", "300"), some("mm"));
    assert_eq!(offered("length", "1.5"), some("m"));
    assert_eq!(offered("length", "3"), None);
    assert_eq!(offered("angle", "30"), some("deg"));
    assert_eq!(offered("angle", "1.57"), some("rad"));
    assert_eq!(offered("angle", "3"), None);
    assert_eq!(offered("share", "95"), some("%"));
    assert_eq!(offered("share", "0.95"), some("95 %"));
    assert_eq!(offered("time", "50"), some("ms"));
    assert_eq!(offered("time", "0.5"), some("s"));
    assert_eq!(offered("count", "32 %"), some(""));
}
