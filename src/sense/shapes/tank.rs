//! A tank: tracks, hull with a sloped front, skirts, turret and gun.
//!
//! Every part is a closed solid of its own; parts overlap inside, and no two
//! visible faces lie in one plane. The flat places for markers (front, rear,
//! two on each skirt, rear deck, turret roof) hold a plate of 276 mm.

use super::builder::Builder;
use super::range;
use crate::geometry::{Point, Vector};
use crate::rules::Call;
use crate::sense::{Mesh, SceneError};

/// The mesh of a `tank` call. Origin on the ground under the hull's middle.
pub(super) fn build(call: &Call) -> Result<Mesh, SceneError> {
    let sizes = 0.05..=10.0;
    let tank = Tank {
        x: range::length(call, "length", sizes.clone())? / 0.90,
        y: range::length(call, "width", sizes.clone())? / 0.60,
        turret: range::length(call, "turret", sizes.clone())? / 2.0,
        gun: range::length(call, "gun", sizes)?,
        colour: call.colour("colour").map_err(SceneError::argument("tank"))?.0,
    };
    Ok(tank.mesh())
}

/// Factors on the proportions of a tank of 0.90 m by 0.60 m; heights go with the width.
struct Tank {
    x: f64,
    y: f64,
    turret: f64,
    gun: f64,
    colour: [u8; 3],
}

impl Tank {
    fn mesh(&self) -> Mesh {
        let mut builder = Builder::default();
        let (dark, light) = (self.shade(0.45), self.shade(1.15));
        // Lower hull: vertical front up to 0.305, then the sloped glacis.
        let hull = [
            (-0.45, 0.02),
            (0.45, 0.02),
            (0.45, 0.305),
            (0.36, 0.339),
            (-0.45, 0.339),
        ];
        self.across(&mut builder, &hull, -0.20, 0.20, self.colour);
        let track = [
            (-0.44, 0.14),
            (-0.36, 0.0),
            (0.34, 0.0),
            (0.44, 0.14),
            (0.44, 0.22),
            (0.36, 0.30),
            (-0.36, 0.30),
            (-0.44, 0.22),
        ];
        let skirt = [(-0.40, 0.03), (0.40, 0.03), (0.40, 0.325), (-0.40, 0.325)];
        for side in [-1.0, 1.0] {
            let span = |a: f64, b: f64| (f64::min(a * side, b * side), f64::max(a * side, b * side));
            let (from, to) = span(0.19, 0.292);
            self.across(&mut builder, &track, from, to, dark);
            let (from, to) = span(0.285, 0.30);
            self.across(&mut builder, &skirt, from, to, light);
        }
        let deck = [(-0.445, 0.31), (0.35, 0.31), (0.35, 0.34), (-0.445, 0.34)];
        self.across(&mut builder, &deck, -0.295, 0.295, self.colour);
        self.turret(&mut builder);
        builder.finish()
    }

    /// An eight-sided turret with the gun through its front side.
    fn turret(&self, builder: &mut Builder) {
        let middle = Point::new(0.08 * self.x, 0.0, 0.33 * self.y);
        let eighth = std::f64::consts::FRAC_PI_4;
        let ring = |k: i32, radius: f64| {
            let turn = (f64::from(k) - 0.5) * eighth;
            (radius * turn.cos(), radius * turn.sin())
        };
        let outline: Vec<Point> = (0..8)
            .map(|k| {
                let (x, y) = ring(k, self.turret);
                middle + Vector::new(x, y, 0.0)
            })
            .collect();
        builder.swept(&outline, Vector::z() * (0.16 * self.y), self.shade(1.08));
        let bore = middle + Vector::z() * (0.085 * self.y);
        let muzzle: Vec<Point> = (0..8)
            .map(|k| {
                let (y, z) = ring(k, 0.028 * self.y);
                bore + Vector::new(0.0, y, z)
            })
            .collect();
        let reach = self.turret * (eighth / 2.0).cos() + self.gun;
        builder.swept(&muzzle, Vector::x() * reach, self.shade(0.7));
    }

    /// Adds the solid of a profile (x, z; counter-clockwise seen from −y)
    /// between two widths.
    fn across(&self, builder: &mut Builder, profile: &[(f64, f64)], from: f64, to: f64, colour: [u8; 3]) {
        let outline: Vec<Point> = profile
            .iter()
            .rev()
            .map(|&(x, z)| Point::new(x * self.x, from * self.y, z * self.y))
            .collect();
        builder.swept(&outline, Vector::y() * ((to - from) * self.y), colour);
    }

    fn shade(&self, factor: f64) -> [u8; 3] {
        self.colour.map(|c| (f64::from(c) * factor).min(255.0) as u8)
    }
}
