//! Whole declarations to fill in, and the words that begin a statement.

use super::context::Block;
use super::{Completion, CompletionKind};
use crate::ide::docs;

/// What begins a statement in a block.
pub(super) fn statements(block: Block) -> Vec<Completion> {
    let words: &[(&str, &str)] = match block {
        Block::Top => TOP,
        Block::Library => LIBRARY,
        Block::Rule => RULE,
        Block::Task => TASK,
        Block::Scene => SCENE,
        Block::Test => TEST,
        Block::Study => STUDY,
        _ => &[],
    };
    words
        .iter()
        .map(|(word, snippet)| keyword(word).snippet(*snippet))
        .collect()
}

/// A keyword with what it says.
pub(super) fn keyword(word: &str) -> Completion {
    Completion::new(word, CompletionKind::Keyword).docs(docs::keyword(word).unwrap_or_default())
}

const TOP: &[(&str, &str)] = &[
    ("vpl", "vpl 1\n"),
    ("use", "use ${1:std}.$0"),
    ("let", "let ${1:name} = $0"),
    (
        "library",
        "library ${1:name} {\n  feature ${2:feature} : ${3:polygon}\n\n  class ${4:class} { ${2:feature} }\n\n  rule -> ${2:feature} {\n    detect  $0\n    measure \n  }\n}",
    ),
    (
        "task",
        "task ${1:name} {\n  library    ${2:library}\n  goal       ${3:confident}\n  camera     ${4:kinect_v2}\n  space      cube(${5:600 mm}) at [0 mm, 0 mm, ${6:300 mm}] voxel ${7:10 mm}\n  views      sphere(radius: ${8:1.4 m}, count: 64)\n  thresholds { near: ${9:20 mm}, absent: 99 %, confidence: 99 % }\n  limit      20 views$0\n}",
    ),
    (
        "test",
        "test \"${1:what holds}\" {\n  library ${2:library}\n  given  $3\n  expect $0\n}",
    ),
    (
        "scene",
        "scene ${1:name} {\n  backdrop sphere(radius: 2 m, colour: grey)\n  object ${2:name} = $0 at [0 mm, 0 mm, 300 mm]\n}",
    ),
    (
        "study",
        "study ${1:name} {\n  program \"${2:program.vpl}\"\n  methods ${3:gn, random}\n  starts  ${4:16}$0\n}",
    ),
];
const STUDY: &[(&str, &str)] = &[
    ("program", "program \"$0\""),
    ("task", "task $0"),
    ("objects", "objects $0"),
    ("methods", "methods $0"),
    ("starts", "starts ${1:16}"),
    ("seeds", "seeds ${1:1}"),
    ("noise", "noise $0"),
    ("published", "published \"$0\""),
    ("variant", "variant ${1:name} { $0 }"),
    ("voxel", "voxel ${1:10 mm}"),
    ("limit", "limit ${1:20} views"),
    ("sensor_model", "sensor_model { hit: ${1:70 %}, miss: ${2:40 %} }"),
];
const LIBRARY: &[(&str, &str)] = &[
    ("use", "use ${1:library}($0)"),
    ("feature", "feature ${1:name} : ${2:polygon}"),
    ("class", "class ${1:name} { $0 }"),
    ("classes", "classes by $1 {\n  $0\n}"),
    ("rule", "rule $1-> $2 {\n  detect  $3\n  measure $0\n}"),
    (
        "layout",
        "layout ${1:name} {\n  $2 at [0 mm, 0 mm, 0 mm] facing +x$0\n}",
    ),
];
const RULE: &[(&str, &str)] = &[
    ("for each", "for each ${1:edge} in $0"),
    ("detect", "detect $0"),
    ("measure", "measure $0"),
    ("predict", "predict $0"),
];
const TASK: &[(&str, &str)] = &[
    ("library", "library $0"),
    ("goal", "goal $0"),
    ("camera", "camera $0"),
    (
        "space",
        "space cube(${1:600 mm}) at [0 mm, 0 mm, ${2:300 mm}] voxel ${3:10 mm}",
    ),
    ("views", "views $0"),
    (
        "thresholds",
        "thresholds { near: ${1:20 mm}, absent: ${2:99 %}, confidence: ${3:99 %} }",
    ),
    ("limit", "limit ${1:20} views"),
    ("overlap", "overlap ${1:20 %}"),
    ("method", "method $0"),
    ("gain_floor", "gain_floor ${1:5} voxels"),
    ("inspected", "inspected $0"),
    ("visibility", "visibility $0"),
    ("verify", "verify all"),
    ("insertion", "insertion $0"),
    ("sensor_model", "sensor_model { hit: ${1:70 %}, miss: ${2:40 %} }"),
];
const TEST: &[(&str, &str)] = &[
    ("library", "library $0"),
    ("given", "given $0"),
    ("expect", "expect $0"),
];
const SCENE: &[(&str, &str)] = &[
    ("backdrop", "backdrop sphere(radius: ${1:2 m}, colour: ${2:grey})"),
    ("object", "object ${1:name} = $2 at [0 mm, 0 mm, ${3:300 mm}]$0"),
];
