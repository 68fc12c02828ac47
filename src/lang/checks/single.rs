//! Rules that predict several places for a feature of which there is one.
//!
//! A feature that is not `many` has one instance, and of several predictions of one
//! instance a single one counts: a feature at another edge is then found absent.

use crate::lang::diagnostics::{Code, Diagnostic};
use crate::rules::Library;

/// Rules with `for each` whose consequent is not `many`.
pub(super) fn check(library: &Library) -> Vec<Diagnostic> {
    let rules = library.rules.iter().filter(|rule| !rule.each.is_empty());
    let single = rules.filter(|rule| !library.feature(rule.consequent).many);
    single
        .map(|rule| {
            let feature = library.feature(rule.consequent);
            let name = &feature.name;
            let message = format!("`for each` predicts `{name}` in several places, but there is one `{name}`");
            Diagnostic::new(Code::W0419, rule.place, message)
                .related(feature.place, "not declared as `many`")
                .help(format!(
                    "of these predictions one counts, and `{name}` elsewhere is taken for absent: declare \
                     `feature {name} : {} many`, or name the one edge",
                    feature.kind
                ))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::testing::codes;
    use crate::lang::Code;

    const LID: (&str, &str) = (
        "feature right : marker",
        "feature right : marker\n feature lid : polygon",
    );
    const FLAP: (&str, &str) = (
        "layout flat",
        "rule -> lid {\n detect plane(min_area: 0.01 m2)\n measure outline()\n }\n\
         rule lid -> flap {\n for each edge in lid.edges\n detect plane_beside(edge, dihedral: 90 deg)\n\
         measure outline(first: edge)\n predict rectangle_on(on: edge, dihedral: 90 deg, height: 100 mm)\n }\n\
         layout flat",
    );

    fn library(flap: &str) -> Vec<Code> {
        let declared = format!("{} feature flap : polygon{flap}", LID.1.to_owned() + "\n");
        let (one, both) = ("class one { left }", "class one { left, lid, flap }");
        codes(&[(LID.0, &declared), FLAP, (one, both)])
    }

    #[test]
    fn fires_where_each_edge_predicts_the_one_instance() {
        assert_eq!(library(""), [Code::W0419]);
    }

    #[test]
    fn keeps_quiet_where_there_may_be_many() {
        assert_eq!(library(" many"), []);
    }
}
