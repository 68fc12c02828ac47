//! Features that one detector cannot tell apart: whatever proves one proves the other.

use std::collections::{BTreeMap, BTreeSet};

use super::names;
use crate::lang::diagnostics::{Code, Diagnostic, Severity};
use crate::primitives::QR_SIZE_WITHIN;
use crate::rules::{Call, FeatureId, FeatureKind, Library, Rule};

pub(super) fn check(library: &Library) -> Vec<Diagnostic> {
    let mut groups: BTreeMap<String, Vec<&Rule>> = BTreeMap::new();
    for rule in &library.rules {
        groups.entry(proof(rule, library)).or_default().push(rule);
    }
    // By feature: the report that names it.
    let mut told: BTreeMap<FeatureId, usize> = BTreeMap::new();
    let mut found = Vec::new();
    // In the order of the first rule of each.
    let mut groups: Vec<Vec<&Rule>> = groups.into_values().collect();
    groups.sort_by_key(|rules| (rules[0].antecedents.len(), rules[0].place.start));
    for rules in &groups {
        for alike in same_size(rules) {
            let features: BTreeSet<FeatureId> = alike.iter().map(|r| r.consequent).collect();
            let features: Vec<FeatureId> = features.into_iter().collect();
            let in_reports: BTreeSet<Option<&usize>> = features.iter().map(|f| told.get(f)).collect();
            let together = in_reports.len() == 1 && !in_reports.contains(&None);
            if features.len() > 1 && !together {
                told.extend(features.iter().map(|f| (*f, found.len())));
                found.extend(report(&alike, &features, library));
            }
        }
    }
    found
}

/// What decides whether a rule is proven, as text. The size of a code is left to
/// [`same_size`]; a shell is proven by what is predicted, too.
fn proof(rule: &Rule, library: &Library) -> String {
    let antecedents: BTreeSet<FeatureId> = rule.antecedents.iter().copied().collect();
    let mut detect = rule.detect.clone();
    if detect.primitive == "qr" {
        detect.arguments.remove("size");
    }
    let shell = library.feature(rule.consequent).kind == FeatureKind::Shell;
    let predict = rule.predict.as_ref().filter(|_| shell);
    serde_json::to_string(&(antecedents, &rule.each, detect, predict)).unwrap_or_else(|_| rule.id.clone())
}

/// Rules whose codes have sizes that the detector takes for each other, from the
/// smallest on.
fn same_size<'a>(rules: &[&'a Rule]) -> Vec<Vec<&'a Rule>> {
    let size = |call: &Call| call.length("size").unwrap_or(0.0);
    let mut rules = rules.to_vec();
    rules.sort_by(|a, b| size(&a.detect).total_cmp(&size(&b.detect)));
    let mut out: Vec<Vec<&Rule>> = Vec::new();
    for rule in rules {
        let fits = |first: &Rule| size(&rule.detect) * (1.0 - QR_SIZE_WITHIN) <= size(&first.detect);
        match out.last_mut().filter(|group| fits(group[0])) {
            Some(group) => group.push(rule),
            None => out.push(vec![rule]),
        }
    }
    out
}

fn report(rules: &[&Rule], features: &[FeatureId], library: &Library) -> Option<Diagnostic> {
    let differ = library.classes.iter().any(|class| {
        let has = |f: &FeatureId| class.presence.has(*f);
        features.iter().any(has) && !features.iter().all(has)
    });
    let last = rules.iter().max_by_key(|r| r.place.start)?;
    let all = names(features.iter().map(|f| library.feature(*f).name.as_str()));
    let message = format!("the same {} finds {all}", what(&last.detect));
    let mut out = Diagnostic::new(Code::E0408, last.place, message);
    if !differ {
        out = out.severity(Severity::Warning);
    }
    if let Some(other) = rules.iter().find(|r| r.place != last.place) {
        out = out.related(other.place, "the other rule");
    }
    Some(out.help(match last.detect.primitive.as_str() {
        "qr" => "give each a text of its own; in a family write the index into it: `\"f{i}\"`",
        _ => "give each a detector of its own: another colour, another angle, or another text",
    }))
}

fn what(detect: &Call) -> String {
    match detect.text("text") {
        Ok(text) => format!("code `{text}`"),
        Err(_) => format!("`{}`", detect.primitive),
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{codes, codes_of};
    use crate::lang::Code;

    #[test]
    fn fires_on_two_markers_of_one_text() {
        assert_eq!(codes(&[("text: \"r\"", "text: \"l\"")]), [Code::E0408]);
        let a_little_larger = ("\"r\", size: 200 mm", "\"l\", size: 220 mm");
        assert_eq!(codes(&[a_little_larger]), [Code::E0408]);
    }

    #[test]
    fn keeps_quiet_where_sizes_tell_them_apart() {
        assert_eq!(codes(&[("\"r\", size: 200 mm", "\"l\", size: 400 mm")]), []);
    }

    #[test]
    fn fires_on_a_family_without_its_index() {
        let text = include_str!("../../../examples/tanks/tanks.vpl").replace("\"f{i}\"", "\"f\"");
        assert_eq!(codes_of(&text), [Code::E0408]);
    }

    #[test]
    fn fires_on_faces_of_one_colour() {
        let text = include_str!("../../../examples/solids/solids.vpl");
        let red = text.replacen("coloured_plane(blue)", "coloured_plane(green)", 1);
        assert_eq!(codes_of(&red), [Code::E0408]);
        assert_eq!(codes_of(text), []);
    }
}
