//! Times of the map: inserting dense frames, sight lines, rear sides, rays and centre
//! views.
//!
//! `cargo bench --bench map [-- VOXEL]`, the voxel's edge in metres. Every pixel returns: what misses the object, a
//! heap of balls, meets a backdrop of radius 2 m. Set `RAYON_NUM_THREADS=1` for
//! single-thread figures; only compare numbers of one run.

use std::hint::black_box;
use std::time::Instant;

use vpl::geometry::{Camera, DepthRange, Intrinsics, Point, Vector, look_at};
use vpl::map::{Map, Occupancy, Ray, RayCounts, Seen, Voxel, VoxelSet, image_rays};
use vpl::rules::{SensorModel, Space};
use vpl::sense::{ColourImage, DepthImage, Observation};

/// Centres and radii, metres.
const BALLS: [([f64; 3], f64); 5] = [
    ([0.0, 0.0, 0.0], 0.12),
    ([0.14, 0.0, 0.05], 0.08),
    ([-0.12, 0.08, 0.0], 0.09),
    ([0.0, -0.15, -0.05], 0.07),
    ([0.03, 0.05, 0.16], 0.08),
];

fn main() {
    let eyes = fibonacci(32, 1.2);
    let frames: Vec<_> = eyes.iter().map(|eye| view_from(*eye)).collect();
    let only: Option<f64> = std::env::args().nth(1).and_then(|a| a.parse().ok());
    for (size, voxel) in [(0.6, 0.01), (1.0, 0.005), (2.0, 0.002)] {
        if only.is_some_and(|v| v != voxel) {
            continue;
        }
        println!("space {size} m, voxel {voxel} m");
        let map = insertion(size, voxel, &frames);
        decision(&map);
    }
}

fn insertion(size: f64, voxel: f64, frames: &[Observation]) -> Map {
    let space = Space {
        centre: Point::origin(),
        size: Vector::repeat(size),
        voxel,
    };
    let mut map = Map::new(&space, SensorModel::default()).expect("a space that fits");
    let frames = &frames[..if voxel < 0.004 { 4 } else { frames.len() }];
    let mut ms: Vec<_> = frames.iter().map(|o| timed(|| map.insert(o)).1).collect();
    ms.sort_by(f64::total_cmp);
    println!(
        "  insert, {} frames of 512x424: median {:.1} ms, slowest {:.1} ms",
        ms.len(),
        ms[ms.len() / 2],
        ms[ms.len() - 1]
    );
    map
}

fn decision(map: &Map) {
    let (counts, ms) = timed(|| map.counts());
    println!("  counts {ms:.2} ms: {counts:?}");
    let (rear, ms) = timed(|| map.rear_side());
    println!("  rear side {ms:.2} ms: {} voxels", rear.len());
    let (_, ms) = timed(|| map.visibility());
    println!("  clearance {ms:.2} ms");
    let targets = spread(map, rear);
    let eyes = fibonacci(100, 1.2);
    for tolerance in [0.0, 2.0 * map.grid().voxel] {
        let (seen, ms) = timed(|| seen(map, &eyes, &targets, tolerance));
        let lines = (eyes.len() * targets.len()) as f64;
        println!(
            "  sight lines, tolerance {tolerance} m: {:.1} ns each, {:.0} % seen of {} from 100 eyes",
            ms * 1e6 / lines,
            100.0 * seen as f64 / lines,
            targets.len()
        );
    }
    rays(map);
    centres(map, &targets, &eyes);
    let (near, ms) = timed(|| {
        let near = |v: &&Voxel| map.measured_within(&map.grid().centre(**v), map.grid().voxel);
        targets.iter().filter(near).count()
    });
    println!(
        "  points within a voxel: {:.0} ns a query, {near} found",
        ms * 1e6 / targets.len() as f64
    );
}

/// At most 40,000 voxels of and behind surfaces.
fn spread(map: &Map, rear: Vec<Voxel>) -> Vec<Voxel> {
    let mut voxels = [map.occupied(), rear].concat();
    voxels.sort_unstable();
    let step = voxels.len().div_ceil(40_000).max(1);
    voxels.into_iter().step_by(step).collect()
}

