//! Fragments of programs, completed by a frame in which they must be right.

use vpl::lang::{self, Code, Memory, Severity};

/// What is wrong with a fragment in the frame that fits it best.
pub fn check(text: &str) -> Option<String> {
    let mut nearest: Option<(usize, String)> = None;
    for frame in [
        entries,
        statements_of_a_rule,
        statements_of_a_task,
        statements_of_a_scene,
        items,
        alone,
        with_imports,
        after_the_tanks,
        after_the_solids,
    ] {
        let program = frame(text);
        let compiled = lang::compile("main.vpl", &Memory::of("main.vpl", &program));
        // Task checks of a fragment mean little: it is not whole.
        let errors = compiled
            .diagnostics
            .iter()
            .filter(|d| d.severity == Severity::Error && d.code < Code::E0401);
        let said: Vec<String> = errors.map(|d| format!("{}: {}", d.code, d.message)).collect();
        let first = said.first()?.clone();
        if nearest.as_ref().is_none_or(|(fewest, _)| said.len() < *fewest) {
            nearest = Some((said.len(), first));
        }
    }
    nearest.map(|(_, said)| said)
}

const USES: &str = "vpl 1
use std.cameras.kinect_v2
use std.detect.coloured_plane
use std.markers.{small_qr, large_qr}
use std.solids.{above, square_under, upright_rectangle}
use std.views.{sphere, hemisphere, ring, from_positions}
";

/// Features that fragments speak of; those that a fragment declares itself are left out.
const FEATURES: &[(&str, &str)] = &[
    ("bottom", "polygon"),
    ("side", "polygon many"),
    ("code", "marker"),
    ("label", "marker"),
    ("lid", "polygon"),
];

fn features(text: &str) -> String {
    let declared = |name: &str| text.contains(&format!("feature {name}"));
    let missing = FEATURES.iter().filter(|(name, _)| !declared(name));
    let line = |(name, kind): &(&str, &str)| match *name {
        "code" => format!("  feature code[1..7] : {kind}\n"),
        name => format!("  feature {name} : {kind}\n"),
    };
    missing.map(line).collect()
}

fn entries(text: &str) -> String {
    let class = if text.contains("class") {
        ""
    } else {
        "  class it { bottom }\n"
    };
    format!("{USES}library it {{\n{}{text}{class}}}\n", features(text))
}

fn statements_of_a_rule(text: &str) -> String {
    let mut rule = text.to_owned();
    for (word, usual) in [
        ("detect", "detect coloured_plane(red)\n"),
        ("measure", "measure outline()\n"),
        ("predict", "predict upright_rectangle(on: bottom.base, height: 1 m)\n"),
    ] {
        if !text.contains(word) {
            rule.push_str(usual);
        }
    }
    format!(
        "{USES}library it {{\n{}rule bottom -> side {{\n{rule}}}\nclass it {{ bottom }}\n}}\n",
        features(text)
    )
}

const TASK: &[&str] = &[
    "library tanks",
    "goal confident",
    "camera kinect_v2",
    "space cube(1 m) at [0 mm, 0 mm, 500 mm] voxel 20 mm",
    "views sphere(radius: 1.5 m, count: 16)",
    "thresholds { near: 30 mm, absent: 95 %, confidence: 99 % }",
];

fn statements_of_a_task(text: &str) -> String {
    let begins = |word: &str| text.lines().any(|l| l.split_whitespace().next() == Some(word));
    let rest: String = TASK
        .iter()
        .filter(|s| !begins(s.split(' ').next().unwrap_or_default()))
        .map(|s| format!("{s}\n"))
        .collect();
    format!("{USES}{LIBRARY}task do_it {{\n{text}{rest}}}\n")
}

const LIBRARY: &str = "library tanks {
  feature code[1..7] : marker
  class tk1 { code[1] }
  class tk2 { code[2] }
  rule -> code[i] {
    detect small_qr(\"{i}\")
    measure marker_pose()
  }
  layout hull {
    code[1] at [0 mm, 0 mm, 0 mm] facing +z
    code[2] at [1 m, 0 mm, 0 mm] facing +z
  }
}
";

fn statements_of_a_scene(text: &str) -> String {
    format!("{USES}{LIBRARY}scene room {{\n{text}}}\n")
}

fn items(text: &str) -> String {
    format!("{USES}{LIBRARY}{text}")
}

fn alone(text: &str) -> String {
    format!("vpl 1\n{text}")
}

fn with_imports(text: &str) -> String {
    format!("{USES}{text}")
}

fn after_the_tanks(text: &str) -> String {
    format!("{}\n{text}", include_str!("../../examples/tanks/tanks.vpl"))
}

fn after_the_solids(text: &str) -> String {
    format!("{}\n{text}", include_str!("../../examples/solids/solids.vpl"))
}
