//! Classes that nothing tells apart, where the goal is to tell them apart.

use std::collections::BTreeMap;

use super::{Analysed, names};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::recognition::Reach;
use crate::rules::{Class, Library};

pub(super) fn check(task: &Analysed<'_>) -> Vec<Diagnostic> {
    let Some(library) = task.library.filter(|_| task.task.goal.confident) else {
        return Vec::new();
    };
    let class = |k: usize| &library.classes[k];
    let pairs = pairs(library).into_iter();
    pairs
        .map(|(k, twin)| report(class(k), class(twin), library, task))
        .collect()
}

/// Classes that nothing tells apart, each with the first that is like it.
pub(super) fn pairs(library: &Library) -> Vec<(usize, usize)> {
    let mut detectable = Reach::new(library).found(|_| true);
    if !detectable.contains(&true) {
        // Nothing can be detected at all, which is said elsewhere.
        detectable.fill(true);
    }
    let mut first: BTreeMap<Vec<bool>, usize> = BTreeMap::new();
    let mut pairs = Vec::new();
    for (k, class) in library.classes.iter().enumerate() {
        let row = class.presence.0.iter().zip(&detectable);
        let seen = row.map(|(p, d)| *p && *d).collect();
        match first.get(&seen) {
            Some(twin) => pairs.push((k, *twin)),
            None => drop(first.insert(seen, k)),
        }
    }
    pairs
}

fn report(class: &Class, twin: &Class, library: &Library, task: &Analysed<'_>) -> Diagnostic {
    let differing: Vec<&str> = library
        .feature_ids()
        .filter(|id| class.presence.has(*id) != twin.presence.has(*id))
        .map(|id| library.feature(id).name.as_str())
        .collect();
    let (message, help) = if differing.is_empty() {
        (
            format!("classes `{}` and `{}` have the same features", twin.name, class.name),
            "give one of them a feature that the other lacks, or make them one class".to_owned(),
        )
    } else {
        (
            format!(
                "classes `{}` and `{}` differ only in {}, which nothing can detect",
                twin.name,
                class.name,
                names(differing.iter().copied())
            ),
            format!("add a rule that detects {}", names(differing)),
        )
    };
    Diagnostic::new(Code::E0401, class.place, message)
        .related(twin.place, "the other class")
        .related(task.spans.head, "this task's goal is to tell them apart")
        .help(help)
}

#[cfg(test)]
mod tests {
    use super::super::testing::codes;
    use crate::lang::Code;

    #[test]
    fn fires_on_equal_presence_under_a_confident_goal() {
        let twins = [("class other { right }", "class other { left }")];
        assert!(codes(&twins).contains(&Code::E0401));
    }

    #[test]
    fn fires_where_the_difference_cannot_be_detected() {
        let hidden = [
            (
                "feature right : marker",
                "feature right : marker\n feature dark : marker",
            ),
            (
                "class other { right }",
                "class other { right }\n class shady { right, dark }",
            ),
        ];
        assert_eq!(codes(&hidden), [Code::W0404, Code::E0401]);
    }

    #[test]
    fn keeps_quiet_where_classes_need_not_be_told_apart() {
        let exhausted = [
            ("class other { right }", "class other { left }"),
            ("goal confident", "goal exhausted"),
        ];
        assert_eq!(codes(&exhausted), []);
    }
}
