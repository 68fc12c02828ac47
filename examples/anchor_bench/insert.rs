//! Insertion.

use serde_json::{Value, json};
use vpl::geometry::{Point, Vector};
use vpl::map::Map;
use vpl::rules::{SensorModel, Space};
use vpl::sense::Observation;

use super::meter::{Took, peak_mb, timed};
use super::{Arguments, files};

/// Depth images, a line.
pub fn depth(arguments: &Arguments) -> Result<Vec<Value>, String> {
    let frames = files::depth_images(&arguments.file, arguments.frames)?;
    let ends = |o: &Observation| {
        let pixels = (0..o.depth.height).flat_map(|v| (0..o.depth.width).map(move |u| (u, v)));
        let points = pixels.filter_map(|(u, v)| o.point(u, v)).collect::<Vec<_>>();
        points.into_iter().chain([o.eye()])
    };
    let mut map = map_of(files::extent(frames.iter().flat_map(ends)), arguments.res)?;
    let before = peak_mb();
    let (points, took) = timed(|| frames.iter().map(|frame| map.insert(frame)).sum::<usize>());
    Ok(vec![line(
        arguments,
        "insert-depth",
        &map,
        frames.len(),
        points,
        took,
        peak_mb() - before,
    )])
}

/// Posed clouds, a line.
pub fn clouds(_: &Arguments) -> Result<Vec<Value>, String> {
    Err("clouds cannot be inserted yet".to_owned())
}

/// An unknown space that holds everything between two corners.
pub fn map_of((low, high): (Point, Point), voxel: f64) -> Result<Map, String> {
    let space = Space {
        centre: nalgebra::center(&low, &high),
        size: high - low + Vector::repeat(4.0 * voxel),
        voxel,
    };
    Map::new(&space, SensorModel::default()).map_err(|e| e.to_string())
}

fn line(arguments: &Arguments, job: &str, map: &Map, frames: usize, points: usize, took: Took, peak: f64) -> Value {
    let (s, counts) = (took.seconds(arguments.threads), map.counts());
    json!({
        "lib": "vpl",
        "job": job,
        "mode": arguments.mode.as_deref().unwrap_or("exact"),
        "threads": arguments.threads,
        "res": arguments.res,
        "data": arguments.data(),
        "frames": frames,
        "points": points,
        "s": s,
        "wall": took.wall.as_secs_f64(),
        "frames_per_s": frames as f64 / s,
        "points_per_s": points as f64 / s,
        "ns_per_ray": 1e9 * s / points as f64,
        "vox_occ": counts.occupied,
        "vox_free": counts.free,
        "peak_mb": peak,
    })
}
