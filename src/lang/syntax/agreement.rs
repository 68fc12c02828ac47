//! The grammar's promise: the strict entry accepts a text exactly when the tolerant
//! one finds nothing bad in it.

use proptest::prelude::*;

use super::{parse, strictly_accepts, tolerantly_accepts};
use crate::lang::source::FileId;

const PROGRAMS: &[&str] = &[
    include_str!("../../../examples/solids/solids.vpl"),
    include_str!("../../../examples/tanks/tanks.vpl"),
    include_str!("../../../stdlib/std/cameras.vpl"),
    include_str!("../../../stdlib/std/solids.vpl"),
    include_str!("../../../examples/studies/ablation.vpl"),
    TEMPLATES,
    FACTS,
];
const TEMPLATES: &str = "vpl 1
use \"boxes.vpl\".{tagged_box, crate_of}
let far(face: polygon, by: length = 2 * 100 mm,
        at: [number] = [1, 2]) = behind(face: face, depth: by)
library pair(width: length, prefix: text = \"b\") {
  feature code[1..2] : marker
  layout flat { code[1] at [width / 2, 0 mm, 0 mm] facing +x }
}
library both {
  use pair(width: 300 mm); use crate_of
  class a { code }
}
";
const FACTS: &str = r#"vpl 1
test "every statement" {
  library tanks
  given code[7] detected, code[4] absent
  given bottom = polygon([[0 m, 0 m, 0 m], [1 m, 0 m, 0 m], [0 m, 1 m, 0 m]]),
    code[1] at [0 m, 0 m, 0 m] facing +x
  expect classes tk5, tk9
  expect class tk9 50 % within 1 %
  expect confident; expect not contradicted
  expect next code[3], code[4]
  expect rules 49
  expect rule bottom -> side predicts 4
  expect code[3] weight 0.92 within 0.01
  expect side predicted 4
  expect code[2] at [0 m, 0 m, 0 m] facing -x within 1 mm
  expect code[1] absent
  expect above(bottom: face, height: 1 m) = [0 m, 0 m, 1 m]
  expect sphere(radius: 1 m, count: 64) count 64
}
"#;
const SCRAPS: &[&str] = &[
    "",
    " ",
    "\n",
    "{",
    "}",
    "(",
    ")",
    "[",
    "]",
    "\"",
    "//",
    ";",
    ",",
    ":",
    "=",
    "->",
    "..",
    "+x",
    "10 mm",
    "%",
    "rule",
    "task t {",
    "library l {",
    "class",
    "use",
    "let",
    "for each",
    "else",
    "1",
    "name",
    "\r\n",
    "é",
    "{i}",
    "use pair(width: 1 m)",
    "(a: length = 1)",
    "test \"t\" {",
    "given",
    "expect",
    "detected",
    "within",
    "count",
    "not",
    "study s {",
    "variant v { voxel 5 mm }",
    "methods",
];

/// A program with some pieces cut out and scraps put in.
pub(in crate::lang) fn mutated() -> impl Strategy<Value = String> {
    let change = (any::<prop::sample::Index>(), 0_usize..12, prop::sample::select(SCRAPS));
    (prop::sample::select(PROGRAMS), prop::collection::vec(change, 0..4)).prop_map(|(program, changes)| {
        let mut chars: Vec<char> = program.chars().collect();
        for (at, cut, scrap) in changes {
            let at = at.index(chars.len() + 1);
            let end = (at + cut).min(chars.len());
            chars.splice(at..end, scrap.chars());
        }
        chars.into_iter().collect()
    })
}

/// Tokens in any order.
pub(in crate::lang) fn soup() -> impl Strategy<Value = String> {
    prop::collection::vec(prop::sample::select(SCRAPS), 0..40).prop_map(|scraps| format!("vpl 1\n{}", scraps.join(" ")))
}

fn agrees(text: &str) -> Result<(), TestCaseError> {
    let strict = strictly_accepts(text);
    prop_assert_eq!(strict, tolerantly_accepts(text));
    let (tree, found) = parse(FileId(0), text);
    if strict {
        prop_assert!(tree.bad.is_empty());
    } else {
        prop_assert!(!found.is_empty() || tree.edition.is_none());
    }
    for d in &found {
        let span = d.primary.span;
        prop_assert!(text.get(span.start..span.end).is_some(), "{:?} cuts a character", span);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn strict_and_tolerant_agree_on_mutated_programs(text in mutated()) {
        agrees(&text)?;
    }

    #[test]
    fn strict_and_tolerant_agree_on_soup(text in soup()) {
        agrees(&text)?;
    }

    /// Whatever the text, compiling it ends, gives a rule set or says why not, and
    /// what it says can be written in every form.
    #[test]
    fn compiling_never_panics(text in mutated()) {
        use crate::lang::{Format, Memory, compile, render};
        let compiled = compile("m", &Memory::of("m", &text));
        prop_assert_eq!(compiled.rules.is_some(), !compiled.has_errors());
        let human = Format::Human { colour: true, width: 80 };
        for format in [human, Format::Plain, Format::Short, Format::Json] {
            let said = render(&compiled.diagnostics, &compiled.sources, format);
            prop_assert!(format == Format::Json || said.is_empty() == compiled.diagnostics.is_empty());
        }
    }
}

#[test]
fn programs_are_accepted_as_they_are() {
    for program in PROGRAMS {
        assert!(strictly_accepts(program) && tolerantly_accepts(program));
    }
}
