//! Which rules facts made use of.

use super::{Concluded, Use, Verdict};
use crate::plan::Existence;
use crate::rules::{Fact, Library, Place, RuleSet};

/// How facts used the rules of a library.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Coverage {
    /// The library.
    pub library: String,
    /// Its rules in order.
    pub rules: Vec<RuleCoverage>,
}

/// How facts used a rule.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RuleCoverage {
    /// Its id, `r4`.
    pub id: String,
    /// `bottom -> prism_side`.
    pub head: String,
    /// Facts in which its antecedents and its consequent were detected.
    pub detected: usize,
    /// Facts in which it predicted something.
    pub predicted: usize,
    /// Where it was declared.
    pub place: Place,
}

impl RuleCoverage {
    /// Whether some fact made use of it.
    pub fn is_used(&self) -> bool {
        self.detected + self.predicted > 0
    }
}

pub(super) fn of(rules: &RuleSet, facts: &[Fact], verdicts: &[Verdict]) -> Vec<Coverage> {
    let covered = |(k, library): (usize, &Library)| {
        let of_library = facts.iter().zip(verdicts).filter(|(fact, _)| fact.library == Some(k));
        let uses: Vec<&[Use]> = of_library.map(|(_, verdict)| verdict.used.as_slice()).collect();
        let count = |rule: usize, want: fn(&Use) -> bool| {
            let used = uses.iter().filter_map(|uses| uses.get(rule));
            used.filter(|u| want(u)).count()
        };
        let rules = library.rules.iter().enumerate().map(|(r, rule)| RuleCoverage {
            id: rule.id.clone(),
            head: rule.head(library),
            detected: count(r, |u| u.detected),
            predicted: count(r, |u| u.predicted),
            place: rule.place,
        });
        Coverage {
            library: library.name.clone(),
            rules: rules.collect(),
        }
    };
    rules.libraries.iter().enumerate().map(covered).collect()
}

/// How a concluded status used each rule.
pub(super) fn used(concluded: &Concluded) -> Vec<Use> {
    let status = &concluded.status;
    let by: Vec<&String> = status
        .features
        .iter()
        .flat_map(|f| f.predicted.values())
        .flat_map(|p| &p.by)
        .collect();
    let detected = |id: &crate::rules::FeatureId| status.feature(*id).state == Existence::Detected;
    let rules = concluded.knowledge.library.rules.iter();
    rules
        .map(|rule| Use {
            detected: rule.antecedents.iter().chain([&rule.consequent]).all(detected),
            predicted: by.contains(&&rule.id),
        })
        .collect()
}
