//! One program with several mistakes in every form, and what each form promises.

use serde_json::Value;
use vpl::lang::{self, Compilation, Format, Memory, render};

use super::support::*;

fn many() -> Compilation {
    lang::compile("many.vpl", &Folder("tests/diagnostics/programs".into()))
}

fn rendered(format: Format) -> String {
    let many = many();
    render(&many.diagnostics, &many.sources, format)
}

const HUMAN: Format = Format::Human {
    colour: false,
    width: 80,
};

#[test]
fn human_form() {
    insta::assert_snapshot!(rendered(HUMAN));
}

#[test]
fn plain_form() {
    insta::assert_snapshot!(rendered(Format::Plain));
}

#[test]
fn short_form() {
    insta::assert_snapshot!(rendered(Format::Short));
}

#[test]
fn json_form() {
    insta::assert_snapshot!(rendered(Format::Json));
}

/// The digests of the standard library change with it, and the version with a release.
#[test]
fn sarif_form() {
    let mut log: Value = serde_json::from_str(&rendered(Format::Sarif)).unwrap();
    let driver = &mut log["runs"][0]["tool"]["driver"];
    driver["version"] = "VERSION".into();
    driver["semanticVersion"] = "VERSION".into();
    for rule in driver["rules"].as_array_mut().unwrap() {
        rule["help"] = "PAGE".into();
    }
    log["runs"][0]["artifacts"]
        .as_array_mut()
        .unwrap()
        .retain(|file| file["location"]["uriBaseId"].is_null());
    insta::assert_snapshot!(format!("{log:#}"));
}

fn text(program: &str, format: Format) -> String {
    let compiled = lang::compile("m.vpl", &Memory::of("m.vpl", program));
    render(&compiled.diagnostics, &compiled.sources, format)
}

/// Marks stand under what they mark: in cells of a terminal, not in characters.
#[test]
fn marks_stand_under_tabs_and_wide_characters() {
    let said = text("vpl 1\nlet a =\t\"大大\" + b\n", HUMAN);
    let lines: Vec<&str> = said.lines().collect();
    assert!(lines.contains(&" 2 │ let a = \"大大\" + b"), "{said}");
    assert!(lines.contains(&"   ·                  ━"), "{said}");
}

#[test]
fn distant_labels_are_drawn_without_what_lies_between() {
    let between = "// nothing\n".repeat(3_000);
    let said = text(&format!("vpl 1\nlet a = 1 mm\n{between}let a = 2 mm\n"), HUMAN);
    assert!(said.contains("⋮") && said.lines().count() < 15, "{said}");
}

#[test]
fn a_very_long_line_is_cut_and_done_in_bounded_time() {
    let line = "a".repeat(1 << 16);
    for program in [
        format!("vpl 1\nlet x = {line}\n"),
        format!("vpl 1\nlet x = [{}b]\n", "b, ".repeat(5_000)),
    ] {
        let said = text(&program, HUMAN);
        let excerpt = said.lines().filter(|line| line.contains('│'));
        let widest = excerpt.map(|line| line.chars().count()).max().unwrap();
        assert!(widest <= 80, "{widest}");
    }
}

#[test]
fn no_form_for_people_writes_what_a_terminal_obeys() {
    let program = "vpl 1\nlet a = \"\u{1b}[2J\" + b\u{202e}c\n\u{7}\n";
    for format in [HUMAN, Format::Plain, Format::Short] {
        let said = text(program, format);
        let obeyed = said
            .chars()
            .find(|c| (c.is_control() && *c != '\n') || *c == '\u{202e}');
        assert_eq!(obeyed, None, "{format:?}: {said:?}");
    }
}

#[test]
fn a_report_for_people_ends_with_where_to_read_on_once() {
    let file = "tests/ui/E0302_units.vpl";
    let ran = vpl(&["check", file, "tests/ui/E0201_unknown_name.vpl"]);
    assert_eq!(err(&ran).lines().last(), Some("for more, run `vpl explain E0302`"));
    assert_eq!(err(&ran).matches("vpl explain").count(), 1);
    for other in [
        vpl(&["check", "--format", "short", file]),
        vpl(&["check", "--format", "plain", file]),
        vpl(&["check", "tests/ui/W0402_useless_features.vpl"]),
    ] {
        assert!(!err(&other).contains("vpl explain"), "{}", err(&other));
    }
    let compile = vpl(&["compile", file]);
    assert!(
        err(&compile).ends_with("for more, run `vpl explain E0302`\n"),
        "{}",
        err(&compile)
    );
}

/// A strict schema of what is written, from the specification: no key but the known.
#[test]
fn sarif_is_as_the_standard_wants_it_whatever_is_wrong() {
    let mut schemas = boon::Schemas::new();
    let mut compiler = boon::Compiler::new();
    compiler.enable_format_assertions();
    let schema = include_str!("sarif.schema.json");
    compiler
        .add_resource("sarif.json", serde_json::from_str(schema).unwrap())
        .unwrap();
    let schema = compiler.compile("sarif.json", &mut schemas).unwrap();
    let mut files: Vec<String> = programs("tests/ui")
        .iter()
        .map(|name| format!("tests/ui/{name}"))
        .collect();
    files.push("tests/diagnostics/programs/many.vpl".into());
    files.push("examples/solids/solids.vpl".into());
    let mut arguments = vec!["check", "--format", "sarif", "/nowhere/ä ö.vpl"];
    arguments.extend(files.iter().map(String::as_str));
    let ran = vpl(&arguments);
    assert_eq!(ran.status.code(), Some(1));
    assert_eq!(err(&ran), "");
    let log: Value = serde_json::from_slice(&ran.stdout).unwrap();
    if let Err(error) = schemas.validate(&log, schema) {
        panic!("{error:#}");
    }
    indices_point_to_what_they_name(&log["runs"][0]);
}

fn indices_point_to_what_they_name(run: &Value) {
    let rules = run["tool"]["driver"]["rules"].as_array().unwrap();
    let artifacts = run["artifacts"].as_array().unwrap();
    let results = run["results"].as_array().unwrap();
    assert!(results.len() > 100);
    for result in results {
        let index = result["ruleIndex"].as_u64().unwrap() as usize;
        assert_eq!(rules[index]["id"], result["ruleId"]);
        let physical = &result["locations"][0]["physicalLocation"];
        let location = &physical["artifactLocation"];
        let artifact = &artifacts[location["index"].as_u64().unwrap() as usize];
        assert_eq!(artifact["location"]["uri"], location["uri"]);
        let region = &physical["region"];
        let end = region["byteOffset"].as_u64().unwrap() + region["byteLength"].as_u64().unwrap();
        assert!(end <= artifact["length"].as_u64().unwrap());
    }
}
