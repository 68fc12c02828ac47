//! What is told of the rules, on worlds worked by hand.

use super::fixtures::{attribute, call, classes, definite, degrees, feature, length, library, on_base, rule, task};
use super::trial::{Seen, Trial};
use super::world::MicroWorld;
use super::worlds::{FRONT, base, pair};
use vpl::detect::{Condition, Unit};
use vpl::plan::trace::{Absence, Nothing, RuleTrace};
use vpl::rules::{Expr, FeatureKind, Library, Value};

const BACK: [f64; 3] = [-5.5, 1.5, 0.5];
const UNKNOWN: &str = "
    ????
    ????
    ????
    ????";
const EMPTY: &str = "
    ??..
    ??..
    ??..
    ????";

fn looked(library: Library, drawing: &str, seen: &Seen) -> Trial {
    let mut trial = Trial::new(library, task(), &[FRONT, BACK]);
    trial.look(0, &MicroWorld::parse(drawing), seen);
    trial
}

fn told<'a>(trial: &'a Trial, id: &str) -> Option<&'a RuleTrace> {
    let rules = &trial.knowledge.library.rules;
    trial.trace.rule(rules.iter().position(|r| r.id == id).unwrap())
}

#[test]
fn a_rule_that_found_something_tells_how_much_of_what() {
    let trial = looked(pair(), UNKNOWN, &base());
    let tries = &told(&trial, "r1").unwrap().tries;
    assert_eq!(
        (tries.len(), tries[0].key.as_str(), tries[0].looked, tries[0].found),
        (1, "1", 1, 1)
    );
}

#[test]
fn a_rule_that_found_nothing_tells_what_failed_and_who_else_asked() {
    // r2 and r3 ask the same of one detector: r3's antecedent was found first.
    let trial = looked(pair(), UNKNOWN, &base());
    let trace = told(&trial, "r2").unwrap();
    assert_eq!(
        (trace.tries[0].found, trace.also.as_slice()),
        (0, ["r3".to_owned()].as_slice())
    );
    assert_eq!(trace.tries[0].conditions, [Condition::plain("shown", false)]);
    assert_eq!(told(&trial, "r3"), None);
}

#[test]
fn what_is_found_already_and_not_seen_again_is_not_told() {
    let mut trial = looked(pair(), UNKNOWN, &base());
    trial.look(1, &MicroWorld::parse(UNKNOWN), &Seen::nothing());
    assert_eq!(told(&trial, "r1"), None);
    assert_eq!(told(&trial, "r2").unwrap().tries[0].looked, 0);
}

#[test]
fn a_feature_ruled_out_tells_by_which_prediction_and_how_much_of_it() {
    let trial = looked(pair(), EMPTY, &base());
    let absence = Absence {
        inspected: 3,
        voxels: 3,
        rules: vec!["r3".to_owned()],
    };
    assert_eq!(
        trial.trace.absent(&trial.knowledge.library),
        [("side".to_owned(), absence)]
    );
}

/// base → box, proven by half of its surface.
fn boxed() -> Library {
    let predict = call(
        "rectangle_on",
        [
            ("on", attribute(0, "base")),
            ("dihedral", degrees(90.0)),
            ("height", length(0.6)),
        ],
    );
    let detect = call("mostly_seen", [("share", Expr::Value(Value::Share(0.5)))]);
    let shell = rule(&[0], 1, detect, call("rough_shape", []), Some(predict));
    let features = vec![
        feature("base", FeatureKind::Polygon, false),
        feature("box", FeatureKind::Shell, false),
    ];
    library(features, classes(&["with 11", "without 10"]), vec![definite(0), shell])
}

#[test]
fn a_shell_tells_which_share_was_seen() {
    let one = "
        ??#.
        ????
        ????
        ????";
    let two = "
        ??#.
        ??#.
        ????
        ????";
    for (drawing, found, share) in [(one, 0, 1.0 / 3.0), (two, 1, 2.0 / 3.0)] {
        let trial = looked(boxed(), drawing, &base());
        let tried = &told(&trial, "r2").unwrap().tries[0];
        assert_eq!((tried.looked, tried.found), (3, found));
        assert_eq!(tried.conditions, [Condition::at_least("seen", Unit::Share, share, 0.5)]);
    }
}

#[test]
fn a_prediction_outside_the_space_or_without_a_value_says_so() {
    // 40 m high: it leaves the grid beyond its diagonal.
    let features = || {
        vec![
            feature("base", FeatureKind::Polygon, false),
            feature("side", FeatureKind::Polygon, false),
        ]
    };
    let far = library(
        features(),
        classes(&["with 11", "without 10"]),
        vec![definite(0), on_base(0, 1, 40.0)],
    );
    let trial = looked(far, UNKNOWN, &base());
    let blank = &told(&trial, "r2").unwrap().blank;
    assert_eq!(
        (blank.len(), blank[0].key.as_str(), blank[0].why),
        (1, "1", Nothing::Outside)
    );
    // As high as the side itself, which is not measured.
    let mut waiting = on_base(0, 1, 0.6);
    let own = attribute(1, "height");
    waiting
        .predict
        .as_mut()
        .unwrap()
        .arguments
        .insert("height".to_owned(), own);
    let waits = library(
        features(),
        classes(&["with 11", "without 10"]),
        vec![definite(0), waiting],
    );
    let trial = looked(waits, UNKNOWN, &base());
    assert_eq!(told(&trial, "r2").unwrap().waits, ["predict"]);
}
