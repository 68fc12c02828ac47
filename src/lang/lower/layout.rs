//! Layouts: every marker predicts every other, rigidly.

use std::collections::BTreeMap;

use super::Lowering;
use super::expand::{Env, MOST_STEPS};
use super::library::MOST_RULES;
use crate::geometry::{Pose, frame_facing};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::source::Span;
use crate::lang::types::typed;
use crate::primitives::printed_edge;
use crate::rules::{Call, Expr, FeatureId, Library, Rule, Value};

/// A layout with its places, in the order of the features.
pub(in crate::lang) struct Placed {
    /// Its name.
    pub name: String,
    /// Its line.
    pub span: Span,
    /// The object's frame from each marker, and where that is written.
    pub places: Vec<(FeatureId, Pose, Span)>,
}

impl<'a> Lowering<'a> {
    /// Adds a rule for every ordered pair of places, in the order of the features.
    /// Says which definite rules are missing where the library is `whole` otherwise.
    pub(super) fn layout(
        &mut self,
        layout: &'a typed::Layout,
        env: &Env<'a>,
        out: &mut Library,
        whole: bool,
    ) -> Option<Placed> {
        let pairs = layout.places.len().saturating_mul(layout.places.len());
        self.steps = self.steps.saturating_add(pairs);
        if pairs + out.rules.len() > MOST_RULES || self.steps > MOST_STEPS {
            return self.too_far(env.call.unwrap_or(layout.span));
        }
        let places = layout.places.iter();
        let places: Vec<Option<_>> = places
            .map(|p| self.place_pose(p, env).map(|(feature, pose)| (feature, pose, p.span)))
            .collect();
        let mut places = places.into_iter().collect::<Option<Vec<_>>>()?;
        places.sort_by_key(|(feature, _, _)| *feature);
        let definite = self.definite_rules(layout, env, out, whole);
        for (a, frame_from_a, _) in &places {
            for (b, frame_from_b, _) in places.iter().filter(|(b, _, _)| a != b) {
                let Some((rule, edge)) = definite.get(b) else { continue };
                let a_from_b = frame_from_a.inv_mul(frame_from_b);
                out.rules.push(Rule {
                    id: format!("r{}", out.rules.len() + 1),
                    antecedents: vec![*a],
                    consequent: *b,
                    each: Vec::new(),
                    detect: rule.detect.clone(),
                    measure: rule.measure.clone(),
                    predict: Some(rigid_marker(*a, a_from_b, *edge)),
                    place: self.place(layout.span),
                });
            }
        }
        Some(Placed {
            name: layout.name.clone(),
            span: layout.span,
            places,
        })
    }

    /// `frame_from_place`: the frame that the layout is written in is the object's.
    fn place_pose(&mut self, place: &'a typed::LayoutPlace, env: &Env<'a>) -> Option<(FeatureId, Pose)> {
        let (at, facing) = (self.value(&place.at, env), self.value(&place.facing, env));
        match (at?, facing?) {
            (Value::Point(at), Value::Direction(facing)) => Some((place.feature, frame_facing(at, facing))),
            _ => None,
        }
    }

    /// The definite rule of each placed feature, whose detection the pairs repeat, and
    /// the edge of its print: a code is drawn once, not once a pair.
    fn definite_rules(
        &mut self,
        layout: &typed::Layout,
        env: &Env<'a>,
        library: &Library,
        whole: bool,
    ) -> BTreeMap<FeatureId, (Rule, Option<f64>)> {
        let mut out = BTreeMap::new();
        for place in &layout.places {
            let definite = library
                .rules
                .iter()
                .find(|r| r.antecedents.is_empty() && r.consequent == place.feature);
            match definite {
                Some(rule) => drop(out.insert(place.feature, (rule.clone(), printed_edge(&rule.detect).ok()))),
                None if !whole => {}
                None => {
                    let name = &library.feature(place.feature).name;
                    let message = format!("no rule says how `{name}` is detected by itself");
                    self.report(
                        Diagnostic::new(Code::E0502, env.call.unwrap_or(place.span), message)
                            .help(format!("add `rule -> {name} {{ … }}` with `detect` and `measure`")),
                    );
                }
            }
        }
        out
    }
}

fn rigid_marker(antecedent: FeatureId, antecedent_from_consequent: Pose, edge: Option<f64>) -> Call {
    let pose = Expr::Attribute {
        feature: antecedent,
        name: "pose".into(),
    };
    let mut arguments = BTreeMap::from([
        ("antecedent".to_owned(), pose),
        (
            "antecedent_from_consequent".to_owned(),
            Expr::Value(Value::Pose(antecedent_from_consequent)),
        ),
    ]);
    if let Some(edge) = edge {
        arguments.insert("size".to_owned(), Expr::Value(Value::Length(edge)));
    }
    Call {
        primitive: "rigid_marker".into(),
        arguments,
    }
}
