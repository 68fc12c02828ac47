//! Templates, defaults and attributes of parameters: what they compile to.

use vpl::lang::{Code, Compilation, FileId, Memory, compile};
use vpl::rules::{Expr, Library, RuleSet, Value};

const TASK: &str = "
use std.cameras.kinect_v2
use std.views.sphere
task tell {
  library mine
  goal confident
  camera kinect_v2
  space cube(600 mm) at [0 mm, 0 mm, 300 mm] voxel 10 mm
  views sphere(radius: 1.4 m, count: 64)
  thresholds { near: 10 mm, absent: 99 %, confidence: 99 % }
}
";
const BOXES: &str = r#"vpl 1
library pair(width: length, prefix: text = "b", size: length = 100 mm) {
  feature code[1..2] : marker
  class two { code }
  rule -> code[i] { detect qr(text: "{prefix}{i}", size: size); measure marker_pose() }
  layout faces {
    code[1] at [width / 2, 0 mm, 0 mm] facing +x
    code[2] at [-width / 2, 0 mm, 0 mm] facing -x
  }
}
library lidded(half: length) {
  feature lid : polygon
  use pair(width: 2 * half, prefix: "w")
  rule -> lid { detect planar_region(colour: red); measure outline() }
}
library plain {
  feature label : marker
  class labelled { label }
  rule -> label { detect qr(text: "label", size: 100 mm); measure marker_pose() }
}
"#;

#[track_caller]
fn compiled(main: &str) -> Compilation {
    let mut world = Memory::of("main.vpl", &format!("vpl 1\n{main}"));
    world.0.insert("boxes.vpl".into(), BOXES.into());
    compile("main.vpl", &world)
}

#[track_caller]
fn rules(main: &str) -> RuleSet {
    let compiled = compiled(main);
    compiled.rules.unwrap_or_else(|| panic!("{:#?}", compiled.diagnostics))
}

#[track_caller]
fn codes(main: &str) -> Vec<Code> {
    compiled(main).diagnostics.iter().map(|d| d.code).collect()
}

fn names(library: &Library) -> (Vec<&str>, Vec<(&str, String)>) {
    let classes = library.classes.iter();
    (
        library.features.iter().map(|f| f.name.as_str()).collect(),
        classes.map(|c| (c.name.as_str(), c.presence.clone().into())).collect(),
    )
}

