//! The map against slow references that share nothing with it: every voxel is
//! tried against every ray or sight line.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Translation3, UnitQuaternion};
use proptest::prelude::*;
use vpl::geometry::{Bounds, Camera, DepthRange, Intrinsics, Point, Pose, Vector, look_at};
use vpl::map::{Map, Occupancy, Voxel, write_bt};
use vpl::rules::{SensorModel, Space};
use vpl::sense::{ColourImage, DepthImage, Observation};

/// A cube of 12³ voxels about the origin, more than one brick an axis.
const SPACE: f64 = 0.6;
const VOXEL: f64 = 0.05;

fn space() -> Space {
    Space {
        centre: Point::origin(),
        size: Vector::repeat(SPACE),
        voxel: VOXEL,
    }
}

fn new_map() -> Map {
    Map::new(&space(), SensorModel::default()).unwrap()
}

fn observation(world_from_camera: Pose, width: u32, metres: Vec<f32>) -> Observation {
    let height = metres.len() as u32 / width;
    let depth = Intrinsics::with_fields_of_view(width, height, 0.9, 0.8);
    Observation {
        camera: Camera {
            depth,
            colour: depth,
            range: DepthRange { min: 0.1, max: 9.0 },
        },
        world_from_camera,
        colour: ColourImage {
            width,
            height,
            pixels: vec![[0; 3]; metres.len()],
        },
        depth: DepthImage { width, height, metres },
    }
}

/// One reading straight ahead of a camera at `eye`, ending at `end`.
fn one_ray(eye: Point, end: Point) -> Observation {
    let mut o = observation(look_at(eye, end), 1, vec![(end - eye).norm() as f32]);
    (o.camera.depth.cx, o.camera.depth.cy) = (0.5, 0.5);
    o
}

fn cube(map: &Map, v: Voxel) -> Bounds {
    Bounds::centred(map.grid().centre(v), Vector::repeat(map.grid().voxel))
}

/// Whether the segment passes through the inside of a cube.
fn passes(from: &Point, to: &Point, cube: &Bounds) -> bool {
    let clipped = cube.clip_ray(from, &(to - from));
    clipped.is_some_and(|(enter, leave)| enter < leave.min(1.0))
}

fn voxels(map: &Map) -> impl Iterator<Item = Voxel> + use<> {
    (0..map.grid().len()).map(Voxel)
}

fn eye() -> impl Strategy<Value = Point> {
    let inside = prop::array::uniform3(-0.29..0.29_f64);
    let outside = prop::array::uniform3(-1.0..1.0_f64).prop_filter("away", |p| Vector::from(*p).norm() > 0.6);
    prop_oneof![1 => inside, 3 => outside].prop_map(Point::from)
}

fn frame() -> impl Strategy<Value = Observation> {
    let target = prop::array::uniform3(-0.2..0.2_f64).prop_map(Point::from);
    let none = prop_oneof![5 => Just(0.0), 1 => Just(f32::NAN), 1 => Just(f32::INFINITY), 1 => Just(-1.0)];
    let reading = prop_oneof![1 => none, 6 => 0.1..1.5_f32, 1 => 2.0..4.0_f32];
    (eye(), target, prop::collection::vec(reading, 35))
        .prop_map(|(eye, target, metres)| observation(look_at(eye, target), 7, metres))
}

/// Measured points in pixel order.
fn readings(o: &Observation) -> Vec<Point> {
    let pixels = (0..o.depth.height).flat_map(|v| (0..o.depth.width).map(move |u| (u, v)));
    pixels.filter_map(|(u, v)| o.point(u, v)).collect()
}

/// OctoMap's precision.
fn rounded(p: Point) -> Point {
    p.map(|c| f64::from(c as f32))
}

/// State of every voxel after one frame, voxel by voxel: a ray goes to the centre
/// of each voxel with a reading.
fn naive_frame(map: &Map, o: &Observation) -> Vec<Occupancy> {
    let grid = map.grid();
    let ends: BTreeSet<_> = readings(o).iter().map(|p| grid.cell_of(p)).collect();
    let centre = |cell: &[i64; 3]| Point::from([0, 1, 2].map(|k| grid.origin[k] + (cell[k] as f64 + 0.5) * VOXEL));
    let rays: Vec<_> = ends.iter().map(|end| rounded(centre(end))).collect();
    let eye = rounded(o.eye());
    let state = |v: Voxel| {
        let (here, cube) = (grid.cell(v), cube(map, v));
        if ends.contains(&here) {
            Occupancy::Occupied
        } else if rays.iter().any(|end| passes(&eye, end, &cube)) {
            Occupancy::Free
        } else {
            Occupancy::Unknown
        }
    };
    voxels(map).map(state).collect()
}

