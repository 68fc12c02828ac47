//! Range checks of shape arguments, with errors in the unit an author writes.

use std::ops::RangeInclusive;

use crate::rules::Call;
use crate::sense::SceneError;

/// A length argument within a range of metres.
pub(super) fn length(call: &Call, name: &'static str, range: RangeInclusive<f64>) -> Result<f64, SceneError> {
    let x = call.length(name).map_err(SceneError::argument(&call.primitive))?;
    check(call, name, x, range, |x| format!("{} mm", round(x * 1e3)))
}

/// An angle argument within a range of radians.
pub(super) fn angle(call: &Call, name: &'static str, range: RangeInclusive<f64>) -> Result<f64, SceneError> {
    let x = call.angle(name).map_err(SceneError::argument(&call.primitive))?;
    check(call, name, x, range, |x| format!("{} deg", round(x.to_degrees())))
}

/// A share argument, 0 to 1.
pub(super) fn share(call: &Call, name: &'static str) -> Result<f64, SceneError> {
    let x = call.share(name).map_err(SceneError::argument(&call.primitive))?;
    check(call, name, x, 0.0..=1.0, |x| format!("{} %", round(x * 100.0)))
}

/// A bare number within a range.
pub(super) fn number(call: &Call, name: &'static str, range: RangeInclusive<f64>) -> Result<f64, SceneError> {
    let x = call.number(name).map_err(SceneError::argument(&call.primitive))?;
    check(call, name, x, range, |x| round(x).to_string())
}

/// A count within a range.
pub(super) fn count(call: &Call, name: &'static str, range: RangeInclusive<u64>) -> Result<u64, SceneError> {
    let n = call.count(name).map_err(SceneError::argument(&call.primitive))?;
    if range.contains(&n) {
        return Ok(n);
    }
    let expected = format!("{} to {}", range.start(), range.end());
    Err(out_of_range(call, name, n.to_string(), expected))
}

/// The error of an argument that does not fit.
pub(super) fn out_of_range(
    call: &Call,
    parameter: &'static str,
    found: String,
    expected: impl Into<String>,
) -> SceneError {
    SceneError::Range {
        primitive: call.primitive.clone(),
        parameter,
        found,
        expected: expected.into(),
    }
}

fn check(
    call: &Call,
    name: &'static str,
    x: f64,
    range: RangeInclusive<f64>,
    show: impl Fn(f64) -> String,
) -> Result<f64, SceneError> {
    if range.contains(&x) {
        return Ok(x);
    }
    let expected = format!("{} to {}", show(*range.start()), show(*range.end()));
    Err(out_of_range(call, name, show(x), expected))
}

/// Three decimals: what a reader of an error can use.
fn round(x: f64) -> f64 {
    (x * 1e3).round() / 1e3
}
