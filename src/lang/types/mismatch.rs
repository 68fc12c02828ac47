//! Values of the wrong dimension: both are named, and what to write instead.

use super::expressions::{Due, constant};
use super::scope::Scope;
use super::typed::Expr;
use super::{Checker, colours, units};
use crate::geometry::Vector;
use crate::lang::diagnostics::{Code, Diagnostic, Edit, Fix};
use crate::lang::names::suggest::{closest, one_of};
use crate::lang::source::Span;
use crate::lang::syntax::tree;
use crate::primitives::Type;
use crate::rules::Value;

impl Checker<'_> {
    /// Reports a value of another type than is due.
    pub(super) fn wrong_type(&mut self, found: &Expr, due: Due<'_>) {
        let (expected, given) = (units::describe(due.ty), units::describe(found.ty));
        let message = format!("expected {expected} for {}, found {given}", due.what);
        let out = Diagnostic::new(Code::E0301, found.span, message).label(given);
        let help = match (due.ty, found.ty) {
            (Type::Colour, Type::List(Type::Colour)) => {
                Some("write one colour, for all of it: a `box` takes one for each of its faces".to_owned())
            }
            _ => units::example(due.ty).map(|example| format!("write {expected} {example}")),
        };
        self.report(out.maybe_help(help));
    }

    /// Reports a number whose unit is of another dimension.
    pub(super) fn wrong_unit(&mut self, q: &tree::Quantity, found: &Expr, due: Due<'_>) {
        let (expected, given) = (units::describe(due.ty), units::describe(found.ty));
        let message = format!("expected {expected} for {}, found {given}", due.what);
        let out = Diagnostic::new(Code::E0301, found.span, message).label(given);
        let written = match q.whole {
            Some(n) => n.to_string(),
            None => q.value.to_string(),
        };
        let known = units::of(due.ty);
        let bare = matches!(due.ty, Type::Number) || (due.ty == Type::Count && q.whole.is_some());
        self.report(match known.first() {
            Some(first) => out.help(format!(
                "{expected} has the unit {}: `{written} {}`",
                one_of(known.iter().copied()),
                obvious_unit(due.ty, q).unwrap_or(first)
            )),
            None if bare => {
                let unit = Span {
                    start: q.number.end,
                    ..found.span
                };
                out.help(format!("{expected} has no unit: write `{written}`")).fix(
                    format!("write `{written}`"),
                    unit,
                    "",
                )
            }
            None => {
                let help = units::example(due.ty).map(|example| format!("write {expected} {example}"));
                out.maybe_help(help)
            }
        });
    }

    /// Reports a bare number where a quantity is due. Where one unit is the obvious
    /// one, it is offered as a fix.
    pub(super) fn unit_missing(&mut self, q: &tree::Quantity, due: Due<'_>) {
        let message = format!("{} is {} and needs a unit", due.what, units::describe(due.ty));
        let out = Diagnostic::new(Code::E0302, q.number, message).label("a bare number");
        let help = format!("add its unit: {}", one_of(units::of(due.ty)));
        let as_percent = due.ty == Type::Share && q.whole.is_none() && (0.0..=1.0).contains(&q.value);
        if as_percent {
            let percent = format!("{} %", tidy(q.value * 100.0));
            let help = format!("shares are written in percent: `{percent}`");
            self.report(out.help(help).fix(format!("write `{percent}`"), q.number, percent));
            return;
        }
        let out = out.help(help);
        self.report(match obvious_unit(due.ty, q) {
            Some(unit) => out.fix(format!("add `{unit}`"), q.number.after(), format!(" {unit}")),
            None => out,
        });
    }

    /// Reports a list of several bare numbers once; `false` where it is none.
    pub(super) fn units_missing(&mut self, span: Span, items: &[tree::Expr], due: Due<'_>) -> bool {
        let bare: Vec<&tree::Quantity> = items.iter().filter_map(bare_number).collect();
        if bare.len() < 2 || bare.len() < items.len() || units::of(due.ty).is_empty() {
            return false;
        }
        let what = due.what.replacen("a coordinate of", "each coordinate of", 1);
        let message = format!("{what} is {} and needs a unit", units::describe(due.ty));
        let mut out = Diagnostic::new(Code::E0302, span, message)
            .label("bare numbers")
            .help(format!("add their unit: {}", one_of(units::of(due.ty))));
        let largest = bare.iter().max_by(|a, b| a.value.total_cmp(&b.value));
        if let Some(unit) = largest.and_then(|q| obvious_unit(due.ty, q)) {
            out.fixes.push(Fix {
                message: format!("add `{unit}`"),
                edits: (bare.iter())
                    .map(|q| Edit {
                        span: q.number.after(),
                        text: format!(" {unit}"),
                    })
                    .collect(),
            });
        }
        self.report(out);
        true
    }

    /// Reports a word in quotes that is a word of the type that is due.
    pub(super) fn quoted_word(&mut self, parts: &[tree::TextPart], span: Span, due: Due<'_>) -> bool {
        let [tree::TextPart::Literal(word)] = parts else {
            return false;
        };
        let known = match due.ty {
            Type::Colour => colours::named(word).is_some(),
            Type::Choice(words) => words.contains(&word.as_str()),
            _ => false,
        };
        if known {
            let message = format!("expected {} for {}, found a text", units::describe(due.ty), due.what);
            self.report(
                Diagnostic::new(Code::E0301, span, message)
                    .label("a text")
                    .help(format!("take the quotes off: `{word}`"))
                    .fix(format!("write `{word}`"), span, word.as_str()),
            );
        }
        known
    }

    /// Reports a word where a text is due, and which stands for nothing that is one.
    pub(super) fn unquoted(&mut self, r: &tree::Reference, due: Due<'_>, scope: Scope<'_>) -> bool {
        let word = &r.name.text;
        let known = scope.parameter(word).is_some()
            || scope.variable(word).is_some()
            || scope.module.scope.contains_key(word)
            || scope.lost(word);
        let parameters = scope.parameters.iter().flat_map(|p| p.keys()).map(String::as_str);
        let plain = r.index.is_none() && r.fields.is_empty();
        if known || !plain || closest(word, parameters).is_some() {
            return false;
        }
        let message = format!("expected a text for {}, found the name `{word}`", due.what);
        let quoted = format!("\"{word}\"");
        self.report(
            Diagnostic::new(Code::E0301, r.span, message)
                .label("no text")
                .help(format!("a text stands in quotes: `{quoted}`"))
                .fix(format!("write `{quoted}`"), r.span, quoted),
        );
        true
    }

    /// `x`, `up`, `left` where a direction is due: it is reported, and read as the axis
    /// that is probably meant.
    pub(super) fn direction_word(&mut self, r: &tree::Reference, scope: Scope<'_>) -> Option<Expr> {
        let name = &r.name.text;
        let known = scope.parameter(name).is_some() || scope.module.scope.contains_key(name);
        let plain = r.index.is_none() && r.fields.is_empty() && !known;
        let (_, right, axis, sign) = DIRECTION_WORDS
            .iter()
            .find(|(word, ..)| plain && name.eq_ignore_ascii_case(word))?;
        let message = format!("a direction is an axis with its sign, and here is `{name}`");
        self.report(
            Diagnostic::new(Code::E0306, r.span, message)
                .help(format!("write `{right}`"))
                .fix(format!("write `{right}`"), r.span, *right),
        );
        let mut vector = Vector::zeros();
        vector[*axis] = *sign;
        Some(constant(Value::Direction(vector), Type::Direction, r.span))
    }
}

