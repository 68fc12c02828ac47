//! Splits the points of a view into planar regions.
//!
//! Regions grow from the flattest pixels, compete for the pixels near their
//! common edges, and are joined where they are parts of one plane. Colour
//! plays no part here.

use std::collections::VecDeque;

use rayon::prelude::*;

use super::cloud::Cloud;
use super::normals::{LocalPlane, RADIUS, WIDE_RADIUS, local_planes};
use super::plane_fit::{Moments, Plane, robust_plane};

/// Pixels of one plane.
pub struct Region {
    /// The plane, its normal towards the camera.
    pub plane: Plane,
    /// Spread of the points about the plane, metres.
    pub rms: f64,
    /// Pixels of the cloud, ascending.
    pub pixels: Vec<usize>,
}

/// A label of no region.
const NONE: u32 = u32::MAX;
/// Smallest region, pixels.
const LEAST_PIXELS: usize = 20;
/// How far a local normal may be off its region's.
const NORMAL_COSINE: f64 = 0.9659; // 15°
/// Bounds of the distance at which a pixel belongs to a plane, metres.
const TOLERANCE: (f64, f64) = (0.0025, 0.020);
/// Tolerance in units of the view's noise.
const SIGMAS: f64 = 3.5;
/// A view's noise from which normals are taken over a wider window, metres.
const NOISY: f64 = 0.0035;
/// How far a frayed border strays from its plane, in units of the tolerance.
const FRAYED: f64 = 2.0;
/// Share of frayed pixels from which a region is no face of its own.
const SLIVER: f64 = 0.8;
/// Sweeps that hand border pixels to the plane they fit best.
const SWEEPS: usize = 12;
/// Pixels worth a thread.
const AT_ONCE: usize = 2_048;
/// Sweeps after which the planes are fitted again.
const SWEEPS_A_FIT: usize = 4;

/// The planar regions of a view, largest first.
pub fn segment(cloud: &Cloud) -> Vec<Region> {
    let mut wanted: Vec<bool> = (0..cloud.points.len()).map(|p| cloud.holds(p)).collect();
    let mut growth = Growth::new(cloud);
    // The second round sees only what the first left: thin strips between
    // large faces get normals of their own.
    for _ in 0..2 {
        growth.round(&wanted);
        for (pixel, label) in growth.labels.iter().enumerate() {
            wanted[pixel] &= *label == NONE;
        }
    }
    growth.compete();
    growth.regions()
}

/// The state of region growing.
struct Growth<'a> {
    cloud: &'a Cloud,
    labels: Vec<u32>,
    planes: Vec<Plane>,
    tolerance: f64,
}

impl<'a> Growth<'a> {
    fn new(cloud: &'a Cloud) -> Self {
        let labels = vec![NONE; cloud.points.len()];
        Self {
            cloud,
            labels,
            planes: Vec::new(),
            tolerance: TOLERANCE.0,
        }
    }

    /// Grows regions over the wanted pixels, the flattest seeds first.
    fn round(&mut self, wanted: &[bool]) {
        let mut locals = local_planes(self.cloud, wanted, RADIUS);
        let spread = median_rms(&locals);
        if spread > NOISY {
            locals = local_planes(self.cloud, wanted, WIDE_RADIUS);
        }
        if self.planes.is_empty() {
            self.tolerance = (SIGMAS * spread).clamp(TOLERANCE.0, TOLERANCE.1);
        }
        let mut seeds: Vec<(f64, usize)> = locals
            .iter()
            .enumerate()
            .filter_map(|(p, l)| Some((l.as_ref()?.rms, p)))
            .collect();
        seeds.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut seen = vec![NONE; self.labels.len()];
        for (turn, &(rms, seed)) in seeds.iter().enumerate() {
            if self.labels[seed] == NONE && rms <= self.tolerance {
                self.grow(seed, &locals, &mut seen, turn as u32);
            }
        }
    }

    /// Grows one region twice: with the seed's plane, refitted on the way,
    /// then with the plane that came out.
    fn grow(&mut self, seed: usize, locals: &[Option<LocalPlane>], seen: &mut [u32], turn: u32) {
        let Some(local) = &locals[seed] else { return };
        let first = self.flood(seed, local.plane, locals, seen, 2 * turn, true);
        if first.0.len() < LEAST_PIXELS {
            return;
        }
        let (pixels, plane) = self.flood(seed, first.1, locals, seen, 2 * turn + 1, false);
        if pixels.len() >= LEAST_PIXELS {
            let label = self.planes.len() as u32;
            pixels.into_iter().for_each(|p| self.labels[p] = label);
            self.planes.push(plane);
        }
    }

    fn flood(
        &self,
        seed: usize,
        mut plane: Plane,
        locals: &[Option<LocalPlane>],
        seen: &mut [u32],
        stamp: u32,
        refit: bool,
    ) -> (Vec<usize>, Plane) {
        let eye = self.cloud.eye();
        let mut moments = Moments::about(self.cloud.points[seed]);
        let (mut pixels, mut queue) = (Vec::new(), VecDeque::from([seed]));
        let mut next_fit = 24;
        seen[seed] = stamp;
        while let Some(pixel) = queue.pop_front() {
            pixels.push(pixel);
            moments.add(&self.cloud.points[pixel]);
            if refit && pixels.len() == next_fit {
                plane = moments.plane().map_or(plane, |p| p.facing(&eye));
                next_fit *= 2;
            }
            for other in self.cloud.neighbours(pixel) {
                if seen[other] != stamp && self.labels[other] == NONE && self.fits(other, &plane, locals) {
                    seen[other] = stamp;
                    queue.push_back(other);
                }
            }
        }
        let plane = moments.plane().map_or(plane, |p| p.facing(&eye));
        (pixels, plane)
    }

