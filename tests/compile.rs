//! `vpl compile`: the rule sets of both experiments, and the command's contract.

use std::process::Command;

use vpl::lang::{self, Memory, ReadFailure, World};
use vpl::rules::{Expr, RuleSet, Value};

/// The file system below the package.
struct Disk;

impl World for Disk {
    fn read(&self, path: &str) -> Result<Vec<u8>, ReadFailure> {
        std::fs::read(path).map_err(|_| ReadFailure::Missing)
    }
}

fn compiled(path: &str) -> RuleSet {
    let compiled = lang::compile(path, &Disk);
    let said = lang::render(&compiled.diagnostics, &compiled.sources, lang::Format::Plain);
    compiled.rules.unwrap_or_else(|| panic!("{said}"))
}

#[test]
fn the_rule_set_of_the_solids() {
    insta::assert_snapshot!(compiled("examples/solids/solids.vpl").to_json());
}

#[test]
fn the_rule_set_of_the_tanks() {
    let rules = compiled("examples/tanks/tanks.vpl");
    let library = &rules.libraries[0];
    let name = |id: vpl::rules::FeatureId| library.feature(id).name.as_str();
    let lines: Vec<String> = library
        .rules
        .iter()
        .map(|rule| {
            let from: Vec<&str> = rule.antecedents.iter().map(|a| name(*a)).collect();
            let text = rule.detect.text("text").unwrap();
            let pose = match rule
                .predict
                .as_ref()
                .and_then(|p| p.constant("antecedent_from_consequent"))
            {
                Some(Value::Pose(pose)) => format!(" {:.3?}", pose.translation.vector.as_slice()),
                _ => String::new(),
            };
            format!(
                "{}: {} -> {} ({text}){pose}",
                rule.id,
                from.join(", "),
                name(rule.consequent)
            )
        })
        .collect();
    insta::assert_snapshot!("tanks_rules", lines.join("\n"));
    insta::assert_json_snapshot!("tanks_classes", library.classes);
    insta::assert_json_snapshot!("tanks_first_pair", library.rules[7]);
    insta::assert_json_snapshot!("tanks_task", rules.tasks);
    insta::assert_json_snapshot!("tanks_first_object", rules.scenes[0].objects[0]);
}

/// The paper's counts: r1 … r9, and r1 … r7 with all ordered pairs.
#[test]
fn the_paper_has_nine_and_forty_nine_rules() {
    assert_eq!(compiled("examples/solids/solids.vpl").libraries[0].rules.len(), 9);
    let tanks = &compiled("examples/tanks/tanks.vpl").libraries[0];
    assert_eq!(tanks.rules.len(), 7 + 7 * 6);
    assert_eq!(tanks.classes.len(), 12);
}

/// H(f1..f7) of the paper's Fig. 8 with uniform priors, in bits.
#[test]
fn the_presence_table_has_the_entropies_of_the_paper() {
    let tanks = &compiled("examples/tanks/tanks.vpl").libraries[0];
    let entropies: Vec<f64> = tanks
        .feature_ids()
        .map(|id| {
            let p: f64 = tanks
                .classes
                .iter()
                .filter(|c| c.presence.has(id))
                .map(|c| c.prior)
                .sum();
            -p * p.log2() - (1.0 - p) * (1.0 - p).log2()
        })
        .collect();
    for (found, expected) in entropies
        .iter()
        .zip([0.4138, 0.9183, 0.9799, 0.9799, 0.8113, 0.8113, 0.6500])
    {
        assert!((found - expected).abs() < 5e-5, "{entropies:?}");
    }
}

/// Going from a to b and from b to a is going nowhere.
#[test]
fn the_pairs_of_a_layout_are_inverse() {
    let tanks = &compiled("examples/tanks/tanks.vpl").libraries[0];
    let pose = |a: u32, b: u32| {
        let of = |r: &&vpl::rules::Rule| r.antecedents.iter().any(|x| x.0 == a) && r.consequent.0 == b;
        let rule = tanks.rules.iter().find(of).unwrap();
        match rule.predict.as_ref().unwrap().constant("antecedent_from_consequent") {
            Some(Value::Pose(pose)) => *pose,
            other => panic!("{other:?}"),
        }
    };
    for (a, b) in [(0, 1), (2, 6), (5, 3)] {
        let there_and_back = pose(a, b) * pose(b, a);
        assert!(there_and_back.translation.vector.norm() < 1e-12);
        assert!(there_and_back.rotation.angle() < 1e-7);
    }
    let apart = pose(0, 1).translation.vector.norm();
    assert!((apart - 0.91).abs() < 2e-3, "{apart}");
}

#[test]
fn an_artefact_reads_back_as_it_was() {
    for path in ["examples/solids/solids.vpl", "examples/tanks/tanks.vpl"] {
        let rules = compiled(path);
        assert_eq!(RuleSet::from_json(&rules.to_json()).unwrap(), rules);
    }
}

