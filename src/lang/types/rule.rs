//! Rules: their features, variables and the three calls.

use super::Checker;
use super::expressions::Due;
use super::features::feature_use;
use super::scope::{Role, RuleScope, Scope, declared, index_use};
use super::shadowing::hides;
use super::typed::{Each, Expr, FeatureUse, IndexUse, Rule};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::index::Kind;
use crate::lang::names;
use crate::lang::source::Span;
use crate::lang::syntax::tree::{self, Index};
use crate::primitives::Type;

impl<'a> Checker<'a> {
    pub(super) fn rule(&mut self, rule: &'a tree::Rule, outer: Scope<'_>) -> Option<Rule> {
        let mut scope = self.rule_scope(rule, outer)?;
        let each = self.each(rule, &mut scope, outer);
        let inside = Scope {
            rule: Some(&scope),
            ..outer
        };
        let detect = self.part(rule, &rule.detect, "detect", Type::Detector, inside);
        let measure = self.part(rule, &rule.measure, "measure", Type::Measure, inside);
        let predict = self.prediction(rule, inside);
        for part in [&detect, &measure, &predict].into_iter().flatten() {
            self.fallbacks(part, &scope, false);
        }
        Some(Rule {
            environment: None,
            each: each?,
            detect: detect?,
            measure: measure?,
            predict: if rule.predict.is_empty() { None } else { Some(predict?) },
            antecedents: scope.antecedents,
            consequent: scope.consequent,
            indices: scope.indices,
            span: rule.head,
        })
    }

    /// The features and index variables of a rule's `->` line.
    fn rule_scope(&mut self, rule: &tree::Rule, outer: Scope<'_>) -> Option<RuleScope> {
        self.names.begin_rule();
        let heads: Vec<&tree::FeatureRef> = rule.antecedents.iter().chain([&rule.consequent]).collect();
        let indices = self.indices(&heads, outer);
        let mut scope = RuleScope {
            antecedents: Vec::new(),
            consequent: plain_use(&rule.consequent),
            each: Vec::new(),
            indices,
        };
        let inside = Scope {
            rule: Some(&scope),
            ..outer
        };
        let uses: Vec<Option<FeatureUse>> = heads
            .iter()
            .map(|f| feature_use(self, &f.name, f.index.as_ref(), f.span, inside))
            .collect();
        let mut uses = uses.into_iter().collect::<Option<Vec<_>>>()?;
        scope.consequent = uses.pop()?;
        self.antecedents_differ(&uses, &scope.consequent)?;
        scope.antecedents = uses;
        Some(scope)
    }

    /// The values of each index variable: those that all its families declare.
    fn indices(&mut self, heads: &[&tree::FeatureRef], outer: Scope<'_>) -> Vec<(String, Vec<u64>)> {
        let mut out: Vec<(String, Vec<u64>)> = Vec::new();
        for head in heads {
            let (Some(Index::Variable(name)), Some(family)) = (&head.index, outer.family(&head.name.text)) else {
                continue;
            };
            self.hides_a_parameter("index variable", name, outer);
            let values = declared(family);
            self.names.local(Kind::Index, name, None);
            match out.iter_mut().find(|(n, _)| *n == name.text) {
                Some((_, known)) => known.retain(|v| values.binary_search(v).is_ok()),
                None => out.push((name.text.clone(), values)),
            }
        }
        out
    }

    fn antecedents_differ(&mut self, antecedents: &[FeatureUse], consequent: &FeatureUse) -> Option<()> {
        let same = |a: &FeatureUse, b: &FeatureUse| a.family == b.family && a.index == b.index;
        for (k, antecedent) in antecedents.iter().enumerate() {
            let (other, message) = if same(antecedent, consequent) {
                (
                    consequent.span,
                    format!("`{}` cannot be its own antecedent", antecedent.family),
                )
            } else if let Some(first) = antecedents[..k].iter().find(|a| same(a, antecedent)) {
                (first.span, format!("`{}` is an antecedent twice", antecedent.family))
            } else {
                continue;
            };
            let out = Diagnostic::new(Code::E0305, antecedent.span, message);
            self.report(out.related(other, "the same feature"));
            return None;
        }
        Some(())
    }

    /// `for each` variables, outermost first; each can see those before it.
    fn each(&mut self, rule: &tree::Rule, scope: &mut RuleScope, outer: Scope<'_>) -> Option<Vec<Each>> {
        let mut out = Some(Vec::new());
        names::unique("variable", rule.each.iter().map(|e| &e.variable), &mut self.found);
        for each in &rule.each {
            let name = &each.variable;
            if scope.indices.iter().any(|(n, _)| *n == name.text) {
                let out = hides("variable", name, "index variable").related(rule.head, "of this rule");
                self.report(out);
            } else {
                self.hides_something("variable", name, outer);
            }
            let checked = self.one_each(each, scope, outer);
            self.names
                .local(Kind::Variable, name, checked.as_ref().map(|_| Type::Edge));
            scope
                .each
                .push((name.text.clone(), checked.as_ref().map(|_| Type::Edge)));
            match (checked, &mut out) {
                (Some(each), Some(list)) => list.push(each),
                _ => out = None,
            }
        }
        out
    }

