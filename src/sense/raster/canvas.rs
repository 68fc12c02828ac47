//! Filling of triangles into a depth buffer, in whole numbers.

use super::NOTHING;
use super::screen::{Corner, Screen};

/// Triangles at least so many pixels wide are filled row by row, narrower ones
/// pixel by pixel.
const WIDE: i64 = 8;

/// The nearest triangle at every pixel so far; among equally near ones, the
/// first.
pub(super) struct Canvas {
    /// 1 / depth, 1/m; 0 where nothing is hit.
    pub(super) inverse: Vec<f32>,
    /// Index in the mesh; `NOTHING` where nothing is hit.
    pub(super) triangles: Vec<u32>,
    width: i64,
    height: i64,
    bits: u32,
}

/// Pixels that a triangle may cover: first and last column and row.
#[derive(Clone, Copy)]
struct Extent {
    columns: [i64; 2],
    rows: [i64; 2],
}

/// Twice the area of the triangle of a pixel centre and an edge: what weighs the
/// corner across the edge.
#[derive(Clone, Copy)]
struct Weight {
    /// At the pixel reached.
    here: i64,
    /// Gained by a step to the next column, and to the next row.
    right: i64,
    down: i64,
}

impl Canvas {
    pub(super) fn new(screen: &Screen) -> Self {
        let pixels = screen.width as usize * screen.height as usize;
        Self {
            inverse: vec![0.0; pixels],
            triangles: vec![NOTHING; pixels],
            width: i64::from(screen.width),
            height: i64::from(screen.height),
            bits: screen.bits,
        }
    }

    /// Whether a triangle within the view may cover a pixel.
    #[inline]
    pub(super) fn may_show(&self, corners: [&Corner; 3]) -> bool {
        let Extent { columns, rows } = self.extent(corners);
        (columns[0] <= columns[1]) & (rows[0] <= rows[1])
    }

    #[inline]
    fn extent(&self, corners: [&Corner; 3]) -> Extent {
        let range = |axis: usize, size: i64| {
            let [a, b, c] = corners.map(|corner| corner.at[axis]);
            let (low, high) = (i64::from(a.min(b).min(c)), i64::from(a.max(b).max(c)));
            let first = (low + (1 << self.bits) - 1) >> self.bits;
            let last = high >> self.bits;
            [(first + size / 2).max(0), (last + size / 2).min(size - 1)]
        };
        Extent {
            columns: range(0, self.width),
            rows: range(1, self.height),
        }
    }

    /// Draws a triangle within the view.
    #[inline]
    pub(super) fn draw(&mut self, triangle: u32, corners: [&Corner; 3]) {
        let extent = self.extent(corners);
        let from = [
            (extent.columns[0] - self.width / 2) << self.bits,
            (extent.rows[0] - self.height / 2) << self.bits,
        ];
        let [a, b, c] = corners.map(|corner| [0, 1].map(|k| i64::from(corner.at[k]) - from[k]));
        let weights = [self.weight(b, c), self.weight(c, a), self.weight(a, b)];
        let area: i64 = weights.iter().map(|w| w.here).sum();
        if area == 0 {
            return;
        }
        let weights = if area > 0 { weights } else { weights.map(Weight::turned) };
        let fill = Fill {
            triangle,
            weights,
            inverse: corners.map(|corner| f64::from(corner.inverse)),
            per_area: 1.0 / area.abs() as f64,
        };
        if extent.columns[1] - extent.columns[0] < WIDE {
            self.fill_pixels(extent, fill);
        } else {
            self.fill_rows(extent, fill);
        }
    }

    #[inline]
    fn weight(&self, p: [i64; 2], q: [i64; 2]) -> Weight {
        Weight {
            here: p[0] * q[1] - p[1] * q[0],
            right: (p[1] - q[1]) << self.bits,
            down: (q[0] - p[0]) << self.bits,
        }
    }

