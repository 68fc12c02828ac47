//! How each statement is written, by the words that begin it.

/// The usage of the statement that a text begins like.
pub(super) fn of(text: &str) -> Option<&'static str> {
    let mut words = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
    let first = words.next()?;
    let found = USAGES.iter().find(|(word, _)| *word == first);
    found.map(|(_, usage)| *usage)
}

const USAGES: &[(&str, &str)] = &[
    ("backdrop", "backdrop sphere(radius: 2 m, colour: grey)"),
    ("angle", "let name = value"),
    ("camera", "camera kinect_v2"),
    ("class", "class prism { bottom, side } prior 60 %"),
    (
        "classes",
        "classes by code[1..3] { tk1 1 0 1 }, each row on a line of its own",
    ),
    ("detect", "detect coloured_plane(red)"),
    ("expect", "expect class tk9 50 %"),
    ("feature", "feature side : polygon many"),
    ("for", "for each edge in bottom.edges"),
    ("given", "given code[7] detected, code[4] absent"),
    ("goal", "goal confident and exhausted"),
    ("float", "let name = value"),
    ("int", "let name = value"),
    ("layout", "layout hull { code[1] at [450 mm, 0 mm, 250 mm] facing +x }"),
    ("length", "let name = value"),
    ("let", "let name(parameter: length) = value"),
    ("library", "library name { … }"),
    ("limit", "limit 20 views"),
    ("measure", "measure outline()"),
    ("method", "method gn"),
    ("methods", "methods gn, gno, random"),
    ("noise", "noise none, structured_light"),
    (
        "object",
        "object name = tank() at [0 mm, 0 mm, 0 mm] turned 30 deg marked tanks.hull as tk1",
    ),
    ("objects", "objects m1, m2, mesh(file: \"part.stl\", units: mm, up: z)"),
    ("overlap", "overlap 20 %"),
    ("predict", "predict square_under(side.base)"),
    ("program", "program \"solids.vpl\""),
    ("published", "published \"table1.csv\""),
    ("rule", "rule bottom -> side { … }"),
    ("scene", "scene name { … }"),
    ("sensor_model", "sensor_model { hit: 70 %, miss: 40 % }"),
    ("seeds", "seeds 4"),
    ("starts", "starts 16"),
    ("study", "study name { … }"),
    ("space", "space cube(600 mm) at [0 mm, 0 mm, 300 mm] voxel 10 mm"),
    ("task", "task name { … }"),
    ("test", "test \"what holds\" { … }"),
    (
        "thresholds",
        "thresholds { near: 10 mm, absent: 99 %, confidence: 99 % }",
    ),
    ("use", "use std.views.{sphere, ring}"),
    ("variant", "variant fine { voxel 5 mm }"),
    ("verify", "verify all"),
    ("views", "views sphere(radius: 1.4 m, count: 64)"),
];
