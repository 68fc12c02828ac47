//! Rays through the planning grid against slow references: every voxel is tried
//! against every ray, and sets count what was met.

use std::collections::BTreeSet;

use proptest::prelude::*;
use vpl::geometry::{Bounds, DepthRange, Intrinsics, Point, Vector, look_at};
use vpl::map::{Map, Occupancy, PlanningGrid, Ray, RayCounts, Seen, Tag, Voxel, VoxelSet, image_rays};
use vpl::rules::{SensorModel, Space};
use vpl::sense::{ColourImage, DepthImage, Observation};

/// No multiple of a brick along any axis.
const SIZE: [f64; 3] = [0.65, 0.45, 0.85];
const VOXEL: f64 = 0.05;

fn new_map() -> Map {
    let space = Space {
        centre: Point::new(0.025, -0.025, 0.025),
        size: SIZE.into(),
        voxel: VOXEL,
    };
    Map::new(&space, SensorModel::default()).unwrap()
}

/// A few readings from an eye, each its own depth.
fn observation(eye: Point, metres: Vec<f32>) -> Observation {
    let (width, height) = (7, metres.len() as u32 / 7);
    let image = Intrinsics::with_fields_of_view(width, height, 0.9, 0.8);
    Observation {
        camera: vpl::geometry::Camera {
            depth: image,
            colour: image,
            range: vpl::geometry::DepthRange { min: 0.1, max: 9.0 },
        },
        world_from_camera: look_at(eye, Point::origin()),
        colour: ColourImage {
            width,
            height,
            pixels: vec![[0; 3]; metres.len()],
        },
        depth: DepthImage { width, height, metres },
    }
}

fn point(reach: f64) -> impl Strategy<Value = Point> {
    prop::array::uniform3(-reach..reach).prop_map(Point::from)
}

/// Some free, occupied and tagged space.
fn map() -> impl Strategy<Value = Map> {
    let frame = (point(1.0), prop::collection::vec(0.2..1.6_f32, 35)).prop_map(|(eye, d)| observation(eye, d));
    let tagged = prop::collection::vec(0..1989_u32, 0..300);
    (prop::collection::vec(frame, 0..4), tagged).prop_map(|(frames, tagged)| {
        let mut map = new_map();
        frames.iter().for_each(|o| {
            map.insert(o);
        });
        map.tag(1 as Tag, tagged.into_iter().map(Voxel).collect());
        map
    })
}

/// From inside or outside, some along an axis or a plane.
fn ray() -> impl Strategy<Value = Ray> {
    let flat = prop::array::uniform3(prop_oneof![3 => Just(1.0), 1 => Just(0.0)]);
    (point(1.2), point(0.4), flat, 0.0..3.0_f64).prop_map(|(from, to, keep, length)| {
        let along = (to - from).component_mul(&Vector::from(keep));
        let along = if along.norm() > 0.0 { along } else { Vector::z() };
        Ray::new(from, along, length)
    })
}

fn voxels(map: &Map) -> impl Iterator<Item = Voxel> + use<> {
    (0..map.grid().len()).map(Voxel)
}

fn met(grid: &PlanningGrid, ray: &Ray) -> Vec<Voxel> {
    let mut met = Vec::new();
    grid.walk(ray, |voxel, _| {
        met.push(voxel);
        true
    });
    met
}

/// Metres of a ray inside a voxel, where it enters, and the length of the way.
fn passage(map: &Map, ray: &Ray, length: f64, voxel: Voxel) -> Option<(f64, f64)> {
    let cube = Bounds::centred(map.grid().centre(voxel), Vector::repeat(VOXEL));
    let (enter, leave) = cube.clip_ray(ray.origin(), &(ray.at(1.0) - ray.origin()))?;
    let (enter, leave) = (enter.max(0.0), leave.min(length));
    (enter < leave).then_some((enter, leave - enter))
}

