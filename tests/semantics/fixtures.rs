//! Libraries and tasks in code, as the compiler would write them.

use vpl::geometry::{Camera, DepthRange, Intrinsics, Point, Polygon, Vector};
use vpl::rules::{
    Call, Class, Each, Expr, Feature, FeatureId, FeatureKind, Goal, Insertion, Inspected, Library, Place, Presence,
    Rule, SensorModel, Space, Task, Thresholds, Value, Visibility,
};

pub fn call<const N: usize>(primitive: &str, arguments: [(&str, Expr); N]) -> Call {
    Call {
        primitive: primitive.to_owned(),
        arguments: arguments.into_iter().map(|(n, e)| (n.to_owned(), e)).collect(),
    }
}

pub fn length(metres: f64) -> Expr {
    Expr::Value(Value::Length(metres))
}

pub fn degrees(angle: f64) -> Expr {
    Expr::Value(Value::Angle(angle.to_radians()))
}

pub fn text(text: &str) -> Expr {
    Expr::Value(Value::Text(text.to_owned()))
}

pub fn attribute(feature: u32, name: &str) -> Expr {
    Expr::Attribute {
        feature: FeatureId(feature),
        name: name.to_owned(),
    }
}

pub fn or(first: Expr, second: Expr) -> Expr {
    Expr::Else(Box::new(first), Box::new(second))
}

pub fn variable(name: &str) -> Expr {
    Expr::Variable(name.to_owned())
}

pub fn feature(name: &str, kind: FeatureKind, many: bool) -> Feature {
    Feature {
        name: name.to_owned(),
        kind,
        many,
        place: Place::default(),
    }
}

/// Classes of equal priors from rows like `tk1 1010111`.
pub fn classes(rows: &[&str]) -> Vec<Class> {
    let class = |row: &&str| {
        let (name, presence) = row.split_once(' ').unwrap();
        Class {
            name: name.to_owned(),
            prior: 1.0 / rows.len() as f64,
            presence: Presence::try_from(presence.trim().to_owned()).unwrap(),
            place: Place::default(),
        }
    };
    rows.iter().map(class).collect()
}

pub fn rule(antecedents: &[u32], consequent: u32, detect: Call, measure: Call, predict: Option<Call>) -> Rule {
    Rule {
        id: String::new(),
        antecedents: antecedents.iter().copied().map(FeatureId).collect(),
        consequent: FeatureId(consequent),
        each: Vec::new(),
        detect,
        measure,
        predict,
        place: Place::default(),
    }
}

pub fn for_each_edge_of(feature: u32, mut rule: Rule) -> Rule {
    rule.each.push(Each {
        variable: "edge".to_owned(),
        feature: FeatureId(feature),
        attribute: "edges".to_owned(),
    });
    rule
}

pub fn library(features: Vec<Feature>, classes: Vec<Class>, mut rules: Vec<Rule>) -> Library {
    for (k, rule) in rules.iter_mut().enumerate() {
        rule.id = format!("r{}", k + 1);
    }
    Library {
        name: "library".to_owned(),
        features,
        classes,
        rules,
        place: Place::default(),
    }
}

/// A camera of 3600 × 3600 pixels over 90°: 1800 pixels a metre at 1 m.
pub fn camera() -> Camera {
    let image = Intrinsics::with_fields_of_view(3600, 3600, 90_f64.to_radians(), 90_f64.to_radians());
    Camera {
        depth: image,
        colour: image,
        range: DepthRange { min: 0.5, max: 100.0 },
    }
}

/// ξ = 0.4 m (under half a voxel: only points in the voxel itself), no gain
/// floor, goal (1, 0), GN.
pub fn task() -> Task {
    Task {
        name: "task".to_owned(),
        library: "library".to_owned(),
        goal: Goal {
            confident: true,
            exhausted: false,
        },
        camera: camera(),
        space: Space {
            centre: Point::new(2.0, 2.0, 0.5),
            size: Vector::new(4.0, 4.0, 1.0),
            voxel: 1.0,
        },
        views: call("fibonacci_sphere", []),
        thresholds: Thresholds {
            near: 0.4,
            absent: 0.99,
            confidence: 0.99,
        },
        overlap: 0.2,
        method: "gn".to_owned(),
        limit: 20,
        gain_floor: 1,
        inspected: Inspected::Observed,
        visibility: Visibility::Exact,
        verify: false,
        insertion: Insertion::default(),
        sensor_model: SensorModel::default(),
        place: Place::default(),
    }
}

/// A face found by a plain definite rule, told apart by colour in real life.
pub fn definite(consequent: u32) -> Rule {
    let detect = call("planar_region", [("smallest", length(0.04))]);
    rule(&[], consequent, detect, call("outline", []), None)
}

/// `from` → `to`: a rectangle of a height on the first edge, at a right angle.
pub fn on_base(from: u32, to: u32, height: f64) -> Rule {
    let predict = call(
        "rectangle_on",
        [
            ("on", attribute(from, "base")),
            ("dihedral", degrees(90.0)),
            ("height", length(height)),
        ],
    );
    let detect = call("planar_region", [("smallest", length(0.04))]);
    rule(&[from], to, detect, call("outline", []), Some(predict))
}

/// A face that makes [`on_base`] predict the upright rectangle x = `x`, y from
/// `y0` to `y1`, z from `z` up, that faces +x: it lies at height z, faces down,
/// and its first edge runs from (x, y1, z) to (x, y0, z).
pub fn foot(x: f64, y0: f64, y1: f64, z: f64) -> Polygon {
    let corners = [(x, y1), (x, y0), (x - 1.0, y0), (x - 1.0, y1)];
    let face = Polygon::new(corners.map(|(x, y)| Point::new(x, y, z)).to_vec()).unwrap();
    assert!((face.normal() + Vector::z()).norm() < 1e-12);
    face
}
