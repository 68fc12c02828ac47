//! Instances: keys, joining, edges, several predictions of one instance.
//!
//! The space is 4 × 4 × 4 m. The base is the square x, y 1…3 at z = 0.9, facing
//! down; rules along its edges predict upright sides of 1.5 m.

use super::fixtures::{
    attribute, call, classes, definite, degrees, feature, for_each_edge_of, length, library, or, rule, task, variable,
};
use super::trial::{Seen, Trial};
use super::world::MicroWorld;
use vpl::geometry::{Edge, Point, Polygon, Vector};
use vpl::map::Occupancy;
use vpl::plan::features::FeatureStatus;
use vpl::rules::{Expr, FeatureId, FeatureKind, Library, Rule, Value};

fn unknown() -> MicroWorld {
    MicroWorld::of([4, 4, 4], vec![Occupancy::Unknown; 64])
}

/// The base with corners at `low` and `high` along x and y, its first edge
/// along +y at x = `low`.
fn base(low: f64, high: f64) -> Polygon {
    let corners = [(low, low), (low, high), (high, high), (high, low)];
    let face = Polygon::new(corners.map(|(x, y)| Point::new(x, y, 0.9)).to_vec()).unwrap();
    assert!((face.normal() + Vector::z()).norm() < 1e-12);
    face
}

/// The upright face on an edge of the base, as high as said.
fn side(edge: &Edge, height: f64) -> Polygon {
    let up = Vector::z() * height;
    Polygon::new(vec![edge.end, edge.start, edge.start + up, edge.end + up]).unwrap()
}

fn upright(default: f64) -> Rule {
    let height = or(attribute(1, "height"), length(default));
    let predict = call(
        "rectangle_on",
        [
            ("on", variable("edge")),
            ("dihedral", degrees(90.0)),
            ("height", height),
        ],
    );
    let detect = call(
        "plane_beside",
        [
            ("edge", variable("edge")),
            ("dihedral", degrees(90.0)),
            ("within", degrees(10.0)),
        ],
    );
    let measure = call("outline", [("first", variable("edge"))]);
    for_each_edge_of(0, rule(&[0], 1, detect, measure, Some(predict)))
}

fn under() -> Rule {
    let facing = Expr::Value(Value::Direction(-Vector::z()));
    let predict = call(
        "completed_square",
        [("edges", Expr::List(vec![attribute(1, "base")])), ("facing", facing)],
    );
    let detect = call("planar_region", [("smallest", length(0.04))]);
    rule(&[1], 0, detect, call("outline", []), Some(predict))
}

/// base, and sides without number on its edges.
fn sided() -> Library {
    let features = vec![
        feature("base", FeatureKind::Polygon, false),
        feature("side", FeatureKind::Polygon, true),
    ];
    let rules = vec![definite(0), definite(1), upright(1.5), under()];
    library(features, classes(&["with 11", "without 10"]), rules)
}

fn looked(seen: &[Seen]) -> Trial {
    let mut trial = Trial::new(sided(), task(), &[[9.5, 1.6, 2.1], [-5.5, 1.5, 2.1], [2.1, 9.5, 2.0]]);
    for (view, seen) in seen.iter().enumerate() {
        trial.look(view, &unknown(), seen);
        trial.agree(&unknown(), &[], &[]);
    }
    trial
}

fn sides(trial: &Trial) -> &FeatureStatus {
    trial.status.feature(FeatureId(1))
}

fn keys(trial: &Trial) -> (Vec<&str>, Vec<&str>) {
    let found = sides(trial).found.iter().map(|f| f.key.as_str()).collect();
    (found, sides(trial).predicted.keys().map(String::as_str).collect())
}

#[test]
fn every_edge_of_the_base_predicts_a_side() {
    let trial = looked(&[Seen::face(0, base(1.0, 3.0))]);
    let all = ["base.1/edge.1", "base.1/edge.2", "base.1/edge.3", "base.1/edge.4"];
    assert_eq!(keys(&trial), (vec![], all.to_vec()));
    // z from 0.9 to 2.4: layers 0, 1 and 2 over two or three columns.
    assert!(sides(&trial).predicted.values().all(|p| p.voxels.len() >= 6));
}

#[test]
fn a_side_found_plainly_gets_the_key_of_its_edge_once_the_base_is_known() {
    let third = side(&base(1.0, 3.0).edge(2), 1.2);
    let mut trial = looked(&[Seen::face(1, third)]);
    assert_eq!(keys(&trial), (vec!["1"], vec![]));
    trial.look(1, &unknown(), &Seen::face(0, base(1.0, 3.0)));
    assert_eq!(
        keys(&trial),
        (
            vec!["base.1/edge.3"],
            vec!["base.1/edge.1", "base.1/edge.2", "base.1/edge.4"]
        )
    );
}

