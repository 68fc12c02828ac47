//! `planar_region`: planar faces of a colour in one view.

use super::account::{Account, Condition, Judgement, Unit};
use super::colour::matches;
use super::evidence::FaceEvidence;
use super::join::{close_together, pieces};
use super::plane_fit::Plane;
use super::scan::Scan;
use crate::rules::Colour;

/// Pieces of fewer pixels are specks of a colour, not parts of a face.
const LEAST_PIECE: usize = 4;

/// A face as seen in one view.
pub struct Face {
    /// Its plane, the normal towards the camera.
    pub plane: Plane,
    /// Its pixels in the cloud, ascending.
    pub pixels: Vec<usize>,
    /// Spread of the points about the plane, metres.
    pub rms: f64,
    /// Its seen area, square metres.
    pub area: f64,
    /// What it has met to be one.
    pub judged: Judgement,
}

/// Faces of a colour (any where `None`) of at least `smallest`² square metres, largest first.
pub fn faces(scan: &Scan, colour: Option<Colour>, smallest: f64) -> (Vec<Face>, Account) {
    let mut found: Vec<Face> = Vec::new();
    let mut account = Account::of(scan.regions.len());
    for region in &scan.regions {
        let fits = |p: &usize| colour.is_none_or(|c| scan.colours[*p].is_some_and(|seen| matches(c, seen)));
        let pixels: Vec<usize> = region.pixels.iter().copied().filter(fits).collect();
        let mut parts = pieces(&scan.cloud, &pixels);
        let largest = parts.iter().map(Vec::len).max().unwrap_or(0);
        let mut judged = Judgement::default();
        if !judged.holds(coloured(colour, largest)) {
            account.reject(judged);
            continue;
        }
        parts.retain(|p| p.len() >= LEAST_PIECE);
        for pixels in close_together(&scan.cloud, parts) {
            let area = pixels
                .iter()
                .map(|&p| scan.cloud.footprint_area(p, &region.plane.normal))
                .sum();
            let mut judged = judged.clone();
            if !judged.holds(Condition::at_least("area", Unit::Area, area, smallest * smallest)) {
                account.reject(judged);
                continue;
            }
            found.push(Face {
                plane: region.plane,
                rms: region.rms,
                pixels,
                area,
                judged,
            });
        }
    }
    found.sort_by(|a, b| b.area.total_cmp(&a.area));
    (found, account)
}

/// Whether the largest connected piece of a colour is more than a speck.
fn coloured(colour: Option<Colour>, largest: usize) -> Condition {
    Condition::at_least("colour", Unit::Pixels, largest as f64, LEAST_PIECE as f64).of(colour.map(String::from))
}

/// `planar_region(colour?, smallest)`.
pub fn planar_region(scan: &Scan, colour: Option<Colour>, smallest: f64) -> (Vec<FaceEvidence>, Account) {
    let (found, account) = faces(scan, colour, smallest);
    let account = account.accept(found.first().map(|f| &f.judged));
    (found.iter().map(|f| FaceEvidence::of(scan, f)).collect(), account)
}
