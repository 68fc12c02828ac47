//! Dents, bumps and notches.
//!
//! A dent or bump is a truncated pyramid pressed into or standing out of one
//! flat face; its walls are steep, so a deep dent hides its floor from most
//! views. A notch belongs to the outline (`outline`).

use super::builder::Builder;
use super::range::{self, out_of_range};
use super::triangulate::{Flat, cross};
use crate::geometry::{Point, Polygon, Vector};
use crate::rules::Call;
use crate::sense::SceneError;

/// Run of a wall over its height: 8° from the face's normal.
const WALL_RUN: f64 = 0.14;
/// What is left of a face around a dent or bump, metres.
const MARGIN: f64 = 0.001;

/// A groove over the whole height of a side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Notch {
    /// From 0.
    pub(super) side: usize,
    /// Share of the side's width.
    pub(super) at: f64,
    pub(super) width: f64,
    pub(super) depth: f64,
}

/// A dent (depth below zero) or bump (above) of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pocket {
    /// From 0; `None` is the bottom.
    pub(super) side: Option<usize>,
    pub(super) across: f64,
    pub(super) up: f64,
    pub(super) width: f64,
    pub(super) height: f64,
    /// How far it stands out, metres.
    pub(super) out: f64,
}

/// What a call's `deformed` lists.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Deformations {
    /// Ordered along each side.
    pub(super) notches: Vec<Notch>,
    pub(super) pockets: Vec<Pocket>,
}

/// A face's frame: corner, right and up as seen from outside, and what a
/// pocket's shares are counted over.
pub(super) struct Face<'a> {
    pub(super) outline: &'a [Point],
    pub(super) origin: Point,
    pub(super) right: Vector,
    pub(super) up: Vector,
}

impl Deformations {
    /// The deformations of a shape with a number of sides.
    pub(super) fn of(shape: &Call, sides: usize) -> Result<Self, SceneError> {
        let mut all = Self::default();
        let calls = shape
            .calls("deformed")
            .map_err(SceneError::argument(&shape.primitive))?;
        for call in calls {
            match call.primitive.as_str() {
                "dent" => all.pockets.push(pocket(call, sides, -1.0)?),
                "bump" => all.pockets.push(pocket(call, sides, 1.0)?),
                "notch" => all.notches.push(notch(call, sides)?),
                other => {
                    let found = format!("`{other}`");
                    return Err(out_of_range(shape, "deformed", found, "`dent`, `bump` or `notch`"));
                }
            }
        }
        all.notches.sort_by(|a, b| a.at.total_cmp(&b.at));
        Ok(all)
    }
}

fn notch(call: &Call, sides: usize) -> Result<Notch, SceneError> {
    Ok(Notch {
        side: range::count(call, "side", 1..=sides as u64)? as usize - 1,
        at: range::share(call, "at")?,
        width: range::length(call, "width", 0.002..=10.0)?,
        depth: range::length(call, "depth", 0.001..=10.0)?,
    })
}

fn pocket(call: &Call, sides: usize, sign: f64) -> Result<Pocket, SceneError> {
    let side = range::count(call, "side", 0..=sides as u64)? as usize;
    let pocket = Pocket {
        side: side.checked_sub(1),
        across: range::share(call, "across")?,
        up: range::share(call, "up")?,
        width: range::length(call, "width", 0.002..=10.0)?,
        height: range::length(call, "height", 0.002..=10.0)?,
        out: range::length(call, "depth", 0.001..=10.0)? * sign,
    };
    let narrowest = pocket.width.min(pocket.height);
    if pocket.out.abs() * WALL_RUN * 2.0 > narrowest - 0.001 {
        let found = format!("{:.0} mm over {:.0} mm", pocket.out.abs() * 1e3, narrowest * 1e3);
        let most = (narrowest - 0.001) / (2.0 * WALL_RUN) * 1e3;
        return Err(out_of_range(
            call,
            "depth",
            found,
            format!("at most {most:.0} mm there"),
        ));
    }
    Ok(pocket)
}

