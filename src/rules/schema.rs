//! The JSON Schema of the rule set, derived from its types: `docs/ruleset.schema.json`
//! holds it, and tests hold the file to the types and the artefacts to the file.

use schemars::JsonSchema;

use super::{FORMAT, RuleSet};

/// A rigid transform as it is written.
#[derive(JsonSchema)]
#[expect(dead_code, reason = "stands for nalgebra's isometry in the schema")]
#[schemars(deny_unknown_fields)]
pub(super) struct Pose {
    /// Unit quaternion: x, y, z, w.
    rotation: [f64; 4],
    /// Metres.
    translation: [f64; 3],
}

const HELD: &str = include_str!("../../docs/ruleset.schema.json");

fn derived() -> String {
    let mut schema = schemars::schema_for!(RuleSet);
    schema.insert(
        "$comment".into(),
        "derived from src/rules by its tests; UPDATE_SCHEMA=1 cargo test --lib rules::schema writes it".into(),
    );
    schema.insert("title".into(), format!("VPL rule set, format {FORMAT}").into());
    format!("{:#}\n", schema.to_value())
}

fn compiled(path: &str) -> serde_json::Value {
    let compiled = crate::lang::compile(path, &crate::cli::Disk);
    let rules = compiled.rules.unwrap_or_else(|| panic!("{path} does not compile"));
    serde_json::from_str(&rules.to_json()).unwrap()
}

fn accepts(artefact: &serde_json::Value) -> bool {
    let mut schemas = boon::Schemas::new();
    let mut compiler = boon::Compiler::new();
    compiler
        .add_resource("ruleset.json", serde_json::from_str(HELD).unwrap())
        .unwrap();
    let schema = compiler.compile("ruleset.json", &mut schemas).unwrap();
    schemas.validate(artefact, schema).is_ok()
}

#[test]
fn the_published_schema_is_that_of_the_types() {
    let derived = derived();
    if std::env::var_os("UPDATE_SCHEMA").is_some() {
        std::fs::write("docs/ruleset.schema.json", &derived).unwrap();
    } else {
        assert_eq!(
            HELD, derived,
            "docs/ruleset.schema.json is stale; its `$comment` names the command"
        );
    }
}

#[test]
fn compiled_programs_meet_the_published_schema() {
    for path in [
        "examples/tanks/tanks.vpl",
        "examples/solids/solids.vpl",
        "tests/plan/parcels.vpl",
    ] {
        assert!(accepts(&compiled(path)), "{path}");
    }
}

/// What the reader refuses, a validator finds too: other people's tools need only the schema.
#[test]
fn the_schema_refuses_what_the_reader_refuses() {
    let whole = compiled("examples/tanks/tanks.vpl");
    for (pointer, wrong) in [
        ("/libraries/0/classes/0/presence", serde_json::json!("10x")),
        ("/libraries/0/rules/0/consequent", serde_json::json!("code")),
        ("/libraries/0/rules/0/detect/primitive", serde_json::json!(null)),
        (
            "/libraries/0/rules/0/detect",
            serde_json::json!({"primitive": "qr", "args": {}}),
        ),
        ("/tasks/0/goal", serde_json::json!({"confident": true})),
        ("/tasks/0/inspected", serde_json::json!("sometimes")),
        ("/tasks/0/insertion", serde_json::json!("rays")),
        ("/tasks/0/limit", serde_json::json!(-3)),
        ("/sources/0", serde_json::json!({"path": "a.vpl"})),
    ] {
        let mut broken = whole.clone();
        *broken.pointer_mut(pointer).unwrap_or_else(|| panic!("{pointer}")) = wrong;
        assert!(RuleSet::from_json(&broken.to_string()).is_err(), "{pointer} is read");
        assert!(!accepts(&broken), "{pointer} meets the schema");
    }
}