/// The distance from the first to the second code, as the layout's rule predicts it.
fn distance(library: &Library) -> f64 {
    let predicted = library.rules.iter().find_map(|r| r.predict.as_ref()).unwrap();
    match &predicted.arguments["antecedent_from_consequent"] {
        Expr::Value(Value::Pose(pose)) => pose.translation.vector.norm(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn parts_stand_where_the_use_stands_and_keep_their_places() {
    let set = rules(&format!(
        "use \"boxes.vpl\".pair
library mine {{
  feature first : polygon
  class before {{ first, code[2] }}
  use pair(width: 300 mm)
  class after {{ code[1] }}
  feature last : polygon
  rule -> last {{ detect planar_region(colour: red); measure outline() }}
  rule -> first {{ detect planar_region(colour: blue); measure outline() }}
  class all {{ first, last, code }}
}}
{TASK}"
    ));
    let [library] = set.libraries.as_slice() else {
        panic!("a template is in the rule set")
    };
    let presence = |bits: &str| bits.to_owned();
    assert_eq!(
        names(library),
        (
            vec!["first", "code[1]", "code[2]", "last"],
            vec![
                ("before", presence("1010")),
                ("two", presence("0110")),
                ("after", presence("0100")),
                ("all", presence("1111")),
            ]
        )
    );
    let consequents: Vec<&str> = (library.rules.iter())
        .map(|r| library.feature(r.consequent).name.as_str())
        .collect();
    assert_eq!(
        consequents,
        ["code[1]", "code[2]", "last", "first", "code[2]", "code[1]"]
    );
    let files: Vec<&str> = (library.rules.iter())
        .map(|r| set.sources[r.place.file as usize].path.as_str())
        .collect();
    assert_eq!(
        files,
        [
            "boxes.vpl",
            "boxes.vpl",
            "main.vpl",
            "main.vpl",
            "boxes.vpl",
            "boxes.vpl"
        ]
    );
    assert!((distance(library) - 0.3).abs() < 1e-12);
}

#[test]
fn arguments_reach_through_templates_of_templates() {
    let set = rules(&format!(
        "use \"boxes.vpl\".lidded
let usual = 50 mm
library mine {{ use lidded(half: 2 * usual); class open {{ code[2] }}; class shut {{ code, lid }}; class half {{ code[1], lid }} }}
{TASK}"
    ));
    let library = &set.libraries[0];
    assert_eq!(names(library).0, ["lid", "code[1]", "code[2]"]);
    assert!((distance(library) - 0.2).abs() < 1e-12);
    let texts: Vec<&str> = library
        .rules
        .iter()
        .filter_map(|r| r.detect.text("text").ok())
        .collect();
    assert_eq!(texts[..2], ["w1", "w2"]);
    assert_eq!(library.rules[0].detect.length("size"), Ok(0.1));
}

#[test]
fn a_library_without_parameters_is_taken_over_and_stays_its_own() {
    let set = rules(&format!(
        "use \"boxes.vpl\".plain
library mine {{ use plain; feature other : marker; class second {{ other }}
  rule -> other {{ detect qr(text: \"o\", size: 100 mm); measure marker_pose() }} }}
{TASK}"
    ));
    let listed: Vec<&str> = set.libraries.iter().map(|l| l.name.as_str()).collect();
    assert_eq!(listed, ["plain", "mine"]);
    assert_eq!(names(&set.libraries[1]).0, ["label", "other"]);
}

#[test]
fn an_imported_library_serves_a_task_by_itself() {
    let task = TASK
        .replace("library mine", "library plain")
        .replace("goal confident", "goal exhausted");
    let set = rules(&format!("use \"boxes.vpl\".plain\n{task}"));
    assert_eq!(set.tasks[0].library, "plain");
}

#[test]
fn templates_are_checked_though_nothing_uses_them() {
    let wrong = "library unused(width: length) {
  feature code : marker
  rule -> code { detect qr(text: \"c\", size: 2 * widht); measure marker_pose() }
  layout l { code at [width, 90 deg, 0 mm] facing +x }
}";
    assert_eq!(codes(wrong), [Code::E0201, Code::E0301]);
    let measured = "library unused(face: polygon) { feature code : marker }";
    assert_eq!(codes(measured), [Code::E0301]);
}

#[test]
fn defaults_stand_in_for_arguments() {
    let set = rules(
        &format!(
            "let cube_of(size: length = 2 * 50 mm, turns: count = 4) = prism(sides: turns, radius: size, height: size)
let usual(size: length = 300 mm) = cube_of(size)
library mine {{ feature a : marker; feature b : marker; class x {{ a }} class y {{ b }}
  rule -> a {{ detect qr(text: \"a\", size: 100 mm); measure marker_pose() }}
  rule -> b {{ detect qr(text: \"b\", size: 100 mm); measure marker_pose() }} }}
scene s {{
  object one = cube_of at [0 mm, 0 mm, 0 mm]
  object two = cube_of() at [0 mm, 0 mm, 0 mm]
  object three = cube_of(turns: 6) at [0 mm, 0 mm, 0 mm]
  object four = usual() at [0 mm, 0 mm, 0 mm]
}}
{TASK}"
        )
        .replace("} class y", "}; class y"),
    );
    let shapes = set.scenes[0].objects.iter().map(|o| &o.shape);
    let read: Vec<_> = shapes
        .map(|s| (s.length("radius").unwrap(), s.count("sides").unwrap()))
        .collect();
    assert_eq!(read, [(0.1, 4), (0.1, 4), (0.1, 6), (0.3, 4)]);
}

const FACES: &str = "
library mine {
  feature bottom : polygon
  feature top : polygon
  feature side : polygon many
  class x { bottom, top }
  class y { bottom, side }
  rule -> bottom { detect planar_region(colour: red); measure outline() }
  rule bottom -> top {
    detect planar_region(colour: blue); measure outline()
    predict PREDICT
  }
  rule bottom -> side {
    for each edge in bottom.edges
    detect plane_beside(edge, dihedral: 90 deg, within: 10 deg); measure outline(first: edge)
    predict rectangle_on(on: edge, dihedral: 90 deg, height: HEIGHT)
  }
}
";

fn faces(definitions: &str, predict: &str, height: &str) -> String {
    let library = FACES.replace("PREDICT", predict).replace("HEIGHT", height);
    format!(
        "{definitions}{library}{}",
        TASK.replace("goal confident", "goal exhausted")
    )
}

#[test]
fn attributes_of_parameters_are_those_of_the_feature() {
    let set = rules(&faces(
        "let hinge(face: polygon) = rectangle_on(on: face.base, dihedral: 90 deg, height: 2 * face.height)
let through(it: polygon) = hinge(it)\n",
        "through(bottom)",
        "100 mm",
    ));
    let predict = set.libraries[0].rules[1].predict.as_ref().unwrap();
    let Expr::Attribute { feature, name } = &predict.arguments["on"] else {
        panic!("{predict:?}")
    };
    assert_eq!((feature.0, name.as_str()), (0, "base"));
}

/// What stands in with `else` may stand inside of a definition.
#[test]
fn a_definition_covers_what_is_not_measured_yet() {
    let height = "let height_of(face: polygon, usual: length = 300 mm) = face.height else usual
let twice(it: polygon) = 2 * height_of(it)\n";
    let predict = "rectangle_on(on: bottom.base, dihedral: 90 deg, height: 100 mm)";
    assert_eq!(codes(&faces(height, predict, "twice(side)")), []);
    let bare = "let height_of(face: polygon) = face.height\n";
    assert_eq!(codes(&faces(bare, predict, "height_of(side)")), [Code::W0401]);
    assert_eq!(codes(&faces(bare, predict, "height_of(side) else 1 m")), []);
}

#[test]
fn the_coded_box_of_the_standard_library_stands_on_its_faces() {
    let set = rules(&format!(
        "use std.markers.coded_box
library mine {{
  use coded_box(width: 400 mm, depth: 300 mm, height: 200 mm, prefix: \"p\", gap: 2 mm)
  classes by code[1..6] {{
    full 1 1 1 1 1 1
    open 1 1 1 1 0 1
  }}
}}
scene s {{ object o = prism(sides: 4, radius: 200 mm, height: 200 mm) at [0 mm, 0 mm, 300 mm] marked mine.faces as open }}
{TASK}"
    ));
    let markers = &set.scenes[0].objects[0].markers;
    let texts: Vec<&str> = markers.iter().map(|m| m.text.as_str()).collect();
    assert_eq!(texts, ["p1", "p2", "p3", "p4", "p6"]);
    let reach: Vec<f64> = (markers.iter())
        .map(|m| m.object_from_marker.translation.vector.norm())
        .collect();
    for (found, by_hand) in reach.iter().zip([0.202, 0.202, 0.152, 0.152, 0.102]) {
        assert!((found - by_hand).abs() < 1e-12, "{reach:?}");
    }
    assert_eq!(set.libraries[0].rules.len(), 6 + 30);
}

/// Whatever takes over what, compiling ends soon and says why it stopped.
#[test]
fn expansion_is_bounded() {
    let chain: String = (1..5_000)
        .map(|k| format!("library l{k}() {{ use l{} }}\n", k - 1))
        .collect();
    let found = codes(&format!("library l0() {{ feature f : polygon }}\n{chain}"));
    assert!(
        !found.is_empty() && found.iter().all(|c| *c == Code::E0312),
        "{found:?}"
    );
    let backwards: String = (1..5_000)
        .rev()
        .map(|k| format!("library l{k}() {{ use l{} }}\n", k - 1))
        .collect();
    let found = codes(&format!("{backwards}library l0() {{ feature f : polygon }}\n"));
    assert!(found.contains(&Code::E0312), "{found:?}");
    let wide: String = (0..200).map(|k| format!("library l{k}() {{ use all }}\n")).collect();
    let found = codes(&format!("library all() {{ feature f[1..4000] : polygon }}\n{wide}"));
    assert!(
        !found.is_empty() && found.iter().all(|c| *c == Code::E0312),
        "{found:?}"
    );
    // What is not constant is not folded: an argument that is used twice doubles.
    let doubled = format!("{}side.height else 1 mm{}", "twice(".repeat(24), ")".repeat(24));
    let predict = "rectangle_on(on: bottom.base, dihedral: 90 deg, height: 100 mm)";
    let found = codes(&faces("let twice(x: length) = x + x\n", predict, &doubled));
    assert!(found.contains(&Code::E0312), "{found:?}");
    let sum = " + 1 mm".repeat(250);
    let deep: String = (1..190)
        .map(|k| format!("let d{k}(x: length) = d{}(x){sum}\n", k - 1))
        .collect();
    let found = codes(&faces(
        &format!("let d0(x: length) = x\n{deep}"),
        predict,
        "d189(side.height else 1 mm)",
    ));
    assert!(found.contains(&Code::E0312), "{found:?}");
    let backwards: String = (1..190)
        .rev()
        .map(|k| format!("let d{k}(x: length) = d{}(x){sum}\n", k - 1))
        .collect();
    let found = codes(&faces(
        &format!("let d0(x: length) = x\n{backwards}"),
        predict,
        "d189(side.height else 1 mm)",
    ));
    assert!(found.contains(&Code::E0312), "{found:?}");
    let lets: String = (1..3_000).map(|k| format!("let a{k}() = a{}()\n", k - 1)).collect();
    let found = codes(&format!("let a0() = 1 mm\n{lets}"));
    assert!(found.contains(&Code::E0312), "{found:?}");
}

#[test]
fn what_is_wrong_inside_is_said_at_the_use() {
    let found = compiled("use \"boxes.vpl\".pair\nlibrary mine { use pair(width: 1 m, size: -1 mm) }");
    let first = &found.diagnostics[0];
    assert_eq!((first.code, first.primary.span.file), (Code::E0309, FileId(0)));
    assert_eq!(found.sources.text(first.primary.span), "-1 mm");
    assert_eq!(found.sources.text(first.related[0].span), "rule -> code[i]");
}
