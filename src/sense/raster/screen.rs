//! From world points to corners on a grid of fractions of a pixel.

use super::clip::Homogeneous;
use crate::geometry::{Intrinsics, Point, Pose};

/// Nothing nearer to the eye plane is drawn, metres.
pub(super) const NEAREST: f64 = 1e-5;
/// Corners lie within ±REACH steps of the grid, so that twice the area of any
/// triangle of them fits 64 bits.
pub(super) const REACH: f64 = (1_i64 << 30) as f64;
/// 1.5 · 2⁵²: adding it rounds a number of up to 51 bits to a whole one, which
/// is then in the low bits of its mantissa. Unlike a cast it vectorises.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// The world as seen by one camera.
///
/// The grid's origin is the centre of pixel (width / 2, height / 2). It is as
/// fine as `REACH` allows: 2²⁰ steps a pixel at 640 columns.
pub(super) struct Screen {
    pub(super) width: u32,
    pub(super) height: u32,
    /// Steps of the grid a pixel, as a power of two.
    pub(super) bits: u32,
    /// World point → (x · z, y · z, z): x and y in steps, z in metres.
    rows: [[f64; 4]; 3],
}

/// A mesh corner on the grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// Column and row, steps.
    pub(super) at: [i32; 2],
    /// 1 / depth, 1/m.
    pub(super) inverse: f32,
    /// The planes of the view that it lies outside, a bit each; `at` and
    /// `inverse` are meaningless unless this is 0.
    pub(super) outside: u32,
}

impl Screen {
    pub(super) fn new(image: &Intrinsics, camera_from_world: &Pose) -> Self {
        let bits = 29 - image.width.max(image.height).max(1).ilog2().min(28);
        let step = f64::from(1_u32 << bits);
        let turned = camera_from_world.to_homogeneous();
        let axis = |focal: f64, principal: f64, middle: u32, row: usize| {
            let shift = principal - f64::from(middle) - 0.5;
            [0, 1, 2, 3].map(|k| step * (focal * turned[(row, k)] + shift * turned[(2, k)]))
        };
        Self {
            width: image.width,
            height: image.height,
            bits,
            rows: [
                axis(image.fx, image.cx, image.width / 2, 0),
                axis(image.fy, image.cy, image.height / 2, 1),
                [0, 1, 2, 3].map(|k| turned[(2, k)]),
            ],
        }
    }

    #[inline]
    pub(super) fn homogeneous(&self, p: &Point) -> Homogeneous {
        self.rows.map(|r| r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3])
    }

    #[inline]
    pub(super) fn corner(&self, p: &Point) -> Corner {
        let [x, y, z] = self.homogeneous(p);
        let reach = REACH * z;
        // So written that what is not a number is outside.
        let outside = [
            !(z >= NEAREST),
            !(x >= -reach),
            !(x <= reach),
            !(y >= -reach),
            !(y <= reach),
        ];
        let inverse = 1.0 / z;
        Corner {
            at: [x, y].map(|c| snap(c * inverse)),
            inverse: inverse as f32,
            outside: (0..5).map(|k| u32::from(outside[k]) << k).sum(),
        }
    }
}

impl Corner {
    /// A corner of a clipped triangle; one that was inside stays where it was.
    pub(super) fn clipped([x, y, z]: Homogeneous) -> Self {
        let inverse = 1.0 / z;
        Self {
            at: [x, y].map(|c| snap((c * inverse).clamp(-REACH, REACH))),
            inverse: inverse as f32,
            outside: 0,
        }
    }
}

/// The nearest whole number.
#[inline]
fn snap(steps: f64) -> i32 {
    (steps + ROUND).to_bits() as i32
}
