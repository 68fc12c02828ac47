//! What the layout looks like, construct by construct, and what it must never do.

use std::path::{Path, PathBuf};

use proptest::prelude::*;

use super::{edits, format};
use crate::lang::syntax::agreement::{mutated, soup};
use crate::lang::syntax::{TokenClass, same_program, tokens};

/// Input and output, and what was left alone.
#[track_caller]
fn laid_out(text: &str) -> String {
    let out = stable(text).unwrap();
    let untouched: String = format(text)
        .untouched
        .iter()
        .map(|span| format!("untouched: {:?}\n", &text[span.start..span.end]))
        .collect();
    format!("{text}\n----\n{out}----\n{untouched}")
}

/// The layout of a text, which must be the same program and its own layout.
fn stable(text: &str) -> Result<String, TestCaseError> {
    let once = format(text);
    prop_assert!(!once.refused, "not the same program:\n{}", text);
    let twice = format(&once.text);
    prop_assert!(!twice.refused, "not the same program:\n{}", once.text);
    prop_assert_eq!(&once.text, &twice.text, "not stable");
    prop_assert_eq!(once.untouched.len(), twice.untouched.len());
    for (a, b) in once.untouched.iter().zip(&twice.untouched) {
        prop_assert_eq!(&text[a.start..a.end], &once.text[b.start..b.end]);
    }
    let mut edited = text.to_owned();
    for edit in edits(text, &once.text).iter().rev() {
        edited.replace_range(edit.span.start..edit.span.end, &edit.text);
    }
    prop_assert_eq!(&edited, &once.text);
    Ok(once.text)
}

/// Every program of the tree.
fn programs() -> Vec<(PathBuf, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut folders: Vec<PathBuf> = ["examples", "stdlib", "src/cli/new", "tests"]
        .iter()
        .map(|f| root.join(f))
        .collect();
    let mut out = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "vpl") {
                let text = std::fs::read_to_string(&path).unwrap();
                out.push((path, text));
            }
        }
    }
    out.sort();
    out
}

