//! What the words of the language mean, and the `///` lines above a declaration.

/// The `///` lines that end right above the line of a byte.
pub(super) fn above(text: &str, at: usize) -> String {
    let start = text
        .get(..at)
        .map_or(0, |before| before.rfind('\n').map_or(0, |n| n + 1));
    let mut lines: Vec<&str> = text[..start]
        .lines()
        .rev()
        .map_while(|line| line.trim_start().strip_prefix("///"))
        .map(|line| line.strip_prefix(' ').unwrap_or(line).trim_end())
        .collect();
    lines.reverse();
    lines.join("\n")
}

/// What a keyword says.
pub(super) fn keyword(word: &str) -> Option<&'static str> {
    WORDS.iter().find(|(name, _)| *name == word).map(|(_, doc)| *doc)
}

/// What a word that a statement takes says.
pub(super) fn word(word: &str) -> Option<&'static str> {
    CHOICES.iter().find(|(name, _)| *name == word).map(|(_, doc)| *doc)
}

/// What a field of a statement says.
pub(super) fn field(statement: &str, field: &str) -> Option<&'static str> {
    let found = FIELDS.iter().find(|(s, f, _)| (*s, *f) == (statement, field));
    found.map(|(.., doc)| *doc)
}

const FIELDS: &[(&str, &str, &str)] = &[
    (
        "thresholds",
        "near",
        "ξ: how close a measured point must be to a predicted one.",
    ),
    (
        "thresholds",
        "absent",
        "ξ_ned: the share of a predicted place to inspect before its feature counts as absent.",
    ),
    (
        "thresholds",
        "confidence",
        "ξ_cfd: the probability from which on a class counts as certain.",
    ),
    ("sensor_model", "hit", "P(occupied) after one hit."),
    ("sensor_model", "miss", "P(occupied) after one miss."),
    ("sensor_model", "clamp_min", "The lowest probability of a voxel."),
    ("sensor_model", "clamp_max", "The highest probability of a voxel."),
    (
        "sensor_model",
        "occupied",
        "A voxel counts as occupied from this probability on.",
    ),
];