    fn fits(&self, pixel: usize, plane: &Plane, locals: &[Option<LocalPlane>]) -> bool {
        locals[pixel]
            .as_ref()
            .is_some_and(|l| l.plane.normal.dot(&plane.normal) > NORMAL_COSINE)
            && plane.distance(&self.cloud.points[pixel]).abs() <= self.tolerance
    }

    /// Hands each pixel near a border to the neighbouring plane that fits it best.
    fn compete(&mut self) {
        for sweep in 0..SWEEPS {
            if sweep % SWEEPS_A_FIT == 0 {
                self.refit();
            }
            let pixels = (0..self.labels.len()).into_par_iter().with_min_len(AT_ONCE);
            let next: Vec<u32> = pixels.map(|p| self.best_label(p)).collect();
            if next == self.labels {
                break;
            }
            self.labels = next;
        }
        self.refit();
    }

    fn best_label(&self, pixel: usize) -> u32 {
        if !self.cloud.holds(pixel) {
            return NONE;
        }
        let own = self.labels[pixel];
        if own != NONE && self.cloud.neighbours(pixel).all(|p| self.labels[p] == own) {
            return own;
        }
        let mut candidates = [NONE; 4];
        let mut count = 0;
        for other in self.cloud.square(pixel, 2) {
            let label = self.labels[other];
            if label != NONE && count < candidates.len() && !candidates[..count].contains(&label) {
                candidates[count] = label;
                count += 1;
            }
        }
        let here = &self.cloud.points[pixel];
        candidates[..count]
            .iter()
            .map(|&label| (label, &self.planes[label as usize]))
            .filter(|(_, plane)| plane.distance(here).abs() <= self.tolerance)
            .map(|(label, plane)| (if count == 1 { 0.0 } else { self.smoothed(pixel, plane) }, label))
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)))
            .map_or(NONE, |(_, label)| label)
    }

    /// Distance of the mean of a pixel's surroundings to a plane.
    fn smoothed(&self, pixel: usize, plane: &Plane) -> f64 {
        let own = plane.distance(&self.cloud.points[pixel]);
        let (mut sum, mut count) = (0.0, 0.0);
        for other in self.cloud.square(pixel, 1).filter(|&p| self.cloud.holds(p)) {
            let d = plane.distance(&self.cloud.points[other]);
            if (d - own).abs() <= 2.0 * self.tolerance {
                sum += d;
                count += 1.0;
            }
        }
        f64::abs(sum / f64::max(count, 1.0))
    }

    fn refit(&mut self) {
        let eye = self.cloud.eye();
        for (plane, pixels) in self.planes.iter_mut().zip(members(&self.labels)) {
            let points = pixels.iter().map(|&p| &self.cloud.points[p]);
            if let Some(fit) = robust_plane(points) {
                *plane = fit.plane.facing(&eye);
            }
        }
    }

    /// Whether pixels are the frayed border of a larger region rather than a
    /// face: almost all lie beside it and little off its plane.
    fn is_sliver(&self, pixels: &[usize], sizes: &[usize]) -> bool {
        let frayed = |p: usize| {
            self.cloud.square(p, 2).map(|q| self.labels[q]).any(|label| {
                label != NONE
                    && sizes[label as usize] > pixels.len()
                    && self.planes[label as usize].distance(&self.cloud.points[p]).abs() <= FRAYED * self.tolerance
            })
        };
        pixels.iter().filter(|&&p| frayed(p)).count() as f64 > SLIVER * pixels.len() as f64
    }

    /// Joins the parts of one plane and fits each region once more.
    fn regions(self) -> Vec<Region> {
        let members = members(&self.labels);
        let sizes: Vec<usize> = members.iter().map(Vec::len).collect();
        let parts: Vec<Part> = members
            .into_iter()
            .zip(&self.planes)
            .filter(|(pixels, _)| pixels.len() >= LEAST_PIXELS && !self.is_sliver(pixels, &sizes))
            .map(|(pixels, plane)| Part { plane: *plane, pixels })
            .collect();
        let mut regions: Vec<Region> = super::join::coplanar(self.cloud, parts, self.tolerance)
            .into_iter()
            .filter_map(|pixels| {
                let fit = robust_plane(pixels.iter().map(|&p| &self.cloud.points[p]))?;
                Some(Region {
                    plane: fit.plane.facing(&self.cloud.eye()),
                    rms: fit.rms,
                    pixels,
                })
            })
            .collect();
        regions.sort_by(|a, b| b.pixels.len().cmp(&a.pixels.len()).then(a.pixels.cmp(&b.pixels)));
        regions
    }
}

/// The typical spread within a window: the view's noise, metres.
fn median_rms(locals: &[Option<LocalPlane>]) -> f64 {
    let mut spreads: Vec<f64> = locals.iter().flatten().map(|l| l.rms).collect();
    spreads.sort_by(f64::total_cmp);
    spreads.get(spreads.len() / 2).copied().unwrap_or(0.0)
}

/// A region before it is joined with others.
pub struct Part {
    /// Its plane, towards the camera.
    pub plane: Plane,
    /// Its pixels, ascending.
    pub pixels: Vec<usize>,
}

/// The pixels of each label, ascending.
fn members(labels: &[u32]) -> Vec<Vec<usize>> {
    let count = labels
        .iter()
        .filter(|&&l| l != NONE)
        .max()
        .map_or(0, |&l| l as usize + 1);
    let mut pixels = vec![Vec::new(); count];
    for (pixel, &label) in labels.iter().enumerate().filter(|&(_, &l)| l != NONE) {
        pixels[label as usize].push(pixel);
    }
    pixels
}