/// Words for directions, in the object's own frame: x forward, y to the left, z up.
const DIRECTION_WORDS: &[(&str, &str, usize, f64)] = &[
    ("x", "+x", 0, 1.0),
    ("y", "+y", 1, 1.0),
    ("z", "+z", 2, 1.0),
    ("front", "+x", 0, 1.0),
    ("forward", "+x", 0, 1.0),
    ("back", "-x", 0, -1.0),
    ("backward", "-x", 0, -1.0),
    ("left", "+y", 1, 1.0),
    ("right", "-y", 1, -1.0),
    ("up", "+z", 2, 1.0),
    ("top", "+z", 2, 1.0),
    ("down", "-z", 2, -1.0),
    ("bottom", "-z", 2, -1.0),
];

/// A number without a unit, negated or not.
fn bare_number(e: &tree::Expr) -> Option<&tree::Quantity> {
    match &e.kind {
        tree::ExprKind::Quantity(q) if q.unit.is_none() => Some(q),
        tree::ExprKind::Negate(inner) => bare_number(inner),
        _ => None,
    }
}

/// The unit that a bare number almost surely has; none where two are likely.
fn obvious_unit(ty: Type, q: &tree::Quantity) -> Option<&'static str> {
    let (whole, x) = (q.whole.is_some(), q.value);
    match ty {
        Type::Length if whole && x >= 10.0 => Some("mm"),
        Type::Length if !whole && x < 10.0 => Some("m"),
        Type::Angle if x > std::f64::consts::TAU => Some("deg"),
        Type::Angle if !whole && x < 2.0 => Some("rad"),
        Type::Share if x > 1.0 && x <= 100.0 => Some("%"),
        Type::Time if whole && x >= 5.0 => Some("ms"),
        Type::Time if !whole && x < 5.0 => Some("s"),
        _ => None,
    }
}

/// A number without the digits that arithmetic adds.
fn tidy(x: f64) -> f64 {
    (x * 1e9).round() / 1e9
}
