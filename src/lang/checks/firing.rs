//! Rules that can never fire: their features occur together in no class.

use super::names;
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::rules::{Library, Rule};

pub(super) fn check(library: &Library) -> Vec<Diagnostic> {
    let mut found: Vec<Diagnostic> = Vec::new();
    for rule in library.rules.iter().filter(|r| !r.antecedents.is_empty()) {
        let together = library
            .classes
            .iter()
            .any(|c| rule.antecedents.iter().all(|a| c.presence.has(*a)));
        // A family or a layout says it once; one pair of a large one is no mistake.
        let expanded = library.rules.iter().filter(|r| r.place == rule.place).count() > 1;
        if !together && !expanded && !library.classes.is_empty() {
            found.push(report(rule, library));
        }
    }
    found
}

fn report(rule: &Rule, library: &Library) -> Diagnostic {
    let features = names(rule.antecedents.iter().map(|a| library.feature(*a).name.as_str()));
    let message = match rule.antecedents.len() {
        1 => format!("this rule can never fire: no class has {features}"),
        _ => format!("this rule can never fire: no class has {features} together"),
    };
    Diagnostic::new(Code::W0405, rule.place, message).help("correct the antecedents, or the classes")
}

#[cfg(test)]
mod tests {
    use super::super::testing::codes;
    use crate::lang::Code;

    const RULE: &str = "rule left, right -> third {\n detect qr(\"t\", 200 mm)\n measure marker_pose()\n
        predict rigid_marker(left.pose, right.pose, size: 200 mm)\n}\n layout flat";
    const THIRD: [(&str, &str); 2] = [
        (
            "feature right : marker",
            "feature right : marker\n feature third : marker",
        ),
        ("layout flat", RULE),
    ];

    #[test]
    fn fires_where_antecedents_never_meet() {
        let apart = [
            THIRD[0],
            THIRD[1],
            ("class both { left, right }", "class both { left, third }"),
        ];
        assert_eq!(codes(&apart), [Code::W0405]);
    }

    #[test]
    fn keeps_quiet_where_they_do() {
        let together = [
            THIRD[0],
            THIRD[1],
            ("class both { left, right }", "class both { left, right, third }"),
        ];
        assert_eq!(codes(&together), []);
    }
}
