//! Rules that can never fire, or never find what they are for.
//!
//! A rule fires on an object when all its antecedents were found, and what is found
//! depends on the object's class; so every class is followed. Members of a family and
//! pairs of a layout count together: one that never fires is no mistake.

use std::collections::BTreeMap;

use super::names;
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::source::Span;
use crate::recognition::Reach;
use crate::rules::{FeatureId, Library, Rule};

/// Most rules of all classes together that are followed.
const MOST_PAIRS: usize = 20_000_000;

pub(super) fn check(library: &Library, reach: &Reach<'_>) -> Vec<Diagnostic> {
    let classes = &library.classes;
    if classes.is_empty() || classes.len() * library.rules.len() > MOST_PAIRS {
        return Vec::new();
    }
    let started = reach.found(|_| true);
    let found = classes.iter().map(|c| reach.found(|f| c.presence.0[f])).collect();
    let firing = Firing { library, found };
    let mut by_place: BTreeMap<Span, Vec<&Rule>> = BTreeMap::new();
    for rule in &library.rules {
        by_place.entry(rule.place.into()).or_default().push(rule);
    }
    by_place
        .into_values()
        .filter_map(|rules| {
            let first = *rules.first()?;
            let starts = |r: &&Rule| !r.antecedents.is_empty() && r.antecedents.iter().all(|a| started[a.index()]);
            let idle = rules.iter().all(starts) && !rules.iter().any(|r| firing.succeeds(r));
            idle.then(|| firing.report(first, &rules)).flatten()
        })
        .collect()
}

struct Firing<'a> {
    library: &'a Library,
    /// By class: what the rules find on an object of it.
    found: Vec<Vec<bool>>,
}

impl Firing<'_> {
    fn fires(&self, rule: &Rule, class: usize) -> bool {
        rule.antecedents.iter().all(|a| self.found[class][a.index()])
    }

    fn succeeds(&self, rule: &Rule) -> bool {
        let has = |class: usize| self.library.classes[class].presence.has(rule.consequent);
        (0..self.found.len()).any(|class| has(class) && self.fires(rule, class))
    }

    fn report(&self, rule: &Rule, all: &[&Rule]) -> Option<Diagnostic> {
        let fires = |r: &Rule| (0..self.found.len()).any(|class| self.fires(r, class));
        match all.iter().find(|r| fires(r)) {
            Some(rule) => self.barren(rule),
            None => Some(self.dead(rule)),
        }
    }

    /// A rule that fires where its consequent is not.
    fn barren(&self, rule: &Rule) -> Option<Diagnostic> {
        let classes = &self.library.classes;
        // A feature that no class has is reported as such.
        classes.iter().find(|c| c.presence.has(rule.consequent))?;
        let message = format!(
            "this can never find `{}`: no class has it together with {}",
            self.name(rule.consequent),
            self.names(&rule.antecedents)
        );
        Some(Diagnostic::new(Code::W0405, rule.place, message).help("correct the antecedents, or the classes"))
    }

    fn dead(&self, rule: &Rule) -> Diagnostic {
        let has_all = |class: &usize| {
            let presence = &self.library.classes[*class].presence;
            rule.antecedents.iter().all(|a| presence.has(*a))
        };
        let together: Vec<usize> = (0..self.found.len()).filter(has_all).collect();
        let lost = |a: &&FeatureId| !together.iter().any(|class| self.found[*class][a.index()]);
        let lost = rule.antecedents.iter().find(lost).filter(|_| !together.is_empty());
        let Some(lost) = lost else {
            let all = if rule.antecedents.len() > 1 { " together" } else { "" };
            let message = format!(
                "this rule can never fire: no class has {}{all}",
                self.names(&rule.antecedents)
            );
            return Diagnostic::new(Code::W0405, rule.place, message).help("correct the antecedents, or the classes");
        };
        let name = self.name(*lost);
        let message = format!("this rule can never fire: what finds `{name}` never fires either");
        let out = Diagnostic::new(Code::W0405, rule.place, message);
        let finder = self.library.rules.iter().find(|r| r.consequent == *lost);
        let out = match finder {
            Some(finder) => out.related(finder.place, format!("this rule finds `{name}`")),
            None => out,
        };
        out.help(format!(
            "find `{name}` by itself, `rule -> {name} {{ … }}`, or correct the classes"
        ))
    }

    fn name(&self, feature: FeatureId) -> &str {
        &self.library.feature(feature).name
    }

    fn names(&self, features: &[FeatureId]) -> String {
        names(features.iter().map(|f| self.name(*f)))
    }
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
        // Nor does the layout find anything, or `third` tell a class.
        assert_eq!(codes(&apart), [Code::W0405, Code::W0405, Code::W0409]);
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

    #[test]
    fn fires_where_the_consequent_is_never_there() {
        let elsewhere = [
            THIRD[0],
            THIRD[1],
            ("class other { right }", "class other { right }\n class odd { third }"),
        ];
        assert!(codes(&elsewhere).contains(&Code::W0405));
    }

    #[test]
    fn fires_down_the_chain_of_a_rule_that_never_fires() {
        // `third` is only found beside `left` and `right`, and `odd` has it without them.
        let fourth = "rule third -> fourth {\n detect qr(\"u\", 200 mm)\n measure marker_pose()\n
            predict rigid_marker(third.pose, third.pose, size: 200 mm)\n}\n rule left, right -> third";
        let rule = RULE.replace("rule left, right -> third", fourth);
        let chain = [
            (
                "feature right : marker",
                "feature right : marker\n feature third : marker\n feature fourth : marker",
            ),
            ("layout flat", rule.as_str()),
            (
                "class other { right }",
                "class other { right }\n class odd { right, third, fourth }",
            ),
        ];
        let all = codes(&chain);
        assert_eq!(all.iter().filter(|c| **c == Code::W0405).count(), 2, "{all:?}");
    }
}