#[test]
fn a_side_found_beside_an_edge_joins_the_same_face_found_plainly() {
    let third = side(&base(1.0, 3.0).edge(2), 1.2);
    let mut seen = Seen::faces(vec![(0, base(1.0, 3.0)), (1, third.clone())]);
    seen.beside.push(("r3", third));
    let trial = looked(&[seen]);
    assert_eq!(keys(&trial).0, ["base.1/edge.3"]);
    assert_eq!(trial.state(1), 1);
}

#[test]
fn the_first_sides_height_is_that_of_the_others_and_they_weigh_nothing() {
    let first = side(&base(1.0, 3.0).edge(0), 0.7);
    let trial = looked(&[Seen::face(0, base(1.0, 3.0)), Seen::face(1, first)]);
    assert_eq!(keys(&trial).0, ["base.1/edge.1"]);
    for predicted in sides(&trial).predicted.values() {
        let heights = predicted.polygons[0].vertices().iter().map(|v| v.z);
        assert!((heights.fold(0.0, f64::max) - 1.6).abs() < 1e-9);
    }
    // es = 1 at the first instance; the further ones are kept without the mark.
    assert_eq!(
        (
            sides(&trial).predicted.len(),
            trial.is_predicted(1),
            trial.status.weights[1]
        ),
        (3, false, 0.0)
    );
}

#[test]
fn predictions_stay_put_until_an_antecedent_moves_by_half_a_voxel() {
    let tags = |t: &Trial| sides(t).predicted.values().map(|p| p.tag).collect::<Vec<_>>();
    let mut trial = looked(&[Seen::face(0, base(1.0, 3.0))]);
    let before = tags(&trial);
    trial.look(1, &unknown(), &Seen::face(0, base(1.0, 3.3)));
    assert_eq!(tags(&trial), before);
    trial.look(2, &unknown(), &Seen::face(0, base(1.0, 3.6)));
    assert_eq!(keys(&trial).1.len(), 4);
    // Edge 1 runs from (1,1) to (1,3.6) now: all four changed.
    assert!(tags(&trial).iter().all(|t| !before.contains(t)));
    let reach = sides(&trial).predicted["base.1/edge.2"].polygons[0].vertices()[0].x;
    assert!((reach - 3.6).abs() < 1e-9);
}

#[test]
fn keys_do_not_outlive_the_edges_they_name() {
    let seen = |low: f64, high: f64, turn: usize, edge: usize| {
        let base = base(low, high).beginning_at(turn);
        let mut seen = Seen::face(0, base.clone());
        seen.beside.push(("r3", side(&base.edge(edge), 1.2)));
        seen
    };
    let mut trial = looked(&[seen(1.0, 3.0, 0, 0)]);
    assert_eq!(keys(&trial).0, ["base.1/edge.1"]);
    // Larger, and its edges numbered from another corner: the old edge 1 is
    // edge 4 now, and the side along it is known by that.
    trial.look(1, &unknown(), &Seen::face(0, base(1.0, 3.6).beginning_at(1)));
    assert_eq!(
        keys(&trial),
        (
            vec!["base.1/edge.4"],
            vec!["base.1/edge.1", "base.1/edge.2", "base.1/edge.3"]
        )
    );
}

#[test]
fn of_several_sides_the_one_nearest_to_its_size_predicts_the_base() {
    // A low and a high side on opposite edges: centres 0.35 and 0.75 m above
    // the base's plane and both 1 m beside its centre, sizes √(2·0.7) and
    // √(2·1.5): levers 1.06/1.18 = 0.90 and 1.25/1.73 = 0.72.
    let face = base(1.0, 3.0);
    let (low, high) = (side(&face.edge(0), 0.7), side(&face.edge(2), 1.5));
    let trial = looked(&[Seen::faces(vec![(1, low), (1, high)])]);
    assert_eq!((trial.state(0), trial.is_predicted(0)), (2, true));
    let predicted = trial.predicted(0);
    assert_eq!(predicted.by, ["r4"]);
    // The square on the high side's foot, x = 3: it begins there.
    let starts = predicted.polygons[0]
        .vertices()
        .iter()
        .filter(|v| (v.x - 3.0).abs() < 1e-9);
    assert_eq!(starts.count(), 2);
}

#[test]
fn one_instance_keeps_the_detection_it_had_when_another_has_no_more_evidence() {
    let elsewhere = base(0.1, 0.9);
    let trial = looked(&[Seen::face(0, base(1.0, 3.0)), Seen::face(0, elsewhere)]);
    let found = &trial.status.feature(FeatureId(0)).found;
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].key, "1");
    let vpl::detect::Measurement::Face(face) = &found[0].measurement else {
        panic!("a base is a face");
    };
    assert!((face.area() - 4.0).abs() < 1e-9);
}

#[test]
fn what_lies_outside_the_space_is_no_prediction() {
    let trial = looked(&[Seen::face(0, base(10.0, 12.0))]);
    assert_eq!(
        (trial.state(1), trial.is_predicted(1), keys(&trial).1.len()),
        (-1, false, 0)
    );
}
