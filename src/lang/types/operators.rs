//! Arithmetic: which dimensions add, scale and divide.

use super::expressions::{Due, made};
use super::scope::Scope;
use super::typed::{Expr, ExprKind};
use super::{Checker, units};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::source::Span;
use crate::lang::syntax::tree::{self, Operator};
use crate::primitives::Type;

impl Checker<'_> {
    pub(super) fn negate(&mut self, inner: &tree::Expr, span: Span, scope: Scope<'_>) -> Option<Expr> {
        let inner = self.infer(inner, scope)?;
        let ty = match inner.ty {
            Type::Count => Type::Number,
            ty if units::is_quantity(ty) || ty == Type::Direction => ty,
            ty => {
                let message = format!("{} has no negative", units::describe(ty));
                self.report(Diagnostic::new(Code::E0305, span, message));
                return None;
            }
        };
        Some(made(ExprKind::Negate(Box::new(inner)), ty, span))
    }

    pub(super) fn binary(
        &mut self,
        op: Operator,
        a: &tree::Expr,
        b: &tree::Expr,
        span: Span,
        scope: Scope<'_>,
    ) -> Option<Expr> {
        let (left, right) = self.sides(op, (a, b), scope);
        let (left, right) = (left?, right?);
        let Some(ty) = combined(op, left.ty, right.ty) else {
            self.report(cannot_combine(op, &left, &right, span));
            return None;
        };
        Some(made(ExprKind::Binary(op, Box::new(left), Box::new(right)), ty, span))
    }
}

impl Checker<'_> {
    /// Both sides; a bare number beside a quantity lacks its unit.
    fn sides(
        &mut self,
        op: Operator,
        (a, b): (&tree::Expr, &tree::Expr),
        scope: Scope<'_>,
    ) -> (Option<Expr>, Option<Expr>) {
        let sum = matches!(op, Operator::Add | Operator::Subtract);
        if sum && is_bare(a) && !is_bare(b) {
            let right = self.infer(b, scope);
            let left = self.side(a, right.as_ref(), ("left", op), scope);
            return (left, right);
        }
        let left = self.infer(a, scope);
        let right = match sum && is_bare(b) {
            true => self.side(b, left.as_ref(), ("right", op), scope),
            false => self.infer(b, scope),
        };
        (left, right)
    }

    /// A bare number, and the other side of the sum.
    fn side(
        &mut self,
        e: &tree::Expr,
        other: Option<&Expr>,
        (side, op): (&str, Operator),
        scope: Scope<'_>,
    ) -> Option<Expr> {
        match other {
            Some(other) if !units::of(other.ty).is_empty() => {
                let what = format!("the {side} side of `{}`", op.symbol());
                let due = Due {
                    ty: other.ty,
                    what: &what,
                };
                self.check(e, due, scope)
            }
            _ => self.infer(e, scope),
        }
    }
}

/// Whether an expression is a number without a unit.
fn is_bare(e: &tree::Expr) -> bool {
    match &e.kind {
        tree::ExprKind::Quantity(q) => q.unit.is_none(),
        tree::ExprKind::Group(inner) | tree::ExprKind::Negate(inner) => is_bare(inner),
        _ => false,
    }
}

/// The type of a sum, difference, product or quotient.
fn combined(op: Operator, left: Type, right: Type) -> Option<Type> {
    let number = |ty| matches!(ty, Type::Number | Type::Count);
    match op {
        Operator::Add | Operator::Subtract if left == Type::Point && right == Type::Point => Some(Type::Point),
        Operator::Add if left == Type::Count && right == Type::Count => Some(Type::Count),
        Operator::Add | Operator::Subtract if number(left) && number(right) => Some(Type::Number),
        Operator::Add | Operator::Subtract => (left == right && units::is_quantity(left)).then_some(left),
        Operator::Multiply if left == Type::Count && right == Type::Count => Some(Type::Count),
        Operator::Multiply | Operator::Divide if number(left) && number(right) => Some(Type::Number),
        Operator::Multiply if number(left) => units::is_quantity(right).then_some(right),
        Operator::Multiply | Operator::Divide if number(right) => units::is_quantity(left).then_some(left),
        Operator::Multiply | Operator::Divide => None,
    }
}

fn cannot_combine(op: Operator, left: &Expr, right: &Expr, span: Span) -> Diagnostic {
    let help = match op {
        Operator::Add | Operator::Subtract => "both sides of a sum are of one dimension",
        Operator::Multiply => "one side of `*` is a bare number",
        Operator::Divide => "the right side of `/` is a bare number",
    };
    Diagnostic::new(
        Code::E0305,
        span,
        format!(
            "{} and {} cannot be combined with `{}`",
            units::describe(left.ty),
            units::describe(right.ty),
            op.symbol()
        ),
    )
    .related(left.span, units::describe(left.ty))
    .related(right.span, units::describe(right.ty))
    .help(help)
}
