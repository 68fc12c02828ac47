//! Our OctoMap files read by OctoMap's tools, and theirs by us.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::process::Command;

use vpl::geometry::{Point, Pose, Vector};
use vpl::map::{Map, Occupancy, OctoMap, Voxel, write_bt, write_ot};
use vpl::rules::{SensorModel, Space};

use crate::scene;
use crate::support::{folder, inspect, installed, shared};

/// The map of the rendered frames.
fn map() -> Map {
    let space = Space {
        centre: Point::new(0.0, 0.1, 0.2),
        size: Vector::new(1.3, 1.1, 0.9),
        voxel: 0.02,
    };
    let mut map = Map::new(&space, SensorModel::default()).unwrap();
    for frame in scene::frames() {
        map.insert(&frame);
    }
    map
}

fn written(map: &Map, write: impl Fn(&Map, &mut Vec<u8>) -> std::io::Result<()>) -> Vec<u8> {
    let mut bytes = Vec::new();
    write(map, &mut bytes).unwrap();
    bytes
}

/// Log-odds by the key of each voxel; leaves of many voxels are cut up.
pub fn voxels(tree: &OctoMap) -> BTreeMap<[u32; 3], f32> {
    let mut voxels = BTreeMap::new();
    for leaf in &tree.leaves {
        let edge = 1_u32 << leaf.height;
        let [x, y, z] = leaf.key.map(u32::from);
        for i in 0..edge * edge * edge {
            let at = [x + i % edge, y + i / edge % edge, z + i / edge / edge];
            assert!(voxels.insert(at, leaf.log_odds).is_none(), "two leaves at {at:?}");
        }
    }
    voxels
}

/// What a tree should hold of a map.
fn expected(map: &Map) -> BTreeMap<[u32; 3], f64> {
    let grid = map.grid();
    let voxel = |n: u32| {
        let p = map.probability(Voxel(n))?;
        let (cell, first) = (
            grid.cell(Voxel(n)),
            [0, 1, 2].map(|k| (grid.origin[k] / grid.voxel).round() as i64),
        );
        Some(([0, 1, 2].map(|k| (cell[k] + first[k] + 32768) as u32), p))
    };
    (0..grid.len()).filter_map(voxel).collect()
}

#[test]
fn files_hold_every_measured_voxel() {
    let map = map();
    let states = voxels(&OctoMap::read(&written(&map, write_bt)).unwrap());
    let tree = OctoMap::read(&written(&map, write_ot)).unwrap();
    let (odds, expected) = (voxels(&tree), expected(&map));
    assert!(expected.len() > 10_000);
    assert!(expected.keys().eq(states.keys()) && expected.keys().eq(odds.keys()));
    for (key, p) in &expected {
        assert_eq!(states[key] > 0.0, *p >= 0.5, "{key:?}");
        let read = 1.0 / (1.0 + f64::from(-odds[key]).exp());
        assert!((read - p).abs() < 1e-6, "{key:?}: {read} for {p}");
    }
    // Occupancy and probability tell the same story.
    let occupied = (0..map.grid().len())
        .filter(|n| map.occupancy(Voxel(*n)) == Occupancy::Occupied)
        .count();
    assert_eq!(occupied, states.values().filter(|x| **x > 0.0).count());
}

/// A frame by a ray to every reading, against sets of voxels made one by one.
#[test]
fn a_ray_to_every_reading_misses_what_it_passes_and_hits_win() {
    let (centre, size) = (Point::new(0.0, 0.1, 0.2), Vector::new(1.3, 1.1, 0.9));
    let voxel = 0.017; // No face of the scene lies on a border.
    let mut map = Map::new(&Space { centre, size, voxel }, SensorModel::default()).unwrap();
    let frame = scene::frames().remove(1);
    map.insert_every_ray(&frame);
    let (grid, eye) = (*map.grid(), frame.eye());
    let (mut hit, mut passed) = (BTreeSet::new(), BTreeSet::new());
    let pixels = (0..frame.depth.height).flat_map(|v| (0..frame.depth.width).map(move |u| (u, v)));
    for p in pixels.filter_map(|(u, v)| frame.point(u, v)) {
        passed.extend(grid.along(&eye, &p));
        hit.extend(grid.containing(&p));
    }
    let expected = |voxel: &Voxel| match (hit.contains(voxel), passed.contains(voxel)) {
        (true, _) => Occupancy::Occupied,
        (false, true) => Occupancy::Free,
        (false, false) => Occupancy::Unknown,
    };
    let wrong = (0..grid.len())
        .map(Voxel)
        .filter(|v| map.occupancy(*v) != expected(v))
        .count();
    assert!(
        hit.len() > 500 && passed.len() > 5000,
        "{} hit, {} passed",
        hit.len(),
        passed.len()
    );
    assert!(wrong < 5, "{wrong} voxels differ");
}

#[test]
fn an_empty_map_is_an_empty_tree() {
    let space = Space {
        voxel: 0.1,
        ..*simple()
    };
    let map = Map::new(&space, SensorModel::default()).unwrap();
    for bytes in [written(&map, write_bt), written(&map, write_ot)] {
        let tree = OctoMap::read(&bytes).unwrap();
        assert!(tree.leaves.is_empty() && tree.nodes == 0);
    }
}

fn simple() -> Box<Space> {
    let (centre, size) = (Point::origin(), Vector::repeat(1.0));
    Box::new(Space {
        centre,
        size,
        voxel: 0.1,
    })
}

