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
    use super::super::testing::codes_of;
    use crate::lang::Code;

    const BOXES: &str = "vpl 1
use std.detect.coloured_plane
use std.solids.upright_rectangle
library boxes {
  feature lid : polygon
  feature flap : polygon
  class open { lid, flap }
  class closed { lid }
  rule -> lid {
    detect coloured_plane(red)
    measure outline()
  }
  rule lid -> flap {
    for each edge in lid.edges
    detect plane_beside(edge, dihedral: 90 deg, within: 10 deg)
    measure outline(first: edge)
    predict upright_rectangle(on: edge, height: 100 mm)
  }
}
";

    #[test]
    fn fires_where_each_edge_predicts_the_one_instance() {
        assert!(codes_of(BOXES).contains(&Code::W0419));
    }

    #[test]
    fn keeps_quiet_where_there_may_be_many() {
        let many = BOXES.replace("flap : polygon", "flap : polygon many");
        assert!(!codes_of(&many).contains(&Code::W0419));
    }
}
