//! `vpl test`: facts from the outside.

use std::io::Write;
use std::process::{Command, Output, Stdio};

fn vpl(arguments: &[&str], input: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_vpl"))
        .args(arguments)
        .env("NO_COLOR", "1")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap()
}

fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// A library of a lid on a box of four sides, with tests behind it.
fn boxes(tests: &str) -> String {
    format!(
        r#"vpl 1
library boxes {{
  feature bottom : polygon
  feature side   : polygon many
  feature mark   : marker
  feature tag    : marker
  class box {{ bottom, side, mark, tag }} prior 60 %
  class lid {{ bottom, tag }} prior 30 %
  class bag {{ mark }} prior 10 %
  rule -> bottom {{
    detect  planar_region(colour: red)
    measure outline()
  }}
  rule bottom -> side {{
    for each edge in bottom.edges
    detect  plane_beside(edge, dihedral: 90 deg, within: 10 deg)
    measure outline(first: edge)
    predict rectangle_on(on: edge, dihedral: 90 deg, height: side.height else 300 mm)
  }}
  rule -> mark {{
    detect  qr(text: "mark", size: 200 mm)
    measure marker_pose()
  }}
  rule -> tag {{
    detect  qr(text: "tag", size: 100 mm)
    measure marker_pose()
  }}
  layout prints {{
    mark at [0 mm, 0 mm, 0 mm] facing +x
    tag at [-100 mm, 0 mm, 50 mm] facing -x
  }}
}}
let square = polygon([[0 m, 0 m, 0 m], [0 m, 1 m, 0 m], [1 m, 1 m, 0 m], [1 m, 0 m, 0 m]])
{tests}
"#
    )
}

fn test(body: &str) -> Output {
    vpl(&["test", "-"], &boxes(&format!("test \"it\" {{\n{body}\n}}")))
}

#[track_caller]
fn holds(body: &str) {
    let output = test(body);
    assert_eq!(output.status.code(), Some(0), "{body}\n{}", said(&output));
    assert_eq!(out(&output), "-\n  ok   it\n1 fact holds, in 1 file\n");
}

#[track_caller]
fn fails(body: &str, why: &str) {
    let output = test(body);
    let text = said(&output).replace("\n  │", "");
    assert_eq!(output.status.code(), Some(1), "{body}\n{text}");
    assert!(text.contains("E0701") && text.contains(why), "{text}");
    assert!(out(&output).starts_with("-\n  FAIL it\n"), "{}", out(&output));
}

#[test]
fn evidence_leaves_the_classes_that_explain_it() {
    holds("expect classes box, lid, bag\n expect class box 60 %");
    holds("given mark detected\n expect classes box, bag\n expect class box 85.7 %");
    holds("given mark absent\n expect classes lid\n expect confident\n expect bottom present\n expect side excluded");
    holds("given mark detected, tag absent\n expect classes bag\n expect class bag 100 %\n expect tag absent");
    fails(
        "given mark detected\n expect classes bag",
        "expected `bag` to remain, found `box` and `bag`",
    );
    fails(
        "given mark detected\n expect class box 85 %",
        "expected class `box` at 85 %, found 85.714 %",
    );
    holds("given mark detected\n expect class box 85 % within 1 %");
    fails(
        "given mark detected\n expect confident",
        "the likeliest class is `box` at 85.714 %, asked is 99 %",
    );
}

#[test]
fn what_no_class_explains_is_a_contradiction() {
    holds("given side detected, mark absent\n expect contradicted\n expect not confident");
    fails(
        "given side detected, mark absent\n expect not contradicted",
        "`mark` was inspected and not found",
    );
    fails("expect contradicted", "still possible: `box`, `lid` and `bag`");
}