/// Every prefix of a file is refused, and so is a tree that is too deep.
#[test]
fn a_broken_tree_is_refused() {
    for bytes in [written(&map(), write_bt), written(&map(), write_ot)] {
        for length in (0..bytes.len() - 1).step_by(97) {
            assert!(OctoMap::read(&bytes[..length]).is_err(), "{length}");
        }
    }
    let head = "# Octomap OcTree binary file\nid OcTree\nsize 40\nres 0.1\ndata\n";
    let deep = [head.as_bytes(), &[3; 400]].concat();
    let error = OctoMap::read(&deep).unwrap_err().to_string();
    assert!(
        error.contains("deeper than 16 levels") || error.contains("ends within"),
        "{error}"
    );
    for (id, words) in [
        ("OcTreeStamped", "of the kind `OcTreeStamped`"),
        ("OcTree\nres -1", "not above 0"),
    ] {
        let text = format!("# Octomap OcTree file\nid {id}\nsize 0\nres 0.1\ndata\n");
        let error = OctoMap::read(text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
}

fn convert(from: &Path, to: &Path) {
    let output = Command::new("convert_octree").args([from, to]).output().unwrap();
    assert!(output.status.success() && to.exists(), "{output:?}");
}

/// Through OctoMap's own reader and writer, every voxel comes back.
#[test]
fn octomaps_tools_read_ours_and_we_theirs() {
    if !installed("convert_octree") {
        return;
    }
    let (base, map) = (folder("octomap"), map());
    fs::write(base.join("ours.bt"), written(&map, write_bt)).unwrap();
    fs::write(base.join("ours.ot"), written(&map, write_ot)).unwrap();
    let read = |name: &str| OctoMap::read(&fs::read(base.join(name)).unwrap()).unwrap();
    for (from, to) in [
        ("ours.bt", "from_bt.ot"),
        ("ours.ot", "from_ot.ot"),
        ("ours.ot", "from_ot.bt"),
    ] {
        convert(&base.join(from), &base.join(to));
        let (ours, theirs) = (voxels(&read(from)), voxels(&read(to)));
        assert!(ours.keys().eq(theirs.keys()), "{from} to {to}");
        for (key, value) in &ours {
            let same = if to.ends_with("from_ot.ot") {
                (value - theirs[key]).abs() < 1e-6
            } else {
                (*value >= 0.0) == (theirs[key] >= 0.0)
            };
            assert!(same, "{from} to {to} at {key:?}: {value} and {}", theirs[key]);
        }
    }
    // Node for node: their copy of our states is our file, their header aside.
    let theirs = fs::read(base.join("from_ot.bt")).unwrap();
    assert_eq!(OctoMap::read(&theirs).unwrap(), read("ours.bt"));
    let vrml = Command::new("bt2vrml").arg(base.join("ours.bt")).output().unwrap();
    assert!(vrml.status.success());
}

/// The samples of others: their counts, by another reader.
#[test]
fn samples_of_others_are_read() {
    let Some(base) = shared("octomap") else { return };
    let read = |name: &str| OctoMap::read(&fs::read(base.join(name)).unwrap()).unwrap();
    let frei = read("geb079.bt");
    assert_eq!((frei.nodes, frei.resolution), (532_566, 0.08));
    // Unknown space is stored as p = 0.5 here: three states.
    for (name, free, unknown, occupied) in [
        ("octomap0.ot", 891, 7205, 253),
        ("octomap5.ot", 7124, 3868, 492),
        ("GT.ot", 0, 0, 11_136),
    ] {
        let tree = read(&format!("nbv-armadillo/{name}"));
        let count = |holds: &dyn Fn(f64) -> bool| tree.leaves.iter().filter(|l| holds(l.probability())).count();
        let found = (
            count(&|p| p <= 0.45),
            count(&|p| p > 0.45 && p < 0.65),
            count(&|p| p >= 0.65),
        );
        assert_eq!(found, (free, unknown, occupied), "{name}");
    }
    let sample = base.join("nbv-armadillo/octomap0.ot");
    inspect(&sample, &[]).expect(0, &["ColorOcTree", "10 mm", "exactly even (p = 0.5)"]);
}

/// A converted sample of others, leaf by leaf.
#[test]
fn a_converted_sample_is_the_same_map() {
    let Some(sample) = shared("octomap/geb079.bt") else {
        return;
    };
    if !installed("convert_octree") {
        return;
    }
    let out = folder("geb079").join("geb079.ot");
    convert(&sample, &out);
    let (theirs, ours) = (
        OctoMap::read(&fs::read(&out).unwrap()).unwrap(),
        OctoMap::read(&fs::read(&sample).unwrap()).unwrap(),
    );
    assert_eq!(theirs.leaves.len(), ours.leaves.len());
    for (a, b) in theirs.leaves.iter().zip(&ours.leaves) {
        assert!((a.key, a.height, a.log_odds > 0.0) == (b.key, b.height, b.log_odds > 0.0));
    }
}

#[test]
fn a_map_of_frames_can_be_written_in_both_forms() {
    let base = folder("forms");
    let path = base.join("set");
    scene::write("transforms", &path, &scene::frames(), Pose::clone);
    let [bt, ot] = ["map.bt", "map.ot"].map(|name| base.join(name));
    for out in [&bt, &ot] {
        inspect(&path, &["--voxel", "20mm", "--map", out.to_str().unwrap()]).expect(0, &["voxels of 20 mm"]);
    }
    let [states, odds] = [&bt, &ot].map(|out| voxels(&OctoMap::read(&fs::read(out).unwrap()).unwrap()));
    assert!(states.iter().all(|(key, x)| (*x > 0.0) == (odds[key] >= 0.0)) && states.len() == odds.len());
    inspect(&ot, &[]).expect(0, &["OctoMap, OcTree", "20 mm"]);
}
