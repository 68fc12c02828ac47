//! Every layout gives the frames that were written.

use std::fs;
use std::path::{Path, PathBuf};

use vpl::geometry::{Intrinsics, Pose, Rotation, Vector};
use vpl::map::OctoMap;
use vpl::sense::Observation;
use vpl::sense::frames::{FrameOptions, Recording};

use crate::octomap::voxels;
use crate::ros;
use crate::scene::{self, LAYOUTS};
use crate::support::{folder, inspect};

/// Opens what a test wrote, with what the layout does not carry.
fn open(layout: &str, path: &Path) -> Recording {
    let intrinsics = (!scene::options(layout).is_empty()).then_some([90.0, 93.0, 50.0, 33.0]);
    let options = FrameOptions {
        intrinsics,
        ..FrameOptions::default()
    };
    Recording::open(path, &options).unwrap_or_else(|e| panic!("{layout}: {e}"))
}

/// Every layout, and the logs, with the frames written in it.
fn written(test: &str, frames: &[Observation]) -> Vec<(&'static str, PathBuf)> {
    let base = folder(test);
    let mut all = Vec::new();
    for layout in LAYOUTS {
        let path = base.join(layout);
        scene::write(layout, &path, frames, Pose::clone);
        all.push((layout, path));
    }
    ros::write_bag(&base.join("run.bag"), &ros::images(frames, false, Pose::clone));
    ros::write_mcap(&base.join("run.mcap"), &ros::images(frames, true, Pose::clone));
    all.extend([("bag", base.join("run.bag")), ("mcap", base.join("run.mcap"))]);
    all
}

fn same_camera(a: &Intrinsics, b: &Intrinsics) -> bool {
    let near = |x: f64, y: f64| (x - y).abs() < 1e-9;
    (a.width, a.height) == (b.width, b.height)
        && near(a.fx, b.fx)
        && near(a.fy, b.fy)
        && near(a.cx, b.cx)
        && near(a.cy, b.cy)
}

#[test]
fn every_layout_gives_the_frames_that_were_written() {
    let frames = scene::frames();
    for (layout, path) in written("round", &frames) {
        let recording = open(layout, &path);
        assert_eq!(recording.frames.len(), scene::FRAMES, "{layout}");
        let unit = match layout {
            "tum" => 1.0 / 5000.0,
            "visp" => 1.0 / 32768.0,
            _ => 0.001,
        };
        for (k, frame) in frames.iter().enumerate() {
            let read = recording.observe(k).unwrap();
            assert!(
                same_camera(&read.camera.depth, &frame.camera.depth),
                "{layout}: {:?}",
                read.camera
            );
            let moved = frame.world_from_camera.inverse() * read.world_from_camera;
            assert!(
                moved.translation.vector.norm() < 1e-6 && moved.rotation.angle() < 1e-6,
                "{layout}: {moved}"
            );
            assert_eq!(read.colour, frame.colour, "{layout}, frame {k}");
            for (a, b) in read.depth.metres.iter().zip(&frame.depth.metres) {
                assert!((a - b).abs() <= 0.5 * unit + 1e-6, "{layout}: {a} for {b}");
            }
        }
    }
}

/// The same readings and poses are the same map, whatever they came in: quaternions
/// and matrices round differently, which decides a few voxels.
#[test]
fn the_map_does_not_depend_on_the_layout() {
    let frames = scene::frames();
    let mut first = None;
    for (layout, path) in written("maps", &frames) {
        let out = path.with_extension("bt");
        let map = ["--voxel", "20mm", "--map", out.to_str().unwrap()];
        let ran = inspect(&path, &[scene::options(layout), &map].concat()).expect(0, &["frames agree", "no reading"]);
        assert!(ran.err.is_empty(), "{layout}: {}", ran.err);
        if matches!(layout, "tum" | "visp") {
            continue; // in other units of depth
        }
        let voxels = voxels(&OctoMap::read(&fs::read(&out).unwrap()).unwrap());
        let first = first.get_or_insert_with(|| voxels.clone());
        let other = voxels.iter().filter(|(key, x)| first.get(*key) != Some(*x)).count();
        assert!(
            voxels.len() > 10_000 && other * 1000 < voxels.len(),
            "{layout}: {other} of {}",
            voxels.len()
        );
    }
}

