//! A view prepared for detection: what all rules share is found once here.

use std::sync::OnceLock;

use super::cloud::{Cloud, window};
use super::qr::{self, Reading};
use super::segment::{Region, segment};
use crate::geometry::{Bounds, Intrinsics};
use crate::rules::Space;
use crate::sense::Observation;

/// An observation prepared for detection: clipped to the space, with planar
/// regions found once for all rules and codes decoded once when first asked for.
pub struct Scan {
    pub(super) cloud: Cloud,
    pub(super) regions: Vec<Region>,
    /// Colour at each pixel of the cloud; `None` outside the colour image.
    pub(super) colours: Vec<Option<[u8; 3]>>,
    luma: Luma,
    reading: OnceLock<Reading>,
}

/// The part of the colour image around the space, as brightness.
pub(super) struct Luma {
    /// Intrinsics of the whole colour image.
    pub intrinsics: Intrinsics,
    corner: (u32, u32),
    width: usize,
    height: usize,
    values: Vec<u8>,
}

impl Scan {
    /// Prepares an observation.
    pub fn new(observation: &Observation, space: &Space) -> Self {
        let bounds = space.bounds();
        let cloud = Cloud::new(observation, &bounds);
        let regions = segment(&cloud);
        let colours = colours(&cloud, observation);
        let luma = Luma::new(observation, &bounds);
        Self {
            cloud,
            regions,
            colours,
            luma,
            reading: OnceLock::new(),
        }
    }

    /// What codes can be read in this view.
    pub(super) fn reading(&self) -> &Reading {
        self.reading
            .get_or_init(|| qr::read(&self.cloud, &self.regions, &self.colours, &self.luma))
    }
}

/// The colour seen along the ray of each depth pixel. Both images share the
/// optical centre, so the ray alone decides.
fn colours(cloud: &Cloud, observation: &Observation) -> Vec<Option<[u8; 3]>> {
    let k = &observation.camera.colour;
    let colour_at = |pixel: usize| {
        let ray = cloud.holds(pixel).then(|| cloud.ray(pixel, 0.5, 0.5))?;
        let (u, v) = k.project(&ray.into())?;
        Some(observation.colour.at(u as u32, v as u32))
    };
    (0..cloud.points.len()).map(colour_at).collect()
}

impl Luma {
    fn new(observation: &Observation, bounds: &Bounds) -> Self {
        let intrinsics = observation.camera.colour;
        let (columns, rows) = window(&intrinsics, &observation.world_from_camera, bounds);
        let mut values = Vec::with_capacity(columns.len() * rows.len());
        for v in rows.clone() {
            let start = v as usize * intrinsics.width as usize;
            let row = &observation.colour.pixels[start + columns.start as usize..start + columns.end as usize];
            values.extend(
                row.iter()
                    .map(|&[r, g, b]| ((u32::from(r) * 77 + u32::from(g) * 150 + u32::from(b) * 29) >> 8) as u8),
            );
        }
        let corner = (columns.start, rows.start);
        Self {
            intrinsics,
            corner,
            width: columns.len(),
            height: rows.len(),
            values,
        }
    }

    /// Brightness at image coordinates, bilinear; 0 outside the window.
    pub fn at(&self, u: f64, v: f64) -> u8 {
        let x = u - 0.5 - f64::from(self.corner.0);
        let y = v - 0.5 - f64::from(self.corner.1);
        if !(x >= 0.0 && y >= 0.0 && x < self.width as f64 - 1.0 && y < self.height as f64 - 1.0) {
            return 0;
        }
        let (left, top) = (x as usize, y as usize);
        let (fx, fy) = ((x - left as f64) as f32, (y - top as f64) as f32);
        let here = top * self.width + left;
        let value = |k: usize| f32::from(self.values[k]);
        let upper = value(here) * (1.0 - fx) + value(here + 1) * fx;
        let lower = value(here + self.width) * (1.0 - fx) + value(here + self.width + 1) * fx;
        (upper * (1.0 - fy) + lower * fy + 0.5) as u8
    }
}