    fn one_each(&mut self, each: &tree::ForEach, scope: &RuleScope, outer: Scope<'_>) -> Option<Each> {
        let over = &each.over;
        let inside = Scope {
            rule: Some(scope),
            ..outer
        };
        let feature = feature_use(self, &over.name, over.index.as_ref(), over.span, inside)?;
        let kind = outer.family(&feature.family)?.kind;
        let [field] = over.fields.as_slice() else {
            self.report(
                Diagnostic::new(
                    Code::E0206,
                    over.span,
                    "`for each` goes over a list of a measured feature",
                )
                .help(format!("write `{}.edges`", feature.family)),
            );
            return None;
        };
        let attribute = self.attribute(&feature.family, field, kind)?;
        if attribute.ty != Type::Edges {
            let message = format!(
                "`{}` is {}, and no list",
                attribute.name,
                super::units::describe(attribute.ty)
            );
            let help = format!("`for each` goes over `{}.edges`", feature.family);
            self.report(Diagnostic::new(Code::E0301, field.span, message).help(help));
            return None;
        }
        if scope.role(&feature) != Role::Antecedent {
            self.report(
                Diagnostic::new(
                    Code::E0205,
                    over.span,
                    format!("`{}` is no antecedent of this rule", feature.family),
                )
                .help("`for each` goes over parts of what the rule starts from"),
            );
            return None;
        }
        Some(Each {
            variable: each.variable.text.clone(),
            feature,
            attribute: attribute.name.to_owned(),
        })
    }

    /// A statement that a rule has exactly once.
    fn part(
        &mut self,
        rule: &tree::Rule,
        statements: &[tree::Statement],
        word: &str,
        ty: Type,
        scope: Scope<'_>,
    ) -> Option<Expr> {
        let Some((first, rest)) = statements.split_first() else {
            if rule.whole {
                let message = format!("this rule has no `{word}`");
                let help = match ty {
                    Type::Detector => "say what proves the feature, like `detect coloured_plane(red)`",
                    Type::Measure => "say what measures it once detected, like `measure outline()`",
                    _ => "say where it must be, like `predict square_under(prism_side.base)`",
                };
                self.report(Diagnostic::new(Code::E0308, rule.head, message).help(help));
            }
            return None;
        };
        for again in rest {
            self.surplus(again.span, first.span, word);
        }
        let what = format!("`{word}`");
        self.check(&first.value, Due { ty, what: &what }, scope)
    }

    /// Reports a statement that stands there twice.
    pub(super) fn surplus(&mut self, span: Span, first: Span, word: &str) {
        let out = Diagnostic::new(Code::E0308, span, format!("`{word}` stands here twice"));
        self.report(out.related(first, "first here").help("leave one of them out"));
    }

    /// Checks something, and leaves out what one code says of it.
    fn besides<T>(&mut self, code: Code, check: impl FnOnce(&mut Self) -> T) {
        let before = self.found.len();
        check(self);
        let new = self.found.split_off(before);
        self.found.extend(new.into_iter().filter(|d| d.code != code));
        // Indices into what was found no longer hold.
        self.unknown_arguments.retain(|_, at| *at < before);
    }

    fn prediction(&mut self, rule: &tree::Rule, scope: Scope<'_>) -> Option<Expr> {
        let definite = rule.antecedents.is_empty();
        match (definite, rule.predict.first()) {
            (true, Some(predict)) => {
                self.report(
                    Diagnostic::new(Code::E0308, predict.span, "a rule without antecedents predicts nothing")
                        .related(rule.head, "nothing stands before the `->`")
                        .help("leave `predict` out, or name the features that the prediction follows from"),
                );
                self.besides(Code::E0205, |checker| {
                    checker.part(rule, &rule.predict, "predict", Type::Predictor, scope)
                });
                None
            }
            (true, None) => None,
            (false, _) => self.part(rule, &rule.predict, "predict", Type::Predictor, scope),
        }
    }
}

/// A use of a feature before it is checked.
fn plain_use(feature: &tree::FeatureRef) -> FeatureUse {
    FeatureUse {
        family: feature.name.text.clone(),
        index: index_use(feature.index.as_ref()).unwrap_or(IndexUse::None),
        span: feature.span,
    }
}
