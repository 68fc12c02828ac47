//! Tests: what they give and expect as plain data in SI units.

use super::expand::Env;
use super::{LoweredLibrary, Lowering, faces};
use crate::geometry::{Polygon, Pose, frame_facing};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::source::Span;
use crate::lang::types::stated::{self, ExpectationKind};
use crate::lang::types::typed;
use crate::lang::types::units::last_digit;
use crate::primitives::{Type, printed_edge};
use crate::rules::{Call, Expectation, Expected, Expr, Fact, FeatureId, Given, Library, Value};

/// Most expectations of a file.
const MOST_EXPECTED: usize = 10_000;
/// Most places that a test gives.
const MOST_PLACES: usize = 64;
/// Most combinations of measured instances and edges that the rules of a fact's
/// library have.
const MOST_COMBINATIONS: f64 = 1_000.0;

/// How far places may lie apart where a test does not say, metres.
const USUAL_DISTANCE: f64 = 1e-3;
/// The same for directions, radians.
const USUAL_TURN: f64 = 1e-3;
/// The same for other quantities, relative: rounding in the last bits.
const USUAL_SHARE: f64 = 1e-9;

impl<'a> Lowering<'a> {
    /// The facts whose library is whole; of others something was said already.
    pub(super) fn facts(&mut self, facts: &'a [stated::Fact], libraries: &[LoweredLibrary]) -> Vec<Fact> {
        let before = facts.iter().scan(0, |n, fact| {
            let before = *n;
            *n += fact.expected.len().max(1);
            Some((before, fact))
        });
        if let Some((_, surplus)) = before.last().filter(|(n, _)| *n > MOST_EXPECTED) {
            let message = format!("the tests of this file expect more than {MOST_EXPECTED} things");
            let help = "put some of them into a file of their own";
            self.report(Diagnostic::new(Code::E0312, surplus.span, message).help(help));
            return Vec::new();
        }
        let mut out = Vec::new();
        for fact in facts {
            let library = fact.library.and_then(|k| libraries.get(k));
            if library.is_none_or(|l| l.whole) {
                out.extend(self.fact(fact, library.map(|l| &l.library)));
            }
        }
        out
    }

    fn fact(&mut self, fact: &'a stated::Fact, library: Option<&Library>) -> Option<Fact> {
        let given: Vec<_> = fact
            .given
            .iter()
            .map(|(id, g, at)| Some((*id, self.given(*id, g, *at, library)?)))
            .collect();
        let expected: Vec<_> = fact.expected.iter().map(|e| self.expectation(e, library)).collect();
        let given: Vec<(FeatureId, Given)> = given.into_iter().collect::<Option<_>>()?;
        let places = given
            .iter()
            .filter(|(_, g)| matches!(g, Given::Face(_) | Given::Marker { .. }));
        if places.count() > MOST_PLACES {
            let message = format!("a test gives at most {MOST_PLACES} places");
            self.report(Diagnostic::new(Code::E0312, fact.span, message));
            return None;
        }
        if let Some(library) = library
            && combinations(&given, library) > MOST_COMBINATIONS
        {
            let message = "the rules have too many combinations of what is given";
            let help = "give fewer instances or fewer corners";
            self.report(Diagnostic::new(Code::E0312, fact.span, message).help(help));
            return None;
        }
        Some(Fact {
            name: fact.name.clone(),
            library: fact.library,
            given,
            expected: expected.into_iter().collect::<Option<_>>()?,
            place: self.place(fact.span),
        })
    }

    fn given(&mut self, id: FeatureId, given: &'a stated::Given, at: Span, library: Option<&Library>) -> Option<Given> {
        Some(match given {
            stated::Given::Detected => Given::Detected,
            stated::Given::Absent => Given::Absent,
            stated::Given::Face(face) => Given::Face(self.face(face)?),
            stated::Given::Marker(place) => {
                let pose = self.marker_pose(place);
                let size = self.print(id, at, library)?.length("size").ok();
                Given::Marker {
                    pose: pose?,
                    size: size?,
                }
            }
        })
    }

    fn face(&mut self, face: &'a typed::Expr) -> Option<Polygon> {
        let call = self.primitive(face, &Env::default())?;
        Polygon::new(faces::corners(&call)?)
    }

