//! The map against OctoMap 1.9.7: the same clouds give the same occupied and free
//! voxels, every one.
//!
//! Digests of what OctoMap gives are stored, so they are compared anywhere. Where
//! `g++` and OctoMap's headers are installed (Debian: `liboctomap-dev`), OctoMap
//! itself is asked, and has to give the stored digests, too.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;

use sha2::{Digest, Sha256};
use vpl::geometry::{Point, Vector};
use vpl::map::{Map, Occupancy, Voxel};
use vpl::rules::{SensorModel, Space};

/// An eye and what it measured.
type Cloud = (Point, Vec<Point>);

/// OctoMap's keys of measured voxels; whether they are occupied.
type Voxels = BTreeMap<[u16; 3], bool>;

struct Case {
    name: &'static str,
    voxel: f64,
    clouds: Vec<Cloud>,
    /// The first half of the SHA-256 of OctoMap's voxels.
    digest: &'static str,
}

/// Numbers that look random and are the same everywhere (Steele et al. 2014).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let a = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let b = (a ^ (a >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        b ^ (b >> 31)
    }

    /// In −half..half, of OctoMap's precision.
    fn number(&mut self, half: f64) -> f64 {
        let share = (self.bits() >> 40) as f64 / f64::from(1 << 24);
        f64::from(((2.0 * share - 1.0) * half) as f32)
    }

    fn point(&mut self, half: f64) -> Point {
        Point::new(self.number(half), self.number(half), self.number(half))
    }
}

/// Points anywhere, seen from anywhere.
fn scattered(seed: u64, clouds: usize, points: usize, half: f64) -> Vec<Cloud> {
    let mut random = Random(seed);
    let mut cloud = |_| (random.point(half), (0..points).map(|_| random.point(half)).collect());
    (0..clouds).map(&mut cloud).collect()
}

/// Eyes and points on borders, edges and corners of voxels and on diagonals.
fn aligned(voxel: f64) -> Vec<Cloud> {
    let steps = [-7.0, -4.0, -1.0, -0.5, 0.0, 0.5, 2.0, 5.0];
    let cells = (0..8 * 8 * 8).map(|i| [steps[i % 8], steps[i / 8 % 8], steps[i / 64]]);
    let points: Vec<_> = cells.map(|cell| Point::from(cell) * voxel).collect();
    let eyes = [
        (0.0, 0.0, 0.0),
        (9.0, 9.0, 9.0),
        (-9.5, 9.5, 0.5),
        (0.5, 0.5, -9.0),
        (3.0, -3.0, 0.0),
    ];
    eyes.map(|(x, y, z)| (Point::new(x, y, z) * voxel, points.clone()))
        .to_vec()
}

/// A bumpy sphere from eyes around it: frames as a robot takes them.
fn looked_at(views: usize, rays: usize) -> Vec<Cloud> {
    let mut random = Random(7);
    let surface = |d: Vector| Point::from(d * (0.2 + 0.02 * (9.0 * d.x).sin() * (7.0 * d.z).cos()));
    let mut cloud = |_| {
        let eye = Point::from(random.point(1.0).coords.normalize() * 0.8);
        let facing = |d: &Vector| d.dot(&eye.coords) > 0.3;
        let directions = (0..rays).map(|_| random.point(1.0).coords.normalize()).filter(facing);
        (eye, directions.map(surface).collect())
    };
    (0..views).map(&mut cloud).collect()
}

fn cases() -> Vec<Case> {
    let case = |name, voxel, clouds, digest| Case {
        name,
        voxel,
        clouds,
        digest,
    };
    vec![
        case(
            "scattered",
            0.05,
            scattered(1, 4, 300, 0.9),
            "59191ed9a1193d329c4a7c3c797ca245",
        ),
        case(
            "a voxel that is no sum of powers of two",
            0.03,
            scattered(2, 6, 500, 0.9),
            "b6c74944bcf644e498bca4bf9b22dabc",
        ),
        case(
            "a few large voxels",
            0.3,
            scattered(3, 20, 40, 0.9),
            "672992bd1a9ab2c50bf9dec7a0cb4d4b",
        ),
        case("aligned", 0.0625, aligned(0.0625), "bfa1f6eae53447ff2b3e0d39511f9b40"),
        case(
            "aligned but for rounding",
            0.07,
            aligned(0.07),
            "26a4bdf4f59ee920a739fa1d8343d002",
        ),
        case("frames", 0.01, looked_at(12, 4000), "61269e4a3328b7b80aefbb665725204f"),
    ]
}