impl Pocket {
    /// The rim of the pocket centred at `centre` (right, up) of a face,
    /// counter-clockwise, if the face holds it with a margin.
    pub(super) fn rim(&self, centre: Flat, face: &Face) -> Option<[Point; 4]> {
        let outline: Vec<Flat> = face.outline.iter().map(|p| face.flat(p)).collect();
        let around = self.rectangle(centre, -MARGIN);
        let inside = Polygon::new(outline.iter().map(|p| Point::new(p[0], p[1], 0.0)).collect())?;
        let free = (0..4).all(|i| {
            let (a, b) = (around[i], around[(i + 1) % 4]);
            inside.contains_projection(&Point::new(a[0], a[1], 0.0))
                && (0..outline.len()).all(|k| !cross(a, b, outline[k], outline[(k + 1) % outline.len()]))
        });
        free.then(|| self.rectangle(centre, 0.0).map(|p| face.point(p, 0.0)))
    }

    /// Adds walls and floor.
    pub(super) fn build(&self, centre: Flat, face: &Face, rim: &[Point; 4], colour: [u8; 3], builder: &mut Builder) {
        let floor = self
            .rectangle(centre, self.out.abs() * WALL_RUN)
            .map(|p| face.point(p, self.out));
        for i in 0..4 {
            let j = (i + 1) % 4;
            builder.convex(&[rim[i], rim[j], floor[j], floor[i]], colour);
        }
        builder.convex(&floor, colour);
    }

    fn rectangle(&self, centre: Flat, inset: f64) -> [Flat; 4] {
        let (w, h) = (self.width / 2.0 - inset, self.height / 2.0 - inset);
        [[-w, -h], [w, -h], [w, h], [-w, h]].map(|d| [centre[0] + d[0], centre[1] + d[1]])
    }
}

impl Face<'_> {
    /// Coordinates of a point, right and up.
    pub(super) fn flat(&self, p: &Point) -> Flat {
        [(p - self.origin).dot(&self.right), (p - self.origin).dot(&self.up)]
    }

    fn point(&self, p: Flat, out: f64) -> Point {
        self.origin + self.right * p[0] + self.up * p[1] + self.right.cross(&self.up) * out
    }

    /// Adds the face with its pockets, each of them with its centre.
    ///
    /// # Errors
    /// A pocket leaves the face or meets another.
    pub(super) fn build(
        &self,
        pockets: &[(Pocket, Flat)],
        colour: [u8; 3],
        shape: &Call,
        builder: &mut Builder,
    ) -> Result<(), SceneError> {
        let mut rims = Vec::new();
        for (pocket, centre) in pockets {
            rims.push(pocket.rim(*centre, self).ok_or_else(|| misfit(pocket, shape))?);
        }
        if builder.face(self.outline, &rims, colour).is_none() {
            let found = "dents or bumps that meet on one face".to_owned();
            return Err(out_of_range(
                shape,
                "deformed",
                found,
                "deformations apart from each other",
            ));
        }
        for ((pocket, centre), rim) in pockets.iter().zip(&rims) {
            pocket.build(*centre, self, rim, colour, builder);
        }
        Ok(())
    }
}

/// The error of a pocket that no flat part of its side holds.
pub(super) fn misfit(pocket: &Pocket, shape: &Call) -> SceneError {
    let side = pocket
        .side
        .map_or("the bottom".to_owned(), |k| format!("side {}", k + 1));
    let found = format!(
        "{} of {:.0} mm by {:.0} mm that does not fit a flat part of {side}",
        if pocket.out < 0.0 { "a dent" } else { "a bump" },
        pocket.width * 1e3,
        pocket.height * 1e3,
    );
    out_of_range(
        shape,
        "deformed",
        found,
        "one that lies within its side, beside notches",
    )
}