    /// The one face that a predictor of constants gives.
    fn predicted(&mut self, predictor: &'a typed::Expr) -> Option<Polygon> {
        let call = self.primitive(predictor, &Env::default())?;
        let face = faces::predicted(&call);
        if face.is_none() {
            let message = format!("`{}` predicts no face from these arguments", call.primitive);
            let help = "write the face that is expected: `polygon([…])`";
            self.report(Diagnostic::new(Code::E0703, predictor.span, message).help(help));
        }
        face
    }

    fn marker_pose(&mut self, place: &'a stated::Place) -> Option<Pose> {
        let (at, facing) = (self.constant(&place.at), self.constant(&place.facing));
        match (at?, facing?) {
            (Value::Point(at), Value::Direction(facing)) => Some(frame_facing(at, facing)),
            _ => None,
        }
    }

    /// The detector that says what is printed on a marker.
    fn print<'l>(&mut self, id: FeatureId, at: Span, library: Option<&'l Library>) -> Option<&'l Call> {
        let library = library?;
        let mut rules = library.rules.iter().filter(|r| r.consequent == id);
        let print = rules.find_map(|r| r.detect.length("size").is_ok().then_some(&r.detect));
        if print.is_none() {
            let message = format!("no rule says how large `{}` is", library.feature(id).name);
            let help = "detect it with `qr(text: …, size: …)`";
            self.report(Diagnostic::new(Code::E0502, at, message).help(help));
        }
        print
    }

    fn expectation(&mut self, e: &'a stated::Expectation, library: Option<&Library>) -> Option<Expectation> {
        Some(Expectation {
            what: self.expected(e, library)?,
            place: self.place(e.span),
        })
    }

    fn expected(&mut self, e: &'a stated::Expectation, library: Option<&Library>) -> Option<Expected> {
        use ExpectationKind as From;
        Some(match &e.kind {
            From::Classes(classes) => Expected::Classes(classes.clone()),
            From::Class(class, share, within) => Expected::Class {
                class: *class,
                share: self.scalar(share)?,
                within: self.rounding(share, within.as_ref())?,
            },
            From::Flag(flag, holds) => Expected::Flag(*flag, *holds),
            From::Next(features) => Expected::Next(features.clone()),
            From::Rules(count) => Expected::Rules(self.whole(count)?),
            From::Predicts {
                antecedents,
                consequent,
                count,
                span,
            } => self.predicts(antecedents, *consequent, count, *span, library)?,
            From::State(feature, state) => Expected::State(*feature, *state),
            From::Weight(feature, bits, within) => Expected::Weight {
                feature: *feature,
                bits: self.scalar(bits)?,
                within: self.rounding(bits, within.as_ref())?,
            },
            From::Predicted(feature, count) => Expected::Predicted(*feature, self.whole(count)?),
            From::Placed(feature, place, within) => Expected::Placed {
                feature: *feature,
                face: self.placed(*feature, place, e.span, library)?,
                within: self.tolerance(within.as_ref(), USUAL_DISTANCE)?,
            },
            From::Equal(found, expected, within) => self.equal(found, expected, within.as_ref())?,
            From::Count(of, count) => Expected::Count(self.expand(of, &Env::default())?.expr, self.whole(count)?),
        })
    }

    fn predicts(
        &mut self,
        antecedents: &[FeatureId],
        consequent: FeatureId,
        count: &'a typed::Expr,
        span: Span,
        library: Option<&Library>,
    ) -> Option<Expected> {
        let library = library?;
        let is_meant = |k: &usize| {
            let rule = &library.rules[*k];
            let mut own = rule.antecedents.clone();
            own.sort_unstable();
            rule.consequent == consequent && own == antecedents
        };
        let rules: Vec<usize> = (0..library.rules.len()).filter(is_meant).collect();
        let Some(head) = rules.first().map(|k| library.rules[*k].head(library)) else {
            let name = &library.feature(consequent).name;
            let heads = library.rules.iter().filter(|r| r.consequent == consequent);
            let heads: Vec<String> = heads.map(|r| r.head(library)).collect();
            let known = crate::lang::names::suggest::one_of(heads.iter().map(String::as_str));
            let out = Diagnostic::new(Code::E0703, span, "the library has no such rule");
            self.report(out.help(format!("the rules that conclude `{name}` are {known}").replace(" or ", " and ")));
            return None;
        };
        let count = self.whole(count)?;
        Some(Expected::Predicts { head, rules, count })
    }

    fn placed(
        &mut self,
        id: FeatureId,
        place: &'a stated::Expected,
        span: Span,
        library: Option<&Library>,
    ) -> Option<Polygon> {
        match place {
            stated::Expected::Face(face) if face.ty == Type::Predictor => self.predicted(face),
            stated::Expected::Face(face) => self.face(face),
            stated::Expected::Marker(place) => {
                let pose = self.marker_pose(place)?;
                let edge = printed_edge(self.print(id, span, library)?).ok()?;
                Polygon::square(&pose, edge)
            }
        }
    }

    fn equal(
        &mut self,
        found: &'a typed::Expr,
        expected: &'a typed::Expr,
        within: Option<&'a typed::Expr>,
    ) -> Option<Expected> {
        let (left, right) = (
            self.expand(found, &Env::default()),
            self.expand(expected, &Env::default()),
        );
        let (left, right) = (left?.expr, right?.expr);
        let usual = match found.ty {
            Type::Direction => USUAL_TURN,
            Type::Point | Type::Polygon | Type::Edge | Type::Edges | Type::Views | Type::Predictor => USUAL_DISTANCE,
            _ => USUAL_SHARE * size(&right).max(1e-3),
        };
        Some(Expected::Equal {
            found: number(left),
            expected: number(right),
            within: self.tolerance(within, usual)?,
        })
    }

    /// A share or a weight with a fraction holds to its last digit.
    fn rounding(&mut self, value: &'a typed::Expr, within: Option<&'a typed::Expr>) -> Option<f64> {
        let written = last_digit(self.sources.text(value.span));
        self.tolerance(within, written.map_or(USUAL_SHARE, |digit| digit / 2.0 + USUAL_SHARE))
    }

    fn tolerance(&mut self, within: Option<&'a typed::Expr>, usual: f64) -> Option<f64> {
        let Some(within) = within else { return Some(usual) };
        let tolerance = self.scalar(within)?;
        if tolerance < 0.0 {
            let out = Diagnostic::new(Code::E0309, within.span, "`within` is negative");
            self.report(out.help("it says how far what is found may lie from what is expected"));
            return None;
        }
        // Rounding in the last bits is no difference.
        Some(tolerance * (1.0 + USUAL_SHARE))
    }

    fn constant(&mut self, e: &'a typed::Expr) -> Option<Value> {
        self.value(e, &Env::default())
    }

    fn scalar(&mut self, e: &'a typed::Expr) -> Option<f64> {
        self.constant(e).as_ref().and_then(super::constants::scalar)
    }

    fn whole(&mut self, e: &'a typed::Expr) -> Option<u64> {
        match self.constant(e)? {
            Value::Count(n) => Some(n),
            _ => None,
        }
    }
}

/// A whole number compares as a number.
fn number(expr: Expr) -> Expr {
    super::constants::as_number(expr)
}

fn size(expr: &Expr) -> f64 {
    match expr {
        Expr::Value(value) => super::constants::scalar(value).unwrap_or(0.0).abs(),
        _ => 0.0,
    }
}

/// How many combinations of given instances and their edges the rules have.
fn combinations(given: &[(FeatureId, Given)], library: &Library) -> f64 {
    let faces = |id: &FeatureId| given.iter().filter(|(other, _)| other == id).count().max(1) as f64;
    let corners = |id: &FeatureId| {
        let of_it = given.iter().filter(|(other, _)| other == id);
        let most = of_it.map(|(_, g)| match g {
            Given::Face(face) => face.vertices().len(),
            _ => 1,
        });
        most.max().unwrap_or(1) as f64
    };
    let of_rule = |rule: &crate::rules::Rule| {
        let instances: f64 = rule.antecedents.iter().map(faces).product();
        instances * rule.each.iter().map(|e| corners(&e.feature)).product::<f64>()
    };
    library.rules.iter().map(of_rule).filter(|n| *n > 1.0).sum()
}
