//! `planar_region`: planar faces of a colour in one view.

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
}

/// Faces of a colour (any where `None`) of at least `smallest`² square metres, largest first.
pub fn faces(scan: &Scan, colour: Option<Colour>, smallest: f64) -> Vec<Face> {
    let mut found: Vec<Face> = Vec::new();
    for region in &scan.regions {
        let fits = |p: &usize| colour.is_none_or(|c| scan.colours[*p].is_some_and(|seen| matches(c, seen)));
        let pixels: Vec<usize> = region.pixels.iter().copied().filter(fits).collect();
        let mut parts = pieces(&scan.cloud, &pixels);
        parts.retain(|p| p.len() >= LEAST_PIECE);
        for pixels in close_together(&scan.cloud, parts) {
            let area = pixels
                .iter()
                .map(|&p| scan.cloud.footprint_area(p, &region.plane.normal))
                .sum();
            if area >= smallest * smallest {
                found.push(Face {
                    plane: region.plane,
                    rms: region.rms,
                    pixels,
                    area,
                });
            }
        }
    }
    found.sort_by(|a, b| b.area.total_cmp(&a.area));
    found
}

/// `planar_region(colour?, smallest)`.
pub fn planar_region(scan: &Scan, colour: Option<Colour>, smallest: f64) -> Vec<FaceEvidence> {
    faces(scan, colour, smallest)
        .iter()
        .map(|f| FaceEvidence::of(scan, f))
        .collect()
}
