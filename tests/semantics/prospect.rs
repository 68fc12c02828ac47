//! Expected new surface, held to values worked by hand: one ray along a row of six
//! voxels of 1 m, seen from 10 m off its middle. A ray stands for z²/100 faces at depth z,
//! and an unknown voxel that nothing is predicted for ends a sixth of it.

use vpl::geometry::{Point, Polygon};
use vpl::plan::methods::Worth;
use vpl::rules::{FeatureKind, Goal, Library, Task};

use super::fixtures::{classes, definite, feature, foot, library, on_base};
use super::information::{facing, narrow};
use super::trial::{Seen, Trial};
use super::world::MicroWorld;

const BEHIND: usize = 0;
const FRONT: usize = 1;

/// A foot at x = 2.5 says where a wall must be that faces +x; half of the classes have it.
fn walls() -> (Library, Polygon) {
    let features = vec![
        feature("foot", FeatureKind::Polygon, false),
        feature("wall", FeatureKind::Polygon, false),
    ];
    let rules = vec![definite(0), definite(1), on_base(0, 1, 1.0)];
    let library = library(features, classes(&["a 11", "b 10"]), rules);
    (library, foot(2.5, 0.0, 1.0, 0.0))
}

fn reconstruct() -> Task {
    Task {
        goal: Goal {
            confident: false,
            exhausted: true,
        },
        ..narrow(1, 1.0)
    }
}

/// A surface at x = 2 that was measured from −x.
fn measured() -> MicroWorld {
    let mut world = MicroWorld::parse("..#???");
    world.eyes = vec![Point::new(-7.0, 0.5, 0.5)];
    world
}

/// After a look from behind that finds what `seen` says.
fn looked(world: &MicroWorld, seen: &Seen, task: Task) -> Trial {
    let mut trial = facing(world, walls().0, task);
    trial.look(BEHIND, world, seen);
    trial
}

/// The score, and what the run could stop by.
#[track_caller]
fn check(trial: &Trial, world: &MicroWorld, view: usize, all: f64, firm: f64) {
    for method in ["joint", "joint2"] {
        let choice = trial.only(world, method, view);
        let most = choice.worth.unwrap().most;
        assert!(
            (choice.best.score - all).abs() < 1e-9,
            "{method}: {}",
            choice.best.score
        );
        assert!((most - firm).abs() < 1e-9, "{method}: {most}");
    }
}

#[test]
fn a_surface_seen_from_behind_has_another_side() {
    let world = measured();
    let trial = looked(&world, &Seen::nothing(), reconstruct());
    // Depths 7.5 and 8.5 in unknown space, which the last voxel is not: it lies beside
    // the surface, at 10.5. Of unknown direction, they count twice.
    let unknown = 0.5625 / 6.0 + 0.7225 * 5.0 / 36.0;
    check(
        &trial,
        &world,
        FRONT,
        2.0 * (unknown + 1.1025 * 25.0 / 36.0),
        2.0 * 1.1025,
    );
    // From its own side there is nothing new.
    check(&trial, &world, BEHIND, 0.0, 0.0);
}

#[test]
fn a_predicted_face_ends_rays_that_it_faces() {
    let world = MicroWorld::parse("??????");
    let trial = looked(&world, &Seen::face(0, walls().1), reconstruct());
    // Half of the classes have the wall: 0.8 · ½.
    let left = 125.0 / 216.0;
    let before = 2.0 * (0.5625 / 6.0 + 0.7225 * 5.0 / 36.0 + 0.9025 * 25.0 / 216.0);
    let behind = 0.6 * 2.0 * (1.3225 / 6.0 + 1.5625 * 5.0 / 36.0);
    check(
        &trial,
        &world,
        FRONT,
        before + left * (0.4 * 1.1025 + behind),
        0.4 * 1.1025,
    );
    assert_eq!(trial.only(&world, "joint", BEHIND).worth.unwrap().most, 0.0);
}

#[test]
fn what_was_measured_free_is_no_surface_whatever_was_predicted() {
    let world = MicroWorld::parse("......");
    let trial = looked(&world, &Seen::face(0, walls().1), reconstruct());
    check(&trial, &world, FRONT, 0.0, 0.0);
}

#[test]
fn a_run_is_exhausted_by_its_own_measure_only_while_no_class_is_asked_for() {
    let world = measured();
    let least = |task: Task| {
        let trial = looked(&world, &Seen::nothing(), task);
        trial.only(&world, "joint", FRONT).worth
    };
    let floor = |gain_floor| Task {
        gain_floor,
        ..reconstruct()
    };
    let exhausted = |worth: Option<Worth>| worth.unwrap().exhausted();
    assert!(!exhausted(least(floor(1))));
    assert!(!exhausted(least(floor(2))));
    assert!(exhausted(least(floor(3))));
    assert_eq!(least(narrow(1, 1.0)), None);
}
