//! Each importer with a corrupted, a truncated and a mistaken recording: what is
//! said of it.

use std::fs;
use std::path::{Path, PathBuf};

use vpl::geometry::{Pose, Rotation, Vector};

use crate::ros;
use crate::scene;
use crate::support::{folder, inspect, vpl};

/// What `vpl inspect` says, without the folder's name: the error, or the verdict
/// on a recording that can be read.
fn said(path: &Path, options: &[&str]) -> String {
    let ran = inspect(path, options);
    let text = match ran.status {
        Some(0) => ran.out.rsplit("\n\n").next().unwrap_or_default().to_owned(),
        _ => ran.err,
    };
    let text = text.replace(path.to_str().unwrap(), "DATASET");
    // Where a line of JSON breaks depends on how long its numbers are.
    let mut parts = text.split(" column ");
    let first = parts.next().unwrap_or_default().to_owned();
    let masked = parts.map(|rest| format!(" column N{}", rest.trim_start_matches(|c: char| c.is_ascii_digit())));
    (first + &masked.collect::<String>()).trim_end().to_owned()
}

/// A fresh recording that one thing is done to.
fn case(layout: &str, name: &str, change: impl FnOnce(&Path)) -> String {
    let path = folder(&format!("refused/{layout}_{name}"));
    scene::write(layout, &path, &scene::frames(), Pose::clone);
    change(&path);
    format!("{name}: {}\n", said(&path, scene::options(layout)))
}

/// A recording whose poses are another convention's.
fn mistaken(layout: &str, options: &[&str], poses: impl Fn(&Pose) -> Pose) -> String {
    let path = folder(&format!("refused/{layout}_mistaken"));
    scene::write(layout, &path, &scene::frames(), poses);
    format!(
        "mistaken: {}\n",
        said(&path, &[scene::options(layout), options].concat())
    )
}

fn edit(path: PathBuf, from: &str, to: &str) {
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains(from), "{text}");
    fs::write(path, text.replacen(from, to, 1)).unwrap();
}

/// Keeps the first half.
fn halve(path: PathBuf) {
    let bytes = fs::read(&path).unwrap();
    fs::write(path, &bytes[..bytes.len() / 2]).unwrap();
}

/// Cuts a text off before its first `word`.
fn cut_before(path: PathBuf, word: &str) {
    let text = fs::read_to_string(&path).unwrap();
    fs::write(path, &text[..text.find(word).unwrap()]).unwrap();
}

/// Cuts the last line off after some words.
fn cut_last_line(path: PathBuf, words: usize) {
    let text = fs::read_to_string(&path).unwrap();
    let (before, last) = text.trim_end().rsplit_once('\n').unwrap();
    let kept: Vec<&str> = last.split(' ').take(words).collect();
    fs::write(path, format!("{before}\n{}", kept.join(" "))).unwrap();
}

/// y and z of the camera turned over.
fn other_axes(pose: &Pose) -> Pose {
    pose * Rotation::from_axis_angle(&Vector::x_axis(), std::f64::consts::PI)
}

#[test]
fn slambook() {
    let text = [
        case("slambook", "corrupted", |p| {
            edit(p.join("pose.txt"), "0.9 0 0.5", "0.9 zero 0.5")
        }),
        case("slambook", "truncated", |p| halve(p.join("depth/2.png"))),
        case("slambook", "a number too few", |p| cut_last_line(p.join("pose.txt"), 5)),
        mistaken("slambook", &[], Pose::inverse),
    ];
    insta::assert_snapshot!(text.concat());
}

#[test]
fn tum() {
    let text = [
        case("tum", "corrupted", |p| {
            edit(p.join("groundtruth.txt"), "0.9 0 0.5", "0.9 0 nan")
        }),
        case("tum", "truncated", |p| cut_last_line(p.join("groundtruth.txt"), 3)),
        case("tum", "another clock", |p| {
            edit(
                p.join("depth.txt"),
                "0.000 depth/0.png\n0.100 depth/1.png\n0.200 depth/2.png\n0.300",
                "9.0 depth/0.png\n9.3",
            )
        }),
        mistaken("tum", &["--depth-scale", "1000"], Pose::clone),
    ];
    insta::assert_snapshot!(text.concat());
}

