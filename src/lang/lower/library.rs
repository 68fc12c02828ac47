//! Libraries: one rule for each value of the index variables, then the layouts'.

use std::collections::BTreeMap;

use super::Lowering;
use super::environments::Environments;
use super::expand::Env;
use super::layout::Placed;
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::source::Span;
use crate::lang::types::typed::{self, FeatureUse};
use crate::primitives;
use crate::rules::{Call, Class, Each, Feature, FeatureId, Library, Presence, Rule, Value};

/// Most rules of a library.
pub(super) const MOST_RULES: usize = 100_000;

impl<'a> Lowering<'a> {
    /// The library, and each layout where its places are right.
    pub(super) fn library(&mut self, library: &'a typed::Library) -> (Library, Vec<Option<Placed>>) {
        let before = self.found.len();
        let environments = self.environments(library);
        let mut out = Library {
            name: library.name.clone(),
            features: library.features.iter().map(|f| self.feature(f)).collect(),
            classes: self.classes(library, &environments),
            rules: Vec::new(),
            place: self.place(library.span),
        };
        for rule in &library.rules {
            let env = environments.of(rule.environment);
            self.taken_over(&env, rule.span, |lowering| lowering.rule(rule, library, &env, &mut out));
        }
        // A rule that is wrong is not missing, too.
        let whole = library.whole && self.found.len() == before;
        let mut placed = Vec::new();
        for layout in &library.layouts {
            let env = environments.of(layout.environment);
            self.taken_over(&env, layout.span, |lowering| {
                placed.push(lowering.layout(layout, &env, &mut out, whole));
            });
        }
        (out, placed)
    }

    fn feature(&self, feature: &typed::Feature) -> Feature {
        Feature {
            name: feature.name.clone(),
            kind: feature.kind,
            many: feature.many,
            place: self.place(feature.span),
        }
    }

    fn classes(&mut self, library: &'a typed::Library, environments: &Environments<'a>) -> Vec<Class> {
        let classes = &library.classes;
        let given = classes.iter().all(|c| c.prior.is_some()) && !classes.is_empty();
        let mut priors = vec![1.0 / classes.len().max(1) as f64; classes.len()];
        if given {
            for (prior, class) in priors.iter_mut().zip(classes) {
                let env = environments.of(class.environment);
                if let Some(Value::Share(share)) = class.prior.as_ref().and_then(|p| self.value(p, &env)) {
                    *prior = share;
                    self.prior_in_range(share, env.call.unwrap_or(class.span));
                }
            }
            self.priors_sum_to_one(&mut priors, library.span);
        }
        classes
            .iter()
            .zip(priors)
            .map(|(class, prior)| Class {
                name: class.name.clone(),
                prior,
                presence: Presence(class.presence.clone()),
                place: self.place(class.span),
            })
            .collect()
    }

    fn prior_in_range(&mut self, share: f64, span: Span) {
        if !(0.0 < share && share <= 1.0) {
            let message = "a prior is above 0 % and at most 100 %";
            let help = "leave a class out that cannot occur";
            self.report(Diagnostic::new(Code::E0311, span, message).help(help));
        }
    }

    fn priors_sum_to_one(&mut self, priors: &mut [f64], span: Span) {
        let sum: f64 = priors.iter().sum();
        if (sum - 1.0).abs() > 1e-6 {
            let message = format!(
                "the priors of the classes sum to {} %, not to 100 %",
                (sum * 1e6).round() / 1e4
            );
            self.report(Diagnostic::new(Code::E0311, span, message));
            return;
        }
        priors.iter_mut().for_each(|p| *p /= sum);
    }

    fn rule(&mut self, rule: &'a typed::Rule, library: &'a typed::Library, outer: &Env<'a>, out: &mut Library) {
        let combinations: usize = rule
            .indices
            .iter()
            .fold(1, |n, (_, values)| n.saturating_mul(values.len()));
        if combinations.saturating_add(out.rules.len()) > MOST_RULES {
            self.too_far::<()>(outer.call.unwrap_or(rule.span));
            return;
        }
        for k in 0..combinations {
            let env = Env {
                indices: combination(&rule.indices, k),
                families: Some(&library.families),
                ..outer.clone()
            };
            let before = self.found.len();
            let one = self.one_rule(rule, &env, out);
            out.rules.extend(one);
            // What is wrong with one member of a family is wrong with all.
            if self.found.len() > before {
                return;
            }
        }
    }

    fn one_rule(&mut self, rule: &'a typed::Rule, env: &Env<'a>, library: &Library) -> Option<Rule> {
        let resolve = |feature: &FeatureUse| env.families?.resolve(feature, &env.indices);
        let antecedents: Vec<FeatureId> = rule.antecedents.iter().map(resolve).collect::<Option<_>>()?;
        let consequent = resolve(&rule.consequent)?;
        // `code[i] -> code[j]` means different ones.
        let distinct = antecedents
            .iter()
            .enumerate()
            .all(|(k, a)| *a != consequent && !antecedents[..k].contains(a));
        if !distinct {
            return None;
        }
        let each = rule
            .each
            .iter()
            .map(|e| {
                Some(Each {
                    variable: e.variable.clone(),
                    feature: resolve(&e.feature)?,
                    attribute: e.attribute.clone(),
                })
            })
            .collect::<Option<_>>()?;
        let kind = library.features.get(consequent.index())?;
        let mut part = |e: &'a typed::Expr, word: &str| {
            let call = self.primitive(e, env)?;
            self.fits(&call, kind, word, env.call.unwrap_or(e.span))?;
            Some(call)
        };
        let (detect, measure) = (part(&rule.detect, "detects"), part(&rule.measure, "measures"));
        let predict = rule.predict.as_ref().map(|p| part(p, "predicts"));
        Some(Rule {
            id: format!("r{}", library.rules.len() + 1),
            antecedents,
            consequent,
            each,
            detect: detect?,
            measure: measure?,
            predict: match predict {
                None => None,
                Some(call) => Some(call?),
            },
            place: self.place(rule.span),
        })
    }

    /// Whether a primitive is for the kind of the consequent.
    fn fits(&mut self, call: &Call, consequent: &Feature, word: &str, span: Span) -> Option<()> {
        let primitive = primitives::find(&call.primitive)?;
        if primitive.features.contains(&consequent.kind) {
            return Some(());
        }
        let kinds: Vec<String> = primitive.features.iter().map(|k| format!("{k}s")).collect();
        let others = primitives::all()
            .filter(|p| p.result == primitive.result && p.features.contains(&consequent.kind))
            .map(|p| p.name);
        let message = format!(
            "`{}` {word} {}, and `{}` is a {}",
            call.primitive,
            kinds.join(" and "),
            consequent.name,
            consequent.kind
        );
        let help = format!(
            "for a {} there is {}",
            consequent.kind,
            crate::lang::names::suggest::one_of(others)
        );
        self.report(
            Diagnostic::new(Code::E0307, span, message)
                .related(consequent.place, "declared here")
                .help(help),
        );
        None
    }
}

/// The `k`th combination of the variables' values, the first variable turning slowest.
fn combination(indices: &[(String, Vec<u64>)], mut k: usize) -> BTreeMap<String, u64> {
    let mut out = BTreeMap::new();
    for (name, values) in indices.iter().rev() {
        out.insert(name.clone(), values[k % values.len()]);
        k /= values.len();
    }
    out
}