#[test]
fn every_program_of_the_tree_has_a_stable_layout() {
    for (path, text) in programs() {
        stable(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    }
}

#[test]
fn the_project_s_own_programs_stand_as_they_should() {
    let shipped = programs().into_iter().filter(|(path, _)| {
        let path = path.to_string_lossy();
        ["/examples/", "/stdlib/", "/cli/new/", "/tests/plan/"]
            .iter()
            .any(|folder| path.contains(folder))
    });
    for (path, text) in shipped {
        assert_eq!(format(&text).text, text, "{}", path.display());
    }
}

#[test]
fn spaces() {
    insta::assert_snapshot!(laid_out(
        "vpl   1\n\nlet a=f( 10mm,99% ,-  5 deg,[ 1,2 ],- x,-x , 3-  2*-y ,(1+2)/3 )\nlet b  ( p :length,q: [[ point ]] )=g (on :p . edge , t:\"a{i}{j}b c\",c:#ff8000 else 1°)\n"
    ));
}

#[test]
fn items_and_blank_lines() {
    insta::assert_snapshot!(laid_out(
        "// first\nvpl 1\nuse std.views . sphere\nuse std.solids . { above , square_under , }\n\n\n\nuse \"a.vpl\".{b}\nlet c = 1 mm\n/// Doc.\nlet d = 2 mm\nlibrary l { class a { x } }\n// about t\ntask t { library l; limit 20 views }\nscene s {}\nlet e = 1 mm /// odd\nlet f = 2 mm\n\n\n"
    ));
}

#[test]
fn columns() {
    insta::assert_snapshot!(laid_out(
        "vpl 1\n\nlibrary l {\n\n  feature a : marker // one\n  // between\n  feature code[1..7] : marker many // two\n\n  feature apart:shell\n  class x { a, code[1] } prior 60 %\n  class yy { a } prior 40 %\n  classes by code[1..2],a {\n   a1 1 0 1 prior 50 %\n   a22 110\n  }\n  rule a->code[i]{ // rule\n  for each e in a.edges\n  detect   f(e)\n  measure g()\n  predict h( // why\n    1 )\n  }\n  layout q {\n code[ 1 ] at [1 mm,2 mm, 3 mm]   facing +x // here\n  a at [1 mm,2 mm, 3 mm]   facing [0,0,1] // and here\n  }\n}\nscene s {\n backdrop none\n object a = f() at [0 m,0 m,0 m]\n object bcd = g() at [0 m,0 m,0 m] turned 3deg marked l . q as x\n}\n"
    ));
}

#[test]
fn brackets() {
    insta::assert_snapshot!(laid_out(
        "vpl 1\n\nlet joined = f(a,\n   b)\nlet kept = f(\na, b,\n\n\nc)\nlet long = f(first: [1 mm, 2 mm, 3 mm, 4 mm], second: g(1, 2, 3), third: 300 mm, fourth: 400 mm, fifth: 500 mm)\nlet hugging = f(a, b: [\n1,2\n])\nlet both = f([\n1], [\n2\n])\nlet sum = (1 mm +\n 2 mm)\nlet else_ = f(\n a\n else b\n // last\n)\nlet only = polygon([[100 mm, 100 mm, 100 mm], [-100 mm, 100 mm, 100 mm], [-100 mm, 100 mm, 400 mm]]) + f([1])\nlet next =\n  f(1)\nlet chain = 1 mm +\n2 mm\n\nlibrary l {\n  class long_class { first_feature, second_feature, third_feature, fourth_feature, fifth_feature, sixth }\n  class broken {\n a\nb }\n  class mixed { a,\nb // b\n, c }\n}\ntask t {\n  thresholds { near: 10 mm, absent: 99 %, confidence: 99 % } ; limit 20 views\n  sensor_model {\n hit: 70 %; miss: 40 % }\n}\n"
    ));
}

#[test]
fn objects_and_places() {
    insta::assert_snapshot!(laid_out(
        "vpl 1\nlibrary l { layout q {\n label at [151 mm, 0 mm, 0 mm] facing +x\n hazard_of_it at [-151 mm, 0 mm, 0 mm] facing -x // back\n lid at p facing -x\n } }\nscene s {\n object plain = carton(blue) at [0 mm, 0 mm, 250 mm] turned 25 deg marked cartons.stickers as plain\n object spares_and_more = carton(blue, 200 mm) at [0 mm, 0 mm, 250 mm] turned 130 deg marked cartons.stickers as spares\n object bare = carton(blue) at [0 mm, 0 mm, 250 mm] marked cartons.stickers as bare\n object wide = prism(sides: 4, radius: 169.7 mm, height: 200 mm, side: grey) at [0 mm, 0 mm, 250 mm] turned 10 deg\n object far = f() at [0 mm, 0 mm, 250 mm]\n}\n"
    ));
}

#[test]
fn comments() {
    insta::assert_snapshot!(laid_out(
        "vpl 1 // edition\n// one\t \n//two\nlet a = // why\n // really\n  f( // open\n // own\n 1 // first\n , 2, // second\n\n // last\n )\nlibrary l { // l\n\n // in\n\n  // end\n}\n// the end"
    ));
}

#[test]
fn what_cannot_be_read_stays() {
    insta::assert_snapshot!(laid_out(
        "vpl 1\ntask t {\n  limit   20views\n    lmit   20   views   // why\n  goal   confident\n}\nlibrary l { rule -> a { detect   f() ; dtect   g() } }\nlibrary   m {\n   class a{b}\n   nonsense (  1,\n      2 )   ;   feature a   : shell\n}\nlet   a   =\n\nlet b=1mm\n"
    ));
}

#[test]
fn marks_of_other_languages() {
    insta::assert_snapshot!(laid_out(
        "VPL : 1\n# a comment\nlibrary  a-b: {\nfeature x=marker\nclasses by x {\n  tk1 1 ,0, yes ,\ntk22: 1, 0, }\n}\nlet a=f(\n1 , /* one */\n  2 ,\n)\nlet  b = (1mm,2mm) /* two */\nlet c=[1,2] mm\ntask t{\nlimit=20 views\ngoal :confident\n}\n"
    ));
}

#[test]
fn line_ends_tabs_and_marks_of_other_systems() {
    let text = "\u{feff}vpl 1\r\n\r\nlibrary l {\r\n\tfeature\ta : marker\t// a\r\n}\r";
    let code = "  feature a : marker";
    let gap = " ".repeat(45 - code.len());
    assert_eq!(
        format(text).text,
        format!("vpl 1\n\nlibrary l {{\n{code}{gap}// a\n}}\n")
    );
    assert_eq!(format("").text, "");
    assert_eq!(format(" \n\n").text, "");
}

#[test]
fn what_the_parser_does_not_take_is_untouched() {
    for text in ["let  a =\0 1", &"(".repeat(500), "vpl  2\nlet  a=1"] {
        let formatted = format(text);
        assert_eq!(formatted.text, text);
        assert_eq!(formatted.untouched.len(), 1);
        assert!(!formatted.refused);
    }
}

#[test]
fn a_space_makes_no_edition_line() {
    assert_eq!(format("vpl1\nlet  a=1").text, "vpl1\nlet a = 1\n");
    assert_eq!(format("VPL  1\nlet  a=1").text, "VPL 1\n\nlet a = 1\n");
}

#[test]
fn templates_and_facts() {
    insta::assert_snapshot!(laid_out(
        "vpl 1\nlibrary box( width:length,prefix : text=\"b\" ){\nuse  other( width:width/2 )\nuse plain\nfeature a:marker\n}\ntest   \"two . boxes\"{\nlibrary box\ngiven code[7]   detected,\ncode[4] absent\ngiven a=polygon([[1mm,2mm,3mm]])\nexpect   classes tk5,tk9\nexpect not confident\nexpect rule a,b->c predicts   4 // four\nexpect code[2] at [0 mm,0 mm,1m] facing -x within 5mm\nexpect class tk9 -50%\n}\n"
    ));
}

/// What a token adds to the depth of brackets in which line ends do not count.
fn bracket(written: &str) -> i32 {
    match written {
        "(" | "[" => 1,
        ")" | "]" => -1,
        _ => 0,
    }
}

/// A program with its spaces, line ends and comments changed.
fn mangled() -> impl Strategy<Value = String> {
    let gaps = prop::collection::vec(0_usize..12, 1..200);
    let short: Vec<_> = programs().into_iter().filter(|(_, text)| text.len() < 3000).collect();
    (prop::sample::select(short), gaps).prop_map(|((_, text), gaps)| {
        let mut out = String::new();
        let (mut end, mut depth) = (0, 0);
        let mut gaps = gaps.iter().cycle();
        for token in tokens(&text) {
            let between = &text[end..token.start];
            match (gaps.next(), token.class) {
                (Some(0), TokenClass::Newline) => out.push_str(" // said\n"),
                (Some(1), TokenClass::Newline) => out.push_str("\n\t\n\n"),
                (Some(2), TokenClass::Newline) => out.push_str("\r\n"),
                (Some(3), TokenClass::Newline) => out.push_str("\n// said\n  /// said"),
                (Some(4), _) => out.push_str(&format!("{between} \t  ")),
                (Some(5), _) if matches!(token.text(&text), ")" | "]" | "," | "+" | "*") => out.push('\n'),
                (Some(6), _) if matches!(token.text(&text), ")" | "]") => out.push_str(" // said\n"),
                _ => out.push_str(between),
            }
            depth += bracket(token.text(&text));
            match (gaps.next(), token.class) {
                (Some(0..=8), TokenClass::Newline) if depth > 0 => out.push(' '),
                (Some(0), TokenClass::Name) => out.push_str(&format!("{}_and_more_of_it", token.text(&text))),
                _ => out.push_str(token.text(&text)),
            }
            if matches!(token.text(&text), "(" | "," | "else") && gaps.next() == Some(&7) {
                out.push('\n');
            }
            end = token.end;
        }
        out + &text[end..]
    })
}

/// A program with pieces cut out.
fn torn() -> impl Strategy<Value = String> {
    let cut = (any::<prop::sample::Index>(), 1_usize..40);
    (mangled(), prop::collection::vec(cut, 1..4)).prop_map(|(text, cuts)| {
        let mut chars: Vec<char> = text.chars().collect();
        for (at, count) in cuts {
            let at = at.index(chars.len() + 1);
            chars.drain(at..(at + count).min(chars.len()));
        }
        chars.into_iter().collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, max_shrink_iters: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn layout_is_stable_and_keeps_the_program(text in mangled()) {
        stable(&text)?;
    }

    #[test]
    fn layout_of_anything_is_stable(text in prop_oneof![mutated(), soup()]) {
        stable(&text)?;
    }

    #[test]
    fn layout_leaves_what_cannot_be_read(text in torn()) {
        let formatted = format(&text);
        stable(&text)?;
        for span in &formatted.untouched {
            prop_assert!(formatted.text.contains(&text[span.start..span.end]));
        }
        prop_assert!(formatted.text == text || same_program(&text, &formatted.text));
    }
}