    #[inline]
    fn fill_pixels(&mut self, extent: Extent, mut fill: Fill) {
        for row in extent.rows[0]..=extent.rows[1] {
            let mut here = fill.weights.map(|w| w.here);
            for column in extent.columns[0]..=extent.columns[1] {
                // The sign bit is set where any of them is negative.
                if here[0] | here[1] | here[2] >= 0 {
                    let k = (row * self.width + column) as usize;
                    let near = fill.mean(here.map(|w| w as f64)) as f32;
                    if near > self.inverse[k] {
                        self.inverse[k] = near;
                        self.triangles[k] = fill.triangle;
                    }
                }
                here = [0, 1, 2].map(|k| here[k] + fill.weights[k].right);
            }
            fill.step_down();
        }
    }

    fn fill_rows(&mut self, extent: Extent, mut fill: Fill) {
        let slope = fill.mean(fill.weights.map(|w| w.right as f64));
        let [low, high] = fill.bounds();
        for row in extent.rows[0]..=extent.rows[1] {
            let steps = fill.covered(extent.columns[1] - extent.columns[0]);
            if let Some((first, last)) = steps {
                let start = fill.mean(fill.weights.map(|w| (w.here + first * w.right) as f64));
                let at = (row * self.width + extent.columns[0] + first) as usize;
                let pixels = at..at + (last - first) as usize + 1;
                let line = self.inverse[pixels.clone()].iter_mut().zip(&mut self.triangles[pixels]);
                for (k, (inverse, shown)) in line.enumerate() {
                    let near = (start + k as i32 as f64 * slope) as f32;
                    let near = if near < low { low } else { near };
                    let near = if near > high { high } else { near };
                    let nearer = near > *inverse;
                    *inverse = if nearer { near } else { *inverse };
                    *shown = if nearer { fill.triangle } else { *shown };
                }
            }
            fill.step_down();
        }
    }

    /// Adds what another canvas of later triangles shows nearer.
    pub(super) fn merge(&mut self, later: &Self) {
        let here = self.inverse.iter_mut().zip(&mut self.triangles);
        let there = later.inverse.iter().zip(&later.triangles);
        for ((inverse, triangle), (&other, &shown)) in here.zip(there) {
            let nearer = other > *inverse;
            *inverse = if nearer { other } else { *inverse };
            *triangle = if nearer { shown } else { *triangle };
        }
    }
}

/// A triangle on its way over the image.
struct Fill {
    triangle: u32,
    /// Not negative, all three, where a pixel is covered.
    weights: [Weight; 3],
    inverse: [f64; 3],
    per_area: f64,
}

impl Fill {
    /// 1 / depth where the corners have some weights: it is linear on the image.
    #[inline]
    fn mean(&self, weights: [f64; 3]) -> f64 {
        let [a, b, c] = [0, 1, 2].map(|k| weights[k] * self.inverse[k]);
        (a + b + c) * self.per_area
    }

    fn bounds(&self) -> [f32; 2] {
        let [a, b, c] = self.inverse.map(|i| i as f32);
        [a.min(b).min(c), a.max(b).max(c)]
    }

    #[inline]
    fn step_down(&mut self) {
        for weight in &mut self.weights {
            weight.here += weight.down;
        }
    }

    /// The first and last step to the right, of at most `most`, to a covered pixel.
    fn covered(&self, most: i64) -> Option<(i64, i64)> {
        let (mut first, mut last) = (0, most);
        for Weight { here, right, .. } in self.weights {
            if right > 0 {
                // Rounded up: where the weight is still negative there.
                first = first.max(-here.div_euclid(right));
            } else if right < 0 {
                last = last.min(here.div_euclid(-right));
            } else if here < 0 {
                return None;
            }
        }
        (first <= last).then_some((first, last))
    }
}

impl Weight {
    /// The same with corners in the other order.
    fn turned(self) -> Self {
        Self {
            here: -self.here,
            right: -self.right,
            down: -self.down,
        }
    }
}