/// How a centre lies to the reading of its pixel; `None` where rounding decides.
fn naively_before(o: &Observation, centre: &Point) -> Option<bool> {
    let p = o.world_from_camera.inverse_transform_point(centre);
    let k = &o.camera.depth;
    let (u, v) = (k.fx * p.x / p.z + k.cx, k.fy * p.y / p.z + k.cy);
    let near = |x: f64, border: f64| (x - border).abs() < 2e-3;
    if p.z.abs() < 1e-4 || (p.z > 0.0 && (near(u, u.round()) || near(v, v.round()))) {
        return None;
    }
    let Some((u, v)) = k.project(&p) else {
        return Some(false);
    };
    let Some(z) = o.depth.at(u as u32, v as u32) else {
        return Some(false);
    };
    (!near(p.z, z)).then_some(p.z < z)
}

fn states(map: &Map) -> Vec<Occupancy> {
    voxels(map).map(|v| map.occupancy(v)).collect()
}

/// A map with the given voxels occupied, each seen from its own direction.
fn world_of(voxel: f64, cells: &[([i64; 3], [i8; 3])]) -> Map {
    let mut map = Map::new(&Space { voxel, ..space() }, SensorModel::default()).unwrap();
    for (cell, side) in cells {
        let end = map.grid().centre(map.grid().at(*cell).unwrap());
        let away = (Vector::from(side.map(f64::from)) * 0.08 + Vector::new(0.06, 0.04, 0.02)) * voxel;
        map.insert(&one_ray(end + away, end));
    }
    map
}

/// A crowded world of 12³ voxels or a sparse one of 96³, where lines leap far.
fn world() -> impl Strategy<Value = Map> {
    let cells = |n: i64| {
        let voxel = (prop::array::uniform3(0..n), prop::array::uniform3(-1..=1_i8));
        prop::collection::vec(voxel, 0..60).prop_map(move |cells| world_of(SPACE / n as f64, &cells))
    };
    prop_oneof![cells(12), cells(96)]
}

