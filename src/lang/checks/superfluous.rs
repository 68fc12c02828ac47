//! Rules that only say what another says: the same calls for the same feature, from
//! the same antecedents or more.

use std::collections::{BTreeMap, BTreeSet};

use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::source::Span;
use crate::rules::{FeatureId, Library, Rule};

/// Most pairs of rules that are compared.
const MOST_PAIRS: usize = 5_000_000;

/// Whole rules, families and layouts of which every rule is said elsewhere.
pub(super) fn check(library: &Library) -> Vec<Diagnostic> {
    let mut places: BTreeMap<Span, Vec<usize>> = BTreeMap::new();
    for (k, rule) in library.rules.iter().enumerate() {
        places.entry(rule.place.into()).or_default().push(k);
    }
    let mut alike = Alike::new(library);
    let mut dropped: BTreeSet<Span> = BTreeSet::new();
    let mut found = Vec::new();
    // From the last to the first, so that of two that say the same the first stays.
    for (place, rules) in places.iter().rev() {
        let mut said = rules.iter().map(|k| alike.said_elsewhere(*k, &dropped));
        let first = said.next().flatten();
        if let Some(other) = first.filter(|_| said.all(|s| s.is_some())) {
            dropped.insert(*place);
            found.push(report(*place, &library.rules[rules[0]], &library.rules[other], library));
        }
    }
    found
}

fn report(place: Span, rule: &Rule, other: &Rule, library: &Library) -> Diagnostic {
    let name = &library.feature(rule.consequent).name;
    let (message, help) = if rule.antecedents.len() == other.antecedents.len() {
        (
            format!("`{name}` is found here as it is by another rule"),
            "leave one of them out".to_owned(),
        )
    } else {
        let needs = other.antecedents.iter().map(|a| library.feature(*a).name.as_str());
        let needs = super::names(needs);
        let from = if other.antecedents.is_empty() {
            "nothing".to_owned()
        } else {
            needs
        };
        (
            format!("`{name}` is found here as it is by another rule, which needs only {from}"),
            "leave this one out, or let it say something of its own".to_owned(),
        )
    };
    Diagnostic::new(Code::W0411, place, message)
        .related(other.place, "the other")
        .help(help)
}

/// Rules by what they say, leaving the antecedents aside.
struct Alike<'a> {
    rules: &'a [Rule],
    groups: BTreeMap<String, Vec<usize>>,
    keys: Vec<String>,
    pairs: usize,
}

impl<'a> Alike<'a> {
    fn new(library: &'a Library) -> Self {
        let keys: Vec<String> = library.rules.iter().map(said).collect();
        let mut groups: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for (k, key) in keys.iter().enumerate() {
            groups.entry(key.clone()).or_default().push(k);
        }
        Self {
            rules: &library.rules,
            groups,
            keys,
            pairs: 0,
        }
    }

    /// A rule of another place, not dropped, that fires whenever this one does.
    fn said_elsewhere(&mut self, k: usize, dropped: &BTreeSet<Span>) -> Option<usize> {
        let rule = &self.rules[k];
        let group = self.groups.get(&self.keys[k])?;
        self.pairs += group.len();
        if self.pairs > MOST_PAIRS {
            return None;
        }
        let mine: BTreeSet<FeatureId> = rule.antecedents.iter().copied().collect();
        group.iter().copied().find(|other| {
            let other = &self.rules[*other];
            other.place != rule.place
                && !dropped.contains(&Span::from(other.place))
                && other.antecedents.iter().all(|a| mine.contains(a))
        })
    }
}

/// What a rule says, as text: equal texts say the same.
fn said(rule: &Rule) -> String {
    let parts = (rule.consequent, &rule.each, &rule.detect, &rule.measure, &rule.predict);
    serde_json::to_string(&parts).unwrap_or_else(|_| rule.id.clone())
}

#[cfg(test)]
mod tests {
    use super::super::testing::codes;
    use crate::lang::Code;

    const THIRD: [(&str, &str); 2] = [
        (
            "feature right : marker",
            "feature right : marker\n feature third : marker",
        ),
        ("class both { left, right }", "class both { left, right, third }"),
    ];

    fn rule(from: &str, text: &str) -> String {
        format!(
            "rule {from} -> third {{\n detect qr(\"{text}\", 200 mm)\n measure marker_pose()\n
             predict rigid_marker(left.pose, left.pose, 200 mm)\n}}\n"
        )
    }

    #[test]
    fn fires_on_a_rule_written_twice_and_on_one_that_needs_more() {
        let twice = format!("{}{} layout flat", rule("left", "t"), rule("left", "t"));
        assert_eq!(codes(&[THIRD[0], THIRD[1], ("layout flat", &twice)]), [Code::W0411]);
        let more = format!("{}{} layout flat", rule("left, right", "t"), rule("left", "t"));
        assert_eq!(codes(&[THIRD[0], THIRD[1], ("layout flat", &more)]), [Code::W0411]);
    }

    #[test]
    fn fires_on_a_layout_written_twice() {
        let again = "layout again {\n left at [-300 mm, 0 mm, 0 mm] facing +z\n right at [300 mm, 0 mm, 0 mm] facing +z\n }\n layout flat";
        assert_eq!(codes(&[("layout flat", again)]), [Code::W0411]);
    }

    #[test]
    fn keeps_quiet_about_another_way_to_the_same_feature() {
        let other = rule("right", "t").replace("left.pose", "right.pose");
        let both = format!("{}{other} layout flat", rule("left", "t"));
        assert_eq!(codes(&[THIRD[0], THIRD[1], ("layout flat", &both)]), []);
    }
}
