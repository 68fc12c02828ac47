//! Colours by name and by digits.

use crate::rules::Colour;

/// Named colours, saturated sRGB.
const NAMED: &[(&str, [u8; 3])] = &[
    ("red", [200, 30, 30]),
    ("green", [30, 160, 50]),
    ("blue", [40, 70, 200]),
    ("yellow", [220, 200, 30]),
    ("cyan", [30, 180, 200]),
    ("magenta", [200, 40, 170]),
    ("orange", [230, 120, 20]),
    ("white", [240, 240, 240]),
    ("grey", [128, 128, 128]),
    ("gray", [128, 128, 128]),
    ("black", [20, 20, 20]),
];

/// The colour of a name.
pub(super) fn named(name: &str) -> Option<(&'static str, Colour)> {
    NAMED
        .iter()
        .find(|(n, _)| *n == name)
        .map(|(n, rgb)| (*n, Colour(*rgb)))
}

/// All names.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    all().map(|(n, _)| n)
}

/// All colours by name.
pub(in crate::lang) fn all() -> impl Iterator<Item = (&'static str, Colour)> {
    NAMED.iter().map(|(n, rgb)| (*n, Colour(*rgb)))
}
