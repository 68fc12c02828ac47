//! What others recorded, where it is at hand: `../shared/data`, or `VPL_DATA`.

use std::fs;

use serde_json::json;
use vpl::map::OctoMap;
use vpl::sense::frames::{FrameOptions, Recording, agreement};

use crate::octomap::voxels;
use crate::plan::{plan, records};
use crate::support::{folder, inspect, shared};

const SLAMBOOK: [&str; 4] = ["--intrinsics", "518,519,325.5,253.5", "--max-depth", "7m"];
const CASTLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/castle.vpl");
const ROOM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/room.vpl");
const BLOCKS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/blocks.vpl");

/// OctoMap's own map of the same frames, in all voxels but those that rounding decides.
#[test]
fn the_map_of_slambook_is_octomaps() {
    let Some(path) = shared("rgbd/slambook5") else { return };
    let out = folder("slambook").join("ours.bt");
    let options = [&SLAMBOOK[..], &["--map", out.to_str().unwrap()]].concat();
    inspect(&path, &options).expect(0, &["frames agree", "5"]);
    let read = |path: &std::path::Path| voxels(&OctoMap::read(&fs::read(path).unwrap()).unwrap());
    let (ours, theirs) = (read(&out), read(&path.join("octomap.bt")));
    let differ = |a: &std::collections::BTreeMap<[u32; 3], f32>, b: &std::collections::BTreeMap<[u32; 3], f32>| {
        a.iter()
            .filter(|(key, x)| b.get(*key).map(|y| *y > 0.0) != Some(**x > 0.0))
            .count()
    };
    let (here, there) = (differ(&ours, &theirs), differ(&theirs, &ours));
    eprintln!(
        "{} voxels of ours and {} of theirs; {here} and {there} differ",
        ours.len(),
        theirs.len()
    );
    // OctoMap computes in 32-bit floats: a ray through an edge goes one way or the other.
    assert!(
        here.max(there) * 10_000 < theirs.len(),
        "{here} and {there} of {}",
        theirs.len()
    );
}

#[test]
fn frames_of_others_agree_as_was_measured_of_them() {
    if let Some(path) = shared("rgbd/slambook5") {
        let options = FrameOptions {
            intrinsics: Some([518.0, 519.0, 325.5, 253.5]),
            max_depth: Some(7.0),
            ..FrameOptions::default()
        };
        // What the data's README says of each pair, measured the other way round.
        let pairs = agreement(&Recording::open(&path, &options).unwrap(), 10).unwrap();
        for (pair, millimetres) in pairs.iter().zip([64.0, 47.0, 41.0, 25.0]) {
            let found = pair.difference.unwrap() * 1000.0;
            assert!(
                (0.6..1.2).contains(&(found / millimetres)),
                "{found} mm for {millimetres}"
            );
        }
    }
    let Some(path) = shared("rgbd/castle-simu") else { return };
    let rows = [
        [1.0, 0.0, 0.0, -0.05],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ];
    let calibration = folder("castle_agrees").join("calibration.json");
    fs::write(&calibration, json!({"depth_from_colour": rows}).to_string()).unwrap();
    let difference = |calibration: Option<std::path::PathBuf>| {
        let options = FrameOptions {
            calibration,
            ..FrameOptions::default()
        };
        let pairs = agreement(&Recording::open(&path, &options).unwrap(), 10).unwrap();
        assert_eq!(pairs.len(), 7);
        pairs.iter().map(|p| p.difference.unwrap()).fold(0.0, f64::max)
    };
    let (with, without) = (difference(Some(calibration)), difference(None));
    assert!(with < 0.0005, "{with}");
    assert!(without > 0.005, "{without}");
    inspect(&path, &[]).expect(0, &["`depth_from_colour` is not stated"]);
}

