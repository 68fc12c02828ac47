//! Expectations of tests: each about the status of a library, or about values.

use super::Checker;
use super::expressions::Due;
use super::facts::due;
use super::scope::Scope;
use super::stated::{Expectation, ExpectationKind, Expected};
use super::typed::{Expr, Library};
use super::units::describe;
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::syntax::tree;
use crate::primitives::Type;
use crate::rules::{FeatureId, FeatureKind, Flag, State};

impl<'a> Checker<'a> {
    pub(super) fn expectation(
        &mut self,
        expectation: &'a tree::Expectation,
        library: Option<&Library>,
    ) -> Option<Expectation> {
        Some(Expectation {
            kind: self.expectation_kind(expectation, library)?,
            span: expectation.span,
        })
    }

    fn expectation_kind(&mut self, e: &'a tree::Expectation, library: Option<&Library>) -> Option<ExpectationKind> {
        use ExpectationKind as To;
        use tree::ExpectationKind as From;
        match &e.kind {
            From::Classes(names) => {
                let classes: Vec<Option<usize>> = names.iter().map(|n| self.fact_class(n, library)).collect();
                let mut classes: Vec<usize> = classes.into_iter().collect::<Option<_>>()?;
                classes.sort_unstable();
                classes.dedup();
                Some(To::Classes(classes))
            }
            From::Class(name, share, within) => {
                let class = self.fact_class(name, library);
                let (share, within) = self.toleranced(share, within.as_ref(), due(Type::Share, "a probability"));
                Some(To::Class(class?, share?, within?))
            }
            From::Flag(word, holds) => {
                let flag = if word.text == "confident" {
                    Flag::Confident
                } else {
                    Flag::Contradicted
                };
                Some(To::Flag(flag, *holds))
            }
            From::Next(features) => {
                let ids: Vec<Vec<FeatureId>> = features.iter().map(|f| self.fact_features(f, library)).collect();
                let mut ids = ids.concat();
                ids.sort_unstable();
                ids.dedup();
                (!ids.is_empty()).then_some(To::Next(ids))
            }
            From::Rules(count) => Some(To::Rules(self.number(count, "the number of rules")?)),
            From::Predicts(head, count) => {
                let count = self.number(count, "the number of instances");
                let antecedents = head.antecedents.iter().map(|f| self.fact_feature(f, library, None));
                let antecedents: Vec<Option<FeatureId>> = antecedents.collect();
                let consequent = self.fact_feature(&head.consequent, library, None);
                let mut antecedents: Vec<FeatureId> = antecedents.into_iter().collect::<Option<_>>()?;
                antecedents.sort_unstable();
                Some(To::Predicts {
                    antecedents,
                    consequent: consequent?,
                    count: count?,
                    span: head.span,
                })
            }
            From::State(feature, word) => {
                let states = State::ALL.map(|(state, word)| (word, state));
                let state = self.state_of(word, "the state of a feature", &states);
                let id = self.fact_feature(feature, library, None);
                Some(To::State(id?, state?))
            }
            From::Weight(feature, bits, within) => {
                let id = self.fact_feature(feature, library, None);
                let (bits, within) = self.toleranced(bits, within.as_ref(), due(Type::Number, "a weight in bits"));
                Some(To::Weight(id?, bits?, within?))
            }
            From::Predicted(feature, count) => {
                let id = self.fact_feature(feature, library, None);
                let count = self.number(count, "the number of predicted instances");
                Some(To::Predicted(id?, count?))
            }
            From::Placed(placed) => self.placed(placed, library),
            From::Equal(found, expected, within) => self.equal(found, expected, within.as_ref()),
            From::Count(of, count) => {
                let scope = Scope::of(self.program.main());
                let of = self.infer(of, scope);
                let count = self.number(count, "a count");
                let of = of?;
                if !has_parts(of.ty) {
                    let message = format!("{} has no parts to count", describe(of.ty));
                    let help = "views, faces, edges and lists are counted; compare values with `=`";
                    self.report(Diagnostic::new(Code::E0703, of.span, message).help(help));
                    return None;
                }
                Some(To::Count(of, count?))
            }
        }
    }

