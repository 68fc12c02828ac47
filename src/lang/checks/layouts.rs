//! Layouts: members of a family that are left out, and prints over each other.

use std::collections::{BTreeMap, BTreeSet};

use super::names;
use super::space::metres;
use crate::geometry::{Pose, Vector};
use crate::lang::diagnostics::{Code, Diagnostic, Severity};
use crate::lang::lower::Placed;
use crate::lang::source::Span;
use crate::primitives::printed_edge;
use crate::rules::{FeatureId, Library};

/// Prints nearer than this lie in one plane: plates are some millimetres thick.
const THICK: f64 = 0.005;
/// Normals closer than this are parallel, as a cosine.
const PARALLEL: f64 = 0.996;

pub(super) fn check(library: &Library, layouts: &[Option<Placed>]) -> Vec<Diagnostic> {
    let layouts: Vec<&Placed> = layouts.iter().flatten().collect();
    let predicted: BTreeSet<FeatureId> = library
        .rules
        .iter()
        .filter(|r| r.predict.is_some())
        .map(|r| r.consequent)
        .collect();
    let prints = sizes(library, &layouts);
    let mut found = Vec::new();
    for layout in layouts {
        found.extend(left_out(layout, library, &predicted));
        found.extend(overlap(layout, library, &prints));
    }
    found
}

/// Members of a placed family that nothing predicts.
fn left_out(layout: &Placed, library: &Library, predicted: &BTreeSet<FeatureId>) -> Option<Diagnostic> {
    let family = |f: FeatureId| library.feature(f).name.split_once('[').map(|(family, _)| family);
    let placed: BTreeSet<FeatureId> = layout.places.iter().map(|(f, _, _)| *f).collect();
    let families: BTreeSet<&str> = placed.iter().filter_map(|f| family(*f)).collect();
    let missing = |f: &FeatureId| {
        let of_family = family(*f).is_some_and(|name| families.contains(name));
        of_family && !placed.contains(f) && !predicted.contains(f)
    };
    let missing: Vec<FeatureId> = library.feature_ids().filter(missing).collect();
    let named = names(missing.iter().map(|f| library.feature(*f).name.as_str()));
    let first = missing.first()?;
    let message = format!("layout `{}` leaves {named} out", layout.name);
    Some(
        Diagnostic::new(Code::W0412, layout.span, message)
            .related(library.feature(*first).place, "the family")
            .help("place all of it: only what is predicted can be found absent"),
    )
}

/// Edges of the code and of the print of each feature that is placed, metres.
fn sizes(library: &Library, layouts: &[&Placed]) -> BTreeMap<FeatureId, (f64, f64)> {
    let placed: BTreeSet<FeatureId> = layouts.iter().flat_map(|l| &l.places).map(|(f, _, _)| *f).collect();
    let mut out = BTreeMap::new();
    let definite = library.rules.iter().filter(|r| r.antecedents.is_empty());
    for rule in definite.filter(|r| placed.contains(&r.consequent)) {
        if let (Ok(code), Ok(print)) = (rule.detect.length("size"), printed_edge(&rule.detect)) {
            out.entry(rule.consequent).or_insert((code, print));
        }
    }
    out
}

/// The first pair of prints of one class that lie over each other.
fn overlap(layout: &Placed, library: &Library, sizes: &BTreeMap<FeatureId, (f64, f64)>) -> Option<Diagnostic> {
    let places = &layout.places;
    let pairs = (0..places.len()).flat_map(|i| (0..i).map(move |j| (j, i)));
    let mut quiet = None;
    for (a, b) in pairs.map(|(j, i)| (&places[j], &places[i])) {
        let (Some(&(code_a, print_a)), Some(&(code_b, print_b))) = (sizes.get(&a.0), sizes.get(&b.0)) else {
            continue;
        };
        if !meet(&a.1, &b.1, print_a, print_b) || !in_one_class(library, a.0, b.0) {
            continue;
        }
        let pair = [(a.0, a.2), (b.0, b.2)];
        if meet(&a.1, &b.1, code_a, code_b) {
            return Some(report(pair, library, Severity::Error, (print_a + print_b) / 2.0));
        }
        quiet.get_or_insert_with(|| report(pair, library, Severity::Warning, (print_a + print_b) / 2.0));
    }
    quiet
}

