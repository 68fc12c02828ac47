//! From the parser's pairs to the tree: tests, what they give and what they expect.

use pest::iterators::Pair;

use super::Rule;
use super::build::{Builder, children, parts, start_to};
use super::expressions::{expr, name, quoted};
use super::tree::{Evidence, Expectation, ExpectationKind, Expr, FeatureRef, Placed, RuleHead, Supposed, Test};

impl Builder<'_> {
    pub(super) fn test(&mut self, pair: Pair<'_, Rule>) -> Option<Test> {
        let doc = self.doc(&pair);
        let start = self.span(&pair);
        let known = self.bad.len();
        let mut parts_of = parts(pair);
        let title = quoted(self, parts_of.next()?, "the name of a test");
        let mut test = Test {
            head: start_to(start, title.span),
            name: title,
            libraries: Vec::new(),
            given: Vec::new(),
            expected: Vec::new(),
            whole: true,
            doc,
        };
        for part in parts_of {
            self.slips(&part);
            match part.as_rule() {
                Rule::library_of => test.libraries.extend(parts(part).next().map(|p| self.title(&p))),
                Rule::given => test.given.extend(parts(part).filter_map(|p| self.supposed(p))),
                Rule::expect => test.expected.extend(self.expectation(part)),
                _ => self.bad(&part),
            }
        }
        test.whole = self.bad.len() == known;
        Some(test)
    }

    fn supposed(&mut self, pair: Pair<'_, Rule>) -> Option<Supposed> {
        let whole = self.span(&pair);
        let mut parts_of = parts(pair);
        let feature = self.feature_ref(parts_of.next()?)?;
        let what = parts_of.next()?;
        let what = match what.as_rule() {
            Rule::measured => Evidence::Face(self.value(what)?),
            Rule::located => {
                let mut values = self.exprs(what).into_iter();
                Evidence::Marker {
                    at: values.next()?,
                    facing: values.next()?,
                }
            }
            _ => Evidence::State(name(self.file, &what)),
        };
        Some(Supposed {
            feature,
            what,
            span: whole,
        })
    }

    fn expectation(&mut self, pair: Pair<'_, Rule>) -> Option<Expectation> {
        let whole = self.span(&pair);
        Some(Expectation {
            kind: self.expectation_kind(parts(pair).next()?)?,
            span: whole,
        })
    }

    fn expectation_kind(&mut self, pair: Pair<'_, Rule>) -> Option<ExpectationKind> {
        use ExpectationKind as Kind;
        let kind = pair.as_rule();
        let holds = !children(pair.clone()).any(|p| p.as_rule() == Rule::kw_not);
        let counted = children(pair.clone()).any(|p| p.as_rule() == Rule::kw_count);
        let mut parts = parts(pair);
        Some(match kind {
            Rule::of_classes => Kind::Classes(parts.map(|p| name(self.file, &p)).collect()),
            Rule::of_class => Kind::Class(
                name(self.file, &parts.next()?),
                expr(self, parts.next()?),
                parts.next().and_then(|p| self.value(p)),
            ),
            Rule::of_flag => Kind::Flag(name(self.file, &parts.next()?), holds),
            Rule::of_next => Kind::Next(parts.filter_map(|p| self.feature_ref(p)).collect()),
            Rule::of_rule => Kind::Predicts(self.rule_head(parts.next()?)?, expr(self, parts.next()?)),
            Rule::of_rules => Kind::Rules(expr(self, parts.next()?)),
            Rule::of_value if counted => Kind::Count(expr(self, parts.next()?), expr(self, parts.next()?)),
            Rule::of_value => Kind::Equal(
                expr(self, parts.next()?),
                expr(self, parts.next()?),
                parts.next().and_then(|p| self.value(p)),
            ),
            _ => {
                let feature = self.feature_ref(parts.next()?)?;
                return self.of_feature(feature, parts.next()?);
            }
        })
    }

    fn of_feature(&mut self, feature: FeatureRef, pair: Pair<'_, Rule>) -> Option<ExpectationKind> {
        use ExpectationKind as Kind;
        Some(match pair.as_rule() {
            Rule::weighs => {
                let mut parts = parts(pair);
                let bits = expr(self, parts.next()?);
                Kind::Weight(feature, bits, parts.next().and_then(|p| self.value(p)))
            }
            Rule::predicted => Kind::Predicted(feature, self.value(pair)?),
            Rule::placed => {
                let (at, facing, within) = self.placed(pair)?;
                Kind::Placed(Placed {
                    feature,
                    at,
                    facing,
                    within,
                })
            }
            _ => Kind::State(feature, name(self.file, &pair)),
        })
    }

    fn placed(&mut self, pair: Pair<'_, Rule>) -> Option<(Expr, Option<Expr>, Option<Expr>)> {
        let (mut values, mut within) = (Vec::new(), None);
        for part in parts(pair) {
            match part.as_rule() {
                Rule::within => within = self.value(part),
                _ => values.push(expr(self, part)),
            }
        }
        let mut values = values.into_iter();
        Some((values.next()?, values.next(), within))
    }

    fn rule_head(&mut self, pair: Pair<'_, Rule>) -> Option<RuleHead> {
        let whole = self.span(&pair);
        self.slips(&pair);
        let mut features: Vec<FeatureRef> = parts(pair).filter_map(|p| self.feature_ref(p)).collect();
        let consequent = features.pop()?;
        Some(RuleHead {
            antecedents: features,
            consequent,
            span: whole,
        })
    }

    fn exprs(&mut self, pair: Pair<'_, Rule>) -> Vec<Expr> {
        parts(pair).map(|p| expr(self, p)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::parse;
    use super::super::tree::{ExpectationKind as Kind, Item};
    use super::*;
    use crate::lang::source::FileId;

    fn test(body: &str) -> Test {
        let text = format!("vpl 1\ntest \"t\" {{\n{body}\n}}\n");
        let (tree, found) = parse(FileId(0), &text);
        assert!(found.is_empty(), "{found:?}");
        match tree.items.into_iter().next() {
            Some(Item::Test(test)) => test,
            other => panic!("no test: {other:?}"),
        }
    }

    fn expected(body: &str) -> ExpectationKind {
        test(body).expected.remove(0).kind
    }

    #[test]
    fn what_is_given_is_read_in_three_forms() {
        let given =
            test("given a[1] absent, b = polygon([]),\n c at [1 m, 0 m, 0 m] facing +x\n given d detected").given;
        assert_eq!(given.len(), 4);
        assert!(matches!(&given[0].what, Evidence::State(s) if s.text == "absent"));
        assert!(matches!(given[1].what, Evidence::Face(_)));
        assert!(matches!(given[2].what, Evidence::Marker { .. }));
    }

    #[test]
    fn what_is_expected_of_a_feature_and_of_a_value_are_told_apart() {
        assert!(matches!(expected("expect code[3] detected"), Kind::State(..)));
        assert!(matches!(
            expected("expect code[3] weight 0.92 within 0.1"),
            Kind::Weight(_, _, Some(_))
        ));
        assert!(matches!(expected("expect side predicted 4"), Kind::Predicted(..)));
        assert!(matches!(expected("expect side at p within 1 mm"), Kind::Placed(_)));
        assert!(matches!(expected("expect kinect = other"), Kind::Equal(_, _, None)));
        assert!(matches!(expected("expect views count 4"), Kind::Count(..)));
        assert!(matches!(expected("expect rules 4"), Kind::Rules(_)));
        assert!(
            matches!(expected("expect rule a, b -> c predicts 1"), Kind::Predicts(h, _) if h.antecedents.len() == 2)
        );
        assert!(matches!(expected("expect not confident"), Kind::Flag(w, false) if w.text == "confident"));
        assert!(matches!(expected("expect contradicted"), Kind::Flag(w, true) if w.text == "contradicted"));
    }

    #[test]
    fn words_of_facts_stay_legal_names() {
        assert!(matches!(expected("expect rules = next"), Kind::Equal(..)));
        assert!(matches!(expected("expect count count 3"), Kind::Count(..)));
        assert!(matches!(expected("expect given detected"), Kind::State(..)));
    }
}
