//! The methods of information gain, held to values worked by hand.
//!
//! Cameras of a few pixels make rays that run along rows of voxels. Measured free
//! voxels have p = ¼, occupied ones 0.9, unknown ones ½.

use std::f64::consts::LN_2;

use vpl::geometry::{Camera, DepthRange, Intrinsics, Point, Pose, look_at};
use vpl::rules::{FeatureKind, Library, Task};

use super::fixtures::{classes, feature, library, task};
use super::trial::{Seen, Trial};
use super::world::MicroWorld;

/// H(¼) and H(0.9), nats.
const FREE: f64 = 0.562_335_144_618_808;
const HIT: f64 = 0.325_082_973_391_448;

/// `rows` pixels across whose rays are `apart` at a distance of 10 m.
pub fn narrow(rows: u32, apart: f64) -> Task {
    let image = Intrinsics {
        width: rows,
        height: 1,
        fx: 10.0 / apart,
        fy: 10.0 / apart,
        cx: f64::from(rows) / 2.0,
        cy: 0.5,
    };
    let camera = Camera {
        depth: image,
        colour: image,
        range: DepthRange { min: 0.5, max: 100.0 },
    };
    Task { camera, ..task() }
}

/// From −x and from +x, 10 m off the middle of a world; the first was visited.
pub fn from_both_sides(world: &MicroWorld, rows: u32) -> Trial {
    let library = library(
        vec![feature("code", FeatureKind::Marker, false)],
        classes(&["a 1", "b 0"]),
        Vec::new(),
    );
    let mut trial = facing(world, library, narrow(rows, world.grid.voxel));
    trial.look(0, world, &Seen::nothing());
    trial
}

/// Views from both sides, none visited.
pub fn facing(world: &MicroWorld, library: Library, task: Task) -> Trial {
    let extent = world.grid.size.map(|n| f64::from(n) * world.grid.voxel);
    let middle = Point::from(extent.map(|e| e / 2.0));
    let eye = |x: f64| Point::new(middle.x + x, middle.y, middle.z);
    let pose = |x: f64| -> Pose { look_at(eye(x), middle) };
    Trial::at(library, task, vec![pose(-10.0), pose(10.0)])
}

#[track_caller]
fn check(trial: &Trial, world: &MicroWorld, method: &str, view: usize, expected: f64) {
    let value = trial.value(world, method, view);
    assert!(
        (value - expected).abs() < 1e-9,
        "{method} of view {view}: {value}, not {expected}"
    );
}

/// One ray: unknown, free, unknown, occupied from −x; the two voxels behind are not met.
fn one_row() -> (MicroWorld, Trial) {
    let world = MicroWorld::parse("?.?#??");
    let trial = from_both_sides(&world, 1);
    (world, trial)
}

#[test]
fn oa_and_uv_weigh_entropy_by_visibility() {
    let (world, trial) = one_row();
    // Visibilities 1, ½, ⅜ and 3/16.
    check(&trial, &world, "oa", 0, LN_2 + 0.5 * FREE + 0.375 * LN_2 + 0.1875 * HIT);
    check(&trial, &world, "uv", 0, 1.375 * LN_2);
    // From +x: 1, ½, ¼.
    check(&trial, &world, "oa", 1, 1.5 * LN_2 + 0.25 * HIT);
    check(&trial, &world, "uv", 1, 1.5 * LN_2);
}

#[test]
fn the_reference_multiplies_p_and_takes_free_voxels_above_a_fifth_for_unknown() {
    let (world, trial) = one_row();
    // Visibilities 1, ½, ⅛ and 1/16; p = ¼ lies between the bounds.
    check(
        &trial,
        &world,
        "oa_implemented",
        0,
        1.125 * LN_2 + 0.5 * FREE + 0.0625 * HIT,
    );
    check(&trial, &world, "uv_implemented", 0, 1.125 * LN_2 + 0.5 * FREE);
    check(&trial, &world, "rse_implemented", 0, 1.125 * LN_2 + 0.5 * FREE);
}

#[test]
fn the_rear_side_is_what_is_unknown_right_before_a_surface() {
    let (world, trial) = one_row();
    check(&trial, &world, "rsv", 0, 1.0);
    check(&trial, &world, "rse", 0, 0.375 * LN_2);
    check(&trial, &world, "rse", 1, 1.5 * LN_2);
    check(&trial, &world, "ae", 0, (2.0 * LN_2 + FREE + HIT) / 4.0);
    check(&trial, &world, "ae_implemented", 1, (2.0 * LN_2 + HIT) / 3.0);
}

#[test]
fn a_free_voxel_before_the_surface_leaves_no_rear_side() {
    let world = MicroWorld::parse("??.#..");
    let trial = from_both_sides(&world, 1);
    check(&trial, &world, "rsv", 0, 0.0);
    check(&trial, &world, "rse", 0, 0.0);
    check(&trial, &world, "rsv_implemented", 0, 1.0);
}

#[test]
fn rays_that_end_nowhere_have_no_rear_side_and_no_average() {
    let world = MicroWorld::parse("??????");
    let trial = from_both_sides(&world, 1);
    for method in ["rsv", "rse", "ae"] {
        check(&trial, &world, method, 1, 0.0);
    }
    // Σ of 2⁻ⁱ, i = 0 … 5.
    check(&trial, &world, "uv", 1, 1.96875 * LN_2);
}

#[test]
fn pc_counts_unknown_space_the_more_the_nearer_it_is_behind_a_surface() {
    // d_max is 3 steps of 10 cm: the voxels behind the surface count 2, 1 and 0.
    let world = MicroWorld::parse("?..#????").scaled(0.1);
    let trial = from_both_sides(&world, 1);
    check(&trial, &world, "pc", 1, 3.0);
    check(&trial, &world, "pc", 0, 0.0);
}

#[test]
fn af_is_best_with_a_fifth_of_occupied_and_four_fifths_of_occluded_rays() {
    let world = MicroWorld::parse("?..#????\n?..#????\n?..#????\n?..#????\n?.....#.").scaled(0.1);
    let trial = from_both_sides(&world, 5);
    check(&trial, &world, "af", 1, 2.0);
    // All five votes are for occupied voxels.
    check(&trial, &world, "af", 0, 0.0);
}
