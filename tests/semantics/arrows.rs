//! Every arrow of Fig. 6, worked by hand from eqs. 1 to 7.

use super::fixtures::{
    attribute, call, classes, definite, degrees, feature, foot, length, library, on_base, rule, task,
};
use super::trial::{Seen, Trial};
use super::world::MicroWorld;
use super::worlds::{FRONT, agree, base, pair};
use vpl::geometry::Polygon;
use vpl::plan::completion::{confident, likeliest};
use vpl::rules::{Expr, FeatureId, FeatureKind, Library, Value};

const BACK: [f64; 3] = [-5.5, 1.5, 0.5];
const UNKNOWN: &str = "
    ????
    ????
    ????
    ????";
/// The predicted place (2,0…2) measured free.
const EMPTY: &str = "
    ??..
    ??..
    ??..
    ????";

fn polygon(name: &str) -> vpl::rules::Feature {
    feature(name, FeatureKind::Polygon, false)
}

/// base, side and lid; the side on the base, the lid nowhere predicted.
fn three(rows: &[&str]) -> Library {
    let features = vec![polygon("base"), polygon("side"), polygon("lid")];
    let rules = vec![definite(0), definite(1), definite(2), on_base(0, 1, 0.6)];
    library(features, classes(rows), rules)
}

fn lid() -> Polygon {
    foot(2.5, 0.2, 2.8, 0.8)
}

fn looked(library: Library, drawing: &str, eyes: &[[f64; 3]], seen: &Seen) -> Trial {
    let world = MicroWorld::parse(drawing);
    let mut trial = Trial::new(library, task(), eyes);
    trial.look(0, &world, seen);
    agree(&trial, &world);
    trial
}

#[test]
fn from_unknown_to_detected() {
    let trial = looked(pair(), UNKNOWN, &[BACK, FRONT], &base());
    assert_eq!((trial.state(0), trial.state(1)), (1, -1));
    assert_eq!(trial.status.posterior, [0.5, 0.5]);
}

#[test]
fn the_mark_predicted_comes_with_unknown() {
    let before = looked(pair(), UNKNOWN, &[BACK, FRONT], &Seen::nothing());
    assert_eq!((before.state(1), before.is_predicted(1)), (-1, false));
    let after = looked(pair(), UNKNOWN, &[BACK, FRONT], &base());
    assert_eq!((after.state(1), after.is_predicted(1)), (-1, true));
}

#[test]
fn from_unknown_to_present_and_excluded_by_the_classes_left() {
    // The lid is only in `a` (1 1 1): the side must exist. In `b` (1 0 0) it
    // would not; `c` (1 1 0) goes with `b`.
    let library = three(&["a 111", "b 100", "c 110"]);
    let trial = looked(library.clone(), UNKNOWN, &[BACK, FRONT], &Seen::face(2, lid()));
    assert_eq!((trial.state(0), trial.state(1), trial.state(2)), (2, 2, 1));
    // No state is −1: what must exist weighs 1.
    assert_eq!(trial.status.weights, [1.0, 1.0, 0.0]);
    // The side absent leaves only `b`: the lid is excluded.
    let trial = looked(library, EMPTY, &[FRONT, BACK], &base());
    assert_eq!((trial.state(1), trial.state(2)), (0, 3));
    assert_eq!(trial.status.posterior, [0.0, 1.0, 0.0]);
}

#[test]
fn the_mark_predicted_comes_with_present_and_goes_with_detected() {
    let library = three(&["a 111", "b 100", "c 110"]);
    let both = Seen::faces(vec![(0, foot(2.5, 0.2, 2.8, 0.2)), (2, lid())]);
    let mut trial = looked(library, UNKNOWN, &[BACK, FRONT], &both);
    assert_eq!((trial.state(1), trial.is_predicted(1)), (2, true));
    // 2 → 1.
    let world = MicroWorld::parse(UNKNOWN);
    trial.look(1, &world, &Seen::face(1, lid()));
    assert_eq!((trial.state(1), trial.is_predicted(1)), (1, false));
    assert!(trial.status.contradiction.is_none());
}

#[test]
fn from_unknown_to_absent_by_inspection() {
    let trial = looked(pair(), EMPTY, &[FRONT, BACK], &base());
    assert_eq!((trial.state(1), trial.is_predicted(1)), (0, false));
    assert_eq!(trial.status.posterior, [0.0, 1.0]);
    assert!(confident(&trial.status, &trial.knowledge));
    assert_eq!(likeliest(&trial.status.posterior), (1, 1.0));
}

#[test]
fn a_share_just_below_the_threshold_leaves_it_unknown() {
    // Two of three voxels: 66.7 %.
    let drawing = "
        ??..
        ??..
        ????
        ????";
    let trial = looked(pair(), drawing, &[FRONT, BACK], &base());
    assert_eq!((trial.state(1), trial.is_predicted(1)), (-1, true));
    let mut lenient = task();
    lenient.thresholds.absent = 0.66;
    let mut trial = Trial::new(pair(), lenient, &[FRONT, BACK]);
    trial.look(0, &MicroWorld::parse(drawing), &base());
    assert_eq!(trial.state(1), 0);
}

