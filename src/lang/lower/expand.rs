//! Expressions: definitions replaced by their bodies, names by what they stand for.

use std::collections::BTreeMap;

use super::{Lowering, constants, faces, ranges};
use crate::geometry::{Point, Vector};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::source::Span;
use crate::lang::types::typed::{self, ExprKind, Families, TextPart};
use crate::primitives::{Primitive, Type};
use crate::rules::{Call, Expr, Value};

/// Deepest expression, with the definitions that it uses inside of each other.
const DEEPEST: usize = 300;
/// Most expressions that a program expands to.
pub(super) const MOST_STEPS: usize = 4_000_000;

/// An expanded expression and where the user wrote it: for a parameter, the argument.
#[derive(Clone, Debug)]
pub(super) struct Expanded {
    pub expr: Expr,
    pub span: Span,
}

/// What names stand for.
#[derive(Clone, Default)]
pub(super) struct Env<'a> {
    pub parameters: BTreeMap<&'a str, Expanded>,
    pub indices: BTreeMap<String, u64>,
    pub families: Option<&'a Families>,
    /// The call or the `use` that the user wrote, where this is inside of a definition
    /// or of a library that was taken over.
    pub call: Option<Span>,
}

impl Env<'_> {
    /// What the inside of a definition sees before its parameters are known.
    pub fn called(call: Span) -> Self {
        Self {
            call: Some(call),
            ..Self::default()
        }
    }
}

impl<'a> Lowering<'a> {
    /// Expands an expression; `None` where a value in it is wrong, which was reported.
    pub(super) fn expand(&mut self, e: &'a typed::Expr, env: &Env<'a>) -> Option<Expanded> {
        self.steps += 1;
        if self.steps > MOST_STEPS || self.depth > DEEPEST {
            return self.too_far(env.call.unwrap_or(e.span));
        }
        self.depth += 1;
        let expanded = self.expand_parts(e, env);
        self.depth -= 1;
        expanded
    }

    fn expand_parts(&mut self, e: &'a typed::Expr, env: &Env<'a>) -> Option<Expanded> {
        let expr = match &e.kind {
            ExprKind::Parameter(name) => return self.argument(name, e.span, env),
            ExprKind::ParameterAttribute(name, attribute) => {
                let of = self.argument(name, e.span, env)?;
                self.attribute_of(&of.expr, attribute, of.span)?
            }
            ExprKind::Value(value) => Expr::Value(value.clone()),
            ExprKind::Text(parts) => Expr::Value(Value::Text(self.text(parts, env, e.span)?)),
            ExprKind::Variable(name) => Expr::Variable(name.clone()),
            ExprKind::Attribute(feature, name) => Expr::Attribute {
                feature: env.families?.resolve(feature, &env.indices)?,
                name: name.clone(),
            },
            ExprKind::Else(a, b) => {
                let (a, b) = (self.expand(a, env), self.expand(b, env));
                Expr::Else(Box::new(a?.expr), Box::new(b?.expr))
            }
            ExprKind::Binary(op, a, b) => {
                let (a, b) = (self.expand(a, env), self.expand(b, env));
                constants::combine(*op, a?.expr, b?.expr)
            }
            ExprKind::Negate(a) => constants::negate(self.expand(a, env)?.expr),
            ExprKind::List(items) => self.list(items, e, env)?,
            ExprKind::Primitive(primitive, arguments) => Expr::Call(self.call(primitive, arguments, e.span, env)?),
            ExprKind::Definition(id, arguments) => {
                let definition = self.typed.definitions.get(id.0)?.as_ref()?;
                let mut inner = Env::called(env.call.unwrap_or(e.span));
                let mut right = true;
                for (parameter, argument) in definition.parameters.iter().zip(arguments) {
                    let given = match (argument, &parameter.default) {
                        (Some(argument), _) => self.expand(argument, env),
                        (None, Some(default)) => self.expand(default, &Env::called(inner.call.unwrap_or(e.span))),
                        (None, None) => None,
                    };
                    right &= given.is_some();
                    inner
                        .parameters
                        .extend(given.map(|given| (parameter.name.as_str(), given)));
                }
                if !right {
                    return None;
                }
                self.expand(&definition.body, &inner)?.expr
            }
        };
        let span = env.call.unwrap_or(e.span);
        let expr = if e.ty == Type::Number {
            constants::as_number(expr)
        } else {
            expr
        };
        self.finite(&expr, span)?;
        Some(Expanded { expr, span })
    }

    /// Expands an expression that must be a call of a primitive.
    pub(super) fn primitive(&mut self, e: &'a typed::Expr, env: &Env<'a>) -> Option<Call> {
        match self.expand(e, env)?.expr {
            Expr::Call(call) => Some(call),
            _ => None,
        }
    }

    /// Expands an expression that has a value at once.
    pub(super) fn value(&mut self, e: &'a typed::Expr, env: &Env<'a>) -> Option<Value> {
        match self.expand(e, env)?.expr {
            Expr::Value(value) => Some(value),
            _ => {
                let message = "this value must be known before the robot moves";
                self.report(Diagnostic::new(Code::E0301, env.call.unwrap_or(e.span), message));
                None
            }
        }
    }

    /// What a parameter stands for. Each use copies it, and counts as what it copies:
    /// arguments that are used several times multiply.
    fn argument(&mut self, name: &str, span: Span, env: &Env<'a>) -> Option<Expanded> {
        let given = env.parameters.get(name)?;
        let (size, depth) = extent(&given.expr);
        self.steps = self.steps.saturating_add(size);
        if self.steps > MOST_STEPS || depth > DEEPEST {
            return self.too_far(env.call.unwrap_or(span));
        }
        Some(given.clone())
    }

