//! Numbers and names, as verdicts write them.

use crate::rules::{FeatureId, Library};

/// A length in millimetres.
pub(super) fn metres(x: f64) -> String {
    format!("{} mm", rounded(x * 1e3))
}

/// An angle in degrees.
pub(super) fn degrees(x: f64) -> String {
    format!("{} deg", rounded(x.to_degrees()))
}

/// A share in percent.
pub(super) fn percent(x: f64) -> String {
    format!("{} %", rounded(x * 1e2))
}

/// A weight in bits.
pub(super) fn bits(x: f64) -> String {
    format!("{} bits", number(x))
}

/// A bare number.
pub(super) fn number(x: f64) -> String {
    format!("{}", (x * 1e4).round() / 1e4 + 0.0)
}

fn rounded(x: f64) -> String {
    format!("{}", (x * 1e3).round() / 1e3 + 0.0)
}

/// `a, b and c` in backticks, cut short where it is long.
pub(super) fn listed<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    const MOST: usize = 14;
    let names: Vec<String> = names.into_iter().map(|n| format!("`{n}`")).collect();
    match names.as_slice() {
        [] => "none".into(),
        [one] => one.clone(),
        all if all.len() > MOST => format!("{} and {} more", all[..MOST].join(", "), all.len() - MOST),
        [init @ .., last] => format!("{} and {last}", init.join(", ")),
    }
}

/// Features by name.
pub(super) fn features(ids: &[FeatureId], library: &Library) -> String {
    listed(ids.iter().map(|id| library.feature(*id).name.as_str()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_as_short_as_they_can_be() {
        assert_eq!(
            (metres(0.3), metres(0.0005), metres(-1e-9)),
            ("300 mm".into(), "0.5 mm".into(), "0 mm".into())
        );
        assert_eq!(
            (percent(1.0 / 12.0), degrees(std::f64::consts::PI)),
            ("8.333 %".into(), "180 deg".into())
        );
        assert_eq!(number(0.918_295_834), "0.9183");
    }

    #[test]
    fn nothing_is_said_to_be_nothing() {
        assert_eq!(listed([]), "none");
        assert_eq!(listed(["a", "b", "c"]), "`a`, `b` and `c`");
    }
}
