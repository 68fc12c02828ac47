//! Methods beside GN and GNO: what each prefers where GN prefers something else.
//!
//! A space of 6 × 6 × 1 unknown voxels with codes of 2 m on three of its faces.
//! Code 1 is seen from the start and says where all the others must be.

use vpl::detect::Measurement;
use vpl::geometry::{Point, Pose, Vector, frame_facing};
use vpl::rules::{Class, FeatureKind, Library};

use super::fixtures::{classes, feature, task};
use super::tanks::codes;
use super::trial::{Seen, Trial};
use super::world::MicroWorld;

const START: [f64; 3] = [-1.5, 1.5, 0.5];
const LEFT: [f64; 3] = [-6.5, 4.0, 0.5];
const LEFT_TOO: [f64; 3] = [-7.5, 3.5, 0.5];
const RIGHT: [f64; 3] = [12.5, 3.0, 0.5];
const FAR: [f64; 3] = [3.0, 12.5, 0.5];
/// Sees the right face and the far one.
const BOTH: [f64; 3] = [16.0, 16.0, 0.5];

const UNKNOWN: &str = "??????\n??????\n??????\n??????\n??????\n??????";

fn left() -> Pose {
    frame_facing(Point::new(0.5, 4.0, 0.5), -Vector::x())
}

fn right() -> Pose {
    frame_facing(Point::new(5.5, 3.0, 0.5), Vector::x())
}

fn far() -> Pose {
    frame_facing(Point::new(3.0, 5.5, 0.5), Vector::y())
}

/// Code 1, which every class has, and those at `places`; code 1 seen.
fn scene(classes: Vec<Class>, places: &[Pose]) -> (Library, Seen) {
    let first = frame_facing(Point::new(0.5, 1.5, 0.5), -Vector::x());
    let tied: Vec<Pose> = std::iter::once(first).chain(places.iter().copied()).collect();
    let seen = Seen {
        definite: vec![(0, Measurement::Marker { pose: first, size: 2.0 })],
        beside: Vec::new(),
    };
    (codes(tied.len(), classes, &tied), seen)
}

/// H(left) = 1 bit; right and far have 0.81 each and 1.5 together.
fn one_or_two() -> (Library, Seen) {
    let rows = classes(&["a 1110", "b 1101", "c 1000", "d 1000"]);
    scene(rows, &[left(), right(), far()])
}

#[test]
fn joint_asks_two_questions_where_they_tell_more_than_the_best_one() {
    let (library, seen) = one_or_two();
    let world = MicroWorld::parse(UNKNOWN);
    let mut trial = Trial::new(library, task(), &[START, LEFT, BOTH]);
    trial.look(0, &world, &seen);
    assert_eq!(trial.next(&world, "gn"), Some((1, false)));
    assert_eq!(trial.next(&world, "joint"), Some((2, false)));
}

#[test]
fn joint2_prefers_two_views_that_complete_each_other() {
    // Left: 014|235|6|7 and right: 024|135|6|7 take 1.81 bits each. The far face parts
    // 01|23|4567, which settles what the right one leaves, but not what the left one does.
    let rows = [
        "0 1100 100 10",
        "1 1100 010 10",
        "2 1010 100 01",
        "3 1010 010 01",
        "4 1100 100 00",
        "5 1010 010 00",
        "6 1001 001 00",
        "7 1000 000 00",
    ];
    let rows = rows.map(|row| {
        let (name, presence) = row.split_once(' ').unwrap();
        format!("{name} {}", presence.replace(' ', ""))
    });
    let rows = rows.each_ref().map(String::as_str);
    let places = [[left(); 3].as_slice(), &[right(); 3], &[far(); 2]].concat();
    let (library, seen) = scene(classes(&rows), &places);
    let world = MicroWorld::parse(UNKNOWN);
    let mut trial = Trial::new(library, task(), &[START, LEFT, RIGHT, FAR]);
    trial.look(0, &world, &seen);
    assert_eq!(trial.next(&world, "joint"), Some((1, false)));
    assert_eq!(trial.next(&world, "joint2"), Some((2, false)));
}

#[test]
fn pfdt_does_not_return_to_a_feature_whose_view_was_taken() {
    let (library, seen) = one_or_two();
    let world = MicroWorld::parse(UNKNOWN);
    let mut trial = Trial::new(library, task(), &[START, LEFT, LEFT_TOO, RIGHT]);
    trial.look(0, &world, &seen);
    assert_eq!(trial.next(&world, "pfdt"), Some((1, false)));
    // Nothing was measured there: the place is still open.
    trial.look(1, &world, &seen);
    assert_eq!(trial.next(&world, "gn"), Some((2, false)));
    assert_eq!(trial.next(&world, "pfdt"), Some((3, false)));
}

/// (4, 1) was measured from the start; (5, 1) behind it can be seen from the right.
fn measured() -> MicroWorld {
    let mut world = MicroWorld::parse("??????\n????#?\n??????\n??????\n??????\n??????");
    world.eyes = vec![Point::from(START)];
    world
}

#[test]
fn ts_turns_to_the_surface_once_the_rough_shapes_of_a_class_are_found() {
    // No class has a rough shape: the second stage from the beginning.
    let (library, seen) = one_or_two();
    let world = measured();
    let mut trial = Trial::new(library, task(), &[START, LEFT, RIGHT]);
    trial.look(0, &world, &seen);
    assert_eq!((trial.surface(&world, 1), trial.surface(&world, 2)), (0, 1));
    assert_eq!(trial.next(&world, "gn"), Some((1, false)));
    assert_eq!(trial.next(&world, "ts"), Some((2, false)));
}

#[test]
fn ts_asks_for_features_until_then() {
    let (mut library, seen) = one_or_two();
    library.features.push(feature("hull", FeatureKind::Shell, false));
    library.classes = classes(&["a 11101", "b 11011", "c 10001", "d 10001"]);
    let world = measured();
    let mut trial = Trial::new(library, task(), &[START, LEFT, RIGHT]);
    trial.look(0, &world, &seen);
    assert_eq!(trial.next(&world, "ts"), Some((1, false)));
}