#[test]
fn weights_say_what_is_worth_looking_for_next() {
    // H(0.9), H(0.6), H(0.7), H(0.9) bits.
    holds("expect bottom weight 0.469\n expect side weight 0.971\n expect next side");
    fails("expect next mark", "expected `mark` next, found `side`");
    fails(
        "expect side weight 0.97 within 0.0001",
        "expected a weight of 0.97 bits, found 0.971 bits",
    );
}

#[test]
fn measured_instances_predict_others() {
    holds("given bottom = square\n expect side predicted 4\n expect rule bottom -> side predicts 4");
    let side = "polygon([[0 m, 1 m, 0 m], [0 m, 0 m, 0 m], [0 m, 0 m, 300 mm], [0 m, 1 m, 300 mm]])";
    holds(&format!("given bottom = square\n expect side at {side}"));
    // A measured side is one of the four, and the others become as high as it is.
    let taken = format!("given bottom = square\n given side = {}", side.replace("300", "500"));
    holds(&format!(
        "{taken}\n expect rule bottom -> side predicts 3\n expect classes box"
    ));
    let next = "polygon([[1 m, 1 m, 0 m], [0 m, 1 m, 0 m], [0 m, 1 m, 500 mm], [1 m, 1 m, 500 mm]])";
    holds(&format!("{taken}\n expect side at {next}"));
    let off = side.replace("300", "305");
    fails(
        &format!("given bottom = square\n expect side at {off}"),
        "found the nearest 5 mm away",
    );
    holds(&format!("given bottom = square\n expect side at {off} within 5 mm"));
    // A predictor stands for the face that it predicts.
    let wall = |edge: u32, height: &str| format!("rectangle_on(edge_of(square, {edge}), 90 deg, {height})");
    holds(&format!("given bottom = square\n expect side at {}", wall(1, "300 mm")));
    fails(
        &format!("given bottom = square\n expect side at {}", wall(1, "320 mm")),
        "found the nearest 20 mm away",
    );
    fails(
        "given bottom = square\n expect side at polygon([[0 m, 1 m, 0 m], [0 m, 0 m, 0 m], [0 m, 0 m, 300 mm]])",
        "found 4 of 4 corners, and this has 3",
    );
    fails(
        "given bottom detected\n expect side predicted 4",
        "no place is given for `bottom`",
    );
    fails(
        "given mark absent, bottom = square\n expect side predicted 4",
        "`side` is excluded",
    );
}

#[test]
fn a_layout_carries_a_marker_over_to_the_others() {
    // Turned by a quarter: what lay behind in -x lies behind in -y.
    let given = "given mark at [1 m, 2 m, 3 m] facing +y";
    holds(&format!(
        "{given}\n expect tag at [1 m, 1900 mm, 3050 mm] facing -y within 0.01 mm"
    ));
    holds(&format!(
        "{given}\n expect rule mark -> tag predicts 1\n expect mark predicted 0"
    ));
    fails(
        &format!("{given}\n expect tag at [1 m, 1900 mm, 3 m] facing -y"),
        "the nearest is `at [1000 mm, 1900 mm, 3050 mm] facing -y`",
    );
}

#[test]
fn values_are_compared_in_their_own_dimension() {
    let edge = "edge_of(square, 1)";
    holds(&format!(
        "expect {edge} = edge_of(square, 1)\n expect square count 4\n expect 2 m = 200 cm"
    ));
    holds("expect behind(square, 1 m) = [500 mm, 500 mm, 1 m]\n expect prism_over(square, 1 m) count 6");
    holds("expect [0, 0, 2] = +z\n expect 3 = 3.0\n expect \"a\" = \"a\"");
    fails("expect 2 m = 2001 mm", "expected 2001 mm, found 2000 mm");
    holds("expect 2 m = 2001 mm within 1 mm");
    fails(
        "expect behind(square, 1 m) = [500 mm, 500 mm, 1.1 m]",
        "they lie 100 mm apart",
    );
    fails("expect square count 3", "expected a count of 3, found 4");
    fails(
        "expect rectangle_on(edge_of(square, 1), 90 deg, 1 m) = square",
        "they lie",
    );
    fails(
        "expect pyramid_over(square, [0 m, 0 m, -1 m]) count 5",
        "predicts nothing from these arguments",
    );
    fails(
        "expect circle(1 m, 4) = circle(1 m, 5)",
        "expected 5 views, found 4 views",
    );
    fails(
        "expect qr(text: \"a\", size: 1 m) = qr(text: \"b\", size: 1 m)",
        "found qr(size: 1000 mm, text: \"a\")",
    );
}

