//! One depth image traced through the grid: which voxels its rays pass, and in
//! which they end.
//!
//! Marks are bits that are OR-ed and readings are listed by pixel, so neither
//! depends on the number of threads. Nothing is changed in the map here.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use rayon::prelude::*;

use super::grid::Grid;
use super::layout::{Address, Bits, Layout, WORDS};
use super::walk::Walk;
use crate::geometry::{Point, Vector};
use crate::sense::Observation;

/// A traced depth image.
pub(super) struct Frame {
    /// Readings that end inside the grid, in pixel order.
    pub readings: Vec<Reading>,
    passed: Vec<AtomicU64>,
}

/// A reading that ends inside the grid.
#[derive(Clone, Copy)]
pub(super) struct Reading {
    /// The voxel it ends in.
    pub address: Address,
    /// The octant of that voxel, 0 to 7.
    pub octant: u8,
    /// The measured point, world axes.
    pub point: Point,
}

impl Frame {
    /// Walks from the eye to every reading of an observation.
    pub fn trace(grid: &Grid, layout: &Layout, observation: &Observation) -> Self {
        let mut passed = Vec::new();
        passed.resize_with(layout.len() * WORDS, AtomicU64::default);
        let tracer = Tracer {
            grid,
            layout,
            eye: grid.in_voxels(&observation.eye()),
            passed: &passed,
        };
        let rows = 0..observation.depth.height;
        let rows: Vec<_> = rows.into_par_iter().map(|v| tracer.row(observation, v)).collect();
        Self {
            readings: rows.concat(),
            passed,
        }
    }

    /// Voxels of a brick that rays passed.
    pub fn passed(&self, brick: usize) -> Bits {
        std::array::from_fn(|word| self.passed[brick * WORDS + word].load(Relaxed))
    }

    /// Whether rays passed a brick.
    pub fn touches(&self, brick: usize) -> bool {
        self.passed(brick) != [0; WORDS]
    }
}

struct Tracer<'a> {
    grid: &'a Grid,
    layout: &'a Layout,
    eye: [f64; 3],
    passed: &'a [AtomicU64],
}

impl Tracer<'_> {
    fn row(&self, observation: &Observation, v: u32) -> Vec<Reading> {
        let k = &observation.camera.depth;
        let rotation = observation.world_from_camera.rotation.to_rotation_matrix();
        let (across, start) = (
            rotation * Vector::new(1.0 / k.fx, 0.0, 0.0),
            rotation * k.ray(0.5, f64::from(v) + 0.5),
        );
        let eye = observation.eye();
        let reading = |u: u32| {
            let z = observation.depth.at(u, v)?;
            self.ray(eye + (start + across * f64::from(u)) * z)
        };
        (0..observation.depth.width).filter_map(reading).collect()
    }

    /// Marks what the ray to a point passes; the reading, where it ends inside.
    fn ray(&self, point: Point) -> Option<Reading> {
        let to = self.grid.in_voxels(&point);
        let mut walk = Walk::clipped(self.grid.size, self.eye, to)?;
        let inside = (0..3).all(|k| 0.0 <= to[k] && to[k] < f64::from(self.grid.size[k]));
        self.mark_way(&mut walk);
        let address = self.layout.address(walk.end);
        if inside {
            let upper = |k: usize| u8::from(to[k].fract() >= 0.5) << k;
            let octant = upper(0) | upper(1) | upper(2);
            return Some(Reading { address, octant, point });
        }
        self.mark(address.0 / 64, address.bit());
        None
    }

    /// Marks every voxel before the last, a word at a time.
    #[inline(always)]
    fn mark_way(&self, walk: &mut Walk) {
        let mut here = self.layout.address(walk.cell);
        let (mut word, mut bits) = (here.0 / 64, 0);
        while walk.advance() {
            if here.0 / 64 != word {
                self.mark(word, bits);
                (word, bits) = (here.0 / 64, 0);
            }
            bits |= here.bit();
            here = self.layout.address(walk.cell);
        }
        self.mark(word, bits);
    }

    /// Most voxels near an eye are passed by many rays: look before writing.
    #[inline(always)]
    fn mark(&self, word: usize, bits: u64) {
        let word = &self.passed[word];
        if word.load(Relaxed) & bits != bits {
            word.fetch_or(bits, Relaxed);
        }
    }
}