fn naive_counts(map: &Map, grid: &PlanningGrid, rays: &[Ray], once: bool) -> RayCounts {
    let (mut counts, mut seen) = (RayCounts::default(), BTreeSet::new());
    for ray in rays {
        for voxel in met(grid, ray) {
            counts.steps += 1;
            if map.occupancy(voxel) == Occupancy::Occupied {
                counts.hits += 1;
                break;
            }
            let new = seen.insert(voxel) || !once;
            counts.unknown += u64::from(new && map.occupancy(voxel) == Occupancy::Unknown);
        }
    }
    counts
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_state_is_the_maps(map in map()) {
        let grid = map.planning_grid();
        for v in voxels(&map) {
            let (state, occupancy) = (grid.state(v), map.occupancy(v));
            prop_assert_eq!(state.is_unknown(), occupancy == Occupancy::Unknown);
            prop_assert_eq!(state.is_free(), occupancy == Occupancy::Free);
            prop_assert_eq!(state.is_occupied(), occupancy == Occupancy::Occupied);
            prop_assert_eq!(state.is_preoccupied(), map.is_preoccupied(v));
            prop_assert!(!state.is_marked());
        }
    }

    #[test]
    fn a_ray_meets_the_cubes_on_its_way_in_their_order(from in point(1.2), to in point(0.4), length in 0.0..3.0_f64) {
        let (map, ray) = (new_map(), Ray::new(from, to - from, length));
        let met = met(&map.planning_grid(), &ray);
        let mut naive: Vec<_> = voxels(&map).filter_map(|v| Some((passage(&map, &ray, length, v)?, v))).collect();
        naive.sort_by(|a, b| a.0.0.total_cmp(&b.0.0));
        // What is only touched may be met or not.
        naive.retain(|((_, way), v)| *way > 1e-7 || met.contains(v));
        prop_assert_eq!(met, naive.into_iter().map(|n| n.1).collect::<Vec<_>>());
    }

    #[test]
    fn rays_in_a_plane_and_along_an_axis_go_straight_and_stay_inside(ray in ray()) {
        let map = new_map();
        let met = met(&map.planning_grid(), &ray);
        prop_assert!(met.iter().all(|v| v.0 < map.grid().len()));
        let cells: Vec<_> = met.iter().map(|v| map.grid().cell(*v)).collect();
        for pair in cells.windows(2) {
            let apart: i64 = (0..3).map(|k| (pair[0][k] - pair[1][k]).abs()).sum();
            prop_assert_eq!(apart, 1);
        }
        let along = ray.at(1.0) - ray.origin();
        for k in 0..3 {
            let back = cells.windows(2).any(|p| (p[1][k] - p[0][k]) as f64 * along[k] < 0.0);
            prop_assert!(!back);
            prop_assert!(along[k] != 0.0 || cells.windows(2).all(|p| p[0][k] == p[1][k]));
        }
    }

    #[test]
    fn counts_are_those_of_sets(map in map(), views in prop::collection::vec(prop::collection::vec(ray(), 0..30), 1..5)) {
        let grid = map.planning_grid();
        let mut seen = Seen::new(&grid);
        for rays in &views {
            prop_assert_eq!(grid.unknown_on_rays(rays), naive_counts(&map, &grid, rays, false));
            prop_assert_eq!(grid.distinct_unknown(rays, &mut seen), naive_counts(&map, &grid, rays, true));
        }
    }

    #[test]
    fn the_first_hit_is_the_first_occupied_voxel_of_the_walk(map in map(), rays in prop::collection::vec(ray(), 1..40)) {
        let (grid, visibility) = (map.planning_grid(), map.visibility());
        for ray in &rays {
            let walked = met(&grid, ray).into_iter().find(|v| map.occupancy(*v) == Occupancy::Occupied);
            prop_assert_eq!(visibility.first_hit(ray), walked, "{:?}", ray);
        }
    }

    /// In an image that holds the whole space, a set counts what is seen one by one.
    #[test]
    fn centres_are_counted_as_they_are_seen(
        map in map(), eye in point(1.0).prop_filter("outside", |p| p.coords.norm() > 1.4), some in prop::collection::vec(0..1989_u32, 1..400),
    ) {
        let image = Intrinsics::with_fields_of_view(90, 90, 1.8, 1.8);
        let view = map.centre_view(&image, DepthRange { min: 0.1, max: 9.0 }, &look_at(eye, Point::origin()));
        let some: BTreeSet<Voxel> = some.into_iter().map(Voxel).collect();
        let seen = some.iter().filter(|v| view.sees(**v, 0.0)).count() as u64;
        let set = VoxelSet::of(map.grid(), &some.iter().copied().collect::<Vec<_>>());
        prop_assert_eq!((set.len(), view.count(&set)), (some.len() as u64, seen));
    }

    /// Eyes, targets and borders at multiples of a quarter voxel.
    #[test]
    fn rays_through_corners_are_those_of_the_grid(from in prop::array::uniform3(-30..30_i32), to in prop::array::uniform3(-16..16_i32)) {
        let map = new_map();
        let at = |quarters: [i32; 3]| Point::from(quarters.map(|q| f64::from(q) * VOXEL / 4.0));
        let ray = Ray::between(&at(from), &at(to));
        let met = met(&map.planning_grid(), &ray);
        prop_assert!(met.windows(2).all(|p| p[0] != p[1]) && met.len() <= 40);
        for v in met {
            let grown = Bounds::centred(map.grid().centre(v), Vector::repeat(VOXEL + 1e-6));
            prop_assert!(grown.clip_ray(ray.origin(), &(ray.at(1.0) - ray.origin())).is_some());
        }
    }
}