    /// An attribute of what a parameter stands for: a feature, or one in place of another.
    fn attribute_of(&mut self, of: &Expr, attribute: &str, span: Span) -> Option<Expr> {
        match of {
            Expr::Attribute { feature, name } if name == "self" => Some(Expr::Attribute {
                feature: *feature,
                name: attribute.to_owned(),
            }),
            Expr::Else(a, b) => {
                let (a, b) = (
                    self.attribute_of(a, attribute, span),
                    self.attribute_of(b, attribute, span),
                );
                Some(Expr::Else(Box::new(a?), Box::new(b?)))
            }
            Expr::Call(call) if faces::is_written(call) => faces::attribute(call, attribute),
            _ => {
                let message = format!("`{attribute}` is read from this, and it is no feature");
                self.report(Diagnostic::new(Code::E0206, span, message).help("give the name of a polygon feature"));
                None
            }
        }
    }

    fn call(
        &mut self,
        primitive: &'static Primitive,
        arguments: &'a BTreeMap<&'static str, typed::Expr>,
        span: Span,
        env: &Env<'a>,
    ) -> Option<Call> {
        let mut out = BTreeMap::new();
        let mut right = true;
        for (name, argument) in arguments {
            let Some(value) = self.expand(argument, env) else {
                right = false;
                continue;
            };
            if let Some(found) = ranges::check(primitive, name, &value) {
                self.report(found);
                right = false;
            }
            out.insert((*name).to_owned(), value.expr);
        }
        let call = Call {
            primitive: primitive.name.to_owned(),
            arguments: out,
        };
        if right && let Some(found) = ranges::check_call(primitive, &call, env.call.unwrap_or(span)) {
            self.report(found);
            right = false;
        }
        right.then_some(call)
    }

    fn text(&mut self, parts: &[TextPart], env: &Env<'_>, span: Span) -> Option<String> {
        let mut out = String::new();
        for part in parts {
            match part {
                TextPart::Literal(text) => out.push_str(text),
                TextPart::Hole(name) => match (env.indices.get(name), env.parameters.get(name.as_str())) {
                    (Some(n), _) => out.push_str(&n.to_string()),
                    (None, Some(given)) => match &given.expr {
                        Expr::Value(Value::Text(text)) => out.push_str(text),
                        Expr::Value(Value::Count(n)) => out.push_str(&n.to_string()),
                        _ => return None,
                    },
                    (None, None) => return None,
                },
            }
        }
        if out.len() > MOST_TEXT {
            return self.too_far(span);
        }
        Some(out)
    }

    fn list(&mut self, items: &'a [typed::Expr], e: &typed::Expr, env: &Env<'a>) -> Option<Expr> {
        let items: Vec<Option<Expanded>> = items.iter().map(|item| self.expand(item, env)).collect();
        let items: Vec<Expr> = items.into_iter().map(|i| i.map(|i| i.expr)).collect::<Option<_>>()?;
        if !matches!(e.ty, Type::Point | Type::Direction) {
            return Some(Expr::List(items));
        }
        let Some([x, y, z]) = constants::triple(&items) else {
            self.report(
                Diagnostic::new(Code::E0301, e.span, "the coordinates of a point must be constants")
                    .help("attributes that are points, like `bottom.centre`, can be added to a point"),
            );
            return None;
        };
        if e.ty == Type::Point {
            return Some(Expr::Value(Value::Point(Point::new(x, y, z))));
        }
        match Vector::new(x, y, z).try_normalize(1e-9) {
            Some(unit) => Some(Expr::Value(Value::Direction(unit))),
            None => {
                self.report(Diagnostic::new(
                    Code::E0309,
                    e.span,
                    "a direction of no length points nowhere",
                ));
                None
            }
        }
    }

    fn finite(&mut self, expr: &Expr, span: Span) -> Option<()> {
        if constants::is_finite(expr) {
            return Some(());
        }
        self.report(
            Diagnostic::new(Code::E0309, span, "this value is too large, or not a number")
                .help("points lie within 1000 km, and nothing is divided by zero"),
        );
        None
    }

    pub(super) fn too_far<T>(&mut self, span: Span) -> Option<T> {
        if !self.found.iter().any(|d| d.code == Code::E0312) {
            self.report(
                Diagnostic::new(Code::E0312, span, "this program expands too far")
                    .help("definitions that use others several times multiply: use fewer levels"),
            );
        }
        None
    }
}

/// How many expressions one is made of, and how deep they nest.
fn extent(expr: &Expr) -> (usize, usize) {
    let parts: Vec<&Expr> = match expr {
        Expr::Value(_) | Expr::Variable(_) | Expr::Attribute { .. } => Vec::new(),
        Expr::Else(a, b) | Expr::Add(a, b) | Expr::Subtract(a, b) | Expr::Multiply(a, b) | Expr::Divide(a, b) => {
            vec![a, b]
        }
        Expr::List(items) => items.iter().collect(),
        Expr::Call(call) => call.arguments.values().collect(),
    };
    let parts = parts.into_iter().map(extent);
    let (size, depth) = parts.fold((0, 0), |(size, deepest), (n, depth)| (size + n, deepest.max(depth)));
    (size + 1, depth + 1)
}

/// Longest text, bytes.
const MOST_TEXT: usize = 4_096;
