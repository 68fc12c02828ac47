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
/// Pixels and the grid are counted from pixel (width / 2, height / 2), from its
/// centre. The grid is as fine as `REACH` allows: 2²⁰ steps a pixel at 640 columns.
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

/// The pixels whose centres lie in a box: first column, first row, − last column,
/// − last row. So the least of each of some boxes is the box around them. Whole,
/// and yet floats: only of these does the baseline processor take four minima at once.
pub(super) type Cells = [f32; 4];

/// Cells of a corner that may lie anywhere.
const ANYWHERE: Cells = [f32::NEG_INFINITY; 4];

impl Screen {
    pub(super) fn new(image: &Intrinsics, camera_from_world: &Pose) -> Self {
        let bits = 29 - image.width.max(image.height).max(1).ilog2().min(29);
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
        // What is not a number is not inside.
        let inside = [z >= NEAREST, x >= -reach, x <= reach, y >= -reach, y <= reach];
        let inverse = 1.0 / z;
        Corner {
            at: [x, y].map(|c| snap(c * inverse)),
            inverse: inverse as f32,
            outside: bits(inside.map(|inside| !inside)),
        }
    }

    /// The pixels at a corner: one, if it falls on a centre, and otherwise none.
    #[inline]
    pub(super) fn cells(&self, corner: &Corner) -> Cells {
        let up = |c: i32| ((c + ((1 << self.bits) - 1)) >> self.bits) as f32;
        let [x, y] = corner.at;
        if corner.outside == 0 {
            [up(x), up(y), up(-x), up(-y)]
        } else {
            ANYWHERE
        }
    }

    /// Column and row of the pixel that all others are counted from.
    pub(super) fn middle(&self) -> [i64; 2] {
        [self.width, self.height].map(|size| i64::from(size / 2))
    }

    /// The box of all pixels.
    pub(super) fn image(&self) -> Cells {
        let [x, y] = self.middle();
        let [right, bottom] = [x + 1 - i64::from(self.width), y + 1 - i64::from(self.height)];
        [-x, -y, right, bottom].map(|k| k as f32)
    }
}

/// The smallest box around boxes.
#[inline]
pub(super) fn around([a, b, c]: [&Cells; 3]) -> Cells {
    let least = |a: f32, b: f32| if a < b { a } else { b };
    std::array::from_fn(|k| least(least(a[k], b[k]), c[k]))
}

/// Whether a box is that of something outside the view.
#[inline]
pub(super) fn anywhere(cells: &Cells) -> bool {
    cells[0] == f32::NEG_INFINITY
}

/// What two boxes have in common.
#[inline]
pub(super) fn common(a: &Cells, b: &Cells) -> Cells {
    std::array::from_fn(|k| if a[k] > b[k] { a[k] } else { b[k] })
}

/// Whether a box holds a pixel.
#[inline]
pub(super) fn holds_any([left, top, right, bottom]: Cells) -> bool {
    (left + right <= 0.0) & (top + bottom <= 0.0)
}

impl Corner {
    /// A corner of a clipped triangle; one that was inside stays where it was.
    pub(super) fn clipped([x, y, z]: Homogeneous) -> Self {
        let inverse = 1.0 / z;
        Self {
            at: [x, y].map(|c| snap((c * inverse).clamp(-REACH, REACH))),
            // Not a number where a corner of the mesh is infinitely far.
            inverse: (inverse as f32).max(0.0),
            outside: 0,
        }
    }
}

#[inline]
fn bits(flags: [bool; 5]) -> u32 {
    let mut bits = 0;
    for flag in flags {
        bits = bits << 1 | u32::from(flag);
    }
    bits
}

/// The nearest whole number.
#[inline]
fn snap(steps: f64) -> i32 {
    (steps + ROUND).to_bits() as i32
}