/// Rays of 8 images on the planning grid, against the plain walk of the grid.
fn rays(map: &Map) {
    let image = Intrinsics::with_fields_of_view(160, 120, 60.0_f64.to_radians(), 46.8_f64.to_radians());
    let of = |eye: Point| image_rays(&image, 1, 2.4, &look_at(eye, Point::origin())).collect::<Vec<_>>();
    let views: Vec<Vec<Ray>> = fibonacci(8, 1.2).into_iter().map(of).collect();
    let (grid, made) = timed(|| map.planning_grid());
    let (counts, ms) = timed(|| views.iter().map(|v| grid.unknown_on_rays(v)).sum::<RayCounts>());
    let (_, distinct) = timed(|| {
        let mut seen = Seen::new(&grid);
        views
            .iter()
            .map(|v| grid.distinct_unknown(v, &mut seen))
            .sum::<RayCounts>()
    });
    let (_, plain) = timed(|| views.iter().flatten().map(|ray| plain_unknown(map, ray)).sum::<u64>());
    let (hits, first) = timed(|| {
        let visibility = map.visibility();
        views
            .iter()
            .flatten()
            .filter(|ray| visibility.first_hit(ray).is_some())
            .count()
    });
    let number = views.iter().map(Vec::len).sum::<usize>() as f64;
    println!("  planning grid {made:.2} ms");
    println!(
        "  unknown on rays: {:.2} ns a voxel, {:.1} x the plain walk; each once: {:.2} ns",
        ms * 1e6 / counts.steps as f64,
        plain / ms,
        distinct * 1e6 / counts.steps as f64
    );
    println!(
        "  first hits: {:.0} ns a ray, {:.1} x the walk, {hits} hits",
        first * 1e6 / number,
        ms / first
    );
}

fn plain_unknown(map: &Map, ray: &Ray) -> u64 {
    let voxels = map.grid().along(ray.origin(), &ray.at(2.4)).map(|v| map.occupancy(v));
    let before = voxels.take_while(|state| *state != Occupancy::Occupied);
    before.filter(|state| *state == Occupancy::Unknown).count() as u64
}

/// Targets counted by their centres, against sight lines.
fn centres(map: &Map, targets: &[Voxel], eyes: &[Point]) {
    let image = Intrinsics::with_fields_of_view(640, 480, 60.0_f64.to_radians(), 46.8_f64.to_radians());
    let range = DepthRange { min: 0.1, max: 9.0 };
    let set = VoxelSet::of(map.grid(), targets);
    let (exact, lines) = timed(|| seen(map, eyes, targets, 0.0));
    let (count, ms) = timed(|| {
        let view = |eye: &Point| {
            map.centre_view(&image, range, &look_at(*eye, Point::origin()))
                .count(&set)
        };
        eyes.iter().map(view).sum::<u64>()
    });
    println!(
        "  centre views: {:.2} ms each, {:.1} x sight lines; {:.1} % of their voxels seen",
        ms / eyes.len() as f64,
        lines / ms,
        100.0 * count as f64 / exact as f64
    );
}

fn seen(map: &Map, eyes: &[Point], targets: &[Voxel], tolerance: f64) -> usize {
    let visibility = map.visibility();
    let from = |eye: &Point| {
        let sight = visibility.from(eye);
        targets.iter().filter(|v| sight.sees(**v, tolerance)).count()
    };
    eyes.iter().map(from).sum()
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = black_box(work());
    (result, start.elapsed().as_secs_f64() * 1e3)
}

fn fibonacci(n: u32, radius: f64) -> Vec<Point> {
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let eye = |i: u32| {
        let z = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(n);
        let (r, a) = ((1.0 - z * z).sqrt(), golden * f64::from(i));
        Point::new(r * a.cos(), r * a.sin(), z) * radius
    };
    (0..n).map(eye).collect()
}

fn view_from(eye: Point) -> Observation {
    let depth = Intrinsics::with_fields_of_view(512, 424, 70.6_f64.to_radians(), 60.0_f64.to_radians());
    let world_from_camera = look_at(eye, Point::origin());
    let metres = (0..depth.pixels() as u32).map(|i| {
        let ray = depth.ray(f64::from(i % 512) + 0.5, f64::from(i / 512) + 0.5);
        first_hit(&eye, &(world_from_camera * ray)) as f32
    });
    Observation {
        camera: Camera {
            depth,
            colour: depth,
            range: DepthRange { min: 0.1, max: 9.0 },
        },
        world_from_camera,
        colour: ColourImage {
            width: 512,
            height: 424,
            pixels: vec![[0; 3]; depth.pixels()],
        },
        depth: DepthImage {
            width: 512,
            height: 424,
            metres: metres.collect(),
        },
    }
}

/// First ball in front, else the far side of the backdrop; in units of `ray`.
fn first_hit(eye: &Point, ray: &Vector) -> f64 {
    let roots = |centre: Point, radius: f64| {
        let (a, b) = (ray.norm_squared(), ray.dot(&(eye - centre)));
        let d = b * b - a * ((eye - centre).norm_squared() - radius * radius);
        (d >= 0.0).then(|| ((-b - d.sqrt()) / a, (-b + d.sqrt()) / a))
    };
    let backdrop = roots(Point::origin(), 2.0).map_or(0.0, |r| r.1);
    let balls = BALLS.iter().filter_map(|(c, r)| roots(Point::from(*c), *r));
    balls.map(|r| r.0).fold(backdrop, f64::min)
}