/// Depth and colour from two cameras: poses are the colour camera's, depth stays as it is.
#[test]
fn the_transform_between_two_cameras_is_undone() {
    let (frames, path) = (scene::frames(), folder("apart"));
    let turn = Rotation::from_axis_angle(&Vector::y_axis(), 0.02);
    let depth_from_colour = Pose::from_parts(Vector::new(-0.05, 0.01, 0.0).into(), turn);
    scene::write("visp", &path, &frames, |p| p * depth_from_colour);
    let m = depth_from_colour.to_homogeneous();
    let rows: Vec<Vec<f64>> = (0..4).map(|i| (0..4).map(|j| m[(i, j)]).collect()).collect();
    fs::write(
        path.join("calibration.json"),
        serde_json::json!({"depth_from_colour": rows}).to_string(),
    )
    .unwrap();
    let recording = open("visp", &path);
    for (k, frame) in frames.iter().enumerate() {
        let read = recording.observe(k).unwrap();
        let moved = frame.world_from_camera.inverse() * read.world_from_camera;
        assert!(
            moved.translation.vector.norm() < 1e-6 && moved.rotation.angle() < 1e-6,
            "{moved}"
        );
        // As the depth camera would see it: black where nothing was read.
        for (colour, z) in read.colour.pixels.iter().zip(&read.depth.metres) {
            assert!(*z > 0.0 || *colour == [0; 3]);
        }
    }
    inspect(&path, &[]).expect(0, &["frames agree", "[-0.050, 0.010, 0.000] m in depth axes"]);
}

#[test]
fn an_organised_cloud_is_the_depth_image_that_it_was() {
    let (frame, path) = (scene::frames().remove(0), folder("cloud").join("one.bag"));
    ros::write_bag(&path, &[ros::cloud(&frame)]);
    let recording = open("bag", &path);
    let read = recording.observe(0).unwrap();
    let (found, camera) = (read.camera.depth, frame.camera.depth);
    assert!(
        (found.fx - camera.fx).abs() < 1e-3 && (found.cx - camera.cx).abs() < 1e-3,
        "{found:?}"
    );
    assert_eq!(read.depth, frame.depth);
    assert_eq!(read.colour, frame.colour);
    inspect(&path, &[]).expect(
        0,
        &["by its points", "one frame", "the axes of `camera_link` are the world"],
    );
}

/// 0, 65535, NaN and infinity carve nothing, and neither does what lies too far.
#[test]
fn what_is_no_reading_stays_none() {
    let (mut frames, base) = (scene::frames(), folder("none"));
    frames.truncate(1);
    for (k, z) in frames[0].depth.metres.iter_mut().enumerate() {
        *z = [0.0, 65.535, 1.0, 3.0][k % 4];
    }
    let path = base.join("scenes");
    scene::write("seven_scenes", &path, &frames, Pose::clone);
    let options = FrameOptions {
        max_depth: Some(3.0),
        ..FrameOptions::default()
    };
    let read = Recording::open(&path, &options).unwrap().observe(0).unwrap();
    assert!(
        read.depth
            .metres
            .iter()
            .enumerate()
            .all(|(k, z)| *z == [0.0, 0.0, 1.0, 0.0][k % 4])
    );
    for z in frames[0].depth.metres.iter_mut().step_by(4) {
        *z = f32::INFINITY;
    }
    ros::write_bag(&base.join("one.bag"), &[ros::cloud(&frames[0])]);
    let read = open("bag", &base.join("one.bag")).observe(0).unwrap();
    assert!(read.depth.metres.iter().all(|z| z.is_finite()));
}