    fn placed(&mut self, placed: &'a tree::Placed, library: Option<&Library>) -> Option<ExpectationKind> {
        let id = self.fact_feature(&placed.feature, library, None);
        let within = self.tolerance(placed.within.as_ref(), Type::Length);
        let kind = id.and_then(|id| library.map(|l| l.features[id.index()].kind));
        let place = match (&placed.facing, kind) {
            (Some(facing), None | Some(FeatureKind::Marker)) => {
                self.fact_place(&placed.at, facing).map(Expected::Marker)
            }
            (None, None | Some(FeatureKind::Polygon)) => self.predicted_face(&placed.at).map(Expected::Face),
            (_, Some(kind)) => {
                let name = &placed.feature.name.text;
                let help = match kind {
                    FeatureKind::Marker => {
                        format!("write where it is and where it looks: `{name} at [0 mm, 0 mm, 0 mm] facing +x`")
                    }
                    FeatureKind::Polygon => format!("write its corners: `{name} at polygon([…])`"),
                    FeatureKind::Shell => format!("count it: `expect {name} predicted 1`"),
                };
                let message = format!("this is no place of a {kind}, and `{name}` is one");
                self.report(Diagnostic::new(Code::E0703, placed.at.span, message).help(help));
                None
            }
        };
        Some(ExpectationKind::Placed(id?, place?, within?))
    }

    /// A face, or a predictor: that stands for the face that it predicts.
    fn predicted_face(&mut self, at: &'a tree::Expr) -> Option<Expr> {
        let (face, scope) = (due(Type::Polygon, "a predicted face"), Scope::of(self.program.main()));
        if !matches!(at.kind, tree::ExprKind::Call(_)) {
            return self.check(at, face, scope);
        }
        let found = self.infer(at, scope)?;
        if !matches!(found.ty, Type::Polygon | Type::Predictor) {
            self.wrong_type(&found, face);
            return None;
        }
        Some(found)
    }

    fn equal(
        &mut self,
        found: &'a tree::Expr,
        expected: &'a tree::Expr,
        within: Option<&'a tree::Expr>,
    ) -> Option<ExpectationKind> {
        let scope = Scope::of(self.program.main());
        let found = self.infer(found, scope)?;
        let expected = match found.ty {
            // Predictors are compared by the faces that they give.
            Type::Predictor => self.infer(expected, scope)?,
            Type::Count => self.check(expected, due(Type::Number, "the value that is expected"), scope)?,
            ty => self.check(expected, due(ty, "the value that is expected"), scope)?,
        };
        if found.ty == Type::Predictor && !matches!(expected.ty, Type::Predictor | Type::Polygon) {
            let what = describe(expected.ty);
            let message = format!("a predicted face cannot be compared with {what}");
            let help = "write the face that is expected: `polygon([…])`";
            self.report(Diagnostic::new(Code::E0703, expected.span, message).help(help));
            return None;
        }
        let Some(measure) = measured_in(found.ty) else {
            if let Some(within) = within {
                let what = describe(found.ty);
                let message = format!("{what} is equal or it is not: `within` has no meaning");
                self.report(Diagnostic::new(Code::E0703, within.span, message).help("leave it out"));
            }
            return Some(ExpectationKind::Equal(found, expected, None));
        };
        let within = self.tolerance(within, measure)?;
        Some(ExpectationKind::Equal(found, expected, within))
    }

    /// A value and the `within` after it.
    fn toleranced(
        &mut self,
        value: &tree::Expr,
        within: Option<&tree::Expr>,
        due: Due<'_>,
    ) -> (Option<Expr>, Option<Option<Expr>>) {
        let value = self.check(value, due, Scope::of(self.program.main()));
        (value, self.tolerance(within, due.ty))
    }

    fn tolerance(&mut self, within: Option<&tree::Expr>, ty: Type) -> Option<Option<Expr>> {
        match within {
            None => Some(None),
            Some(e) => self
                .check(e, due(ty, "`within`"), Scope::of(self.program.main()))
                .map(Some),
        }
    }

    fn number(&mut self, count: &tree::Expr, what: &str) -> Option<Expr> {
        self.check(count, due(Type::Count, what), Scope::of(self.program.main()))
    }
}

/// What the difference of two values is measured in; `None` where there is none.
fn measured_in(ty: Type) -> Option<Type> {
    match ty {
        Type::Length | Type::Angle | Type::Share | Type::Time | Type::Number => Some(ty),
        Type::Count => Some(Type::Number),
        Type::Point | Type::Polygon | Type::Edge | Type::Edges | Type::Views | Type::Predictor => Some(Type::Length),
        Type::Direction => Some(Type::Angle),
        _ => None,
    }
}

fn has_parts(ty: Type) -> bool {
    matches!(
        ty,
        Type::Views | Type::Predictor | Type::Polygon | Type::Edges | Type::List(_)
    )
}
