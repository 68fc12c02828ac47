//! Expressions: checked against a type where one is due, inferred elsewhere.

use super::scope::Scope;
use super::typed::{Expr, ExprKind, TextPart};
use super::{Checker, units};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::index::Entity;
use crate::lang::names::suggest::{closest, one_of};
use crate::lang::source::Span;
use crate::lang::syntax::tree;
use crate::primitives::Type;
use crate::rules::{Colour, Value};

/// A type that is due, and for what.
#[derive(Clone, Copy)]
pub(super) struct Due<'a> {
    pub ty: Type,
    /// In words: "`radius`", "`height` of `prism`".
    pub what: &'a str,
}

impl Checker<'_> {
    /// Checks an expression against the type that is due; `None` where it is wrong.
    pub(super) fn check(&mut self, e: &tree::Expr, due: Due<'_>, scope: Scope<'_>) -> Option<Expr> {
        match &e.kind {
            tree::ExprKind::Group(inner) => self.check(inner, due, scope),
            tree::ExprKind::Else(a, b) => self.check_else(e.span, (a, b), due, scope),
            tree::ExprKind::Quantity(q) if q.unit.is_none() && !units::of(due.ty).is_empty() => {
                self.unit_missing(q, due);
                None
            }
            tree::ExprKind::Quantity(q) if q.unit.is_some() => {
                let found = self.quantity(q, e.span)?;
                if !serves(found.ty, due.ty) {
                    self.wrong_unit(q, &found, due);
                    return None;
                }
                self.coerce(found, due)
            }
            tree::ExprKind::Text(parts) if self.quoted_word(parts, e.span, due) => None,
            tree::ExprKind::Reference(r) if due.ty == Type::Text && self.unquoted(r, due, scope) => None,
            tree::ExprKind::List(items) if takes_list(due.ty) => self.check_list(e.span, items, due, scope),
            tree::ExprKind::Reference(r) if self.is_word(r, due.ty, scope) => self.word(r, due),
            tree::ExprKind::Reference(r) if due.ty == Type::Direction => match self.direction_word(r, scope) {
                Some(direction) => Some(direction),
                None => {
                    let found = self.reference(r, scope)?;
                    self.coerce(found, due)
                }
            },
            tree::ExprKind::Negate(inner) if units::is_quantity(due.ty) && due.ty != Type::Count => {
                let inner = self.check(inner, due, scope)?;
                let ty = inner.ty;
                Some(made(ExprKind::Negate(Box::new(inner)), ty, e.span))
            }
            _ => {
                let found = self.infer(e, scope)?;
                self.coerce(found, due)
            }
        }
    }

    /// The type of an expression where none is due.
    pub(super) fn infer(&mut self, e: &tree::Expr, scope: Scope<'_>) -> Option<Expr> {
        match &e.kind {
            tree::ExprKind::Quantity(q) => self.quantity(q, e.span),
            tree::ExprKind::Text(parts) => self.text(parts, e.span, scope),
            tree::ExprKind::Colour(digits) => self.colour(digits, e.span),
            tree::ExprKind::Direction(sign, axis) => {
                let mut v = crate::geometry::Vector::zeros();
                v[*axis] = *sign;
                Some(constant(Value::Direction(v), Type::Direction, e.span))
            }
            tree::ExprKind::Reference(r) => self.reference(r, scope),
            tree::ExprKind::Call(call) => self.call(call, e.span, scope),
            tree::ExprKind::List(items) => self.infer_list(items, e.span, scope),
            tree::ExprKind::Group(inner) => self.infer(inner, scope),
            tree::ExprKind::Negate(inner) => self.negate(inner, e.span, scope),
            tree::ExprKind::Binary(op, a, b) => self.binary(*op, a, b, e.span, scope),
            tree::ExprKind::Else(a, b) => {
                let first = self.infer(a, scope)?;
                let due = Due {
                    ty: first.ty,
                    what: "the value after `else`",
                };
                let second = self.check(b, due, scope)?;
                self.in_a_rule(e.span, scope)?;
                let ty = first.ty;
                Some(made(ExprKind::Else(Box::new(first), Box::new(second)), ty, e.span))
            }
        }
    }

    fn check_else(
        &mut self,
        span: Span,
        (a, b): (&tree::Expr, &tree::Expr),
        due: Due<'_>,
        scope: Scope<'_>,
    ) -> Option<Expr> {
        let (a, b) = (self.check(a, due, scope), self.check(b, due, scope));
        self.in_a_rule(span, scope)?;
        Some(made(ExprKind::Else(Box::new(a?), Box::new(b?)), due.ty, span))
    }

    fn in_a_rule(&mut self, span: Span, scope: Scope<'_>) -> Option<()> {
        if scope.in_a_rule() {
            return Some(());
        }
        self.report(
            Diagnostic::new(
                Code::E0305,
                span,
                "`else` has no use here: both values are known at once",
            )
            .help("`a else b` stands in a rule, for attributes that are not measured yet"),
        );
        None
    }

    fn quantity(&mut self, q: &tree::Quantity, span: Span) -> Option<Expr> {
        let Some(unit) = &q.unit else {
            return Some(match q.whole {
                Some(n) => constant(Value::Count(n), Type::Count, span),
                None => constant(Value::Number(q.value), Type::Number, span),
            });
        };
        if let Some((word, ty, si)) = units::find(&unit.text) {
            self.names.uses(unit.span, Entity::Unit(word));
            return Some(constant(units::value(ty, q.value, si), ty, span));
        }
        if let Some(noun) = units::NOUNS.iter().find(|noun| **noun == unit.text) {
            self.names.uses(unit.span, Entity::Unit(noun));
        }
        match q.whole {
            Some(n) if units::NOUNS.contains(&unit.text.as_str()) => Some(constant(Value::Count(n), Type::Count, span)),
            None if units::NOUNS.contains(&unit.text.as_str()) => {
                let message = format!("`{}` counts whole things", unit.text);
                self.report(Diagnostic::new(Code::E0302, span, message).help("write a whole number"));
                None
            }
            _ => {
                self.unknown_unit(unit);
                None
            }
        }
    }

    fn unknown_unit(&mut self, unit: &tree::Name) {
        let out = Diagnostic::new(Code::E0302, unit.span, format!("there is no unit `{}`", unit.text));
        let near = closest(&unit.text, units::all())
            .or_else(|| units::all().find(|u| crate::lang::names::suggest::foreign(&unit.text) == Some(u)));
        let out = match near {
            Some(near) => out
                .help(format!("did you mean `{near}`?"))
                .fix(format!("write `{near}`"), unit.span, near),
            None => out.help(format!("units are {}", one_of(units::all()))),
        };
        self.report(out);
    }

    fn text(&mut self, parts: &[tree::TextPart], span: Span, scope: Scope<'_>) -> Option<Expr> {
        let mut out = Vec::new();
        for part in parts {
            out.push(match part {
                tree::TextPart::Literal(text) => TextPart::Literal(text.clone()),
                tree::TextPart::Hole(name) => self.hole(name, scope)?,
            });
        }
        Some(made(ExprKind::Text(out), Type::Text, span))
    }

    /// `{i}`: an index variable of the rule, or a text or count parameter.
    fn hole(&mut self, name: &tree::Name, scope: Scope<'_>) -> Option<TextPart> {
        let index = scope
            .rule
            .is_some_and(|r| r.indices.iter().any(|(n, _)| *n == name.text));
        let parameter = match scope.parameter(&name.text) {
            Some(None) => return None,
            Some(ty) => matches!(ty, Some(Type::Text | Type::Count)),
            None => false,
        };
        if index || parameter {
            self.names.uses_local(name);
            self.uses_parameter(name, scope);
            return Some(TextPart::Hole(name.text.clone()));
        }
        let known: Vec<&str> = scope
            .rule
            .map(|r| r.indices.iter().map(|(n, _)| n.as_str()).collect())
            .unwrap_or_default();
        let help = match known.as_slice() {
            [] => "`{…}` in a text stands for an index variable like the `i` of `rule -> code[i]`; write `\\{` for a brace"
                .to_owned(),
            known => format!("in scope is {}; write `\\{{` for a brace", one_of(known.iter().copied())),
        };
        self.report(
            Diagnostic::new(
                Code::E0201,
                name.span,
                format!("`{}` is no index variable here", name.text),
            )
            .help(help),
        );
        None
    }

    fn colour(&mut self, digits: &str, span: Span) -> Option<Expr> {
        match Colour::try_from(format!("#{digits}")) {
            Ok(colour) => Some(constant(Value::Colour(colour), Type::Colour, span)),
            Err(_) => {
                let out = Diagnostic::new(Code::E0110, span, format!("`#{digits}` is no colour"))
                    .help("write six hexadecimal digits, like `#ff8000`");
                let short = digits.len() == 3 && digits.chars().all(|c| c.is_ascii_hexdigit());
                self.report(if short {
                    let long: String = digits.chars().flat_map(|c| [c, c]).collect();
                    out.fix(format!("write `#{long}`"), span, format!("#{long}"))
                } else {
                    out
                });
                None
            }
        }
    }

    fn check_list(&mut self, span: Span, items: &[tree::Expr], due: Due<'_>, scope: Scope<'_>) -> Option<Expr> {
        let (element, triple) = match due.ty {
            Type::Point => (Type::Length, true),
            Type::Direction => (Type::Number, true),
            Type::List(element) => (*element, false),
            _ => return None,
        };
        let inner = Due { ty: element, ..due };
        let what = format!("a coordinate of {}", due.what);
        let inner = if triple { Due { what: &what, ..inner } } else { inner };
        if self.units_missing(span, items, inner) {
            return None;
        }
        let list: Vec<Option<Expr>> = items.iter().map(|item| self.check(item, inner, scope)).collect();
        if triple && items.len() != 3 {
            let message = format!("{} has three coordinates, and here are {}", due.what, items.len());
            let example = units::example(due.ty).unwrap_or_default();
            self.report(Diagnostic::new(Code::E0301, span, message).help(format!("write it {example}")));
            return None;
        }
        let list = list.into_iter().collect::<Option<_>>()?;
        Some(made(ExprKind::List(list), due.ty, span))
    }

    /// Three lengths are a point; other lists have the type of their elements.
    fn infer_list(&mut self, items: &[tree::Expr], span: Span, scope: Scope<'_>) -> Option<Expr> {
        let Some((first, rest)) = items.split_first() else {
            self.report(Diagnostic::new(Code::E0301, span, "an empty list says nothing here").help("leave it out"));
            return None;
        };
        let first = self.infer(first, scope)?;
        let element = if first.ty == Type::Count {
            Type::Number
        } else {
            first.ty
        };
        let due = Due {
            ty: element,
            what: "each element of this list",
        };
        let mut list = vec![self.coerce(first, due)?];
        for item in rest {
            list.push(self.check(item, due, scope)?);
        }
        let ty = match (element, list.len()) {
            (Type::Length, 3) => Type::Point,
            (Type::Number, 3) => Type::Direction,
            _ => match units::list_of(element) {
                Some(ty) => ty,
                None => {
                    let message = format!("there are no lists of {}", units::describe(element));
                    self.report(Diagnostic::new(Code::E0301, span, message));
                    return None;
                }
            },
        };
        Some(made(ExprKind::List(list), ty, span))
    }

    /// Turns what is meant anyway into the type that is due.
    pub(super) fn coerce(&mut self, found: Expr, due: Due<'_>) -> Option<Expr> {
        if serves(found.ty, due.ty) {
            return Some(Expr { ty: due.ty, ..found });
        }
        self.wrong_type(&found, due);
        None
    }
}

/// Whether values of a type serve where another is due.
fn serves(found: Type, due: Type) -> bool {
    found == due
        || matches!(
            (found, due),
            (Type::Count, Type::Number) | (Type::Edges, Type::List(Type::Edge))
        )
}

fn takes_list(ty: Type) -> bool {
    matches!(ty, Type::Point | Type::Direction | Type::List(_))
}

pub(super) fn made(kind: ExprKind, ty: Type, span: Span) -> Expr {
    Expr { kind, ty, span }
}

pub(super) fn constant(value: Value, ty: Type, span: Span) -> Expr {
    made(ExprKind::Value(value), ty, span)
}
