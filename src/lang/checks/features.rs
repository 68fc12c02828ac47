//! Features of no use: that no class has, that every class has, that nothing detects.

use std::collections::BTreeSet;

use super::Analysed;
use crate::lang::diagnostics::{Code, Diagnostic, Severity};
use crate::rules::{FeatureId, Library};

/// Features that no class has, or that no rule concludes.
pub(super) fn check(library: &Library) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    let concluded: BTreeSet<FeatureId> = library.rules.iter().map(|r| r.consequent).collect();
    for id in library.feature_ids() {
        let feature = library.feature(id);
        // A template has more than each of its users needs, and its file may be another's.
        let own = feature.place.file == library.place.file;
        if own && !library.classes.is_empty() && !library.classes.iter().any(|c| c.presence.has(id)) {
            found.push(
                Diagnostic::new(Code::W0402, feature.place, format!("no class has `{}`", feature.name))
                    .help("list it in a class, or leave it out"),
            );
        }
        if !concluded.contains(&id) {
            found.push(
                Diagnostic::new(
                    Code::W0404,
                    feature.place,
                    format!("no rule can detect `{}`", feature.name),
                )
                .help(format!("add `rule -> {} {{ … }}`", feature.name)),
            );
        }
    }
    found
}

/// Features that every class has: no use to a task that tells classes apart.
pub(super) fn common(task: &Analysed<'_>) -> Vec<Diagnostic> {
    let Some(library) = task.library.filter(|l| task.task.goal.confident && l.classes.len() > 1) else {
        return Vec::new();
    };
    let everywhere = |id: &FeatureId| library.classes.iter().all(|c| c.presence.has(*id));
    library
        .feature_ids()
        .filter(everywhere)
        .map(|id| {
            let feature = library.feature(id);
            let message = format!("every class has `{}`: it tells none apart", feature.name);
            Diagnostic::new(Code::W0403, feature.place, message)
                .severity(Severity::Note)
                .related(task.spans.head, "this task's goal is to tell classes apart")
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::testing::codes;
    use crate::lang::Code;

    const THIRD: (&str, &str) = (
        "feature right : marker",
        "feature right : marker\n feature third : marker",
    );

    #[test]
    fn fires_on_a_feature_of_no_class_and_of_no_rule() {
        assert_eq!(codes(&[THIRD]), [Code::W0402, Code::W0404]);
    }

    #[test]
    fn keeps_quiet_about_what_a_template_of_another_file_has() {
        let used = [
            (
                "use std.views.sphere",
                "use std.views.sphere\nuse std.markers.coded_box",
            ),
            (
                "feature left : marker",
                "use coded_box(width: 1 m, depth: 1 m, height: 1 m)\n feature left : marker",
            ),
            ("class both {", "class both { code[1], "),
        ];
        assert!(!codes(&used).contains(&Code::W0402), "{:?}", codes(&used));
    }

    #[test]
    fn keeps_quiet_about_a_feature_that_is_used() {
        let rule = "rule -> third {\n detect qr(\"t\", 200 mm)\n measure marker_pose()\n}\n layout flat";
        let used = [
            THIRD,
            ("class other { right }", "class other { right, third }"),
            ("layout flat", rule),
        ];
        assert_eq!(codes(&used), []);
    }

    #[test]
    fn notes_what_every_class_has_where_classes_are_told_apart() {
        let common = [
            ("class other { right }", "class other { left, right }"),
            ("class both { left, right }", ""),
        ];
        let common = [common[0], common[1], ("as both", "as one")];
        assert_eq!(codes(&common), [Code::W0403]);
        let told = [common[0], common[1], common[2], ("goal confident", "goal exhausted")];
        assert_eq!(codes(&told), []);
    }
}