#[test]
fn definitions_that_read_a_face_are_tried_on_a_written_one() {
    let defined = |body: &str| {
        vpl(
            &["test", "-"],
            &boxes(&format!(
                "let lifted(face: polygon) = rectangle_on(on: face.base, dihedral: 90 deg, height: face.height)\n\
             let middle(face: polygon) = face.centre\nlet top(face: polygon) = face.apex\n\
             let rim(face: polygon) = face.edges\nlet out(face: polygon) = face.normal\n\
             test \"it\" {{ {body} }}"
            )),
        )
    };
    let output = defined(
        "expect lifted(square) = polygon([[0 m, 1 m, 0 m], [0 m, 0 m, 0 m], [0 m, 0 m, 1 m], [0 m, 1 m, 1 m]])
         expect middle(square) = [500 mm, 500 mm, 0 m]
         expect top(square) = [1 m, 1 m, 0 m]
         expect rim(square) count 4
         expect out(square) = -z",
    );
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
}

#[test]
fn every_failure_is_shown_where_it_stands() {
    let output = vpl(
        &["test", "-"],
        &boxes("test \"one\" {\n  expect rules 3\n  expect classes box\n}\ntest \"two\" { expect rules 6 }"),
    );
    assert_eq!(
        out(&output),
        "-\n  FAIL one\n  ok   two\n1 fact holds, 1 fails, in 1 file\n"
    );
    let text = said(&output);
    assert!(
        text.contains("expected rules: 3, found 6") && text.contains("-:35:3"),
        "{text}"
    );
    assert!(text.contains("-:36:3") && text.contains("in this test"), "{text}");
}

#[test]
fn coverage_counts_facts_by_rule() {
    let tests = "test \"a\" { given bottom = square\n expect side predicted 4 }\ntest \"b\" { given mark detected\n expect classes box, bag }";
    let output = vpl(&["test", "--coverage", "-"], &boxes(tests));
    let text = out(&output);
    assert!(text.contains("library `boxes`: 3 of 6 rules used"), "{text}");
    assert!(text.contains("r2  bottom -> side  detected 0, predicted 1"), "{text}");
    assert!(text.contains("r3  -> mark         detected 1, predicted 0"), "{text}");
    assert!(text.contains("r5  mark -> tag     never used"), "{text}");
}

#[test]
fn json_has_facts_diagnostics_and_coverage() {
    let tests = "test \"good\" { expect rules 6 }\ntest \"bad\" { expect rules 7 }";
    let output = vpl(&["test", "--format", "json", "--coverage", "-"], &boxes(tests));
    assert_eq!(output.status.code(), Some(1));
    assert!(output.stderr.is_empty());
    let all: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(all["summary"], serde_json::json!({ "facts": 2, "hold": 1, "fail": 1 }));
    assert_eq!(all["facts"][1]["failures"][0], "expected rules: 7, found 6");
    assert_eq!(all["diagnostics"][0]["code"], "E0701");
    assert_eq!(all["diagnostics"][0]["start"]["line"], 35);
    assert_eq!(all["coverage"][0]["rules"].as_array().unwrap().len(), 6);
}

