//! The reference page of the primitives, written from their declarations.

use std::fmt::Write as _;

use super::{Default, Parameter, Primitive, Type, all};
use crate::rules::Value;

const SECTIONS: [(Type, &str); 10] = [
    (Type::Detector, "Detectors"),
    (Type::Measure, "Measures"),
    (Type::Predictor, "Predictors"),
    (Type::Point, "Points"),
    (Type::Polygon, "Faces"),
    (Type::Edge, "Edges"),
    (Type::Views, "Candidate views"),
    (Type::Camera, "Cameras"),
    (Type::Shape, "Shapes of a scene"),
    (Type::Deformation, "Deformations of a shape"),
];

/// The page in Markdown.
pub fn reference() -> String {
    let mut page = String::from(
        "# Primitives\n\nWhat the language knows by itself; `stdlib/` builds on it. Written from the\n\
         declarations by `cargo run --release --example primitives > docs/primitives.md`.\n",
    );
    for (result, title) in SECTIONS {
        let _ = write!(page, "\n## {title}\n");
        for primitive in all().filter(|p| p.result == result) {
            entry(&mut page, primitive);
        }
    }
    page
}

fn entry(page: &mut String, primitive: &Primitive) {
    let parameters: Vec<String> = primitive.parameters.iter().map(signature).collect();
    let _ = write!(
        page,
        "\n### `{}({})`\n\n{}\n",
        primitive.name,
        parameters.join(", "),
        primitive.doc
    );
    if !primitive.parameters.is_empty() {
        page.push('\n');
    }
    for parameter in primitive.parameters {
        let _ = writeln!(page, "- `{}`: {}", parameter.name, parameter.doc);
    }
}

/// `size: length`, `share: share = 80 %`, `colour: colour?`.
pub fn signature(parameter: &Parameter) -> String {
    let (name, ty) = (parameter.name, written(parameter.ty));
    match parameter.default {
        Default::Required => format!("{name}: {ty}"),
        Default::Absent => format!("{name}: {ty}?"),
        Default::Value(value) => format!("{name}: {ty} = {}", constant(&value())),
    }
}

/// A type as parameter lists write it.
pub fn written(ty: Type) -> String {
    match ty {
        Type::Choice(words) => words.join(" | "),
        Type::List(of) => format!("[{}]", written(*of)),
        other => format!("{other:?}").to_lowercase(),
    }
}

fn constant(value: &Value) -> String {
    match value {
        Value::Length(x) => format!("{} mm", round(x * 1000.0)),
        Value::Angle(x) => format!("{} deg", round(x.to_degrees())),
        Value::Share(x) => format!("{} %", round(x * 100.0)),
        Value::Time(x) => format!("{} s", round(*x)),
        Value::Number(x) => round(*x).to_string(),
        Value::Count(n) => n.to_string(),
        Value::Colour(c) => c.to_string(),
        Value::Text(t) => format!("\"{t}\""),
        Value::Choice(word) => word.clone(),
        Value::Direction(v) => format!("[{}, {}, {}]", v.x, v.y, v.z),
        Value::Point(p) => format!("[{} m, {} m, {} m]", p.x, p.y, p.z),
        Value::Pose(_) => "a pose".to_owned(),
    }
}

fn round(x: f64) -> f64 {
    (x * 1e6).round() / 1e6
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_primitive_is_on_the_page_that_the_docs_hold() {
        let page = reference();
        for primitive in all() {
            assert!(
                page.contains(&format!("### `{}(", primitive.name)),
                "`{}`",
                primitive.name
            );
        }
        let held = include_str!("../../docs/primitives.md");
        let stale = held.lines().zip(page.lines()).find(|(held, page)| held != page);
        assert!(
            held == page,
            "docs/primitives.md is stale, its first lines name the command: {stale:?}"
        );
    }
}
