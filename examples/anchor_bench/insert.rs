//! Insertion.

use serde_json::{Value, json};
use vpl::geometry::{Point, Vector};
use vpl::map::Map;
use vpl::rules::{SensorModel, Space};
use vpl::sense::Observation;

use super::meter::{Measured, measured};
use super::{Arguments, files};

/// Posed clouds by exact rays, a line.
pub fn clouds(arguments: &Arguments) -> Result<Vec<Value>, String> {
    mode(arguments, &["exact"])?;
    let clouds = files::clouds(&arguments.file, arguments.frames)?;
    let ends = clouds.iter().flat_map(|c| c.points.iter().copied().chain([c.eye]));
    let extent = files::extent(ends);
    let map = || {
        let mut map = map_of(extent, arguments.res)?;
        clouds.iter().for_each(|c| {
            map.insert_cloud(&c.eye, &c.points);
        });
        Ok(map)
    };
    let points = clouds.iter().map(|c| c.points.len()).sum();
    line(arguments, "exact", [clouds.len(), points], measured(map))
}

/// Depth images, a line.
pub fn depth(arguments: &Arguments) -> Result<Vec<Value>, String> {
    let mode = mode(arguments, &["exact", "projective"])?;
    let frames = files::depth_images(&arguments.file, arguments.frames)?;
    let extent = files::extent(frames.iter().flat_map(|frame| points(frame).chain([frame.eye()])));
    let map = || {
        let mut map = map_of(extent, arguments.res)?;
        frames.iter().for_each(|frame| {
            match mode {
                "exact" => map.insert(frame),
                _ => map.insert_projected(frame),
            };
        });
        Ok(map)
    };
    let points = frames.iter().map(|frame| points(frame).count()).sum();
    line(arguments, mode, [frames.len(), points], measured(map))
}

/// The mode that is asked for, the first one where none is.
pub fn mode<'a>(arguments: &'a Arguments, known: &[&'a str]) -> Result<&'a str, String> {
    let Some(mode) = arguments.mode.as_deref() else {
        return Ok(known[0]);
    };
    let found = known.contains(&mode).then_some(mode);
    found.ok_or_else(|| format!("`{}` has the modes {}, not `{mode}`", arguments.job, known.join(", ")))
}

fn points(frame: &Observation) -> impl Iterator<Item = Point> {
    let pixels = (0..frame.depth.height).flat_map(|v| (0..frame.depth.width).map(move |u| (u, v)));
    pixels.filter_map(|(u, v)| frame.point(u, v))
}

/// An unknown space that holds everything between two corners.
pub fn map_of((low, high): (Point, Point), voxel: f64) -> Result<Map, String> {
    let space = Space {
        centre: nalgebra::center(&low, &high),
        size: high - low + Vector::repeat(4.0 * voxel),
        voxel,
    };
    let map = Map::new(&space, SensorModel::default()).map_err(|e| e.to_string())?;
    Ok(map.of_occupancy_alone())
}

fn line(
    arguments: &Arguments,
    mode: &str,
    [frames, points]: [usize; 2],
    measured: Measured<Result<Map, String>>,
) -> Result<Vec<Value>, String> {
    let (map, s) = (measured.done?, measured.took.seconds(arguments.threads));
    let (counts, (bricks, bytes)) = (map.counts(), map.memory());
    Ok(vec![json!({
        "lib": "vpl",
        "job": arguments.job,
        "mode": mode,
        "threads": arguments.threads,
        "res": arguments.res,
        "data": arguments.data(),
        "frames": frames,
        "points": points,
        "s": s,
        "wall": measured.took.wall.as_secs_f64(),
        "frames_per_s": frames as f64 / s,
        "points_per_s": points as f64 / s,
        "ns_per_ray": 1e9 * s / points as f64,
        "vox_occ": counts.occupied,
        "vox_free": counts.free,
        "nodes": bricks,
        "heap_mb": measured.heap_mb,
        "own_mb": bytes as f64 / 1_048_576.0,
        "peak_mb": measured.peak_mb,
        "peak_heap_mb": measured.peak_heap_mb,
        "bytes_per_known_voxel": measured.heap_mb * 1_048_576.0 / (counts.occupied + counts.free) as f64,
    })])
}
