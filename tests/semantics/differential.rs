//! The fast planner and the naive reference agree on random small worlds: drawn
//! voxel by voxel, and measured into a real map.

use std::collections::BTreeMap;

use proptest::collection::vec;
use proptest::prelude::*;
use vpl::geometry::{Camera, DepthRange, Intrinsics, Point, Polygon, Pose, Vector, look_at};
use vpl::map::{Map, Occupancy, Voxel};
use vpl::plan::World;
use vpl::rules::{Inspected, SensorModel, Space, Task};
use vpl::sense::{ColourImage, DepthImage, Observation};

use super::fixtures::task;
use super::trial::{Seen, Trial};
use super::world::MicroWorld;
use super::worlds::{agree, pair};

const SIZE: [u32; 3] = [5, 4, 3];

/// A base whose first edge predicts an upright side somewhere in the space.
fn any_base() -> impl Strategy<Value = Polygon> {
    (0.3..4.5, 0.3..3.5, 0.2..2.0, 0.0..std::f64::consts::TAU).prop_map(|(x, y, z, turn): (f64, f64, f64, f64)| {
        let at = |u: f64, v: f64| {
            Point::new(
                x + turn.cos() * u - turn.sin() * v,
                y + turn.sin() * u + turn.cos() * v,
                z,
            )
        };
        let face = Polygon::new(vec![at(-1.2, 0.0), at(1.2, 0.0), at(0.0, 1.0)]).unwrap();
        face.facing(&-Vector::z())
    })
}

/// Views from around the space at its middle, none on a line through corners.
fn any_views() -> impl Strategy<Value = Vec<Pose>> {
    let eye = (0.0..std::f64::consts::TAU, -1.2..1.2, 4.5..9.0).prop_map(|(turn, up, far): (f64, f64, f64)| {
        let middle = Point::new(2.5, 2.0, 1.5);
        let out = Vector::new(turn.cos() * up.cos(), turn.sin() * up.cos(), up.sin());
        look_at(middle + out * far, middle + Vector::new(0.013, 0.029, 0.017))
    });
    vec(eye, 3..7)
}

fn any_task() -> impl Strategy<Value = Task> {
    let settings = (0.4..1.6, any::<bool>(), 0.1..0.9, 0_u32..4);
    settings.prop_map(|(near, observed, overlap, gain_floor): (f64, bool, f64, u32)| {
        let mut task = task();
        task.thresholds.near = near;
        task.inspected = if observed {
            Inspected::Observed
        } else {
            Inspected::NearPoint
        };
        (task.overlap, task.gain_floor) = (overlap, gain_floor);
        task.space = space();
        task
    })
}

fn space() -> Space {
    Space {
        centre: Point::new(2.5, 2.0, 1.5),
        size: Vector::new(5.0, 4.0, 3.0),
        voxel: 1.0,
    }
}

fn any_state() -> impl Strategy<Value = Occupancy> {
    prop_oneof![
        4 => Just(Occupancy::Unknown),
        3 => Just(Occupancy::Free),
        1 => Just(Occupancy::Occupied),
    ]
}

/// A camera of few pixels for measuring into a map.
fn coarse() -> Camera {
    let image = Intrinsics::with_fields_of_view(9, 7, 1.1, 0.9);
    Camera {
        depth: image,
        colour: image,
        range: DepthRange { min: 0.1, max: 50.0 },
    }
}

fn measurement(view: &Pose, depths: &[f32]) -> Observation {
    let camera = coarse();
    let (width, height) = (camera.depth.width, camera.depth.height);
    Observation {
        camera,
        world_from_camera: *view,
        colour: ColourImage {
            width,
            height,
            pixels: vec![[0; 3]; camera.colour.pixels()],
        },
        depth: DepthImage {
            width,
            height,
            metres: depths.to_vec(),
        },
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn on_drawn_worlds(
        states in vec(any_state(), 60),
        face in any_base(),
        views in any_views(),
        looks in 1_usize..3,
        task in any_task(),
    ) {
        let mut world = MicroWorld::of(SIZE, states);
        world.eyes = views[..looks].iter().map(|v| Point::from(v.translation.vector)).collect();
        let mut trial = Trial::at(pair(), task, views);
        for view in 0..looks {
            trial.look(view, &world, &Seen::face(0, face.clone()));
        }
        agree(&trial, &world);
    }

    #[test]
    fn on_measured_maps(
        depths in vec(vec(prop_oneof![1 => Just(0.0_f32), 6 => 2.0_f32..9.0, 1 => Just(40.0_f32)], 63), 2),
        face in any_base(),
        views in any_views(),
        task in any_task(),
    ) {
        let model = SensorModel { hit: 0.9, miss: 0.45, ..SensorModel::default() };
        let mut map = Map::new(&space(), model).unwrap();
        let (mut measured, mut kept) = (Vec::new(), BTreeMap::new());
        for (view, depths) in views.iter().zip(&depths) {
            let observation = measurement(view, depths);
            map.insert(&observation);
            for (point, voxel) in ends(&map, &observation) {
                measured.push((observation.eye(), voxel));
                kept.entry(octant(&point)).or_insert(point);
            }
        }
        let mut trial = Trial::at(pair(), task, views);
        for view in 0..2 {
            trial.look(view, &map, &Seen::face(0, face.clone()));
        }
        trial.agree(&map, &kept.into_values().collect::<Vec<_>>(), &measured);
    }
}

/// Every measured point inside the space and its voxel, in pixel order.
fn ends(map: &Map, observation: &Observation) -> Vec<(Point, Voxel)> {
    let pixels = (0..observation.depth.height).flat_map(|v| (0..observation.depth.width).map(move |u| (u, v)));
    let points = pixels.filter_map(|(u, v)| observation.point(u, v));
    points
        .filter_map(|p| Some((p, World::grid(map).containing(&p)?)))
        .collect()
}

/// The half of a voxel along each axis that a point lies in: of each the map
/// remembers the first.
fn octant(p: &Point) -> [i64; 3] {
    [0, 1, 2].map(|k| (p[k] * 2.0).floor() as i64)
}