#[test]
fn seven_scenes() {
    let text = [
        case("seven_scenes", "corrupted", |p| {
            fs::write(p.join("frame-000001.pose.txt"), "1 0 0 0\n0 1 0 0\n0 0 -1 0\n0 0 0 1\n").unwrap()
        }),
        case("seven_scenes", "truncated", |p| {
            cut_last_line(p.join("frame-000001.pose.txt"), 2)
        }),
        case("seven_scenes", "colour for depth", |p| {
            fs::copy(p.join("frame-000000.color.png"), p.join("frame-000000.depth.png"))
                .map(drop)
                .unwrap();
        }),
        mistaken("seven_scenes", &[], other_axes),
    ];
    insta::assert_snapshot!(text.concat());
}

#[test]
fn redwood() {
    let text = [
        case("redwood", "corrupted", |p| {
            edit(p.join("trajectory.log"), "1 1 2", "1.5 1 2")
        }),
        case("redwood", "truncated", |p| cut_last_line(p.join("trajectory.log"), 0)),
        case("redwood", "a picture too few", |p| {
            fs::remove_file(p.join("depth/000003.png")).unwrap()
        }),
        mistaken("redwood", &[], Pose::inverse),
    ];
    insta::assert_snapshot!(text.concat());
}

#[test]
fn bop() {
    let text = [
        case("bop", "corrupted", |p| {
            edit(p.join("scene_camera.json"), "\"cam_K\"", "\"cam_k\"")
        }),
        case("bop", "truncated", |p| {
            cut_before(p.join("scene_camera.json"), "\"cam_R_w2c\"")
        }),
        case("bop", "no poses", |p| {
            edit(p.join("scene_camera.json"), "cam_R_w2c", "rotation");
        }),
        mistaken("bop", &[], Pose::inverse),
    ];
    insta::assert_snapshot!(text.concat());
}

#[test]
fn visp() {
    let text = [
        case("visp", "corrupted", |p| {
            let file = p.join("Depth/Depth_0001.bin");
            let mut bytes = fs::read(&file).unwrap();
            bytes[2] = 0xff;
            fs::write(file, bytes).unwrap();
        }),
        case("visp", "truncated", |p| halve(p.join("Depth/Depth_0002.bin"))),
        case("visp", "no intrinsics", |p| {
            fs::remove_dir_all(p.join("Config")).unwrap()
        }),
        mistaken("visp", &[], |p| other_axes(p).inverse()),
    ];
    insta::assert_snapshot!(text.concat());
}

#[test]
fn transforms() {
    let text = [
        case("transforms", "corrupted", |p| {
            edit(p.join("transforms.json"), "fl_x", "focal")
        }),
        case("transforms", "truncated", |p| {
            cut_before(p.join("transforms.json"), "\"transform_matrix\"")
        }),
        case("transforms", "a picture is missing", |p| {
            fs::remove_file(p.join("depth/1.png")).unwrap()
        }),
        mistaken("transforms", &[], other_axes),
    ];
    insta::assert_snapshot!(text.concat());
}

#[test]
fn bag() {
    let (base, frames) = (folder("refused/bag"), scene::frames());
    let path = base.join("run.bag");
    let mut text = String::new();
    let mut say = |name: &str, change: &dyn Fn(Vec<u8>) -> Vec<u8>| {
        ros::write_bag(&path, &ros::images(&frames, false, Pose::clone));
        let bytes = fs::read(&path).unwrap();
        fs::write(&path, change(bytes)).unwrap();
        text += &format!("{name}: {}\n", said(&path, &[]));
    };
    say("corrupted", &|b| [&b"#ROSBAG V1.2\n"[..], &b[13..]].concat());
    say("broken inside", &|mut b| {
        b[4200..4300].fill(0xff);
        b
    });
    say("truncated", &|b| b[..b.len() / 2].to_vec());
    say("without its index", &|mut b| {
        let at = b.windows(10).position(|w| w == b"index_pos=").unwrap() + 10;
        b[at..at + 8].fill(0);
        b
    });
    ros::write_bag(&path, &ros::images(&frames, false, Pose::inverse));
    text += &format!("mistaken: {}\n", said(&path, &[]));
    let without: Vec<_> = ros::images(&frames, false, Pose::clone)
        .into_iter()
        .filter(|m| !m.topic.starts_with("/tf"))
        .collect();
    ros::write_bag(&path, &without);
    text += &format!("without tf: {}\n", said(&path, &[]));
    insta::assert_snapshot!(text);
}

