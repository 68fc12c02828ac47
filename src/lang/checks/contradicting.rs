//! Rules that contradict each other: two texts on one print, two places for one
//! instance.
//!
//! Only what is constant is judged, for only that is known before the robot moves. Of
//! two predictions of one instance the planner follows the first; where they differ,
//! one of them is wrong.

use std::collections::{BTreeMap, BTreeSet};

use super::space::metres;
use crate::geometry::Pose;
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::source::Span;
use crate::rules::{Call, Expr, FeatureId, FeatureKind, Library, Rule, Value};

/// Places nearer than this are one, metres.
const APART: f64 = 1e-4;
/// Turns smaller than this are none, radians.
const TURNED: f64 = 1e-3;

pub(super) fn check(library: &Library) -> Vec<Diagnostic> {
    let mut found = prints(library);
    found.extend(poses(library));
    found.extend(predictions(library));
    found
}

/// One marker, found as two prints.
fn prints(library: &Library) -> Vec<Diagnostic> {
    let mut first: BTreeMap<FeatureId, &Rule> = BTreeMap::new();
    let mut found = Vec::new();
    for rule in library.rules.iter().filter(|r| r.antecedents.is_empty()) {
        let feature = library.feature(rule.consequent);
        if feature.kind != FeatureKind::Marker || feature.many {
            continue;
        }
        match first.get(&rule.consequent) {
            None => drop(first.insert(rule.consequent, rule)),
            Some(other) if other.detect == rule.detect => {}
            Some(other) => {
                let message = format!("`{}` is said to be two different prints", feature.name);
                found.push(
                    Diagnostic::new(Code::E0407, rule.place, message)
                        .label(print(&rule.detect))
                        .related(other.place, print(&other.detect))
                        .help("a marker is one print: leave one of the rules out, or declare another feature"),
                );
            }
        }
    }
    found
}

fn print(detect: &Call) -> String {
    match (detect.text("text"), detect.length("size")) {
        (Ok(text), Ok(size)) => format!("`{text}`, {} wide", metres(size)),
        _ => "detected otherwise".into(),
    }
}

/// One marker at two places beside the same other one. Said once for two layouts.
fn poses(library: &Library) -> Vec<Diagnostic> {
    let mut first: BTreeMap<(FeatureId, FeatureId), (&Rule, Pose)> = BTreeMap::new();
    let mut said: BTreeSet<(Span, Span)> = BTreeSet::new();
    let mut found = Vec::new();
    for rule in &library.rules {
        let Some((antecedent, pose)) = rigid(rule) else {
            continue;
        };
        let (other, held) = *first.entry((antecedent, rule.consequent)).or_insert((rule, pose));
        let (apart, turned) = difference(&held, &pose);
        if (apart > APART || turned > TURNED) && said.insert((other.place.into(), rule.place.into())) {
            let [from, to] = [antecedent, rule.consequent].map(|f| &library.feature(f).name);
            let message = format!("`{from}` is said to have `{to}` beside it at two different places");
            let label = format!("{} and {:.1} deg apart", metres(apart), turned.to_degrees());
            found.push(
                Diagnostic::new(Code::E0407, rule.place, message)
                    .label(label)
                    .related(other.place, "the other place")
                    .help("a layout is rigid: correct one of the places, or leave it out"),
            );
        }
    }
    found
}

/// A constant pose of the consequent in the frame of another marker.
fn rigid(rule: &Rule) -> Option<(FeatureId, Pose)> {
    let predict = rule.predict.as_ref().filter(|p| p.primitive == "rigid_marker")?;
    let Some(Expr::Attribute { feature, name }) = predict.arguments.get("antecedent") else {
        return None;
    };
    match predict.constant("antecedent_from_consequent") {
        Some(Value::Pose(pose)) if name == "pose" => Some((*feature, *pose)),
        _ => None,
    }
}

fn difference(a: &Pose, b: &Pose) -> (f64, f64) {
    let apart = (a.translation.vector - b.translation.vector).norm();
    (apart, a.rotation.angle_to(&b.rotation))
}

