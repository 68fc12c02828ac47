//! Prisms: a base, flat sides that may taper and lean, deformations.

use super::builder::Builder;
use super::deform::{Deformations, Face, Pocket, misfit};
use super::outline::{Base, OutlinePoint, SIZES};
use super::range::{self, out_of_range};
use super::simple;
use super::triangulate::Flat;
use crate::geometry::{Point, Vector};
use crate::rules::Call;
use crate::sense::{Mesh, SceneError};

/// The mesh of a `prism` call.
pub(super) fn build(call: &Call) -> Result<Mesh, SceneError> {
    let base = Base::of(call)?;
    let height = range::length(call, "height", SIZES)?;
    let top = top(&base, height, call)?;
    let deformed = Deformations::of(call, base.sides())?;
    let low = base.outline(&deformed.notches, call)?;
    let bottom = raised(&low, -height / 2.0);
    let lid = raised(&top.outline(&deformed.notches, call)?, height / 2.0);

    let mut builder = Builder::default();
    let colours = Colours::of(call)?;
    build_bottom(&bottom, &deformed, colours.bottom, call, &mut builder)?;
    let top_colour = call.colour("top").map_err(SceneError::argument("prism"))?.0;
    builder.face(&lid, &[], top_colour).ok_or_else(|| crossing(call))?;
    let sides = sides(&base, &top, height);
    let panels = (0..low.len()).map(|i| {
        let j = (i + 1) % low.len();
        (low[i].side, vec![bottom[i], bottom[j], lid[j], lid[i]])
    });
    build_sides(&sides, panels, &deformed, colours.side, call, &mut builder)?;
    simple::checked(builder.finish()).ok_or_else(|| crossing(call))
}

/// The base as taper and lean leave it at the top.
fn top(base: &Base, height: f64, call: &Call) -> Result<Base, SceneError> {
    let taper = range::angle(call, "taper", -0.8..=0.8)?;
    let inset = base.inset(height * taper.tan()).ok_or_else(|| {
        let found = format!("{:.1} deg over {:.0} mm", taper.to_degrees(), height * 1e3);
        out_of_range(call, "taper", found, "one that leaves a top")
    })?;
    Ok(inset.shifted(height * lean(call)?.tan()))
}

/// Whole sides between base and top.
fn sides(base: &Base, top: &Base, height: f64) -> Vec<Side> {
    let corner = |p: Flat, z: f64| Point::new(p[0], p[1], z);
    let (low, high) = (-height / 2.0, height / 2.0);
    (0..base.sides())
        .map(|k| {
            let ((a, b), (c, d)) = (base.side(k), top.side(k));
            Side::new(vec![corner(a, low), corner(b, low), corner(d, high), corner(c, high)])
        })
        .collect()
}

fn raised(points: &[OutlinePoint], z: f64) -> Vec<Point> {
    points.iter().map(|p| Point::new(p.at[0], p.at[1], z)).collect()
}

/// Colours of bottom and sides.
pub(super) struct Colours {
    pub(super) bottom: [u8; 3],
    pub(super) side: [u8; 3],
}

impl Colours {
    pub(super) fn of(call: &Call) -> Result<Self, SceneError> {
        let read = |name| call.colour(name).map_err(SceneError::argument(&call.primitive));
        Ok(Self {
            bottom: read("bottom")?.0,
            side: read("side")?.0,
        })
    }
}

/// The `lean` of a call.
pub(super) fn lean(call: &Call) -> Result<f64, SceneError> {
    range::angle(call, "lean", -0.8..=0.8)
}

/// The error of deformations that run into each other.
pub(super) fn crossing(call: &Call) -> SceneError {
    out_of_range(
        call,
        "deformed",
        "deformations that run into each other or through a side".to_owned(),
        "shallower or fewer ones",
    )
}

/// Adds the bottom, which faces down; `points` run counter-clockwise from above.
pub(super) fn build_bottom(
    points: &[Point],
    deformed: &Deformations,
    colour: [u8; 3],
    call: &Call,
    builder: &mut Builder,
) -> Result<(), SceneError> {
    let outline: Vec<Point> = points.iter().rev().copied().collect();
    let face = Face {
        outline: &outline,
        origin: Point::new(0.0, 0.0, points[0].z),
        right: Vector::x(),
        up: -Vector::y(),
    };
    let extent = |f: fn(&Point) -> f64| {
        let low = points.iter().map(f).fold(f64::INFINITY, f64::min);
        let high = points.iter().map(f).fold(f64::NEG_INFINITY, f64::max);
        (low, high)
    };
    let ((x0, x1), (y0, y1)) = (extent(|p| p.x), extent(|p| p.y));
    let pockets: Vec<(Pocket, Flat)> = deformed
        .pockets
        .iter()
        .filter(|p| p.side.is_none())
        .map(|p| (*p, [x0 + (x1 - x0) * p.across, -(y0 + (y1 - y0) * p.up)]))
        .collect();
    face.build(&pockets, colour, call, builder)
}

/// A whole side before notches: the frame that its dents are placed in.
pub(super) struct Side {
    corners: Vec<Point>,
    right: Vector,
    up: Vector,
}

impl Side {
    /// A side from its corners, bottom edge first, counter-clockwise from outside.
    pub(super) fn new(corners: Vec<Point>) -> Self {
        let right = (corners[1] - corners[0]).normalize();
        let out = right.cross(&(corners[2] - corners[0])).normalize();
        Self {
            right,
            up: out.cross(&right),
            corners,
        }
    }

    /// A face of this side's frame.
    fn face<'a>(&self, outline: &'a [Point]) -> Face<'a> {
        Face {
            outline,
            origin: self.corners[0],
            right: self.right,
            up: self.up,
        }
    }

    /// Where the middle of a pocket lies, right and up.
    fn centre(&self, pocket: &Pocket) -> Flat {
        let face = self.face(&self.corners);
        let flat: Vec<Flat> = self.corners.iter().map(|p| face.flat(p)).collect();
        let (left_top, right_top) = (flat[flat.len() - 1], flat[2]);
        let t = pocket.up;
        let left = left_top[0] * t;
        let right = flat[1][0] + (right_top[0] - flat[1][0]) * t;
        [left + (right - left) * pocket.across, left_top[1] * t]
    }
}

/// Adds all panels; each pocket goes to the panel of its side that holds it.
pub(super) fn build_sides(
    sides: &[Side],
    panels: impl Iterator<Item = (Option<usize>, Vec<Point>)>,
    deformed: &Deformations,
    colour: [u8; 3],
    call: &Call,
    builder: &mut Builder,
) -> Result<(), SceneError> {
    let mut left: Vec<Pocket> = deformed.pockets.iter().filter(|p| p.side.is_some()).copied().collect();
    for (side, outline) in panels {
        let Some(k) = side else {
            builder.convex(&outline, colour);
            continue;
        };
        let face = sides[k].face(&outline);
        let mut mine = Vec::new();
        left.retain(|pocket| {
            let centre = sides[k].centre(pocket);
            let held = pocket.side == Some(k) && pocket.rim(centre, &face).is_some();
            if held {
                mine.push((*pocket, centre));
            }
            !held
        });
        face.build(&mine, colour, call, builder)?;
    }
    left.first().map_or(Ok(()), |pocket| Err(misfit(pocket, call)))
}
