//! Conditions, quantities and states in words.

use crate::detect::{Condition, Test, Unit};
use crate::primitives::colours::name_of;
use crate::rules::Colour;

/// ✓ or ✗.
pub(super) fn mark(holds: bool) -> char {
    if holds { '✓' } else { '✗' }
}

/// `✓ dihedral 88.2° (80° to 100°)`.
pub(super) fn condition(condition: &Condition) -> String {
    let mark = mark(condition.holds);
    let name = match &condition.of {
        Some(what) => format!("{} {}", condition.name, named(what)),
        None => condition.name.to_string(),
    };
    match &condition.test {
        Test::Quantity {
            unit,
            least,
            most,
            found,
        } => {
            let found = found.map_or("no value".to_owned(), |x| quantity(*unit, x));
            format!("{mark} {name} {found}{}", bounds(*unit, *least, *most))
        }
        Test::Name { expected, .. } if condition.holds => format!("{mark} {name} `{expected}`"),
        Test::Name { expected, found } if found.is_empty() => format!("{mark} {name} `{expected}`: none was read"),
        Test::Name { expected, found } => format!("{mark} {name} `{expected}`: read {}", listed(found)),
        Test::Plain {} => format!("{mark} {name}"),
    }
}

/// Widest line of conditions, characters.
const WIDTH: usize = 100;

/// A head and conditions after it, over as many lines as it takes.
pub(super) fn wrapped(head: &str, all: &[Condition]) -> String {
    let indent = "        ";
    let mut text = head.to_owned();
    let mut width = head.chars().count();
    for (k, one) in all.iter().map(condition).enumerate() {
        let separator = if k == 0 { ": " } else { " · " };
        let more = one.chars().count() + separator.chars().count();
        if width + more > WIDTH {
            text += if k == 0 { ":" } else { "" };
            text += &format!("\n{indent}{one}");
            width = indent.len() + more;
        } else {
            text += &format!("{separator}{one}");
            width += more;
        }
    }
    text + "\n"
}

fn bounds(unit: Unit, least: Option<f64>, most: Option<f64>) -> String {
    match (least, most) {
        (Some(least), Some(most)) => format!(" ({} to {})", quantity(unit, least), quantity(unit, most)),
        (Some(least), None) => format!(" (at least {})", quantity(unit, least)),
        (None, Some(most)) => format!(" (at most {})", quantity(unit, most)),
        (None, None) => String::new(),
    }
}

/// A colour by its name where it has one; other names in backticks.
fn named(what: &str) -> String {
    match Colour::try_from(what.to_owned()) {
        Ok(colour) => name_of(colour).map_or_else(|| what.to_owned(), str::to_owned),
        Err(_) => format!("`{what}`"),
    }
}

/// A value with its unit.
pub(super) fn quantity(unit: Unit, value: f64) -> String {
    match unit {
        Unit::Angle => format!("{}°", short(value.to_degrees())),
        Unit::Length if value.abs() < 1.0 => format!("{} mm", short(value * 1e3)),
        Unit::Length => format!("{value:.2} m"),
        Unit::Area => format!("{} cm²", short(value * 1e4)),
        Unit::Share => share(value),
        Unit::Bits => format!("{value:.2} bits"),
        Unit::Pixels => format!("{} px", short(value)),
        Unit::Voxels => format!("{} voxels", short(value)),
        Unit::Levels | Unit::Count => short(value),
    }
}

/// A share in percent.
pub(super) fn share(value: f64) -> String {
    format!("{} %", short(value * 100.0))
}

/// One decimal, none where it is 0.
fn short(value: f64) -> String {
    let text = format!("{value:.1}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

/// A feature's state in words.
pub(super) fn state(code: i8) -> &'static str {
    match code {
        -1 => "unknown",
        0 => "absent",
        1 => "detected",
        2 => "present by reasoning",
        3 => "excluded by reasoning",
        _ => "in no known state",
    }
}

/// `a, b and c` in backticks.
pub(super) fn listed<S: AsRef<str>>(names: &[S]) -> String {
    let quoted: Vec<String> = names.iter().map(|n| format!("`{}`", n.as_ref())).collect();
    match quoted.as_slice() {
        [] => "none".to_owned(),
        [one] => one.clone(),
        [most @ .., last] => format!("{} and {last}", most.join(", ")),
    }
}

/// `3 views`, `1 view`.
pub(super) fn plural(n: usize, noun: &str) -> String {
    format!("{n} {noun}{}", if n == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_condition_says_its_value_and_its_bounds() {
        let angle = Condition::about(
            "dihedral",
            Unit::Angle,
            1.2444,
            90_f64.to_radians(),
            10_f64.to_radians(),
        );
        assert_eq!(condition(&angle), "✗ dihedral 71.3° (80° to 100°)");
        let green = Condition::at_least("colour", Unit::Pixels, 412.0, 4.0).of(Some("#1ea032".into()));
        assert_eq!(condition(&green), "✓ colour green 412 px (at least 4 px)");
        let text = Condition::named("text", "f3", "f1", vec!["f1".into(), "f6".into()]);
        assert_eq!(condition(&text), "✗ text `f3`: read `f1` and `f6`");
        assert_eq!(condition(&Condition::plain("decoded", false)), "✗ decoded");
        let nothing = Condition::at_least("seen", Unit::Share, f64::NAN, 0.8);
        assert_eq!(condition(&nothing), "✗ seen no value (at least 80 %)");
    }

    #[test]
    fn conditions_are_wrapped_between_and_never_within() {
        let all: Vec<Condition> = (0..9)
            .map(|_| Condition::plain("a condition of some words", true))
            .collect();
        let text = wrapped("    key", &all);
        assert!(
            text.lines().count() > 2 && text.lines().all(|l| l.chars().count() <= 104),
            "{text}"
        );
        assert_eq!(text.matches("✓ a condition of some words").count(), 9);
    }
}
