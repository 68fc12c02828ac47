//! The base of prisms and pyramids: a regular polygon, stretched, with notches.

use super::deform::Notch;
use super::range::{self, out_of_range};
use super::triangulate::Flat;
use crate::rules::Call;
use crate::sense::SceneError;

/// Sizes that a shape may have, metres.
pub(super) const SIZES: std::ops::RangeInclusive<f64> = 0.005..=10.0;

/// The corners of a base: side k (from 0) runs from corner k to corner k + 1.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Base(pub(super) Vec<Flat>);

/// A corner of a base outline with notches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct OutlinePoint {
    pub(super) at: Flat,
    /// The side that the stretch from here to the next point is a flat part
    /// of; `None` for the walls of a notch.
    pub(super) side: Option<usize>,
}

impl Base {
    /// The base that `sides`, `radius` and `stretch` of a call describe.
    pub(super) fn of(call: &Call) -> Result<Self, SceneError> {
        let n = range::count(call, "sides", 3..=12)?;
        let radius = range::length(call, "radius", SIZES)?;
        let stretch = range::number(call, "stretch", 0.1..=10.0)?;
        let step = std::f64::consts::TAU / n as f64;
        let corner = |k: u64| {
            let turn = (k as f64 - 0.5) * step;
            [radius * turn.cos() * stretch, radius * turn.sin()]
        };
        Ok(Self((0..n).map(corner).collect()))
    }

    /// Number of sides.
    pub(super) fn sides(&self) -> usize {
        self.0.len()
    }

    /// Both ends of a side.
    pub(super) fn side(&self, k: usize) -> (Flat, Flat) {
        (self.0[k], self.0[(k + 1) % self.0.len()])
    }

    /// The base with every side moved inwards; `None` where a side would vanish.
    pub(super) fn inset(&self, by: f64) -> Option<Self> {
        let n = self.sides();
        let lines: Vec<(Flat, Flat)> = (0..n)
            .map(|k| {
                let (a, b) = self.side(k);
                let d = direction(a, b);
                ([a[0] - d[1] * by, a[1] + d[0] * by], d)
            })
            .collect();
        let corners = (0..n)
            .map(|k| meet(lines[(k + n - 1) % n], lines[k]))
            .collect::<Option<Vec<Flat>>>()?;
        let inset = Self(corners);
        let kept = |k: usize| {
            let (a, b) = inset.side(k);
            let d = lines[k].1;
            (b[0] - a[0]) * d[0] + (b[1] - a[1]) * d[1] > 0.002
        };
        (0..n).all(kept).then_some(inset)
    }

    /// The base moved along x.
    pub(super) fn shifted(mut self, dx: f64) -> Self {
        for p in &mut self.0 {
            p[0] += dx;
        }
        self
    }

    /// The outline with its notches, each of them at its share of its side.
    pub(super) fn outline(&self, notches: &[Notch], call: &Call) -> Result<Vec<OutlinePoint>, SceneError> {
        let mut points = Vec::new();
        for k in 0..self.sides() {
            let (a, b) = self.side(k);
            let (d, length) = (direction(a, b), distance(a, b));
            points.push(OutlinePoint { at: a, side: Some(k) });
            let mut free_from = 0.0;
            for notch in notches.iter().filter(|n| n.side == k) {
                let middle = notch.at * length;
                let (from, to) = (middle - notch.width / 2.0, middle + notch.width / 2.0);
                if from < free_from + 0.002 || to > length - 0.002 {
                    return Err(out_of_range(
                        call,
                        "deformed",
                        format!(
                            "a notch of {:.0} mm in side {} of {:.0} mm",
                            notch.width * 1e3,
                            k + 1,
                            length * 1e3
                        ),
                        "notches that fit their side, at its top too, and do not meet",
                    ));
                }
                free_from = to;
                points.extend(notch_points(a, d, [from, to], notch.depth, k));
            }
        }
        Ok(points)
    }
}

fn notch_points(a: Flat, d: Flat, [from, to]: [f64; 2], depth: f64, side: usize) -> [OutlinePoint; 4] {
    let along = |s: f64, inwards: f64| [a[0] + d[0] * s - d[1] * inwards, a[1] + d[1] * s + d[0] * inwards];
    [
        (along(from, 0.0), None),
        (along(from, depth), None),
        (along(to, depth), None),
        (along(to, 0.0), Some(side)),
    ]
    .map(|(at, side)| OutlinePoint { at, side })
}

pub(super) fn distance(a: Flat, b: Flat) -> f64 {
    (b[0] - a[0]).hypot(b[1] - a[1])
}

fn direction(a: Flat, b: Flat) -> Flat {
    let length = distance(a, b);
    [(b[0] - a[0]) / length, (b[1] - a[1]) / length]
}

/// Where two lines (point, direction) meet.
fn meet((p, d): (Flat, Flat), (q, e): (Flat, Flat)) -> Option<Flat> {
    let across = d[0] * e[1] - d[1] * e[0];
    let t = ((q[0] - p[0]) * e[1] - (q[1] - p[1]) * e[0]) / across;
    (across.abs() > 1e-9).then_some([p[0] + d[0] * t, p[1] + d[1] * t])
}
