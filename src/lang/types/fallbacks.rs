//! Attributes of a rule's consequent: they have no value before the first instance is
//! measured, so something stands in with `else`.

use super::Checker;
use super::scope::{Role, RuleScope};
use super::typed::{Expr, ExprKind};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::names::DefinitionId;

impl Checker<'_> {
    /// Warns of attributes of the consequent that stand without `else`: they have no
    /// value before the first instance is measured.
    pub(super) fn fallbacks(&mut self, e: &Expr, scope: &RuleScope, covered: bool) {
        match &e.kind {
            ExprKind::Attribute(feature, name) if !covered && scope.role(feature) == Role::Consequent => {
                let family = &feature.family;
                let read = if name == "self" {
                    family.clone()
                } else {
                    format!("{family}.{name}")
                };
                let message = format!("`{read}` has no value before the first `{family}` is measured");
                self.report(
                    Diagnostic::new(Code::W0401, e.span, message)
                    .help("add what holds until then after `else`, of the same type: a length for a height, a point for an apex"),
                );
            }
            ExprKind::Else(a, b) => {
                self.fallbacks(a, scope, true);
                self.fallbacks(b, scope, covered);
            }
            ExprKind::Binary(_, a, b) => {
                self.fallbacks(a, scope, covered);
                self.fallbacks(b, scope, covered);
            }
            ExprKind::Negate(a) => self.fallbacks(a, scope, covered),
            ExprKind::List(items) => items.iter().for_each(|item| self.fallbacks(item, scope, covered)),
            ExprKind::Definition(id, arguments) => {
                for (k, argument) in arguments.iter().enumerate() {
                    let Some(argument) = argument else { continue };
                    let covered = covered || self.covers(*id, k);
                    self.fallbacks(argument, scope, covered);
                }
            }
            ExprKind::Primitive(_, arguments) => {
                arguments
                    .values()
                    .for_each(|argument| self.fallbacks(argument, scope, covered));
            }
            _ => {}
        }
    }

    /// Looks at the parameters of a definition, after those that it needs: no chain of
    /// definitions is then followed all at once.
    pub(super) fn coverage(&mut self, id: DefinitionId) {
        for k in 0..self.signatures[id.0].len() {
            self.covers(id, k);
        }
    }

    /// Whether every use of a definition's parameter stands before an `else`.
    fn covers(&mut self, id: DefinitionId, parameter: usize) -> bool {
        if let Some(known) = self.known_coverage.get(&(id, parameter)) {
            return *known;
        }
        let definition = self.definitions[id.0].checked();
        let covered = definition.is_some_and(|d| {
            let name = d.parameters.get(parameter).map(|p| p.name.as_str());
            !name.is_some_and(|name| self.reads_bare(&d.body, name))
        });
        self.known_coverage.insert((id, parameter), covered);
        covered
    }

    /// Whether an expression reads a parameter where nothing stands in for it.
    fn reads_bare(&mut self, e: &Expr, name: &str) -> bool {
        match &e.kind {
            ExprKind::Parameter(n) | ExprKind::ParameterAttribute(n, _) => n == name,
            ExprKind::Else(_, b) => self.reads_bare(b, name),
            ExprKind::Binary(_, a, b) => self.reads_bare(a, name) || self.reads_bare(b, name),
            ExprKind::Negate(a) => self.reads_bare(a, name),
            ExprKind::List(items) => items.iter().any(|item| self.reads_bare(item, name)),
            ExprKind::Primitive(_, arguments) => arguments.values().any(|a| self.reads_bare(a, name)),
            ExprKind::Definition(id, arguments) => arguments.iter().enumerate().any(|(k, argument)| {
                argument.as_ref().is_some_and(|a| self.reads_bare(a, name)) && !self.covers(*id, k)
            }),
            ExprKind::Value(_) | ExprKind::Text(_) | ExprKind::Variable(_) | ExprKind::Attribute(..) => false,
        }
    }
}