/// One instance, found alike and predicted at two places.
fn predictions(library: &Library) -> Vec<Diagnostic> {
    let mut first: BTreeMap<String, &Rule> = BTreeMap::new();
    let mut said: BTreeSet<(Span, Span)> = BTreeSet::new();
    let mut found = Vec::new();
    for rule in &library.rules {
        let Some(predict) = rule.predict.as_ref().filter(|p| p.primitive != "rigid_marker") else {
            continue;
        };
        let other = *first.entry(instance(rule, predict)).or_insert(rule);
        let Some(name) = other.predict.as_ref().and_then(|p| differing(p, predict)) else {
            continue;
        };
        if said.insert((other.place.into(), rule.place.into())) {
            let feature = &library.feature(rule.consequent).name;
            let message = format!("`{feature}` is predicted at two different places from the same features");
            found.push(
                Diagnostic::new(Code::E0407, rule.place, message)
                    .label(format!("another `{name}`"))
                    .related(other.place, "the other prediction, which goes first")
                    .help("leave one of the rules out"),
            );
        }
    }
    found
}

/// What must be equal for two rules to be about the same instance, found alike and
/// predicted alike but for constants.
fn instance(rule: &Rule, predict: &Call) -> String {
    let antecedents: BTreeSet<FeatureId> = rule.antecedents.iter().copied().collect();
    let variable = |e: &&Expr| !matches!(e, Expr::Value(_));
    let arguments: BTreeMap<&String, Option<&Expr>> = predict
        .arguments
        .iter()
        .map(|(name, e)| (name, Some(e).filter(variable)))
        .collect();
    let about = (rule.consequent, antecedents, &rule.each, &predict.primitive, arguments);
    serde_json::to_string(&(about, &rule.detect, &rule.measure)).unwrap_or_else(|_| rule.id.clone())
}

/// The first argument in which two calls differ.
fn differing<'a>(a: &'a Call, b: &Call) -> Option<&'a str> {
    let mut arguments = a.arguments.iter();
    let (name, _) = arguments.find(|(name, value)| b.arguments.get(*name) != Some(*value))?;
    Some(name)
}

#[cfg(test)]
mod tests {
    use super::super::testing::codes;
    use crate::lang::Code;

    fn second_layout(x: &str) -> String {
        format!(
            "layout again {{\n left at [0 mm, 0 mm, 0 mm] facing +z\n right at [{x}, 0 mm, 0 mm] facing +z\n }}\n layout flat"
        )
    }

    #[test]
    fn fires_on_two_layouts_that_put_a_pair_apart_differently() {
        assert_eq!(codes(&[("layout flat", &second_layout("550 mm"))]), [Code::E0407]);
    }

    #[test]
    fn keeps_quiet_where_the_frames_differ_and_the_places_agree() {
        assert!(!codes(&[("layout flat", &second_layout("600 mm"))]).contains(&Code::E0407));
    }

    #[test]
    fn fires_on_a_marker_of_two_texts() {
        let rule = |text: &str| {
            format!("rule -> left {{\n detect qr(\"{text}\", 200 mm)\n measure marker_pose()\n }}\n rule -> right")
        };
        assert_eq!(codes(&[("rule -> right", &rule("other"))]), [Code::E0407]);
        assert!(!codes(&[("rule -> right", &rule("l"))]).contains(&Code::E0407));
    }

    #[test]
    fn fires_on_faces_of_two_heights_and_not_on_measured_ones() {
        let text = include_str!("../../../examples/solids/solids.vpl");
        let rule = |height: &str| {
            format!(
                "rule bottom -> prism_side {{\n for each edge in bottom.edges\n
                 detect plane_beside(edge, dihedral: 90 deg, within: 10 deg, colour: green)\n
                 measure outline(first: edge)\n predict upright_rectangle(on: edge, height: {height})\n }}\n"
            )
        };
        let of = |a: &str, b: &str| {
            let two = format!("{}{} rule bottom -> pyramid_side", rule(a), rule(b));
            super::super::testing::codes_of(&text.replacen("rule bottom -> pyramid_side", &two, 1))
        };
        assert!(of("300 mm", "200 mm").contains(&Code::E0407));
        assert!(!of("300 mm", "300 mm").contains(&Code::E0407));
        assert!(!of("prism_side.height else 300 mm", "200 mm").contains(&Code::E0407));
    }
}