const WORDS: &[(&str, &str)] = &[
    (
        "given",
        "What is supposed: features that are detected, absent, or measured somewhere.",
    ),
    ("expect", "What must follow from what is given."),
    (
        "vpl",
        "The edition of the language that a file is written in: its first line.",
    ),
    (
        "use",
        "Brings definitions of another file or of the standard library into scope.",
    ),
    (
        "let",
        "Defines an expression under a name, with parameters where it needs some.",
    ),
    (
        "library",
        "What is known about the objects of a task: their features, classes and rules.",
    ),
    (
        "task",
        "What a robot is to find out: with which library, camera, space, views and goal.",
    ),
    (
        "scene",
        "What the built-in simulator shows. A planning session never reads it.",
    ),
    ("test", "Facts that `vpl test` holds a library to."),
    (
        "study",
        "An experiment for `vpl study`: objects × methods × starts × noise × variants of a task.",
    ),
    (
        "program",
        "The file whose task and objects are studied; this one where left out.",
    ),
    (
        "objects",
        "Which objects; all of the program's and this file's where left out.",
    ),
    (
        "methods",
        "The methods that are compared; the first is what the others are held against.",
    ),
    (
        "starts",
        "From how many first views, evenly spread over the candidates.",
    ),
    (
        "seeds",
        "How often a run that chance decides is repeated with another seed.",
    ),
    ("noise", "What the depth camera does to depth; each is run."),
    ("published", "A table of published numbers that stands beside ours."),
    ("variant", "The same runs with other settings; `usual` is without."),
    (
        "feature",
        "A local surface by which objects are known: a polygon, a marker or a shell.",
    ),
    ("many", "An object can have several instances of the feature."),
    ("class", "A kind of object, by the features that it has."),
    (
        "classes",
        "Several classes as a table: a row a class, a 1 or a 0 a feature.",
    ),
    ("by", "The features that are the columns of the table."),
    (
        "prior",
        "How probable a class is before anything was seen. Every class has one, or none.",
    ),
    (
        "rule",
        "How the feature behind `->` is detected, measured and predicted once those before it are known.",
    ),
    (
        "layout",
        "Where markers stand on an object. Seeing one predicts all others.",
    ),
    ("at", "Where it is."),
    ("facing", "The direction in which the print looks."),
    (
        "for",
        "Repeats the rule for each part of a measured feature: `for each edge in bottom.edges`.",
    ),
    (
        "each",
        "Repeats the rule for each part of a measured feature: `for each edge in bottom.edges`.",
    ),
    ("in", "The list that `for each` goes over."),
    ("detect", "What proves that the feature is there."),
    ("measure", "What measures the feature once it is detected."),
    ("predict", "Where the feature must be, from what the rule starts with."),
    ("else", "What holds until the attribute before it is measured."),
    (
        "goal",
        "When the task is done: `confident` of a class, `exhausted` surroundings, or both.",
    ),
    ("and", "Both goals must be reached."),
    ("camera", "The sensor: images, fields of view, range."),
    (
        "space",
        "The part of the world that is mapped: its shape, its centre, and the edge of a voxel.",
    ),
    ("voxel", "The edge of a cell of the map."),
    ("views", "The candidate views to choose from."),
    ("thresholds", "ξ (`near`), ξ_ned (`absent`) and ξ_cfd (`confidence`)."),
    ("limit", "Most views, the first included."),
    (
        "overlap",
        "The share of a view that `gno` wants to overlap with what is known.",
    ),
    ("method", "How the next view is chosen."),
    ("gain_floor", "Gains of fewer voxels count as none."),
    (
        "inspected",
        "What counts as evidence about a predicted place: `observed`, or `near_point` alone.",
    ),
    (
        "visibility",
        "What hides a voxel: `exact` sight lines, or what is drawn at its `centre`, faster and coarser.",
    ),
    (
        "verify",
        "`all`: confident only when every predicted feature of the winning class was inspected.",
    ),
    (
        "insertion",
        "How measurements enter the map: `exact` along rays, or `projective`, by the pixel that a voxel falls on.",
    ),
    ("sensor_model", "What a reading says about a voxel, as probabilities."),
    ("backdrop", "What stands behind the objects: `sphere(…)`, or `none`."),
    (
        "object",
        "Something that the simulator can show, by its shape and its place.",
    ),
    ("turned", "How far it is turned about the vertical."),
    ("marked", "The layout whose codes are printed on it."),
    ("as", "The class that says which codes those are."),
];

const CHOICES: &[(&str, &str)] = &[
    ("confident", "Until one class is certain enough."),
    ("exhausted", "Until no predicted feature is left to look for."),
    ("observed", "A point was measured near the place, or it was seen free."),
    (
        "near_point",
        "A point was measured near the place; one that turns out empty is never ruled out.",
    ),
    (
        "exact",
        "`insertion`: a ray goes to every voxel with a point and frees those before it, as OctoMap does. `visibility`: an occupied voxel on the line to the eye hides.",
    ),
    (
        "projective",
        "Free is what lies in front of the reading of its pixel: several times faster where voxels are small, without slivers along silhouettes.",
    ),
    (
        "centre",
        "A voxel is hidden where an occupied one is drawn nearer at its centre; errs towards hidden.",
    ),
    ("all", "Every predicted feature of the winning class."),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lang::vocabulary;

    #[test]
    fn the_lines_right_above_document() {
        let text = "// no\n/// One.\n  ///  Two.\nlet a = 1\n\n/// far\n\nlet b = 2\n";
        assert_eq!(above(text, text.find("let a").unwrap()), "One.\n Two.");
        assert_eq!(above(text, text.find("let b").unwrap() + 4), "");
        assert_eq!(above("let a = 1", 4), "");
    }

    #[test]
    fn every_reserved_word_is_explained() {
        assert!(WORDS.iter().filter(|(w, _)| vocabulary::is_reserved(w)).count() == 12);
        for statement in ["thresholds", "sensor_model"] {
            let fields = vocabulary::fields(statement);
            assert!(fields.iter().all(|(f, _)| field(statement, f).is_some()), "{statement}");
        }
        for statement in ["goal", "inspected", "visibility", "verify", "insertion"] {
            assert!(
                vocabulary::words(statement).iter().all(|w| word(w).is_some()),
                "{statement}"
            );
        }
    }
}
