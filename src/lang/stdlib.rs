//! The standard library, shipped inside the binary.

const MODULES: &[(&str, &str)] = &[
    ("cameras", include_str!("../../stdlib/std/cameras.vpl")),
    ("detect", include_str!("../../stdlib/std/detect.vpl")),
    ("markers", include_str!("../../stdlib/std/markers.vpl")),
    ("solids", include_str!("../../stdlib/std/solids.vpl")),
    ("views", include_str!("../../stdlib/std/views.vpl")),
];

/// The text of the module `std.NAME`.
pub(super) fn module(name: &str) -> Option<&'static str> {
    MODULES.iter().find(|(n, _)| *n == name).map(|(_, text)| *text)
}

/// The names of all modules.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    MODULES.iter().map(|(n, _)| *n)
}