#[test]
fn from_present_to_absent_contradicts_the_library() {
    // Every class has the side, a definite rule could have found it, and its
    // place is empty.
    let library = three(&["a 110", "b 111"]);
    let trial = looked(library, EMPTY, &[FRONT, BACK], &base());
    assert_eq!(trial.state(1), 0);
    let contradiction = trial.status.contradiction.as_ref().unwrap();
    assert_eq!(contradiction.feature, FeatureId(1));
    assert!(
        contradiction.evidence.starts_with("3 of the 3 voxels"),
        "{}",
        contradiction.evidence
    );
    assert_eq!(trial.status.posterior, [0.0, 0.0]);
    assert!(!confident(&trial.status, &trial.knowledge));
}

#[test]
fn detections_that_no_class_combines_are_a_contradiction() {
    // Side and lid exclude each other.
    let library = three(&["a 110", "b 101"]);
    let seen = Seen::faces(vec![(0, foot(2.5, 0.2, 2.8, 0.2)), (1, lid()), (2, lid())]);
    let trial = looked(library, UNKNOWN, &[BACK, FRONT], &seen);
    assert_eq!(trial.status.contradiction.as_ref().unwrap().feature, FeatureId(2));
}

#[test]
fn final_states_stay() {
    // The side is absent; what looks like one later is not taken for it.
    let library = three(&["a 111", "b 100", "c 110"]);
    let mut trial = looked(library, EMPTY, &[FRONT, BACK], &base());
    trial.look(1, &MicroWorld::parse(EMPTY), &Seen::faces(vec![(1, lid()), (2, lid())]));
    assert_eq!((trial.state(1), trial.state(2)), (0, 3));
    assert!(trial.status.contradiction.is_none());
}

#[test]
fn exclusion_runs_to_a_fixed_point_within_one_measurement() {
    // side absent → `with` goes → lid (only in `with`) is 3, foot must exist.
    let features = vec![polygon("base"), polygon("side"), polygon("lid"), polygon("plinth")];
    let rules = vec![definite(0), definite(1), definite(2), definite(3), on_base(0, 1, 0.6)];
    let library = library(features, classes(&["with 1110", "without 1001"]), rules);
    let trial = looked(library, EMPTY, &[FRONT, BACK], &base());
    assert_eq!([0, 1, 2, 3].map(|f| trial.state(f)), [1, 0, 3, 2]);
}

/// base → box, a shell over the base; `detect` is the share that proves it.
fn boxed(rows: &[&str]) -> Library {
    let shell = rule(
        &[0],
        1,
        call("mostly_seen", [("share", Expr::Value(Value::Share(0.5)))]),
        call("rough_shape", []),
        Some(call(
            "rectangle_on",
            [
                ("on", attribute(0, "base")),
                ("dihedral", degrees(90.0)),
                ("height", length(0.6)),
            ],
        )),
    );
    let features = vec![polygon("base"), feature("box", FeatureKind::Shell, false)];
    library(features, classes(rows), vec![definite(0), shell])
}

#[test]
fn a_shell_is_proven_by_its_measured_surface() {
    // Two of three predicted voxels hold a point: 67 % of at least 50 %.
    let drawing = "
        ??#.
        ??#.
        ????
        ????";
    let trial = looked(boxed(&["with 11", "without 10"]), drawing, &[FRONT, BACK], &base());
    assert_eq!(trial.state(1), 1);
    assert_eq!(trial.status.posterior, [1.0, 0.0]);
}

#[test]
fn an_inspected_shell_is_absent_only_if_it_need_not_exist() {
    let open = looked(boxed(&["with 11", "without 10"]), EMPTY, &[FRONT, BACK], &base());
    assert_eq!(open.state(1), 0);
    // In state 2 it stays, weighs nothing, and keeps its share for the log.
    let must = looked(boxed(&["only 11"]), EMPTY, &[FRONT, BACK], &base());
    assert_eq!((must.state(1), must.is_predicted(1)), (2, true));
    assert_eq!(must.status.weights[1], 0.0);
    assert_eq!(must.predicted(1).share(), 1.0);
    assert!(must.status.contradiction.is_none());
}

#[test]
fn verification_waits_for_the_winners_predicted_features() {
    let drawing = "
        ??..
        ????
        ????
        ????";
    let mut verifying = task();
    verifying.verify = true;
    let library = three(&["only 110"]);
    let mut trial = Trial::new(library, verifying, &[FRONT, BACK]);
    trial.look(0, &MicroWorld::parse(drawing), &base());
    assert!(!confident(&trial.status, &trial.knowledge));
    trial.look(1, &MicroWorld::parse(drawing), &Seen::face(1, lid()));
    assert!(confident(&trial.status, &trial.knowledge));
}

#[test]
fn what_must_exist_weighs_half_of_the_least_open_feature() {
    // side ∈ {a}, lid ∈ {a, b, c} of four classes, base in all: once the base
    // is detected, H(side) = H(¼) = 0.8113 = H(lid); plinth is in all: state 2.
    let features = vec![polygon("base"), polygon("side"), polygon("lid"), polygon("plinth")];
    let rules = vec![definite(0), definite(1), definite(2), definite(3)];
    let library = library(features, classes(&["a 1111", "b 1011", "c 1011", "d 1001"]), rules);
    let trial = looked(library, UNKNOWN, &[BACK, FRONT], &base());
    assert_eq!([0, 1, 2, 3].map(|f| trial.state(f)), [1, -1, -1, 2]);
    assert!((trial.status.weights[1] - 0.811_278).abs() < 1e-6);
    assert!((trial.status.weights[2] - 0.811_278).abs() < 1e-6);
    assert!((trial.status.weights[3] - 0.405_639).abs() < 1e-6);
}
