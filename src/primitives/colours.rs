//! The named colours, as programs write them and answers say them.

use crate::rules::Colour;

/// Named colours, saturated sRGB; of two names of one colour the first is ours.
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
pub fn named(name: &str) -> Option<Colour> {
    NAMED.iter().find(|(n, _)| *n == name).map(|(_, rgb)| Colour(*rgb))
}

/// The name of a colour.
pub fn name_of(colour: Colour) -> Option<&'static str> {
    NAMED.iter().find(|(_, rgb)| *rgb == colour.0).map(|(n, _)| *n)
}

/// All names.
pub fn names() -> impl Iterator<Item = &'static str> {
    all().map(|(n, _)| n)
}

/// All names with their colours.
pub fn all() -> impl Iterator<Item = (&'static str, Colour)> {
    NAMED.iter().map(|(n, rgb)| (*n, Colour(*rgb)))
}