/// Everything in all clouds lies in it.
const WHOLE: f64 = 2.0;

/// Voxels that the map knows in a cube about the origin.
fn ours(case: &Case, size: f64) -> Voxels {
    let space = Space {
        centre: Point::origin(),
        size: Vector::repeat(size),
        voxel: case.voxel,
    };
    let mut map = Map::new(&space, SensorModel::default()).unwrap().of_occupancy_alone();
    case.clouds.iter().for_each(|(eye, points)| {
        map.insert_cloud(eye, points);
    });
    let key = |v: Voxel| {
        let cell = map.grid().cell(v);
        [0, 1, 2].map(|k| ((map.grid().origin[k] / case.voxel).round() as i64 + cell[k] + 32_768) as u16)
    };
    let voxels = (0..map.grid().len()).map(Voxel).map(|v| (v, map.occupancy(v)));
    let known = voxels.filter(|(_, state)| *state != Occupancy::Unknown);
    known.map(|(v, state)| (key(v), state == Occupancy::Occupied)).collect()
}

/// Over keys, ascending, and states.
fn digest(voxels: &Voxels) -> String {
    let mut sha = Sha256::new();
    for (key, occupied) in voxels {
        key.iter().for_each(|k| sha.update(k.to_le_bytes()));
        sha.update([u8::from(*occupied)]);
    }
    sha.finalize()[..16].iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The program that asks OctoMap; `None` where it cannot be built.
fn reference() -> Option<&'static Path> {
    static BUILT: OnceLock<Option<PathBuf>> = OnceLock::new();
    let build = || {
        let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("octomap_reference");
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/octomap/reference.cpp");
        let mut compiler = Command::new("g++");
        compiler
            .args(["-O2", "-o"])
            .arg(&program)
            .arg(source)
            .args(["-loctomap", "-loctomath"]);
        let built = compiler
            .stderr(Stdio::null())
            .status()
            .is_ok_and(|status| status.success());
        if !built {
            eprintln!("SKIPPED: OctoMap itself is not asked, g++ or liboctomap-dev is missing");
        }
        built.then_some(program)
    };
    BUILT.get_or_init(build).as_deref()
}

/// What OctoMap makes of a case.
fn octomap(program: &Path, case: &Case) -> Voxels {
    let mut bytes = case.voxel.to_le_bytes().to_vec();
    let count = |bytes: &mut Vec<u8>, n: usize| bytes.extend((n as u32).to_le_bytes());
    let point = |bytes: &mut Vec<u8>, p: &Point| p.iter().for_each(|c| bytes.extend((*c as f32).to_le_bytes()));
    count(&mut bytes, case.clouds.len());
    for (eye, points) in &case.clouds {
        point(&mut bytes, eye);
        count(&mut bytes, points.len());
        points.iter().for_each(|p| point(&mut bytes, p));
    }
    let mut child = Command::new(program)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(&bytes).unwrap();
    let out = child.wait_with_output().unwrap();
    assert!(out.status.success());
    let voxels = out.stdout.chunks(8).map(|voxel| {
        let word = |i: usize| u16::from_le_bytes([voxel[2 * i], voxel[2 * i + 1]]);
        ([word(0), word(1), word(2)], word(3) == 1)
    });
    voxels.collect()
}

#[test]
fn clouds_give_the_voxels_that_octomap_gives() {
    for case in cases() {
        let voxels = ours(&case, WHOLE);
        assert!(voxels.values().any(|&occupied| occupied) && voxels.values().any(|&occupied| !occupied));
        if let Some(program) = reference() {
            let theirs = octomap(program, &case);
            let differing = voxels
                .iter()
                .filter(|(key, state)| theirs.get(*key) != Some(state))
                .count();
            assert_eq!((differing, voxels.len()), (0, theirs.len()), "{}", case.name);
        }
        assert_eq!(digest(&voxels), case.digest, "{}", case.name);
    }
}

/// A space that holds neither eyes nor all points clips what OctoMap gives.
#[test]
fn a_smaller_space_gives_the_voxels_of_octomap_inside() {
    for case in cases() {
        for size in [0.1, 0.5] {
            let half = (size / 2.0 / case.voxel - 1e-6).ceil() as i32;
            let inside = |key: &[u16; 3]| key.iter().all(|&k| (-half..half).contains(&(i32::from(k) - 32_768)));
            let whole = ours(&case, WHOLE).into_iter().filter(|(key, _)| inside(key));
            assert!(ours(&case, size) == whole.collect(), "{} in {size} m", case.name);
        }
    }
}