fn naively_visible(map: &Map, occupied: &[Voxel], eye: &Point, target: Voxel, tolerance: f64) -> bool {
    let centre = map.grid().centre(target);
    !occupied.iter().any(|&o| {
        let far = (map.grid().centre(o) - centre).norm() > tolerance + 1e-9;
        o != target && far && passes(&centre, eye, &cube(map, o))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_frame_frees_and_occupies_what_every_ray_tried_on_every_voxel_does(o in frame()) {
        let mut map = new_map();
        map.insert(&o);
        prop_assert_eq!(states(&map), naive_frame(&map, &o));
    }

    #[test]
    fn a_projected_frame_frees_the_voxels_whose_centres_are_seen(o in frame(), fine in prop::bool::ANY) {
        let voxel = if fine { VOXEL / 4.0 } else { VOXEL };
        let new_map = || Map::new(&Space { voxel, ..space() }, SensorModel::default()).unwrap();
        let (mut map, mut exact) = (new_map(), new_map());
        prop_assert_eq!(map.insert_projected(&o), exact.insert(&o));
        prop_assert_eq!(map.occupied(), exact.occupied());
        for v in voxels(&map).filter(|&v| map.occupancy(v) != Occupancy::Occupied) {
            if let Some(free) = naively_before(&o, &map.grid().centre(v)) {
                prop_assert_eq!(map.occupancy(v) == Occupancy::Free, free, "{:?}", map.grid().cell(v));
            }
        }
    }

    #[test]
    fn a_cloud_is_inserted_as_the_depth_image_that_it_comes_from(frames in prop::collection::vec(frame(), 1..3)) {
        let (mut of_images, mut of_clouds) = (new_map(), new_map());
        for o in &frames {
            prop_assert_eq!(of_images.insert(o), of_clouds.insert_cloud(&o.eye(), &readings(o)));
        }
        prop_assert_eq!(states(&of_images), states(&of_clouds));
        let mut alone = new_map().of_occupancy_alone();
        frames.iter().for_each(|o| { alone.insert(o); });
        prop_assert_eq!(states(&of_images), states(&alone));
        prop_assert!(alone.points().is_empty() && alone.rear_side().is_empty());
    }

    #[test]
    fn threads_do_not_change_a_map(frames in prop::collection::vec(frame(), 1..4)) {
        let built = |threads, insert: fn(&mut Map, &Observation) -> usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let mut map = new_map();
            pool.install(|| frames.iter().for_each(|o| { insert(&mut map, o); }));
            map
        };
        for insert in [Map::insert, Map::insert_projected] {
            let (one, three) = (built(1, insert), built(3, insert));
            prop_assert!(one == three);
            prop_assert_eq!(one.points(), three.points());
        }
    }

    #[test]
    fn the_order_of_rays_does_not_change_states(o in frame()) {
        let mut mirrored = o.clone();
        mirrored.depth.metres.reverse();
        let half_turn = UnitQuaternion::from_axis_angle(&Vector::z_axis(), std::f64::consts::PI);
        mirrored.world_from_camera *= half_turn;
        let (mut a, mut b) = (new_map(), new_map());
        a.insert(&o);
        b.insert(&mirrored);
        prop_assert_eq!(states(&a), states(&b));
        prop_assert_eq!(a.rear_side(), b.rear_side());
    }

    #[test]
    fn counts_tally_the_states(frames in prop::collection::vec(frame(), 0..4), tagged in prop::collection::vec(0..1728_u32, 0..200)) {
        let mut map = new_map();
        frames.iter().for_each(|o| { map.insert(o); });
        map.tag(3, tagged.into_iter().map(Voxel).collect());
        let c = map.counts();
        let of = |state| voxels(&map).filter(|&v| map.occupancy(v) == state).count() as u64;
        prop_assert_eq!((c.free, c.occupied), (of(Occupancy::Free), of(Occupancy::Occupied)));
        prop_assert_eq!(c.unknown + c.preoccupied, of(Occupancy::Unknown));
        prop_assert_eq!(c.preoccupied, voxels(&map).filter(|&v| map.is_preoccupied(v)).count() as u64);
        prop_assert_eq!(c.preoccupied, map.preoccupied().len() as u64);
    }

    #[test]
    fn sight_lines_meet_what_the_segment_against_every_cube_does(
        map in world(), eye in eye(), tolerance in prop_oneof![Just(0.0), 0.0..0.2_f64], from in 0..64_u32,
    ) {
        let sight = map.visibility().from(&eye);
        let occupied = map.occupied();
        let some = voxels(&map).skip(from as usize).step_by(map.grid().len() as usize / 250);
        // Behind every occupied voxel, where lines are met.
        let behind = occupied.iter().filter_map(|&o| {
            let centre = map.grid().centre(o);
            map.grid().containing(&(centre + (centre - eye) * 0.1))
        });
        for v in some.chain(behind) {
            prop_assert_eq!(sight.sees(v, tolerance), naively_visible(&map, &occupied, &eye, v, tolerance), "{:?}", v);
        }
    }

    #[test]
    fn rear_sides_are_what_their_definition_says(frames in prop::collection::vec(frame(), 1..4)) {
        let mut map = new_map();
        let mut faces = BTreeSet::new();
        for o in &frames {
            let hit: BTreeSet<_> = naive_frame(&map, o).into_iter().zip(voxels(&map))
                .filter(|(s, _)| *s == Occupancy::Occupied).map(|(_, v)| v).collect();
            map.insert(o);
            for v in hit {
                let d = map.grid().centre(v) - o.eye();
                for (k, side) in [(0, 1), (0, -1), (1, 1), (1, -1), (2, 1), (2, -1)] {
                    if d[k] * f64::from(side) > 0.0 {
                        faces.insert((v, k, i64::from(side)));
                    }
                }
            }
        }
        let behind = |&(v, k, side): &(Voxel, usize, i64)| {
            let mut cell = map.grid().cell(v);
            cell[k] += side;
            let next = map.grid().at(cell)?;
            let rear = map.occupancy(v) == Occupancy::Occupied && map.occupancy(next) == Occupancy::Unknown;
            rear.then_some(next)
        };
        let naive: BTreeSet<_> = faces.iter().filter_map(behind).collect();
        prop_assert_eq!(map.rear_side(), naive.into_iter().collect::<Vec<_>>());
    }

    #[test]
    fn measured_points_are_found_where_they_lie(
        frames in prop::collection::vec(frame(), 1..3), p in prop::array::uniform3(-0.4..0.4_f64), radius in 0.0..0.3_f64,
    ) {
        let (mut map, mut kept) = (new_map(), BTreeMap::new());
        for o in &frames {
            map.insert(o);
            for q in readings(o) {
                let twice = [0, 1, 2].map(|k| ((q[k] + SPACE / 2.0) / VOXEL * 2.0).floor() as i64);
                if map.grid().containing(&q).is_some() {
                    kept.entry(twice).or_insert(q);
                }
            }
        }
        let p = Point::from(p);
        let near = kept.values().any(|q| nalgebra::distance(q, &p) <= radius);
        prop_assert_eq!(map.measured_within(&p, radius), near);
    }

    #[test]
    fn the_first_point_of_every_voxel_is_listed(frames in prop::collection::vec(frame(), 1..3)) {
        let (mut map, mut first) = (new_map(), BTreeMap::new());
        let inside: usize = frames.iter().map(|o| map.insert(o)).sum();
        let measured: Vec<_> = frames.iter().flat_map(readings).filter_map(|q| Some((map.grid().containing(&q)?, q))).collect();
        measured.iter().for_each(|(v, q)| { first.entry(*v).or_insert(*q); });
        prop_assert_eq!(inside, measured.len());
        let listed = map.points();
        prop_assert_eq!(listed.len(), first.len());
        prop_assert!(listed.iter().zip(first.values()).all(|(a, b)| (a - b).norm() < 1e-9));
    }

    #[test]
    fn tags_are_what_was_last_said(
        changes in prop::collection::vec((0..4_u32, prop::collection::vec(0..2000_u32, 0..60)), 1..12), o in frame(),
    ) {
        let (mut map, mut said) = (new_map(), BTreeMap::new());
        map.insert(&o);
        for (tag, named) in changes {
            if named.len() % 3 == 0 {
                map.untag(tag);
                said.remove(&tag);
            } else {
                map.tag(tag, named.iter().copied().map(Voxel).collect());
                said.insert(tag, named);
            }
        }
        for v in voxels(&map) {
            let of: Vec<_> = said.iter().filter(|(_, named)| named.contains(&v.0)).map(|(&t, _)| t).collect();
            prop_assert_eq!(map.is_preoccupied(v), !of.is_empty() && map.occupancy(v) == Occupancy::Unknown);
            prop_assert_eq!(map.tags(v), of);
        }
    }

    #[test]
    fn an_octomap_file_holds_the_same_states(frames in prop::collection::vec(frame(), 0..3)) {
        let mut map = new_map();
        frames.iter().for_each(|o| { map.insert(o); });
        let mut file = Vec::new();
        write_bt(&map, &mut file).unwrap();
        let leaves = read_bt(&file, VOXEL);
        for v in voxels(&map) {
            let c = map.grid().centre(v);
            let of: Vec<_> = leaves.iter().filter(|(b, _)| b.contains(&c)).map(|l| l.1).collect();
            let expected = Some(map.occupancy(v)).filter(|s| *s != Occupancy::Unknown);
            prop_assert_eq!(of, expected.into_iter().collect::<Vec<_>>());
        }
    }
}

/// The leaves of an OctoMap binary tree; checks the header's count of nodes.
fn read_bt(file: &[u8], res: f64) -> Vec<(Bounds, Occupancy)> {
    let mark = b"\ndata\n";
    let split = file.windows(mark.len()).position(|w| w == mark).unwrap() + mark.len();
    let header = std::str::from_utf8(&file[..split]).unwrap();
    assert!(header.starts_with("# Octomap OcTree binary file\n"));
    assert!(header.contains("\nid OcTree\n") && header.contains(&format!("\nres {res}\n")));
    let size: usize = header
        .lines()
        .find_map(|l| l.strip_prefix("size "))
        .unwrap()
        .parse()
        .unwrap();
    let (mut leaves, mut rest) = (Vec::new(), &file[split..]);
    let half = 32_768.0 * res;
    let root = Bounds::centred(Point::origin(), Vector::repeat(2.0 * half));
    let nodes = if rest.is_empty() {
        0
    } else {
        read_node(&mut rest, root, &mut leaves)
    };
    assert_eq!((nodes, rest.len()), (size, 0));
    leaves
}

fn read_node(rest: &mut &[u8], node: Bounds, leaves: &mut Vec<(Bounds, Occupancy)>) -> usize {
    let word = u16::from_le_bytes([rest[0], rest[1]]);
    *rest = &rest[2..];
    let quarter = node.size() / 4.0;
    let mut nodes = 1;
    for i in 0..8 {
        let side = Vector::from([0, 1, 2].map(|k| if i >> k & 1 == 1 { 1.0 } else { -1.0 }));
        let child = Bounds::centred(node.centre() + side.component_mul(&quarter), quarter * 2.0);
        match word >> (2 * i) & 3 {
            0b01 => leaves.push((child, Occupancy::Free)),
            0b10 => leaves.push((child, Occupancy::Occupied)),
            0b11 => nodes += read_node(rest, child, leaves) - 1,
            _ => continue,
        }
        nodes += 1;
    }
    nodes
}

#[test]
fn a_ray_frees_its_way_and_occupies_its_end() {
    let mut map = new_map();
    let (eye, end) = (Point::new(1.0, 0.01, 0.01), Point::new(0.01, 0.01, 0.01));
    assert_eq!(map.insert(&one_ray(eye, end)), 1);
    let at = |x: f64| map.occupancy(map.grid().containing(&Point::new(x, 0.01, 0.01)).unwrap());
    assert_eq!(at(0.01), Occupancy::Occupied);
    assert!([0.06, 0.16, 0.29].iter().all(|&x| at(x) == Occupancy::Free));
    assert_eq!(at(-0.04), Occupancy::Unknown);
    let c = map.counts();
    assert_eq!((c.free, c.occupied, c.unknown), (5, 1, 12 * 12 * 12 - 6));
    let behind = map.grid().containing(&Point::new(-0.04, 0.01, 0.01)).unwrap();
    assert!(map.rear_side().contains(&behind));
}

#[test]
fn a_reading_beyond_the_space_only_frees_and_a_missing_one_does_nothing() {
    let mut map = new_map();
    let eye = Point::new(1.0, 0.01, 0.01);
    assert_eq!(map.insert(&one_ray(eye, Point::new(-2.0, 0.01, 0.01))), 0);
    assert_eq!((map.counts().free, map.counts().occupied), (12, 0));
    let mut nothing = one_ray(eye, Point::new(0.0, 0.2, 0.2));
    nothing.depth.metres = vec![0.0];
    let before = map.clone();
    assert_eq!(map.insert(&nothing), 0);
    assert!(map == before);
}

/// OctoMap's shipped model: hit, then three misses until free; a hit and a miss
/// in one frame are a hit.
#[test]
fn looks_add_up_as_in_octomap() {
    let mut map = new_map();
    let (eye, end) = (Point::new(1.0, 0.01, 0.01), Point::new(0.01, 0.01, 0.01));
    let v = map.grid().containing(&end).unwrap();
    map.insert(&one_ray(eye, end));
    assert!((map.probability(v).unwrap() - 0.7).abs() < 1e-3);
    let through = one_ray(eye, Point::new(-1.0, 0.01, 0.01));
    let mut seen = Vec::new();
    for _ in 0..3 {
        map.insert(&through);
        seen.push(map.occupancy(v));
    }
    assert_eq!(seen, [Occupancy::Occupied, Occupancy::Occupied, Occupancy::Free]);
    assert!(
        map.measured_within(&end, 1e-6),
        "a point stays when its voxel turns free"
    );

    let mut both = through.clone();
    (both.depth.width, both.depth.metres) = (2, vec![0.99, 2.0]);
    both.camera.depth.fx = 1e9;
    let mut map = new_map();
    map.insert(&both);
    assert!((map.probability(v).unwrap() - 0.7).abs() < 1e-3);
}

#[test]
fn unusable_observations_change_nothing() {
    let mut map = new_map();
    let mut o = one_ray(Point::new(1.0, 0.0, 0.0), Point::origin());
    o.depth.metres = vec![f32::NAN];
    assert_eq!(map.insert(&o), 0);
    o.depth.metres = vec![1.0];
    o.world_from_camera.translation = Translation3::new(f64::NAN, 0.0, f64::INFINITY);
    assert_eq!((map.insert(&o), map.insert_projected(&o)), (0, 0));
    let beyond = [f64::INFINITY, f64::NAN, 1e300].map(|x| Point::new(x, 0.0, 0.0));
    assert_eq!(map.insert_cloud(&Point::new(1.0, 0.0, 0.0), &beyond), 0);
    assert_eq!(map.insert_cloud(&beyond[2], &[Point::origin()]), 0);
    let mut o = one_ray(Point::new(1.0, 0.0, 0.0), Point::origin());
    for (width, height, metres) in [(0, 0, vec![]), (7, 3, vec![0.0; 5]), (1, 1, vec![f32::INFINITY])] {
        o.depth = DepthImage { width, height, metres };
        map.insert_projected(&o);
    }
    assert_eq!(map.counts().unknown, 1728);
    assert_eq!(map.occupancy(Voxel(u32::MAX)), Occupancy::Unknown);
    assert!(map.tags(Voxel(u32::MAX)).is_empty());
}

#[test]
fn a_wall_hides_what_is_behind_it_and_its_own_thickness_is_tolerated() {
    let wall: Vec<_> = (0..12)
        .flat_map(|y| (0..12).map(move |z| ([6, y, z], [0; 3])))
        .collect();
    let map = world_of(VOXEL, &wall);
    let eye = Point::new(1.01, 0.013, 0.017);
    let sees = |x: i64, tolerance: f64| map.visible(&eye, map.grid().at([x, 5, 5]).unwrap(), tolerance);
    assert!(sees(9, 0.0) && sees(6, 0.0) && !sees(5, 0.0) && !sees(2, 0.0));
    assert!(sees(5, 0.1) && !sees(2, 0.1));
}

/// An oblique plane, densely measured, ξ as small as a voxel: no voxel of it
/// may lack a near point because others were forgotten.
#[test]
fn a_measured_plane_is_near_its_points_everywhere() {
    let eye = Point::new(1.1, 0.2, 0.3);
    let normal = Vector::new(1.0, 1.0, 0.14).normalize();
    let mut o = observation(look_at(eye, Point::origin()), 300, vec![0.0; 300 * 300]);
    for (i, z) in o.depth.metres.iter_mut().enumerate() {
        let ray = o.camera.depth.ray((i % 300) as f64 + 0.5, (i / 300) as f64 + 0.5);
        *z = (-eye.coords.dot(&normal) / (o.world_from_camera * ray).dot(&normal)) as f32;
    }
    let fine = Space { voxel: 0.01, ..space() };
    let mut map = Map::new(&fine, SensorModel::default()).unwrap();
    map.insert(&o);
    let across = normal.cross(&Vector::z()).normalize();
    let up = normal.cross(&across);
    let samples = (-60..60).flat_map(|i| (-60..60).map(move |j| (across * f64::from(i) + up * f64::from(j)) * 0.0025));
    let plane: BTreeSet<_> = samples.filter_map(|p| map.grid().containing(&Point::from(p))).collect();
    let near = plane
        .iter()
        .filter(|v| map.measured_within(&map.grid().centre(**v), 0.01))
        .count();
    assert!(plane.len() > 1000 && near == plane.len(), "{near} of {}", plane.len());
}

/// Through an edge exactly, x is crossed before y.
#[test]
fn a_sight_line_through_an_edge_meets_the_voxel_across_x() {
    let unit = Space {
        centre: Point::origin(),
        size: Vector::repeat(8.0),
        voxel: 1.0,
    };
    let grid = *Map::new(&unit, SensorModel::default()).unwrap().grid();
    let hidden_by = |cell| {
        let mut map = Map::new(&unit, SensorModel::default()).unwrap();
        let end = grid.centre(grid.at(cell).unwrap());
        map.insert(&one_ray(end + Vector::new(0.1, 0.2, 0.3), end));
        !map.visible(&Point::new(8.5, 8.5, 0.5), grid.at([2, 2, 4]).unwrap(), 0.0)
    };
    assert!(hidden_by([3, 2, 4]) && hidden_by([3, 3, 4]) && !hidden_by([2, 3, 4]));
}
