//! Quantities, in the units that they are written in and in those that are kept.

use crate::lang::syntax::tree::Quantity;
use crate::lang::vocabulary;
use crate::rules::Value;

/// Units whose SI value is not a shift of the decimal point.
const CONVERTED: &[&str] = &["deg", "in"];

/// What a quantity comes down to, like `1.5708 rad`; none where its unit is unknown.
pub(super) fn in_si(quantity: &Quantity) -> Option<String> {
    let unit = quantity.unit.as_ref()?;
    said(&vocabulary::quantity(quantity.value, &unit.text)?)
}

/// Whether the SI value of a quantity is no matter of looking twice.
pub(super) fn is_converted(quantity: &Quantity) -> bool {
    let unit = quantity.unit.as_ref();
    unit.is_some_and(|u| CONVERTED.contains(&u.text.as_str()))
}

/// A value with its SI unit.
pub(super) fn said(value: &Value) -> Option<String> {
    Some(match value {
        Value::Length(x) => format!("{} m", short(*x)),
        Value::Angle(x) => format!("{} rad", short(*x)),
        Value::Share(x) => short(*x),
        Value::Time(x) => format!("{} s", short(*x)),
        Value::Number(x) => short(*x),
        Value::Count(n) => n.to_string(),
        _ => return None,
    })
}

/// Five significant digits.
pub(super) fn short(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return format!("{x}");
    }
    let digits = 4 - x.abs().log10().floor() as i32;
    if !(-12..=12).contains(&digits) {
        return format!("{x:.4e}");
    }
    let scale = 10f64.powi(digits);
    format!("{}", (x * scale).round() / scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn five_digits_are_kept() {
        let said: Vec<String> = [0.0, 0.01, 1.234_567_8, 12_345.678, -0.3, 1e-20, 1e20]
            .map(short)
            .to_vec();
        assert_eq!(
            said,
            ["0", "0.01", "1.2346", "12346", "-0.3", "1.0000e-20", "1.0000e20"]
        );
    }
}
