//! From the parser's pairs to the tree: expressions, names and literals.

use pest::iterators::Pair;

use super::build::{Builder, children, parts, replace};
use super::habits::Habit;
use super::tree::{Argument, Call, Expr, ExprKind, Name, Operator, Quantity, Reference, TextPart};
use super::{Rule, span};
use crate::lang::diagnostics::{Code, Diagnostic, Edit};
use crate::lang::source::{FileId, Span};

pub(super) fn name(file: FileId, pair: &Pair<'_, Rule>) -> Name {
    Name {
        text: pair.as_str().to_owned(),
        span: span(file, pair),
    }
}

/// A whole number; one that no machine word holds is reported and read as the largest.
pub(super) fn integer(b: &mut Builder<'_>, pair: &Pair<'_, Rule>) -> u64 {
    pair.as_str().parse().unwrap_or_else(|_| {
        let at = b.span(pair);
        b.found.push(Diagnostic::new(
            Code::E0110,
            at,
            format!("`{}` is too large for a whole number", pair.as_str()),
        ));
        u64::MAX
    })
}

/// The content of a text without holes; `what` it is, in words.
pub(super) fn quoted(b: &mut Builder<'_>, pair: Pair<'_, Rule>, what: &str) -> Name {
    let at = b.span(&pair);
    let mut text = String::new();
    for part in text_parts(b, pair) {
        match part {
            TextPart::Literal(literal) => text.push_str(&literal),
            TextPart::Hole(hole) => b.found.push(
                Diagnostic::new(Code::E0110, hole.span, format!("{what} has no `{{…}}`"))
                    .help("write it out, `\\{` for a brace"),
            ),
        }
    }
    Name { text, span: at }
}

pub(super) fn expr(b: &mut Builder<'_>, pair: Pair<'_, Rule>) -> Expr {
    let at = b.span(&pair);
    let kind = match pair.as_rule() {
        Rule::expr | Rule::line_expr => return fold(b, pair, |_, left, right| ExprKind::Else(left, right)),
        Rule::sum | Rule::line_sum | Rule::product | Rule::line_product => {
            return fold(b, pair, ExprKind::Binary);
        }
        Rule::unary => return unary(b, pair),
        Rule::group => match parts(pair).next() {
            Some(inner) => ExprKind::Group(Box::new(expr(b, inner))),
            None => ExprKind::List(Vec::new()),
        },
        Rule::direction => direction(pair.as_str()),
        Rule::quantity => ExprKind::Quantity(quantity(b, pair)),
        Rule::text => ExprKind::Text(text_parts(b, pair)),
        Rule::colour => ExprKind::Colour(pair.as_str()[1..].to_owned()),
        Rule::tuple => tuple(b, pair, at),
        Rule::common_unit => common_unit(b, pair),
        Rule::list => ExprKind::List(parts(pair).map(|p| expr(b, p)).collect()),
        Rule::call => ExprKind::Call(call(b, pair)),
        _ => match reference(b, pair) {
            Some(reference) => ExprKind::Reference(reference),
            None => ExprKind::List(Vec::new()),
        },
    };
    Expr { kind, span: at }
}

/// `(107 mm, 0 mm, 0 mm)`: a list in the wrong brackets.
fn tuple(b: &mut Builder<'_>, pair: Pair<'_, Rule>, at: Span) -> ExprKind {
    let open = replace(
        Span {
            end: at.start + 1,
            ..at
        },
        "[",
    );
    let close = replace(
        Span {
            start: at.end - 1,
            ..at
        },
        "]",
    );
    b.habits.met(Habit::Tuple, at, vec![open, close]);
    ExprKind::List(parts(pair).map(|p| expr(b, p)).collect())
}

/// `[107, 0, 0] mm`: one unit for all numbers of a list.
fn common_unit(b: &mut Builder<'_>, pair: Pair<'_, Rule>) -> ExprKind {
    let mut parts = parts(pair);
    let (list, unit) = (parts.next().map(|p| expr(b, p)), parts.next().map(|p| name(b.file, &p)));
    let (Some(mut list), Some(unit)) = (list, unit) else {
        return ExprKind::List(Vec::new());
    };
    let between = Span {
        start: list.span.end,
        ..unit.span
    };
    let mut edits = vec![replace(between, "")];
    if let ExprKind::List(items) = &mut list.kind {
        items.iter_mut().for_each(|item| add_unit(item, &unit, &mut edits));
    }
    edits.sort_by_key(|e| e.span);
    b.habits.met(Habit::CommonUnit, unit.span, edits);
    list.kind
}

/// Gives a bare number, negated or not, a unit.
fn add_unit(item: &mut Expr, unit: &Name, edits: &mut Vec<Edit>) {
    match &mut item.kind {
        ExprKind::Negate(inner) | ExprKind::Group(inner) => add_unit(inner, unit, edits),
        ExprKind::Quantity(quantity) if quantity.unit.is_none() => {
            edits.push(replace(quantity.number.after(), &format!(" {}", unit.text)));
            quantity.unit = Some(unit.clone());
        }
        _ => {}
    }
}

/// Most operators in a row: the tree of a chain is as deep as the chain is long.
const LONGEST_CHAIN: usize = 256;

