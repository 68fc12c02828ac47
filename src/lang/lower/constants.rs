//! Arithmetic on constants; what is not constant stays an expression.

use crate::lang::syntax::tree::Operator;
use crate::rules::{Expr, Value};

/// `a op b`, folded where both are constants. Types were checked before.
pub(super) fn combine(op: Operator, a: Expr, b: Expr) -> Expr {
    if let (Expr::Value(x), Expr::Value(y)) = (&a, &b)
        && let Some(value) = fold(op, x, y)
    {
        return Expr::Value(value);
    }
    let (a, b) = (Box::new(a), Box::new(b));
    match op {
        Operator::Add => Expr::Add(a, b),
        Operator::Subtract => Expr::Subtract(a, b),
        Operator::Multiply => Expr::Multiply(a, b),
        Operator::Divide => Expr::Divide(a, b),
    }
}

/// `-a`.
pub(super) fn negate(a: Expr) -> Expr {
    if let Expr::Value(Value::Direction(v)) = a {
        return Expr::Value(Value::Direction(-v));
    }
    combine(Operator::Multiply, Expr::Value(Value::Number(-1.0)), a)
}

/// A whole number as a number.
pub(super) fn as_number(expr: Expr) -> Expr {
    match expr {
        Expr::Value(Value::Count(n)) => Expr::Value(Value::Number(n as f64)),
        other => other,
    }
}

/// Three constants in SI units.
pub(super) fn triple(items: &[Expr]) -> Option<[f64; 3]> {
    let numbers: Vec<f64> = items
        .iter()
        .map(|item| match item {
            Expr::Value(value) => scalar(value),
            _ => None,
        })
        .collect::<Option<_>>()?;
    <[f64; 3]>::try_from(numbers).ok()
}

/// Largest number of any kind; lengths and the like have limits of their own.
const LARGEST: f64 = 1e15;

/// Whether a constant is a number within reason, or none at all.
pub(super) fn is_finite(expr: &Expr) -> bool {
    match expr {
        Expr::Value(Value::Point(p)) => p.coords.iter().all(|c| c.abs() <= 1e6),
        Expr::Value(value) => scalar(value).is_none_or(|x| x.abs() <= LARGEST),
        _ => true,
    }
}

/// A constant's number in SI units.
pub(super) fn scalar(value: &Value) -> Option<f64> {
    match value {
        Value::Length(x) | Value::Angle(x) | Value::Share(x) | Value::Time(x) | Value::Number(x) => Some(*x),
        Value::Count(n) => Some(*n as f64),
        _ => None,
    }
}

fn fold(op: Operator, a: &Value, b: &Value) -> Option<Value> {
    if let (Value::Count(x), Value::Count(y)) = (a, b) {
        let whole = match op {
            Operator::Add => x.checked_add(*y),
            Operator::Multiply => x.checked_mul(*y),
            Operator::Subtract | Operator::Divide => None,
        };
        if let Some(whole) = whole {
            return Some(Value::Count(whole));
        }
    }
    if let (Value::Point(p), Value::Point(q)) = (a, b) {
        return match op {
            Operator::Add => Some(Value::Point(*p + q.coords)),
            Operator::Subtract => Some(Value::Point(*p - q.coords)),
            Operator::Multiply | Operator::Divide => None,
        };
    }
    let (x, y) = (scalar(a)?, scalar(b)?);
    let result = match op {
        Operator::Add => x + y,
        Operator::Subtract => x - y,
        Operator::Multiply => x * y,
        Operator::Divide => x / y,
    };
    let of = if matches!(a, Value::Number(_) | Value::Count(_)) {
        b
    } else {
        a
    };
    Some(like(of, result))
}

/// A number of the dimension of another.
fn like(value: &Value, x: f64) -> Value {
    match value {
        Value::Length(_) => Value::Length(x),
        Value::Angle(_) => Value::Angle(x),
        Value::Share(_) => Value::Share(x),
        Value::Time(_) => Value::Time(x),
        _ => Value::Number(x),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folded(op: Operator, a: Value, b: Value) -> Expr {
        combine(op, Expr::Value(a), Expr::Value(b))
    }

    #[test]
    fn quantities_are_scaled_by_numbers_on_either_side() {
        let length = Expr::Value(Value::Length(0.5));
        assert_eq!(
            folded(Operator::Multiply, Value::Number(0.5), Value::Length(1.0)),
            length
        );
        assert_eq!(folded(Operator::Divide, Value::Length(1.0), Value::Count(2)), length);
        assert_eq!(
            folded(Operator::Subtract, Value::Length(1.0), Value::Length(0.5)),
            length
        );
    }

    #[test]
    fn whole_numbers_stay_whole_where_they_can() {
        assert_eq!(
            folded(Operator::Add, Value::Count(2), Value::Count(3)),
            Expr::Value(Value::Count(5))
        );
        assert_eq!(
            folded(Operator::Divide, Value::Count(1), Value::Count(2)),
            Expr::Value(Value::Number(0.5))
        );
        assert_eq!(
            folded(Operator::Subtract, Value::Count(1), Value::Count(2)),
            Expr::Value(Value::Number(-1.0))
        );
    }

    #[test]
    fn division_by_zero_is_seen() {
        assert!(!is_finite(&folded(
            Operator::Divide,
            Value::Length(1.0),
            Value::Count(0)
        )));
    }
}
