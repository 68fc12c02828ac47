//! The tank library of Fig. 8 on micro-worlds: weights and whole-in-one-view.

use super::fixtures::{call, classes, feature, length, library, rule, task, text};
use super::trial::{Seen, Trial};
use super::world::MicroWorld;
use super::worlds::{FRONT, agree};
use vpl::detect::Measurement;
use vpl::geometry::{Point, Pose, Vector, frame_facing};
use vpl::rules::{Class, Expr, FeatureKind, Library, Rule, Value};

const TABLE: [&str; 12] = [
    "tk1 1010111",
    "tk2 1000011",
    "tk3 1011111",
    "tk4 0100100",
    "tk5 1110111",
    "tk6 1011011",
    "tk7 1000111",
    "tk8 1011010",
    "tk9 1100111",
    "tk10 1011101",
    "tk11 1001111",
    "tk12 1110101",
];

/// Codes of 2 m; the layout of the first `tied.len()` of them.
pub fn codes(count: usize, classes: Vec<Class>, tied: &[Pose]) -> Library {
    let detect = |k: usize| call("qr", [("text", text(&format!("f{k}"))), ("size", length(2.0))]);
    let measure = || call("marker_pose", []);
    let features = (1..=count).map(|k| feature(&format!("code[{k}]"), FeatureKind::Marker, false));
    let mut rules: Vec<Rule> = (0..count)
        .map(|k| rule(&[], k as u32, detect(k + 1), measure(), None))
        .collect();
    for (i, from) in tied.iter().enumerate() {
        for (j, to) in tied.iter().enumerate().filter(|(j, _)| *j != i) {
            let predict = call(
                "rigid_marker",
                [
                    ("antecedent", super::fixtures::attribute(i as u32, "pose")),
                    (
                        "antecedent_from_consequent",
                        Expr::Value(Value::Pose(from.inverse() * to)),
                    ),
                    ("size", length(2.0)),
                ],
            );
            rules.push(rule(&[i as u32], j as u32, detect(j + 1), measure(), Some(predict)));
        }
    }
    library(features.collect(), classes, rules)
}

#[test]
fn with_nothing_seen_the_codes_weigh_what_the_table_says() {
    let trial = Trial::new(codes(7, classes(&TABLE), &[]), task(), &[FRONT]);
    let expected = [0.4138, 0.9183, 0.9799, 0.9799, 0.8113, 0.8113, 0.6500];
    for (weight, expected) in trial.status.weights.iter().zip(expected) {
        assert!((weight - expected).abs() < 5e-5, "{weight} for {expected}");
    }
}

#[test]
fn priors_weigh_the_classes() {
    // P(a) = ¾ has code 1, P(b) = ¼ has not: H(¼).
    let mut rows = classes(&["a 1", "b 0"]);
    (rows[0].prior, rows[1].prior) = (0.75, 0.25);
    let trial = Trial::new(codes(1, rows, &[]), task(), &[FRONT]);
    assert!((trial.status.weights[0] - 0.811_278).abs() < 1e-6);
}

/// Code 1 behind (facing −x), code 2 in front: the square x = 2.5, y 0.5…2.5,
/// z −0.5…1.5 that faces +x; in the one layer z = 0: PV (2,0), (2,1), (2,2).
fn two_codes() -> (Library, Seen) {
    let behind = frame_facing(Point::new(0.5, 1.5, 0.5), -Vector::x());
    let front = frame_facing(Point::new(2.5, 1.5, 0.5), Vector::x());
    let library = codes(2, classes(&["both 11", "one 10"]), &[behind, front]);
    let marker = Measurement::Marker {
        pose: behind,
        size: 2.0,
    };
    let seen = Seen {
        definite: vec![(0, marker)],
        beside: Vec::new(),
    };
    (library, seen)
}

#[test]
fn a_code_must_be_seen_whole_in_one_view() {
    // (3,1) hides (2,1) from the front: n = 0, not 2. From (9.5, 3.2) the line
    // of (2,1) leaves its row at x = 2.5 + 7 · 0.5/1.7 = 4.6, behind (3,1); that
    // of (2,0) leaves its row at x = 2.5 + 7 · 0.5/2.7 = 3.8 and passes row 1
    // from there to 6.4, beyond (3,1) for x ≥ 4 but not from 3.8 to 4.
    let (library, seen) = two_codes();
    let world = MicroWorld::parse(
        "
        ????
        ???#
        ????
        ????",
    );
    let mut trial = Trial::new(library, task(), &[[-5.5, 1.5, 0.5], FRONT, [9.5, 3.2, 0.5]]);
    trial.look(0, &world, &seen);
    agree(&trial, &world);
    assert_eq!(trial.predicted(1).voxels.len(), 3);
    assert_eq!((trial.n(&world, 1, 1), trial.n(&world, 1, 2)), (0, 0));
}

#[test]
fn parts_seen_in_several_views_do_not_add_up_for_a_code() {
    // The place is free. (3,1) hides (2,1) from the front; another view at 62°
    // is outside the 55° of a QR code.
    let (library, seen) = two_codes();
    let world = MicroWorld::parse(
        "
        ..?.
        ...#
        ....
        ....",
    );
    let eyes = [FRONT, [7.5, 2.1, 0.5], [5.0, 6.5, 0.5], [6.5, -3.0, 0.5]];
    let mut trial = Trial::new(library.clone(), task(), &eyes);
    for view in 0..4 {
        trial.look(view, &world, &seen);
    }
    agree(&trial, &world);
    assert_eq!((trial.state(1), trial.predicted(1).share()), (-1, 0.0));
    // Without the obstacle one look from the front settles it.
    let empty = MicroWorld::parse(
        "
        ....
        ....
        ....
        ....",
    );
    let mut trial = Trial::new(library, task(), &eyes);
    trial.look(0, &empty, &seen);
    assert_eq!(trial.state(1), 0);
}

#[test]
fn the_key_of_a_code_is_its_family_index() {
    let (library, seen) = two_codes();
    let world = MicroWorld::parse("????\n????\n????\n????");
    let mut trial = Trial::new(library, task(), &[[-5.5, 1.5, 0.5], FRONT]);
    trial.look(0, &world, &seen);
    assert_eq!(trial.status.features[0].found[0].key, "1");
    assert_eq!(trial.status.features[1].predicted.keys().collect::<Vec<_>>(), ["2"]);
    assert_eq!(trial.predicted(1).by, ["r3"]);
}
