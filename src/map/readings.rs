//! The measured points of a frame: which voxels they lie in, and which of them
//! the map keeps.

use rayon::prelude::*;

use super::layout::Address;
use super::trace::Trace;
use crate::geometry::{Point, Vector};
use crate::sense::Observation;

/// Points of a cloud that a thread takes at a time.
const CHUNK: usize = 2048;

/// Pixels that are looked at together, since most of an image may be empty.
const RUN: usize = 16;

/// A measured point inside the grid.
#[derive(Clone, Copy)]
pub(super) struct Reading {
    /// The voxel it lies in.
    pub address: Address,
    /// The octant of that voxel, 0 to 7.
    pub octant: u8,
    /// The measured point, world axes.
    pub point: Point,
}

/// What became of the points of a frame.
#[derive(Default)]
pub(super) struct Readings {
    /// Number of points inside the grid.
    pub inside: usize,
    /// Those points, in the order of measurement, where they are wanted.
    pub kept: Vec<Reading>,
}

/// Marks the hits of a cloud, and the rays to points beyond the grid.
pub(super) fn of_cloud(trace: &Trace, points: &[Point], keep: bool) -> Readings {
    let chunk = |points: &[Point]| Readings::of(trace, points.iter().copied(), keep);
    joined(points.par_chunks(CHUNK).map(chunk).collect())
}

/// The same of a depth image, row by row.
pub(super) fn of_image(trace: &Trace, observation: &Observation, keep: bool) -> Readings {
    let rows = (0..observation.depth.height).into_par_iter().with_min_len(4);
    joined(rows.map(|v| Readings::of(trace, row(observation, v), keep)).collect())
}

/// The measured points of an image row, world axes.
fn row(observation: &Observation, v: u32) -> impl Iterator<Item = Point> {
    let k = &observation.camera.depth;
    let rotation = observation.world_from_camera.rotation.to_rotation_matrix();
    let across = rotation * Vector::new(1.0 / k.fx, 0.0, 0.0);
    let start = rotation * k.ray(0.5, f64::from(v) + 0.5);
    let (eye, width) = (observation.eye(), observation.depth.width as usize);
    let row = observation.depth.metres.chunks(width.max(1)).nth(v as usize);
    let runs = row.unwrap_or_default().chunks(RUN).enumerate();
    let read = runs.filter(|(_, run)| run.iter().fold(0, |any, z| any | z.to_bits()) != 0);
    read.flat_map(move |(i, run)| {
        run.iter().enumerate().filter_map(move |(u, &z)| {
            let measured = z > 0.0 && z < f32::INFINITY;
            measured.then(|| eye + (start + across * (i * RUN + u) as f64) * f64::from(z))
        })
    })
}

impl Readings {
    fn of(trace: &Trace, points: impl Iterator<Item = Point>, keep: bool) -> Self {
        let mut readings = Self::default();
        let mut last = [i32::MIN; 3];
        for point in points {
            let Some(p) = trace.keys.point(&point) else { continue };
            let cell = trace.keys.cell(p);
            let inside = trace.keys.has(cell);
            if cell != last {
                trace.end(cell, inside);
                last = cell;
            }
            readings.inside += usize::from(inside);
            if inside && keep {
                let (address, octant) = (trace.address(cell), trace.keys.octant(p));
                readings.kept.push(Reading { address, octant, point });
            }
        }
        readings
    }
}

fn joined(parts: Vec<Readings>) -> Readings {
    let inside = parts.iter().map(|part| part.inside).sum();
    let mut kept = Vec::with_capacity(parts.iter().map(|part| part.kept.len()).sum());
    parts.into_iter().for_each(|part| kept.extend(part.kept));
    Readings { inside, kept }
}
