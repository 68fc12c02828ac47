//! Predictions that nothing starts: every chain must begin with a definite rule.

use std::collections::BTreeMap;

use crate::lang::diagnostics::{Code, Diagnostic};
use crate::recognition::Reach;
use crate::rules::{FeatureId, Library, Rule};

pub(super) fn check(library: &Library, reach: &Reach<'_>) -> Vec<Diagnostic> {
    let help = "add a rule without antecedents, which finds a feature by itself: `rule -> name { … }`";
    if !library.features.is_empty() && !library.rules.iter().any(|r| r.antecedents.is_empty()) {
        let message = format!("nothing in library `{}` can be detected first", library.name);
        return vec![Diagnostic::new(Code::E0405, library.place, message).help(help)];
    }
    let reached = reach.found(|_| true);
    let mut first: BTreeMap<FeatureId, &Rule> = BTreeMap::new();
    for rule in &library.rules {
        first.entry(rule.consequent).or_insert(rule);
    }
    library
        .feature_ids()
        .filter(|id| !reached[id.index()])
        .filter_map(|id| {
            let rule = first.get(&id)?;
            let name = &library.feature(id).name;
            let message = format!("nothing starts the predictions that lead to `{name}`");
            let waits = rule.antecedents.iter().find(|a| !reached[a.index()])?;
            let waits = library.feature(*waits);
            Some(
                Diagnostic::new(Code::W0406, rule.place, message)
                    .related(waits.place, format!("`{}` would have to be detected first", waits.name))
                    .help(help),
            )
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::testing::codes;
    use crate::lang::Code;

    #[test]
    fn fires_on_a_library_without_a_definite_rule() {
        let text = super::super::testing::program(&[]);
        let (from, to) = (text.find("  rule ->"), text.find("  layout"));
        let rules = &text[from.unwrap_or(0)..to.unwrap_or(0)];
        let weak = "rule left -> right {\n detect qr(\"r\", 200 mm)\n measure marker_pose()\n
            predict rigid_marker(left.pose, left.pose, 200 mm)\n}\n";
        let all = codes(&[(rules, weak), ("marked pair.flat as both", "")]);
        assert!(all.contains(&Code::E0405) || all.contains(&Code::E0502), "{all:?}");
    }

    #[test]
    fn fires_on_a_circle_and_not_on_a_chain() {
        let add = (
            "feature right : marker",
            "feature right : marker\n feature a : marker\n feature b : marker",
        );
        let class = ("class both { left, right }", "class both { left, right, a, b }");
        let rule = |from: &str, to: &str| {
            format!(
                "rule {from} -> {to} {{\n detect qr(\"{to}\", 200 mm)\n measure marker_pose()\n
                 predict rigid_marker({from}.pose, {from}.pose, 200 mm)\n}}\n"
            )
        };
        let circle = format!("{}{} layout flat", rule("a", "b"), rule("b", "a"));
        assert_eq!(
            codes(&[add, class, ("layout flat", &circle)]),
            [Code::W0406, Code::W0406]
        );
        let chain = format!("{}{} layout flat", rule("left", "a"), rule("a", "b"));
        assert_eq!(codes(&[add, class, ("layout flat", &chain)]), []);
    }
}