/// The pair of TUM's frames, in TUM's layout, with the motion that odometry found.
#[test]
fn a_pair_of_tum_agrees() {
    let Some(pair) = shared("rgbd/tum-pair") else { return };
    let base = folder("tum_freiburg2_pair");
    for name in ["1.png", "1_depth.png", "2.png", "2_depth.png"] {
        fs::copy(pair.join(name), base.join(name)).unwrap();
    }
    fs::write(base.join("rgb.txt"), "1.0 1.png\n2.0 2.png\n").unwrap();
    fs::write(base.join("depth.txt"), "1.0 1_depth.png\n2.0 2_depth.png\n").unwrap();
    let m = nalgebra::Matrix3::new(0.998, -0.0494, 0.0395, 0.0486, 0.9986, 0.0214, -0.0405, -0.0194, 0.999);
    let second_from_first = vpl::geometry::Pose::from_parts(
        vpl::geometry::Vector::new(-0.1267, -0.0027, 0.0548).into(),
        nalgebra::UnitQuaternion::from_matrix(&m),
    );
    let pose = second_from_first.inverse();
    let (t, q) = (pose.translation.vector, pose.rotation);
    let line = format!(
        "1.0 0 0 0 0 0 0 1\n2.0 {} {} {} {} {} {} {}\n",
        t.x, t.y, t.z, q.i, q.j, q.k, q.w
    );
    fs::write(base.join("groundtruth.txt"), line).unwrap();
    inspect(&base, &[]).expect(0, &["published for freiburg2", "raw / 5000", "frames agree"]);
    let pairs = agreement(&Recording::open(&base, &FrameOptions::default()).unwrap(), 1).unwrap();
    assert!(pairs[0].difference.unwrap() < 0.010, "{pairs:?}");
    inspect(&base, &["--depth-scale", "1000"]).expect(0, &["likely mistake", "--depth-scale 5000"]);
}

/// A scene of polyhedra with exact poses, two cameras and grey pictures.
#[test]
fn the_castle_is_planned_among_its_frames() {
    let Some(path) = shared("rgbd/castle-simu") else { return };
    let base = folder("castle");
    let rows = [
        [1.0, 0.0, 0.0, -0.05],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ];
    let calibration = base.join("castle.json");
    fs::write(&calibration, json!({"depth_from_colour": rows}).to_string()).unwrap();
    let log = base.join("run.jsonl");
    let ran = plan(CASTLE, &path, &log, &["--calibration", calibration.to_str().unwrap()]);
    assert!(matches!(ran.status, Some(0 | 3)), "{}", ran.err);
    assert!(
        !ran.err.contains("warning") && !ran.err.contains("the camera is the recording's"),
        "{}",
        ran.err
    );
    let records = records(&log);
    assert_eq!(records[0]["candidates"], 8);
    let last = &records[records.len() - 2];
    let walls = last["features"]["wall"]["instances"].as_array().unwrap();
    assert!(walls.iter().filter(|w| w["state"] == 1).count() >= 3, "{walls:?}");
    assert!(records.last().unwrap()["coverage"].is_null());
}

#[test]
fn the_dining_room_is_planned_among_its_frames() {
    let Some(path) = shared("rgbd/slambook5") else { return };
    let log = folder("room").join("run.jsonl");
    let ran = plan(ROOM, &path, &log, &SLAMBOOK[..2]);
    assert!(matches!(ran.status, Some(0 | 3)), "{}", ran.err);
    let records = records(&log);
    assert_eq!(records[0]["candidates"], 5);
    assert!(records[1]["points"].as_u64().unwrap() > 10_000);
}

/// One real organised cloud, without tf.
#[test]
fn the_bag_with_a_cloud_is_read_and_planned() {
    let Some(path) = shared("logs/perception_tutorial.bag") else {
        return;
    };
    let words = [
        "640 × 480",
        "fx 525.00, fy 525.00, cx 319.50, cy 239.50 (by its points)",
        "camera_rgb_optical_frame",
    ];
    inspect(&path, &[]).expect(0, &words);
    let base = folder("bag");
    let task = fs::read_to_string(BLOCKS)
        .unwrap()
        .replace("[0 mm, 0 mm, 200 mm]", "[0 mm, 0 mm, 1400 mm]");
    fs::write(base.join("can.vpl"), task).unwrap();
    let log = base.join("run.jsonl");
    let ran = plan(base.join("can.vpl").to_str().unwrap(), &path, &log, &[]);
    assert!(matches!(ran.status, Some(0 | 3)), "{}", ran.err);
    let records = records(&log);
    assert_eq!(records[0]["candidates"], 1);
    assert!(records[1]["points"].as_u64().unwrap() > 1000);
    assert_eq!(records[1]["features"]["face"]["state"], 1, "the floor is a plane");
}

/// One frame in BOP's notation.
#[test]
fn a_single_frame_of_bop_is_read() {
    let Some(path) = shared("rgbd/lmo-frame") else { return };
    inspect(&path, &[]).expect(0, &["fx 572.41, fy 573.57", "raw / 1000", "one frame without a pose"]);
}