/// A chain of one precedence, read from the left.
fn fold(b: &mut Builder<'_>, pair: Pair<'_, Rule>, join: fn(Operator, Box<Expr>, Box<Expr>) -> ExprKind) -> Expr {
    let whole = b.span(&pair);
    let mut left: Option<Expr> = None;
    let (mut operator, mut operands) = (Operator::Add, 0);
    for part in children(pair) {
        match part.as_rule() {
            Rule::plus => operator = Operator::Add,
            Rule::minus => operator = Operator::Subtract,
            Rule::times => operator = Operator::Multiply,
            Rule::slash => operator = Operator::Divide,
            Rule::kw_else => {}
            _ if operands > LONGEST_CHAIN => {
                let message = format!("more than {LONGEST_CHAIN} operators in a row");
                let out = Diagnostic::new(Code::E0108, whole, message);
                b.found.push(out.help("name parts of the expression with `let`"));
                break;
            }
            _ => {
                operands += 1;
                let right = expr(b, part);
                left = Some(joined(left, operator, right, join));
            }
        }
    }
    left.unwrap_or(Expr {
        kind: ExprKind::List(Vec::new()),
        span: whole,
    })
}

fn joined(
    left: Option<Expr>,
    operator: Operator,
    right: Expr,
    join: fn(Operator, Box<Expr>, Box<Expr>) -> ExprKind,
) -> Expr {
    let Some(left) = left else {
        return right;
    };
    Expr {
        span: left.span.to(right.span),
        kind: join(operator, Box::new(left), Box::new(right)),
    }
}

fn unary(b: &mut Builder<'_>, pair: Pair<'_, Rule>) -> Expr {
    let at = b.span(&pair);
    let mut negated = false;
    let mut operand = Expr {
        kind: ExprKind::List(Vec::new()),
        span: at,
    };
    for part in children(pair) {
        match part.as_rule() {
            Rule::minus => negated = true,
            _ => operand = expr(b, part),
        }
    }
    if !negated {
        return operand;
    }
    Expr {
        kind: ExprKind::Negate(Box::new(operand)),
        span: at,
    }
}

fn direction(text: &str) -> ExprKind {
    let sign = if text.starts_with('-') { -1.0 } else { 1.0 };
    let axis = match &text[1..] {
        "x" => 0,
        "y" => 1,
        _ => 2,
    };
    ExprKind::Direction(sign, axis)
}

fn quantity(b: &mut Builder<'_>, pair: Pair<'_, Rule>) -> Quantity {
    let at = b.span(&pair);
    let mut quantity = Quantity {
        value: 0.0,
        whole: None,
        unit: None,
        number: at,
    };
    for part in children(pair) {
        if part.as_rule() == Rule::unit {
            quantity.unit = Some(name(b.file, &part));
            continue;
        }
        quantity.number = b.span(&part);
        quantity.whole = part.as_str().parse().ok();
        quantity.value = part.as_str().parse().unwrap_or(f64::INFINITY);
        if !quantity.value.is_finite() {
            let at = quantity.number;
            b.found
                .push(Diagnostic::new(Code::E0110, at, "this number is too large"));
        }
    }
    quantity
}

fn text_parts(b: &mut Builder<'_>, pair: Pair<'_, Rule>) -> Vec<TextPart> {
    let mut out = Vec::new();
    let mut literal = String::new();
    for part in pair.into_inner() {
        match part.as_rule() {
            Rule::chunk => literal.push_str(part.as_str()),
            Rule::escape => literal.extend(escaped(b, &part)),
            _ => {
                if !literal.is_empty() {
                    out.push(TextPart::Literal(std::mem::take(&mut literal)));
                }
                out.extend(part.into_inner().next().map(|hole| TextPart::Hole(name(b.file, &hole))));
            }
        }
    }
    if !literal.is_empty() || out.is_empty() {
        out.push(TextPart::Literal(literal));
    }
    out
}

fn escaped(b: &mut Builder<'_>, pair: &Pair<'_, Rule>) -> Option<char> {
    let c = pair.as_str().chars().nth(1)?;
    if !matches!(c, '"' | '\\' | '{' | '}') {
        let at = b.span(pair);
        b.found.push(
            Diagnostic::new(Code::E0110, at, format!("`\\{c}` means nothing in a text"))
                .help("a backslash stands before `\"`, `\\`, `{` or `}`; write `\\\\` for the backslash itself"),
        );
    }
    Some(c)
}

pub(super) fn call(b: &mut Builder<'_>, pair: Pair<'_, Rule>) -> Call {
    let at = b.span(&pair);
    let mut title = Name {
        text: String::new(),
        span: at,
    };
    let mut arguments = Vec::new();
    for part in parts(pair) {
        match part.as_rule() {
            Rule::name => title = name(b.file, &part),
            _ => arguments.extend(argument(b, part)),
        }
    }
    Call { name: title, arguments }
}

fn argument(b: &mut Builder<'_>, pair: Pair<'_, Rule>) -> Option<Argument> {
    b.slips(&pair);
    let mut parts = parts(pair).peekable();
    let title = parts.next_if(|p| p.as_rule() == Rule::name).map(|p| name(b.file, &p));
    Some(Argument {
        name: title,
        value: expr(b, parts.next()?),
    })
}

pub(super) fn reference(b: &mut Builder<'_>, pair: Pair<'_, Rule>) -> Option<Reference> {
    let whole = b.span(&pair);
    let mut parts = parts(pair).peekable();
    let title = name(b.file, &parts.next()?);
    let index = parts.next_if(|p| p.as_rule() == Rule::index).and_then(|p| b.index(p));
    Some(Reference {
        name: title,
        index,
        fields: parts.map(|p| name(b.file, &p)).collect(),
        span: whole,
    })
}
