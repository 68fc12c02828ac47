//! Places where a rule's own detector finds nothing: the plane is looked for at
//! another angle than it is predicted at.

use std::collections::BTreeSet;

use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::source::Span;
use crate::rules::{Library, Rule};

/// Angles nearer than this are equal, radians.
const EQUAL: f64 = 1e-9;

pub(super) fn check(library: &Library) -> Vec<Diagnostic> {
    let mut said: BTreeSet<Span> = BTreeSet::new();
    let apart = library.rules.iter().filter_map(|r| Some((r, angles(r)?)));
    apart
        .filter(|(rule, _)| said.insert(rule.place.into()))
        .map(|(rule, angles)| report(rule, angles, library))
        .collect()
}

struct Angles {
    predicted: f64,
    detected: f64,
    within: f64,
}

/// The angles of a rule that predicts and looks along one edge, where they disagree.
fn angles(rule: &Rule) -> Option<Angles> {
    let predict = rule.predict.as_ref().filter(|p| p.primitive == "rectangle_on")?;
    let detect = Some(&rule.detect).filter(|d| d.primitive == "plane_beside")?;
    let same_edge = predict.arguments.get("on")? == detect.arguments.get("edge")?;
    let angles = Angles {
        predicted: predict.angle("dihedral").ok()?,
        detected: detect.angle("dihedral").ok()?,
        within: detect.angle("within").ok()?,
    };
    let off = (angles.predicted - angles.detected).abs();
    (same_edge && off > angles.within + EQUAL).then_some(angles)
}

fn report(rule: &Rule, angles: Angles, library: &Library) -> Diagnostic {
    let degrees = |angle: f64| (angle.to_degrees() * 10.0).round() / 10.0;
    let message = format!(
        "`{}` is predicted at {} deg, where its detector does not find it",
        library.feature(rule.consequent).name,
        degrees(angles.predicted)
    );
    Diagnostic::new(Code::W0413, rule.place, message)
        .label(format!(
            "it looks at {} deg, within {} deg",
            degrees(angles.detected),
            degrees(angles.within)
        ))
        .help("give `detect` and `predict` the same dihedral")
}

#[cfg(test)]
mod tests {
    use super::super::testing::codes_of;
    use crate::lang::Code;

    #[test]
    fn fires_where_detector_and_predictor_disagree() {
        let text = include_str!("../../../examples/solids/solids.vpl");
        let at = |angle: &str| text.replacen("edge, dihedral: 90 deg", &format!("edge, dihedral: {angle}"), 1);
        assert_eq!(codes_of(&at("75 deg")), [Code::W0413]);
        assert_eq!(codes_of(&at("80 deg")), []);
    }
}
