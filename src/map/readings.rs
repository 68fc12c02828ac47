//! The measured points of a frame: which voxels they lie in, and which of them
//! the map keeps.

use rayon::prelude::*;

use super::layout::Address;
use super::trace::Trace;
use super::walk::each;
use crate::geometry::{Point, Vector};
use crate::sense::Observation;

/// Runs of points of a cloud that a thread takes at a time.
const RUNS: usize = 128;
/// Points that are looked at together.
pub(super) const RUN: usize = 16;

/// Coordinates of points, an axis after the other.
pub(super) type Run = [[f64; RUN]; 3];

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
    let chunk = |points: &[Point]| {
        let mut taker = Taker::new(trace, keep);
        for run in points.chunks(RUN) {
            let nowhere = f64::NAN;
            let coordinate = |k: usize, i: usize| run.get(i).map_or(nowhere, |p| p[k]);
            let run = each(|k| std::array::from_fn(|i| coordinate(k, i)));
            taker.take(&run, &[true; RUN]);
        }
        taker.readings
    };
    joined(points.par_chunks(RUN * RUNS).map(chunk).collect())
}

/// The same of a depth image, row by row.
pub(super) fn of_image(trace: &Trace, observation: &Observation, keep: bool) -> Readings {
    let rows = (0..observation.depth.height).into_par_iter().with_min_len(4);
    joined(rows.map(|v| of_row(trace, observation, v, keep)).collect())
}

fn of_row(trace: &Trace, observation: &Observation, v: u32, keep: bool) -> Readings {
    let k = &observation.camera.depth;
    let rotation = observation.world_from_camera.rotation.to_rotation_matrix();
    let across = rotation * Vector::new(1.0 / k.fx, 0.0, 0.0);
    let start = rotation * k.ray(0.5, f64::from(v) + 0.5);
    let (eye, width) = (observation.eye(), observation.depth.width as usize);
    let row = observation.depth.metres.chunks(width.max(1)).nth(v as usize);
    let mut taker = Taker::new(trace, keep);
    for (first, run) in row.unwrap_or_default().chunks(RUN).enumerate() {
        // Most of an image may be empty.
        if run.iter().fold(0, |any, z| any | z.to_bits()) == 0 {
            continue;
        }
        let mut depth = [0.0; RUN];
        depth[..run.len()].copy_from_slice(run);
        let column = |i: usize| (first * RUN + i) as f64;
        let point = |k: usize, i: usize| eye[k] + (start[k] + across[k] * column(i)) * f64::from(depth[i]);
        let points = each(|k| std::array::from_fn(|i| point(k, i)));
        taker.take(&points, &depth.map(|z| z > 0.0 && z < f32::INFINITY));
    }
    taker.readings
}

/// Takes measured points one after the other.
struct Taker<'a> {
    trace: &'a Trace<'a>,
    keep: bool,
    /// The voxel of the last point: the next one is often in it, too.
    last: [i32; 3],
    readings: Readings,
}

impl<'a> Taker<'a> {
    fn new(trace: &'a Trace, keep: bool) -> Self {
        Self {
            trace,
            keep,
            last: [i32::MIN; 3],
            readings: Readings::default(),
        }
    }

    fn take(&mut self, run: &Run, measured: &[bool; RUN]) {
        let (cells, near) = self.trace.keys.cells(run);
        for i in (0..RUN).filter(|&i| measured[i] && near[i]) {
            let cell = each(|k| cells[k][i]);
            let inside = self.trace.keys.has(cell);
            if cell != self.last {
                self.trace.end(cell, inside);
                self.last = cell;
            }
            self.readings.inside += usize::from(inside);
            if inside && self.keep {
                let point = Point::from(each(|k| run[k][i]));
                let octant = self.trace.keys.octant(&point);
                let address = self.trace.address(cell);
                self.readings.kept.push(Reading { address, octant, point });
            }
        }
    }
}

fn joined(parts: Vec<Readings>) -> Readings {
    let inside = parts.iter().map(|part| part.inside).sum();
    let mut kept = Vec::with_capacity(parts.iter().map(|part| part.kept.len()).sum());
    parts.into_iter().for_each(|part| kept.extend(part.kept));
    Readings { inside, kept }
}
