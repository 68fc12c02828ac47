//! Views of the harnesses valued on a map: unknown voxels on their rays, distinct
//! ones, first hits.
//!
//! Views stand on a Fibonacci sphere of 1.1 m and look at its centre, 60° across. With
//! `--roi H` the space is the cube of half edge H about the centre and rays are clipped
//! to it; without, it holds the clouds and the eyes, and rays end after `--range`.
//! What a decision makes anew, the planning grid or the distances for leaps, is in the
//! time.

use rayon::prelude::*;
use serde_json::{Value, json};
use vpl::geometry::{Bounds, DepthRange, Intrinsics, Point, Pose, Vector};
use vpl::map::{Map, Ray, RayCounts, Seen};
use vpl::rules::{SensorModel, Space};

use super::insert::{map_of, mode};
use super::meter::{Took, timed};
use super::{Arguments, files};

/// The images that are valued.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct Images {
    /// Half the edge of the region that rays are clipped to, metres; 0 for none.
    #[arg(long, default_value_t = 0.0)]
    roi: f64,
    /// Number of views.
    #[arg(long, default_value_t = 32)]
    views: u32,
    /// Columns of an image.
    #[arg(long, default_value_t = 160)]
    w: u32,
    /// Rows of an image.
    #[arg(long, default_value_t = 120)]
    h: u32,
    /// Where rays end without a region, metres.
    #[arg(long, default_value_t = 2.0)]
    range: f64,
}

/// Distance of the eyes from the centre, metres.
const RADIUS: f64 = 1.1;

/// Unknown voxels on rays, a line.
pub fn gain(arguments: &Arguments) -> Result<Vec<Value>, String> {
    let mode = mode(arguments, &["exact"])?;
    let (map, rays) = (map(arguments)?, rays(arguments));
    let (counts, took) = timed(|| {
        let grid = map.planning_grid();
        rays.par_iter().map(|rays| grid.unknown_on_rays(rays)).sum()
    });
    Ok(vec![line(arguments, "gain", mode, number(&rays), counts, took)])
}

/// Unknown voxels that views see, each once a view, a line.
pub fn distinct(arguments: &Arguments) -> Result<Vec<Value>, String> {
    let mode = mode(arguments, &["exact", "centre"])?;
    let map = map(arguments)?;
    if mode == "centre" {
        let (counts, took) = timed(|| centres(arguments, &map));
        let pixels = u64::from(arguments.images.views * arguments.images.w * arguments.images.h);
        return Ok(vec![line(arguments, "distinct", mode, pixels, counts, took)]);
    }
    let rays = rays(arguments);
    let (counts, took) = timed(|| {
        let grid = map.planning_grid();
        let views = rays
            .par_iter()
            .with_min_len(rays.len().div_ceil(arguments.threads.max(1)));
        let count = |seen: &mut Seen, rays: &Vec<Ray>| grid.distinct_unknown(rays, seen);
        views.map_init(|| Seen::new(&grid), count).sum()
    });
    Ok(vec![line(arguments, "distinct", mode, number(&rays), counts, took)])
}

/// First occupied voxels on rays, a line.
pub fn first(arguments: &Arguments) -> Result<Vec<Value>, String> {
    let mode = mode(arguments, &["exact"])?;
    let (map, rays) = (map(arguments)?, rays(arguments));
    let (counts, took) = timed(|| {
        let visibility = map.visibility();
        let hits = |rays: &Vec<Ray>| rays.iter().filter(|ray| visibility.first_hit(ray).is_some()).count();
        let hits = rays.par_iter().map(hits).sum::<usize>() as u64;
        RayCounts {
            hits,
            ..RayCounts::default()
        }
    });
    Ok(vec![line(arguments, "thru", mode, number(&rays), counts, took)])
}

/// Counts by the centres of voxels. Steps are the voxels that were asked for.
fn centres(arguments: &Arguments, map: &Map) -> RayCounts {
    let (image, range) = (
        image(arguments),
        DepthRange {
            min: 0.0,
            max: f64::from(f32::MAX),
        },
    );
    let unknown = map.unknown();
    let of_view = |pose: &Pose| map.centre_view(&image, range, pose).count(&unknown);
    RayCounts {
        steps: unknown.len() * u64::from(arguments.images.views),
        hits: 0,
        unknown: poses(arguments.images.views).par_iter().map(of_view).sum(),
    }
}

