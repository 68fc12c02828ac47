//! `qr`: QR codes read from the colour image and placed by the depth image.
//!
//! Each planar region of the depth image is drawn as seen head-on, so a tilted
//! code is square again; finder patterns are located there, the modules
//! sampled, and the bits decoded. A code is seen only if it was decoded.

mod finder;
mod modules;
mod patch;
mod place;

use super::account::{Account, Condition, Judgement, Unit};
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
/// Finder patterns of a code.
const FINDERS: f64 = 3.0;
/// Most texts that an account lists, and the most characters of each.
const MOST_TEXTS: usize = 8;
const LONGEST_TEXT: usize = 40;

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
    /// What it has met to be read.
    judged: Judgement,
}

/// What could be read in a view.
pub(super) struct Reading {
    codes: Vec<Code>,
    account: Account,
}

/// Reads every code on the planar regions of a view.
pub(super) fn read(cloud: &Cloud, regions: &[Region], colours: &[Option<[u8; 3]>], luma: &Luma) -> Reading {
    let mut reading = Reading {
        codes: Vec::new(),
        account: Account::of(regions.len()),
    };
    for region in regions {
        let mut judged = Judgement::default();
        if judged.holds(contrasts(region, colours))
            && let Some(patch) = patch::Patch::of(cloud, region, luma, &mut judged)
        {
            reading.on(cloud, region, luma, &patch, judged);
        } else {
            reading.account.reject(judged);
        }
    }
    reading
}

impl Reading {
    /// Reads the codes of one region.
    fn on(&mut self, cloud: &Cloud, region: &Region, luma: &Luma, patch: &patch::Patch, mut judged: Judgement) {
        let finders = finder::finders(patch);
        let count = Condition::at_least("finder patterns", Unit::Count, finders.len() as f64, FINDERS);
        if !judged.holds(count) {
            return self.account.reject(judged);
        }
        let squares = modules::decode(patch, &finders);
        if !judged.holds(Condition::plain("decoded", !squares.is_empty())) {
            return self.account.reject(judged);
        }
        for square in squares {
            let mut judged = judged.clone();
            let placed = place::placed(cloud, region, luma, patch, square);
            if !judged.holds(Condition::plain("borne out by depth", placed.is_some())) {
                self.account.reject(judged);
                continue;
            }
            let new = placed.filter(|c| !self.codes.iter().any(|d| same(c, d)));
            self.codes.extend(new.map(|code| Code { judged, ..code }));
        }
    }

    /// Up to a few of the texts that were read.
    fn texts(&self) -> Vec<String> {
        let mut texts: Vec<String> = self.codes.iter().map(|c| shortened(&c.text)).collect();
        texts.sort_unstable();
        texts.dedup();
        texts.truncate(MOST_TEXTS);
        texts
    }
}

/// A foreign code may hold a novel.
fn shortened(text: &str) -> String {
    text.chars().take(LONGEST_TEXT).collect()
}

/// Whether a region shows dark and light, as every code does.
fn contrasts(region: &Region, colours: &[Option<[u8; 3]>]) -> Condition {
    let mut greens: Vec<u8> = region.pixels.iter().filter_map(|&p| colours[p].map(|c| c[1])).collect();
    greens.sort_unstable();
    let share = |s: usize| greens.get(greens.len() * s / 100).copied().unwrap_or(0);
    let contrast = f64::from(share(98)) - f64::from(share(2));
    // Nothing is brighter than white: the bound is reached where the dark is.
    let enough = share(98) > share(2).saturating_add(LEAST_CONTRAST);
    let bounds = (Some(f64::from(LEAST_CONTRAST) + 1.0), None);
    Condition::quantity("contrast", Unit::Levels, contrast, bounds, enough)
}

fn same(a: &Code, b: &Code) -> bool {
    let centre = |c: &Code| Point::from(c.pose.translation.vector);
    a.text == b.text && (centre(a) - centre(b)).norm() < SAME * a.size
}

/// `qr(text, size)`: every code with that text and about that size.
pub(super) fn qr(scan: &Scan, text: &str, size: f64) -> (Vec<MarkerEvidence>, Account) {
    let reading = scan.reading();
    let (mut found, mut account) = (Vec::new(), reading.account.clone());
    for code in &reading.codes {
        let mut judged = code.judged.clone();
        let wanted = judged.holds(Condition::named("text", text, &code.text, reading.texts()))
            && judged.holds(Condition::about(
                "size",
                Unit::Length,
                code.size,
                size,
                SIZE_WITHIN * size,
            ));
        if !wanted {
            account.reject(judged);
            continue;
        }
        if found.is_empty() {
            account = account.accept(Some(&judged));
        }
        found.push(MarkerEvidence {
            looks: vec![Look {
                pose: code.pose,
                weight: code.pixels,
            }],
            size,
        });
    }
    (found, account)
}
