//! `qr`: QR codes read from the colour image and placed by the depth image.
//!
//! Each planar region of the depth image is drawn as seen head-on, so a tilted
//! code is square again; finder patterns are located there, the modules
//! sampled, and the bits decoded. A code is seen only if it was decoded.

mod finder;
mod modules;
mod patch;
mod place;

use super::cloud::Cloud;
use super::evidence::{Look, MarkerEvidence};
use super::scan::{Luma, Scan};
use super::segment::Region;
use crate::geometry::{Point, Pose};

/// Largest difference between declared and measured size, as a share.
const SIZE_WITHIN: f64 = crate::primitives::QR_SIZE_WITHIN;
/// Corners of one code read in two regions lie closer than this, in units of its size.
const SAME: f64 = 0.25;

/// Least difference between light and dark pixels of a region with a code, of 255.
const LEAST_CONTRAST: u8 = 30;

/// A decoded code in the world.
pub struct Code {
    /// The decoded text.
    pub text: String,
    /// `world_from_marker`: x right, y up on the print, z out of it.
    pub pose: Pose,
    /// Measured edge of the square of modules, metres.
    pub size: f64,
    /// Pixels of the colour image that the square covers.
    pub pixels: f64,
}

/// Reads every code on the planar regions of a view.
pub(super) fn read(cloud: &Cloud, regions: &[Region], colours: &[Option<[u8; 3]>], luma: &Luma) -> Vec<Code> {
    let mut codes: Vec<Code> = Vec::new();
    for region in regions.iter().filter(|r| contrasts(r, colours)) {
        let Some(patch) = patch::Patch::of(cloud, region, luma) else {
            continue;
        };
        for square in modules::decode(&patch, &finder::finders(&patch)) {
            let code = place::placed(cloud, region, luma, &patch, square);
            codes.extend(code.filter(|c| !codes.iter().any(|d| same(c, d))));
        }
    }
    codes
}

/// Whether a region shows dark and light, as every code does.
fn contrasts(region: &Region, colours: &[Option<[u8; 3]>]) -> bool {
    let mut greens: Vec<u8> = region.pixels.iter().filter_map(|&p| colours[p].map(|c| c[1])).collect();
    greens.sort_unstable();
    let share = |s: usize| greens.get(greens.len() * s / 100).copied().unwrap_or(0);
    share(98) > share(2).saturating_add(LEAST_CONTRAST)
}

fn same(a: &Code, b: &Code) -> bool {
    let centre = |c: &Code| Point::from(c.pose.translation.vector);
    a.text == b.text && (centre(a) - centre(b)).norm() < SAME * a.size
}

/// `qr(text, size)`: every code with that text and about that size.
pub(super) fn qr(scan: &Scan, text: &str, size: f64) -> Vec<MarkerEvidence> {
    scan.codes()
        .iter()
        .filter(|code| code.text == text && (code.size - size).abs() <= SIZE_WITHIN * size)
        .map(|code| MarkerEvidence {
            looks: vec![Look {
                pose: code.pose,
                weight: code.pixels,
            }],
            size,
        })
        .collect()
}