fn in_one_class(library: &Library, a: FeatureId, b: FeatureId) -> bool {
    library.classes.iter().any(|c| c.presence.has(a) && c.presence.has(b))
}

fn report([a, b]: [(FeatureId, Span); 2], library: &Library, severity: Severity, wide: f64) -> Diagnostic {
    let [name_a, name_b] = [a, b].map(|(f, _)| &library.feature(f).name);
    let message = match severity {
        Severity::Error => format!("the prints of `{name_a}` and `{name_b}` lie over each other"),
        _ => format!("the quiet zones of `{name_a}` and `{name_b}` lie over each other"),
    };
    Diagnostic::new(Code::E0409, b.1, message)
        .severity(severity)
        .related(a.1, "the other place")
        .help(format!(
            "with their quiet zones they need {} from centre to centre",
            metres(wide)
        ))
}

/// Whether two squares of these edges in one plane have something in common.
fn meet(a: &Pose, b: &Pose, edge_a: f64, edge_b: f64) -> bool {
    let axis = |pose: &Pose, of: Vector| pose.rotation * of;
    let apart = b.translation.vector - a.translation.vector;
    let (out_a, out_b) = (axis(a, Vector::z()), axis(b, Vector::z()));
    if out_a.dot(&out_b) < PARALLEL || apart.dot(&out_a).abs() > THICK {
        return false;
    }
    // Two squares are apart where some side of one has the other beyond it.
    let reach = |pose: &Pose, edge: f64, along: &Vector| {
        let share = |of: Vector| axis(pose, of).dot(along).abs();
        edge / 2.0 * (share(Vector::x()) + share(Vector::y()))
    };
    let sides = [a, b]
        .into_iter()
        .flat_map(|p| [axis(p, Vector::x()), axis(p, Vector::y())]);
    sides
        .into_iter()
        .all(|along| apart.dot(&along).abs() < reach(a, edge_a, &along) + reach(b, edge_b, &along) - 1e-9)
}

#[cfg(test)]
mod tests {
    use super::super::testing::{codes, codes_of};
    use super::*;
    use crate::geometry::{Point, frame_facing};

    #[test]
    fn squares_meet_in_one_plane_only() {
        let at = |x: f64, z: f64, facing: Vector| frame_facing(Point::new(x, 0.0, z), facing);
        let up = at(0.0, 0.0, Vector::z());
        assert!(meet(&up, &at(0.19, 0.0, Vector::z()), 0.2, 0.2));
        assert!(!meet(&up, &at(0.21, 0.0, Vector::z()), 0.2, 0.2));
        assert!(!meet(&up, &at(0.0, 0.02, Vector::z()), 0.2, 0.2));
        assert!(!meet(&up, &at(0.0, 0.0, -Vector::z()), 0.2, 0.2));
    }

    #[test]
    fn fires_on_prints_over_each_other() {
        assert_eq!(
            codes(&[("[300 mm, 0 mm, 0 mm]", "[-250 mm, 0 mm, 0 mm]")]),
            [Code::E0409]
        );
        assert_eq!(
            codes(&[("[300 mm, 0 mm, 0 mm]", "[-50 mm, 0 mm, 0 mm]")]),
            [Code::E0409]
        );
    }

    #[test]
    fn keeps_quiet_about_places_that_no_class_uses_together() {
        let apart = [
            ("[300 mm, 0 mm, 0 mm]", "[-250 mm, 0 mm, 0 mm]"),
            ("class both { left, right }", ""),
            ("as both", "as one"),
        ];
        assert!(!codes(&apart).contains(&Code::E0409));
        assert_eq!(codes(&[("[300 mm, 0 mm, 0 mm]", "[0 mm, 0 mm, 0 mm]")]), []);
    }

    #[test]
    fn fires_on_a_code_that_is_left_out() {
        let text = include_str!("../../../examples/tanks/tanks.vpl");
        let line = "    code[7] at [-220 mm, 305 mm, 178 mm]  facing +y    // left skirt, rear half\n";
        assert!(text.contains(line));
        let all = codes_of(&text.replace(line, ""));
        assert!(all.contains(&Code::W0412), "{all:?}");
        assert_eq!(codes_of(text), []);
    }
}
