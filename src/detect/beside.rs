//! `plane_beside`: the face beyond a known edge, at a dihedral angle.

use std::f64::consts::PI;

use super::account::{Account, Condition, Unit};
use super::evidence::FaceEvidence;
use super::faces::{Face, faces};
use super::scan::Scan;
use crate::geometry::Edge;
use crate::rules::Colour;

/// How near a face must come to its edge, metres; a pixel's footprint is added.
const NEAR: f64 = 0.02;
/// Share of the edge along which the face must come near.
const ALONG: f64 = 0.4;
/// Smallest face: square root of area, metres.
const SMALLEST: f64 = 0.03;
/// Stretches into which an edge is divided.
const STRETCHES: usize = 25;

/// The angle asked for between the faces at an edge, inside the object.
#[derive(Clone, Copy, Debug)]
pub struct Dihedral {
    /// Radians: π for coplanar faces, less where the edge is convex.
    pub angle: f64,
    /// How far it may be off, radians.
    pub within: f64,
}

/// `plane_beside(edge, dihedral, within, colour?)`: the faces that share the
/// edge at that angle, the face that comes nearest along it first.
pub fn plane_beside(
    scan: &Scan,
    edge: &Edge,
    dihedral: Dihedral,
    colour: Option<Colour>,
) -> (Vec<FaceEvidence>, Account) {
    let (faces, mut account) = faces(scan, colour, SMALLEST);
    let mut found: Vec<(f64, Face)> = Vec::new();
    for mut face in faces {
        match shares(scan, edge, dihedral, &mut face) {
            Some(share) => found.push((share, face)),
            None => account.reject(face.judged),
        }
    }
    found.sort_by(|a, b| b.0.total_cmp(&a.0).then(b.1.area.total_cmp(&a.1.area)));
    // One edge bounds one other face; what else comes near is a sliver of it.
    found.truncate(1);
    let account = account.accept(found.first().map(|(_, face)| &face.judged));
    (
        found.iter().map(|(_, face)| FaceEvidence::of(scan, face)).collect(),
        account,
    )
}

/// The share of the edge along which a face at that angle lies; `None` where
/// the edge is not theirs in common.
fn shares(scan: &Scan, edge: &Edge, dihedral: Dihedral, face: &mut Face) -> Option<f64> {
    let angle = interior_angle(scan, edge, face);
    let angle = Condition::about("dihedral", Unit::Angle, angle, dihedral.angle, dihedral.within);
    if !face.judged.holds(angle) {
        return None;
    }
    let share = share_along(scan, edge, face);
    let along = Condition::at_least("along the edge", Unit::Share, share, ALONG);
    if !face.judged.holds(along) {
        return None;
    }
    let another = Condition::plain("a face other than the edge's own", !same_plane(edge, face));
    face.judged.holds(another).then_some(share)
}

/// π − the angle between the outward normals at a convex edge, π + it at a concave one.
fn interior_angle(scan: &Scan, edge: &Edge, face: &Face) -> f64 {
    let turn = edge.face_normal.angle(&face.plane.normal);
    let mean = face
        .pixels
        .iter()
        .map(|&p| scan.cloud.points[p].coords)
        .sum::<crate::geometry::Vector>()
        / face.pixels.len() as f64;
    let above = (mean - edge.midpoint().coords).dot(&edge.face_normal) > 0.0;
    if above { PI + turn } else { PI - turn }
}

/// Whether the face is the one that the edge was taken from.
fn same_plane(edge: &Edge, face: &Face) -> bool {
    let level = [edge.start, edge.end]
        .iter()
        .all(|p| face.plane.distance(p).abs() < NEAR);
    level && face.plane.normal.dot(&edge.face_normal) > 0.97
}

/// Share of the edge's stretches that have a point of the face close by.
fn share_along(scan: &Scan, edge: &Edge, face: &Face) -> f64 {
    let along = edge.end - edge.start;
    let squared = along.norm_squared();
    if squared < 1e-12
        || [edge.start, edge.end]
            .iter()
            .any(|p| face.plane.distance(p).abs() > 2.0 * NEAR)
    {
        return 0.0;
    }
    let mut near = [false; STRETCHES];
    for &pixel in &face.pixels {
        let p = &scan.cloud.points[pixel];
        let reach = scan.cloud.footprint_area(pixel, &face.plane.normal).sqrt();
        if edge.distance(p) > NEAR + reach {
            continue;
        }
        let middle = (p - edge.start).dot(&along) / squared;
        let half = reach / squared.sqrt();
        let stretch = |t: f64| (t.clamp(0.0, 1.0 - 1e-9) * STRETCHES as f64) as usize;
        if middle + half >= 0.0 && middle - half <= 1.0 {
            near[stretch(middle - half)..=stretch(middle + half)].fill(true);
        }
    }
    near.iter().filter(|&&n| n).count() as f64 / STRETCHES as f64
}
