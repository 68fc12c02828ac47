//! Faces that several markers of one layout predict: a layout is rigid, so that all of
//! them must say the same place.
//!
//! Only constant places of a class that has all of it are judged. What most markers say
//! is taken for right.

use std::collections::BTreeMap;

use super::names;
use super::space::metres;
use crate::geometry::{Point, Polygon, Pose, Vector, axis_word};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::lower::Placed;
use crate::predict;
use crate::primitives::{Arguments, Datum};
use crate::rules::{Call, Expr, FeatureId, Library, Rule, Value};

/// What two measurements on a drawing may differ by, metres.
const APART: f64 = 0.01;

pub(super) fn check(library: &Library, layouts: &[Option<Placed>]) -> Vec<Diagnostic> {
    let layouts = layouts.iter().flatten();
    layouts.flat_map(|layout| of_layout(library, layout)).collect()
}

/// A rule and the face that it predicts in the frame of the layout.
struct Said<'a> {
    rule: &'a Rule,
    marker: FeatureId,
    face: Polygon,
}

fn of_layout(library: &Library, layout: &Placed) -> Vec<Diagnostic> {
    let mut faces: BTreeMap<FeatureId, Vec<Said<'_>>> = BTreeMap::new();
    for rule in library.rules.iter().filter(|r| !library.feature(r.consequent).many) {
        let Some((marker, face)) = by_marker(rule, layout) else {
            continue;
        };
        let of_face = faces.entry(rule.consequent).or_default();
        if of_face.iter().all(|said| said.marker != marker) {
            of_face.push(Said { rule, marker, face });
        }
    }
    faces.values().flat_map(|said| odd(library, layout, said)).collect()
}

/// The face that a rule predicts by one marker of a layout alone.
fn by_marker(rule: &Rule, layout: &Placed) -> Option<(FeatureId, Polygon)> {
    let call = rule.predict.as_ref().filter(|p| p.primitive == "rectangle_by_marker")?;
    let marker = match call.arguments.get("marker")? {
        Expr::Attribute { feature, name } if name == "pose" && rule.antecedents == [*feature] => *feature,
        _ => return None,
    };
    let (_, pose, _) = layout.places.iter().find(|(feature, ..)| *feature == marker)?;
    let prediction = predict::predict(&call.primitive, &arguments(call, *pose)?).ok()??;
    Some((marker, prediction.polygons.into_iter().next()?))
}

/// The arguments of a prediction whose marker was found at `pose`; `None` where one is
/// no constant.
fn arguments(call: &Call, pose: Pose) -> Option<Arguments> {
    let known = |(name, value): (&String, &Expr)| match value {
        _ if name == "marker" => Some((name.clone(), Datum::Constant(Value::Pose(pose)))),
        Expr::Value(value) => Some((name.clone(), Datum::Constant(value.clone()))),
        _ => None,
    };
    call.arguments.iter().map(known).collect::<Option<_>>().map(Arguments)
}

/// The predictions of a face that are not where most are.
fn odd(library: &Library, layout: &Placed, said: &[Said<'_>]) -> Vec<Diagnostic> {
    let agree = |a: &Said<'_>| said.iter().filter(|b| same(&a.face, &b.face)).count();
    // The first of those that most agree with.
    let Some(usual) = said.iter().rev().max_by_key(|a| agree(a)) else {
        return Vec::new();
    };
    let (most, others): (Vec<&Said<'_>>, Vec<_>) = said.iter().partition(|s| same(&s.face, &usual.face));
    let contradicted = |odd: &Said<'_>| {
        let beside = most.iter().find(|s| in_one_class(library, odd, s))?;
        Some(contradiction(library, layout, odd, beside))
    };
    others.into_iter().filter_map(contradicted).collect()
}

/// Whether corners lie on corners, and the faces look the same way.
fn same(a: &Polygon, b: &Polygon) -> bool {
    let beside = |p: &Point| b.vertices().iter().any(|q| (p - q).norm() <= APART);
    a.normal().dot(&b.normal()) > 0.0 && a.vertices().iter().all(beside)
}

fn in_one_class(library: &Library, a: &Said<'_>, b: &Said<'_>) -> bool {
    let all = [a.marker, b.marker, a.rule.consequent];
    let mut classes = library.classes.iter();
    classes.any(|class| all.iter().all(|f| class.presence.has(*f)))
}

fn contradiction(library: &Library, layout: &Placed, odd: &Said<'_>, usual: &Said<'_>) -> Diagnostic {
    let name = |id: FeatureId| library.feature(id).name.as_str();
    let message = format!(
        "{} predict `{}` at two different places, and layout `{}` ties them together",
        names([name(odd.marker), name(usual.marker)]),
        name(odd.rule.consequent),
        layout.name
    );
    Diagnostic::new(Code::E0407, odd.rule.place, message)
        .label(format!("by `{}` {}", name(odd.marker), place(&odd.face)))
        .related(
            usual.rule.place,
            format!("by `{}` {}", name(usual.marker), place(&usual.face)),
        )
        .related(layout.span, "both in the axes of this layout")
        .help("`at` and `facing` are in the axes of the marker: x right and y up on the print, z out of it")
}

/// Where a face is and which way it looks.
fn place(face: &Polygon) -> String {
    let at = face.centre();
    let at = [at.x, at.y, at.z].map(|x| metres((x * 1e4).round() / 1e4 + 0.0));
    format!(
        "its middle is at [{}], facing {}",
        at.join(", "),
        direction(&face.normal())
    )
}

fn direction(v: &Vector) -> String {
    axis_word(v).map_or_else(|| format!("[{:.2}, {:.2}, {:.2}]", v.x, v.y, v.z), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::super::testing::codes;
    use crate::lang::Code;

    /// Two markers on the front and the left of a box, and a lid that both predict.
    fn lid_by(left: &str, right: &str, class: &str) -> Vec<Code> {
        let rule = |marker: &str, at: &str| {
            format!(
                "rule {marker} -> lid {{\n detect planar_region(colour: red)\n measure outline()\n
                 predict rectangle_by_marker({marker}.pose, at: {at}, facing: +y, width: 300 mm, height: 300 mm)\n }}\n"
            )
        };
        let rules = format!(
            "feature lid : polygon\n {}{} rule -> lid {{\n detect planar_region(colour: red)\n measure outline()\n }}\n
             class both {{",
            rule("left", left),
            rule("right", right)
        );
        codes(&[
            ("class both {", &rules),
            ("class both { left, right }", &format!("class both {{ {class} }}")),
            (
                "left at [-300 mm, 0 mm, 0 mm] facing +z",
                "left at [151 mm, 0 mm, 0 mm] facing +x",
            ),
            (
                "right at [300 mm, 0 mm, 0 mm] facing +z",
                "right at [0 mm, 151 mm, 0 mm] facing +y",
            ),
        ])
    }

    #[test]
    fn fires_on_a_sign_that_is_flipped() {
        let found = lid_by("[0 mm, 100 mm, -151 mm]", "[0 mm, 100 mm, 151 mm]", "left, right, lid");
        assert!(found.contains(&Code::E0407), "{found:?}");
    }

    #[test]
    fn keeps_quiet_where_both_say_one_place_or_no_class_has_both() {
        let found = lid_by("[0 mm, 100 mm, -151 mm]", "[2 mm, 100 mm, -149 mm]", "left, right, lid");
        assert!(!found.contains(&Code::E0407), "{found:?}");
        let found = lid_by("[0 mm, 100 mm, -151 mm]", "[0 mm, 100 mm, 151 mm]", "left, lid");
        assert!(!found.contains(&Code::E0407), "{found:?}");
    }
}