/// The bytes do not depend on where the compiler stands.
#[test]
fn the_artefact_is_the_same_from_every_folder() {
    let compile = |folder: &str, path: &str| {
        let output = Command::new(env!("CARGO_BIN_EXE_vpl"))
            .args(["compile", path])
            .current_dir(folder)
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(0));
        output.stdout
    };
    let here = compile(".", "examples/tanks/tanks.vpl");
    assert_eq!(here, compile("examples", "tanks/tanks.vpl"));
    assert_eq!(here, compile("examples/tanks", "./tanks.vpl"));
    assert_eq!(here, compiled("examples/tanks/tanks.vpl").to_json().into_bytes());
}

#[test]
fn modules_of_the_user_are_imported_by_relative_path() {
    let mut world = Memory::of(
        "work/main.vpl",
        "vpl 1\nuse \"parts/a.vpl\".{far}\nlet reach = far(2)\n",
    );
    let parts = [
        (
            "work/parts/a.vpl",
            "vpl 1\nuse \"../b.vpl\".near\nlet far(n: count) = n * near\n",
        ),
        ("work/b.vpl", "vpl 1\nlet near = 3 mm\n"),
    ];
    for (path, text) in parts {
        world.0.insert(path.into(), text.into());
    }
    let compiled = lang::compile("work/main.vpl", &world);
    assert_eq!(compiled.diagnostics, []);
    let sources: Vec<String> = compiled.rules.unwrap().sources.into_iter().map(|s| s.path).collect();
    assert_eq!(sources, ["main.vpl", "parts/a.vpl", "b.vpl"]);
}

#[test]
fn families_range_over_their_indices_and_skip_themselves() {
    let text = "vpl 1\nlibrary l {\n feature a[1..3] : marker\n class c { a }\n class d { a[2..3] }\n
        rule -> a[i] {\n detect qr(\"a{i}\", 10 cm)\n measure marker_pose()\n}\n
        rule a[i] -> a[j] {\n detect qr(\"a{j}\", 10 cm)\n measure marker_pose()\n
        predict rigid_marker(a[i].pose, a[i].pose, 10 cm * 2 - 5 cm)\n}\n}\n";
    let compiled = lang::compile("m", &Memory::of("m", text));
    let rules = compiled.rules.unwrap_or_else(|| panic!("{:?}", compiled.diagnostics));
    let library = &rules.libraries[0];
    assert_eq!(library.rules.len(), 3 + 6);
    let pairs: Vec<(u32, u32)> = library.rules[3..]
        .iter()
        .map(|r| (r.antecedents[0].0, r.consequent.0))
        .collect();
    assert_eq!(pairs, [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)]);
    assert_eq!(library.rules[4].detect.text("text").unwrap(), "a3");
    let size = library.rules[3].predict.as_ref().unwrap().length("size").unwrap();
    assert!((size - 0.15).abs() < 1e-12);
    assert_eq!(String::from(library.classes[1].presence.clone()), "011");
}

#[test]
fn priors_are_normal() {
    let text = "vpl 1\nlibrary l {\n feature a : polygon\n class c { a } prior 30 %\n
        classes by a {\n d 0 prior 70 %\n }\n
        rule -> a {\n detect planar_region()\n measure outline()\n}\n}\n";
    let compiled = lang::compile("m", &Memory::of("m", text));
    let rules = compiled.rules.unwrap_or_else(|| panic!("{:?}", compiled.diagnostics));
    let priors: Vec<f64> = rules.libraries[0].classes.iter().map(|c| c.prior).collect();
    assert_eq!(priors, [0.3, 0.7]);
}

#[test]
fn an_else_keeps_both_sides_for_the_planner() {
    let solids = &compiled("examples/solids/solids.vpl").libraries[0];
    let r4 = solids.rules[3].predict.as_ref().unwrap();
    assert!(matches!(&r4.arguments["height"], Expr::Else(a, b)
        if matches!(**a, Expr::Attribute { .. }) && **b == Expr::Value(Value::Length(0.3))));
}

#[test]
fn a_result_that_cannot_be_written_is_a_clean_error() {
    let output = Command::new(env!("CARGO_BIN_EXE_vpl"))
        .args(["compile", "examples/tanks/tanks.vpl", "-o", "/nowhere/at/all.json"])
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(
        said.starts_with("error[E0601]: `/nowhere/at/all.json` cannot be written"),
        "{said}"
    );
    if std::path::Path::new("/dev/full").exists() {
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let status = Command::new(env!("CARGO_BIN_EXE_vpl"))
            .args(["compile", "examples/tanks/tanks.vpl"])
            .stdout(full)
            .status()
            .unwrap();
        assert_eq!(status.code(), Some(1));
    }
}