/// The map of the file's clouds.
fn map(arguments: &Arguments) -> Result<Map, String> {
    let clouds = files::clouds(&arguments.file, arguments.frames)?;
    let mut map = if arguments.images.roi > 0.0 {
        let space = Space {
            centre: Point::origin(),
            size: Vector::repeat(2.0 * arguments.images.roi),
            voxel: arguments.res,
        };
        let map = Map::new(&space, SensorModel::default()).map_err(|e| e.to_string())?;
        map.of_occupancy_alone()
    } else {
        let ends = clouds.iter().flat_map(|c| c.points.iter().copied().chain([c.eye]));
        let eyes = poses(arguments.images.views)
            .into_iter()
            .map(|p| Point::from(p.translation.vector));
        map_of(files::extent(ends.chain(eyes)), arguments.res)?
    };
    clouds.iter().for_each(|c| {
        map.insert_cloud(&c.eye, &c.points);
    });
    Ok(map)
}

fn image(arguments: &Arguments) -> Intrinsics {
    let (width, height) = (arguments.images.w, arguments.images.h);
    let focal = f64::from(width) / 2.0 / 30_f64.to_radians().tan();
    Intrinsics {
        width,
        height,
        fx: focal,
        fy: focal,
        cx: f64::from(width) / 2.0,
        cy: f64::from(height) / 2.0,
    }
}

/// The views, `world_from_camera`.
fn poses(count: u32) -> Vec<Pose> {
    let turn = std::f64::consts::PI * (1.0 + 5_f64.sqrt());
    let pose = |i: u32| {
        let place = f64::from(i) + 0.5;
        let (z, angle) = (
            1.0 - 2.0 * place / f64::from(count),
            turn * place + std::f64::consts::PI,
        );
        let across = (1.0 - z * z).sqrt();
        looking_at_the_centre(Point::new(across * angle.cos(), across * angle.sin(), z) * RADIUS)
    };
    (0..count).map(pose).collect()
}

/// As the harnesses have it: y is up where the view is steeper than 0.95.
fn looking_at_the_centre(eye: Point) -> Pose {
    let forward = -eye.coords.normalize();
    let up = if forward.z.abs() < 0.95 {
        Vector::z()
    } else {
        Vector::y()
    };
    let right = forward.cross(&up).normalize();
    let axes = nalgebra::Matrix3::from_columns(&[right, forward.cross(&right), forward]);
    let rotation = nalgebra::Rotation3::from_matrix_unchecked(axes);
    Pose::from_parts(eye.into(), rotation.into())
}

/// The rays of every view that meet the region.
fn rays(arguments: &Arguments) -> Vec<Vec<Ray>> {
    let (image, images) = (image(arguments), arguments.images);
    let region = Bounds::centred(Point::origin(), Vector::repeat(2.0 * images.roi));
    let clipped = |pose: &Pose, u: u32, v: u32| {
        let eye = Point::from(pose.translation.vector);
        let along = (pose * image.ray(f64::from(u) + 0.5, f64::from(v) + 0.5)).normalize();
        if images.roi <= 0.0 {
            return Some(Ray::new(eye, along, images.range));
        }
        let (enter, leave) = region.clip_ray(&eye, &along)?;
        let leave = leave.min(images.range);
        (enter < leave).then(|| Ray::new(eye + along * enter, along, leave - enter))
    };
    let of_view = |pose: &Pose| {
        let pixels = (0..image.height).flat_map(|v| (0..image.width).map(move |u| (u, v)));
        pixels.filter_map(|(u, v)| clipped(pose, u, v)).collect()
    };
    poses(images.views).iter().map(of_view).collect()
}

fn number(rays: &[Vec<Ray>]) -> u64 {
    rays.iter().map(|rays| rays.len() as u64).sum()
}

fn line(arguments: &Arguments, job: &str, mode: &str, rays: u64, counts: RayCounts, took: Took) -> Value {
    let (s, images) = (took.seconds(arguments.threads), arguments.images);
    let per_step = |value: f64| (counts.steps > 0).then_some(value);
    json!({
        "lib": "vpl",
        "job": format!("eval-{job}{}", if images.roi > 0.0 { "-roi" } else { "" }),
        "mode": mode,
        "threads": arguments.threads,
        "res": arguments.res,
        "data": arguments.data(),
        "views": images.views,
        "wh": format!("{}x{}", images.w, images.h),
        "rays": rays,
        "steps": counts.steps,
        "hits": counts.hits,
        "unknown": counts.unknown,
        "s": s,
        "wall": took.wall.as_secs_f64(),
        "mrays_per_s": rays as f64 / s / 1e6,
        "mvoxels_per_s": per_step(counts.steps as f64 / s / 1e6),
        "ns_per_step": per_step(1e9 * s / counts.steps as f64),
        "ns_per_ray": 1e9 * s / rays as f64,
    })
}