#[test]
fn through_a_corner_x_is_crossed_before_y_before_z() {
    let unit = Space {
        centre: Point::origin(),
        size: Vector::repeat(4.0),
        voxel: 1.0,
    };
    let map = Map::new(&unit, SensorModel::default()).unwrap();
    let ray = Ray::between(&Point::new(-1.5, -1.5, -1.5), &Point::new(-0.5, -0.5, -0.5));
    let cells: Vec<_> = met(&map.planning_grid(), &ray)
        .iter()
        .map(|v| map.grid().cell(*v))
        .collect();
    assert_eq!(cells, [[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, 1]]);
}

#[test]
fn a_ray_that_is_not_finite_or_misses_meets_nothing() {
    let grid = new_map().planning_grid();
    let (eye, x) = (Point::new(2.0, 0.0, 0.0), Vector::x());
    let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
    let rays = bad.into_iter().flat_map(|bad| {
        [
            Ray::new(Point::new(bad, 0.0, 0.0), -x, 5.0),
            Ray::new(eye, Vector::new(bad, 1.0, 0.0), 5.0),
        ]
    });
    let odd = [
        Ray::new(eye, Vector::zeros(), 5.0),
        Ray::new(eye, -x, f64::NAN),
        Ray::new(eye, -x, -1.0),
        Ray::new(eye, x, 5.0),
        Ray::new(eye, -x, 1.0),
        Ray::new(Point::new(0.0, 9.0, 0.0), x, 5.0),
    ];
    for ray in rays.chain(odd) {
        assert_eq!(met(&grid, &ray), [], "{ray:?}");
    }
    assert_eq!(met(&grid, &Ray::new(eye, -x, f64::INFINITY)).len(), 13);
}

#[test]
fn views_are_told_apart_however_many_they_are() {
    let grid = new_map().planning_grid();
    let ray = Ray::new(Point::new(2.0, 0.0, 0.0), -Vector::x(), 9.0);
    let mut seen = Seen::new(&grid);
    for _ in 0..600 {
        assert_eq!(grid.distinct_unknown(&[ray, ray], &mut seen).unknown, 13);
    }
}

#[test]
fn marks_are_met() {
    let map = new_map();
    let mut grid = map.planning_grid();
    grid.mark(&[Voxel(5), Voxel(u32::MAX)]);
    let marked: Vec<_> = voxels(&map).filter(|v| grid.state(*v).is_marked()).collect();
    assert_eq!(marked, [Voxel(5)]);
    assert!(grid.state(Voxel(5)).is_unknown());
}

#[test]
fn an_image_has_a_ray_through_the_middle_of_every_cell() {
    let image = Intrinsics::with_fields_of_view(8, 6, 1.0, 0.8);
    let pose = look_at(Point::new(1.0, 0.0, 0.0), Point::origin());
    let rays: Vec<_> = image_rays(&image, 2, 3.0, &pose).collect();
    assert_eq!(rays.len(), 12);
    for (i, ray) in rays.iter().enumerate() {
        let local = pose.inverse_transform_point(&ray.at(0.7));
        let (u, v) = image.project(&local).unwrap();
        let middle = ((i % 4) as f64 * 2.0 + 1.0, (i / 4) as f64 * 2.0 + 1.0);
        assert!((u - middle.0).abs() < 1e-9 && (v - middle.1).abs() < 1e-9);
    }
}