#[test]
fn mcap() {
    let (base, frames) = (folder("refused/mcap"), scene::frames());
    let path = base.join("run.mcap");
    let mut text = String::new();
    let mut say = |name: &str, change: &dyn Fn(Vec<u8>) -> Vec<u8>| {
        ros::write_mcap(&path, &ros::images(&frames, true, Pose::clone));
        let bytes = fs::read(&path).unwrap();
        fs::write(&path, change(bytes)).unwrap();
        text += &format!("{name}: {}\n", said(&path, &[]));
    };
    say("corrupted", &|b| [&b"\x89PCAP0\r\n"[..], &b[8..]].concat());
    say("truncated", &|b| b[..b.len() / 2].to_vec());
    let mut messages = ros::images(&frames, true, Pose::clone);
    messages[3].data.truncate(40);
    ros::write_mcap(&path, &messages);
    text += &format!("a message cut: {}\n", said(&path, &[]));
    ros::write_mcap(&path, &ros::images(&frames, true, other_axes));
    text += &format!("mistaken: {}\n", said(&path, &[]));
    insta::assert_snapshot!(text);
}

#[test]
fn what_is_no_recording_is_told_what_would_be_one() {
    let base = folder("refused/none");
    let empty = base.join("empty");
    fs::create_dir_all(&empty).unwrap();
    fs::write(base.join("notes.txt"), "hello").unwrap();
    let mut text = String::new();
    for name in ["empty", "notes.txt", "nowhere"] {
        text += &(said(&base.join(name), &[]) + "\n");
    }
    let unstated = folder("refused/unstated");
    scene::write("slambook", &unstated, &scene::frames(), Pose::clone);
    text += &(said(&unstated, &[]) + "\n");
    fs::write(
        unstated.join("calibration.json"),
        r#"{"depth": {"fx": 90, "fy": 93, "cx": 50, "cy": 33, "width": 640}}"#,
    )
    .unwrap();
    text += &(said(&unstated, &[]) + "\n");
    fs::write(unstated.join("calibration.json"), r#"{"focal": 90}"#).unwrap();
    text += &(said(&unstated, &[]) + "\n");
    insta::assert_snapshot!(text);
}

#[test]
fn wrong_usage_is_refused() {
    let path = folder("refused/usage");
    scene::write("transforms", &path, &scene::frames(), Pose::clone);
    let name = path.to_str().unwrap();
    for (options, words) in [
        (&["--voxel", "50"][..], "a length with a unit, as in `50mm`"),
        (&["--voxel", "0mm"], "no number above 0"),
        (&["--intrinsics", "1,2,3"], "expected four numbers"),
        (&["--depth-scale", "-1"], "unexpected argument"),
        (&["--map", "out.pcd"], "end it in `.bt` or `.ot`"),
    ] {
        vpl(&[&["inspect", name], options].concat()).expect(2, &[words]);
    }
    let inside = path.join("map.bt");
    vpl(&["inspect", name, "--map", inside.to_str().unwrap()]).expect(2, &["would write into the recording"]);
    assert!(!inside.exists());
}

/// Rubbish of many shapes ends in an error, soon.
#[test]
fn rubbish_is_refused() {
    let base = folder("refused/rubbish");
    let noise = |seed: u32, n: usize| -> Vec<u8> {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 24) as u8
        };
        (0..n).map(|_| next()).collect()
    };
    for name in ["x.bag", "x.mcap", "x.json", "x.bt", "x.ot"] {
        for (seed, n) in [(1, 0), (2, 1), (3, 5000)] {
            let head: &[u8] = match name {
                "x.bag" => b"#ROSBAG V2.0\n",
                "x.mcap" => b"\x89MCAP0\r\n",
                "x.bt" => b"# Octomap OcTree binary file\nid OcTree\nsize 9\nres 0.1\ndata\n",
                "x.ot" => b"# Octomap OcTree file\nid OcTree\nsize 9\nres 0.1\ndata\n",
                _ => b"{",
            };
            fs::write(base.join(name), [head, &noise(seed, n)].concat()).unwrap();
            inspect(&base.join(name), &[]).expect(1, &["error[E061"]);
        }
    }
}
