//! Depth noise of real sensors.
//!
//! `structured_light` follows Nguyen, Izadi and Lovell (2012), measured on a
//! Kinect: axial σ_z = 0.0012 + 0.0019 (z − 0.4)² plus
//! 0.0001/√z · θ²/(π/2 − θ)², lateral σ = 0.8 + 0.035 θ/(π/2 − θ) px, with θ
//! the angle between ray and surface normal. Readings are lost at grazing
//! incidence, beside depth edges, and now and then anywhere.

use std::str::FromStr;

use rand::{Rng, RngExt};
use rand_pcg::Pcg64;
use rayon::prelude::*;

use crate::geometry::DepthRange;

/// How depth readings differ from the truth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Noise {
    /// Not at all.
    #[default]
    None,
    /// As a structured-light sensor's (Kinect v1).
    StructuredLight,
}

/// A name that is no noise model.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum UnknownNoise {
    /// A model that this build lacks.
    #[error("noise `{0}` is not available yet; known: `none`, `structured_light`")]
    NotYet(String),
    /// No model at all.
    #[error("`{0}` is not a noise model; known: `none`, `structured_light`")]
    Unknown(String),
}

impl Noise {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::StructuredLight => "structured_light",
        }
    }
}

impl FromStr for Noise {
    type Err = UnknownNoise;

    fn from_str(name: &str) -> Result<Self, UnknownNoise> {
        match name {
            "none" => Ok(Self::None),
            "structured_light" => Ok(Self::StructuredLight),
            "stereo" | "tof" => Err(UnknownNoise::NotYet(name.to_owned())),
            _ => Err(UnknownNoise::Unknown(name.to_owned())),
        }
    }
}

/// Incidence from which on readings are lost, and at which all are, radians.
const FADES: (f64, f64) = (70.0 * DEGREE, 82.0 * DEGREE);
const DEGREE: f64 = std::f64::consts::PI / 180.0;
/// Share of readings lost anywhere.
const LOST: f64 = 0.005;
/// Share of readings lost beside a depth edge.
const LOST_AT_EDGES: f64 = 0.4;
/// A step between neighbours that makes a depth edge, metres.
const EDGE: f32 = 0.03;

/// Random values drawn for a pixel.
const DRAWS: usize = 5;

impl Noise {
    /// The measured depth image of a true one (row by row, 0: no reading);
    /// `incidence` gives the angle between ray and normal at a pixel, radians.
    ///
    /// The random stream follows from `seed` and the view's number `n`, and a
    /// pixel's place in it from its index, whatever the number of threads.
    pub(super) fn apply(
        self,
        truth: Vec<f32>,
        width: usize,
        incidence: impl Fn(usize) -> f64 + Send + Sync,
        range: DepthRange,
        seed: u64,
        n: u32,
    ) -> Vec<f32> {
        if self == Self::None {
            return truth;
        }
        let angles: Vec<f64> = (0..truth.len()).into_par_iter().map(incidence).collect();
        let image = Truth {
            depth: &truth,
            angles: &angles,
            width,
        };
        let mut measured = vec![0.0; truth.len()];
        measured.par_chunks_mut(width).enumerate().for_each(|(v, row)| {
            let mut random = Pcg64::new(u128::from(seed), u128::from(n));
            random.advance((v * width * DRAWS) as u128);
            for (u, z) in row.iter_mut().enumerate() {
                let read = image.measured(v * width + u, &mut random);
                *z = if range.contains(f64::from(read)) { read } else { 0.0 };
            }
        });
        measured
    }
}

/// σ_z in metres at depth `z` and incidence `theta`.
pub(super) fn axial(z: f64, theta: f64) -> f64 {
    let left = (std::f64::consts::FRAC_PI_2 - theta).max(1e-3);
    0.0012 + 0.0019 * (z - 0.4).powi(2) + 0.0001 / z.sqrt() * theta * theta / (left * left)
}

/// Lateral σ in pixels at incidence `theta`.
fn lateral(theta: f64) -> f64 {
    0.8 + 0.035 * theta / (std::f64::consts::FRAC_PI_2 - theta).max(1e-3)
}

/// Probability that a reading at incidence `theta` is lost.
fn fading(theta: f64) -> f64 {
    ((theta - FADES.0) / (FADES.1 - FADES.0)).clamp(0.0, 1.0)
}

struct Truth<'a> {
    depth: &'a [f32],
    angles: &'a [f64],
    width: usize,
}

impl Truth<'_> {
    /// The reading of pixel `k`. Draws `DRAWS` values whatever comes of it, so
    /// one pixel's fate does not move another's.
    fn measured(&self, k: usize, random: &mut Pcg64) -> f32 {
        let (jitter_u, jitter_v) = normal_pair(random);
        let (along, _) = normal_pair(random);
        let fate: f64 = random.random();
        let jitter = lateral(self.angles[k]).min(3.0);
        let read = self.shifted(k, jitter_u * jitter, jitter_v * jitter);
        if self.depth[read] <= 0.0 {
            return 0.0;
        }
        let theta = self.angles[read];
        let edge = if self.beside_edge(k) { LOST_AT_EDGES } else { 0.0 };
        let kept = (1.0 - fading(theta)) * (1.0 - edge) * (1.0 - LOST);
        if fate >= kept {
            return 0.0;
        }
        let z = f64::from(self.depth[read]);
        (z + along * axial(z, theta)) as f32
    }

    /// The pixel at an offset, clamped to the image.
    fn shifted(&self, k: usize, du: f64, dv: f64) -> usize {
        let height = self.depth.len() / self.width;
        let moved = |x: usize, by: f64, n: usize| (x as i64 + by.round() as i64).clamp(0, n as i64 - 1) as usize;
        moved(k / self.width, dv, height) * self.width + moved(k % self.width, du, self.width)
    }

    fn beside_edge(&self, k: usize) -> bool {
        let here = self.depth[k];
        let u = k % self.width;
        let differs = |j: usize| self.depth.get(j).is_some_and(|z| (z - here).abs() > EDGE);
        (u > 0 && differs(k - 1))
            || (u + 1 < self.width && differs(k + 1))
            || (k >= self.width && differs(k - self.width))
            || differs(k + self.width)
    }
}

/// Two independent standard normal values (Box and Muller 1958).
fn normal_pair(random: &mut impl Rng) -> (f64, f64) {
    let (a, b): (f64, f64) = (random.random(), random.random());
    let radius = (-2.0 * (1.0 - a).ln()).sqrt();
    let (sine, cosine) = (std::f64::consts::TAU * b).sin_cos();
    (radius * cosine, radius * sine)
}

#[cfg(test)]
mod tests;