#[test]
fn facts_are_chosen_by_their_name() {
    let tests = "test \"good one\" { expect rules 6 }\ntest \"bad one\" { expect rules 7 }";
    let output = vpl(&["test", "--filter", "good", "-"], &boxes(tests));
    assert_eq!(out(&output), "-\n  ok   good one\n1 fact holds, in 1 file\n");
    let none = vpl(&["test", "-"], "vpl 1\nlet a = 1 m\n");
    assert_eq!(out(&none), "-\n  no facts\n0 facts hold, in 1 file\n");
    assert_eq!(none.status.code(), Some(0));
    assert_eq!(vpl(&["test"], "").status.code(), Some(2));
}

#[test]
fn a_wrong_program_is_not_run() {
    let output = vpl(&["test", "-"], &boxes("test \"it\" { expect classes bix }"));
    assert_eq!(output.status.code(), Some(1));
    assert!(said(&output).contains("E0208"), "{}", said(&output));
    assert_eq!(
        out(&output),
        "-\n  not run: the program is wrong\n0 facts hold, 1 file could not be run, in 1 file\n"
    );
}

/// Importing a module does not run its facts; running the module does.
#[test]
fn the_facts_of_the_library_and_the_examples_hold() {
    let mut files = vec![
        "examples/solids/solids.vpl".to_owned(),
        "examples/tanks/tanks.vpl".to_owned(),
    ];
    for entry in std::fs::read_dir("stdlib/std").unwrap() {
        files.push(entry.unwrap().path().to_str().unwrap().to_owned());
    }
    files.sort();
    let mut arguments = vec!["test"];
    arguments.extend(files.iter().map(String::as_str));
    let output = vpl(&arguments, "");
    assert_eq!(output.status.code(), Some(0), "{}{}", out(&output), said(&output));
    assert!(!out(&output).contains("no facts"), "{}", out(&output));
    let imports = vpl(
        &["test", "-"],
        "vpl 1\nuse std.views.sphere\ntest \"it\" { expect sphere(1 m, 8) count 8 }\n",
    );
    assert_eq!(out(&imports), "-\n  ok   it\n1 fact holds, in 1 file\n");
}

#[test]
fn far_more_facts_than_anyone_writes_are_refused_at_once() {
    let many: String = (0..100_000)
        .map(|k| format!("test \"{k}\" {{ expect rules 6 }}\n"))
        .collect();
    let output = vpl(&["test", "-"], &boxes(&many));
    assert_eq!(output.status.code(), Some(1));
    assert!(
        said(&output).contains("expect more than 10000 things"),
        "{}",
        said(&output)
    );
    let wheel: String = (0..60)
        .map(|k| {
            let turn = f64::from(k) * std::f64::consts::TAU / 60.0;
            format!("[{:.3} m, {:.3} m, 0 m], ", turn.cos() * 2.0, turn.sin() * 2.0)
        })
        .collect();
    let output = test(&format!("given bottom = polygon([{wheel}])\n expect side predicted 60"));
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let places = "given side = square\n".repeat(65);
    let output = test(&format!("{places}expect rules 6"));
    assert!(said(&output).contains("at most 64 places"), "{}", said(&output));
}

#[test]
fn numbers_without_meaning_are_said_before_anything_is_run() {
    for body in [
        "expect 1 m = 1e400 m",
        "expect 1 m / 0 = 1 m",
        "expect class box 1e300 % within 1e300 %",
        "given bottom = polygon([[1e300 m, 0 m, 0 m], [0 m, 1 m, 0 m], [0 m, 0 m, 1 m]])\n expect rules 6",
        "given mark at [0 m, 0 m, 0 m] facing [0, 0, 0]\n expect rules 6",
        "given side = polygon([[0 m, 0 m, 0 m], [900000 m, 0 m, 0 m], [0 m, 0.000001 mm, 0 m]])\n expect rules 6",
        "expect rules 1.5",
    ] {
        let output = test(body);
        assert_eq!(output.status.code(), Some(1), "{body}");
        assert!(said(&output).contains("E0"), "{body}");
    }
}
