//! Filling of triangles into a depth buffer, in whole numbers.

use super::screen::{Cells, Corner, Screen};

/// Triangles at least so many pixels wide are filled row by row, narrower ones
/// pixel by pixel.
const WIDE: usize = 8;

/// What shows at a pixel so far: the bits of 1 / depth above those of the
/// complement of a triangle's index; 0 where nothing is hit. The greatest shows:
/// the nearest, and among equally near ones the first of the mesh. So the order
/// of drawing does not matter, and canvases are merged by the same rule.
pub(super) type Pixel = u64;

/// An image's pixels.
pub(super) struct Canvas {
    pub(super) pixels: Vec<Pixel>,
    width: usize,
    /// Column and row from which the screen counts.
    middle: [i64; 2],
    bits: u32,
}

/// Rows and columns of an image from `first` up to `end`.
#[derive(Clone, Copy)]
struct Window {
    first: [usize; 2],
    end: [usize; 2],
}

/// A triangle on its way over the image. What weighs a corner is twice the area
/// of the triangle of the pixel centre and the edge across.
struct Fill {
    triangle: u32,
    /// Weights at the first pixel of a row; none is negative where it is covered.
    here: [i64; 3],
    /// What a step to the next column, and to the next row, adds.
    right: [i64; 3],
    down: [i64; 3],
    /// 1 / depth at the corners, 1/m.
    inverse: [f64; 3],
    per_area: f64,
}

impl Canvas {
    pub(super) fn new(screen: &Screen) -> Self {
        Self {
            pixels: vec![0; screen.width as usize * screen.height as usize],
            width: screen.width as usize,
            middle: screen.middle(),
            bits: screen.bits,
        }
    }

    /// Draws a triangle of which some pixels of the image, `cells`, may show.
    pub(super) fn draw(&mut self, triangle: u32, cells: &Cells, corners: [&Corner; 3]) {
        let fill = Fill::new(triangle, self.steps(cells), corners, self.bits);
        let window = self.window(cells);
        if let Some(fill) = fill.filter(|fill| !self.is_hidden(window, fill.nearest())) {
            if window.end[0] - window.first[0] < WIDE {
                self.fill_pixels(window, fill);
            } else {
                self.fill_rows(window, fill);
            }
        }
    }

    /// The same for W × H pixels, few of them, without a branch that the
    /// processor might guess wrong.
    #[inline]
    pub(super) fn draw_few<const W: usize, const H: usize>(
        &mut self,
        triangle: u32,
        cells: &Cells,
        corners: [&Corner; 3],
    ) {
        let Some(fill) = Fill::new(triangle, self.steps(cells), corners, self.bits) else {
            return;
        };
        let first =
            (cells[1] as i64 + self.middle[1]) as usize * self.width + (cells[0] as i64 + self.middle[0]) as usize;
        for row in 0..H {
            let Some(shown) = self
                .pixels
                .get_mut(first + row * self.width..)
                .and_then(|p| p.first_chunk_mut::<W>())
            else {
                return;
            };
            for (column, shown) in shown.iter_mut().enumerate() {
                let weight = |k: usize| fill.here[k] + row as i64 * fill.down[k] + column as i64 * fill.right[k];
                let here = [weight(0), weight(1), weight(2)];
                let inside = here[0] | here[1] | here[2] >= 0;
                let near = pixel(fill.mean(here) as f32, triangle);
                *shown = (*shown).max(if inside { near } else { 0 });
            }
        }
    }

    /// The first of some pixels, in steps of the screen.
    #[inline]
    fn steps(&self, cells: &Cells) -> [i64; 2] {
        [cells[0], cells[1]].map(|cell| (cell as i64) << self.bits)
    }

    #[inline]
    fn window(&self, cells: &Cells) -> Window {
        let [left, top, right, bottom] = cells.map(|cell| cell as i64);
        let [x, y] = self.middle;
        Window {
            first: [left + x, top + y].map(|k| k as usize),
            end: [x - right + 1, y - bottom + 1].map(|k| k as usize),
        }
    }

    /// Whether all of a window shows something nearer.
    fn is_hidden(&self, window: Window, nearest: Pixel) -> bool {
        let [first, end] = [window.first[0], window.end[0]];
        (window.first[1]..window.end[1])
            .map(|row| &self.pixels[row * self.width + first..row * self.width + end])
            .all(|row| row.iter().all(|&shown| shown >= nearest))
    }

    fn fill_pixels(&mut self, window: Window, mut fill: Fill) {
        for row in window.first[1]..window.end[1] {
            let mut here = fill.here;
            let line = row * self.width;
            for shown in &mut self.pixels[line + window.first[0]..line + window.end[0]] {
                // The sign bit is set where any of them is negative.
                if here[0] | here[1] | here[2] >= 0 {
                    *shown = pixel(fill.mean(here) as f32, fill.triangle).max(*shown);
                }
                add(&mut here, &fill.right);
            }
            add(&mut fill.here, &fill.down);
        }
    }

    fn fill_rows(&mut self, window: Window, mut fill: Fill) {
        let slope = fill.mean(fill.right);
        let [a, b, c] = fill.inverse.map(|i| i as f32);
        let (farthest, nearest) = (-highest(-a, -b, -c), highest(a, b, c));
        for row in window.first[1]..window.end[1] {
            if let Some((first, last)) = fill.covered(window.end[0] - window.first[0] - 1) {
                let mut here = fill.here;
                (0..3).for_each(|k| here[k] += first * fill.right[k]);
                let start = fill.mean(here);
                let line = row * self.width + window.first[0];
                let row = &mut self.pixels[line + first as usize..=line + last as usize];
                for (k, shown) in row.iter_mut().enumerate() {
                    let near = (start + f64::from(k as i32) * slope) as f32;
                    *shown = pixel(near.clamp(farthest, nearest), fill.triangle).max(*shown);
                }
            }
            add(&mut fill.here, &fill.down);
        }
    }

    /// Adds what another canvas shows.
    pub(super) fn merge(&mut self, other: &Self) {
        for (here, there) in self.pixels.iter_mut().zip(&other.pixels) {
            *here = (*here).max(*there);
        }
    }
}

impl Fill {
    /// From a pixel's centre on; `None` seen from the edge.
    #[inline]
    fn new(triangle: u32, from: [i64; 2], [a, b, c]: [&Corner; 3], bits: u32) -> Option<Self> {
        let at = |corner: &Corner| [i64::from(corner.at[0]) - from[0], i64::from(corner.at[1]) - from[1]];
        let [p, q, r] = [at(a), at(b), at(c)];
        let here = [cross(q, r), cross(r, p), cross(p, q)];
        let area = here[0] + here[1] + here[2];
        let sign = area.signum();
        let step = |d: i64| (d * sign) << bits;
        (area != 0).then(|| Self {
            triangle,
            here: [here[0] * sign, here[1] * sign, here[2] * sign],
            right: [step(q[1] - r[1]), step(r[1] - p[1]), step(p[1] - q[1])],
            down: [step(r[0] - q[0]), step(p[0] - r[0]), step(q[0] - p[0])],
            inverse: [a.inverse, b.inverse, c.inverse].map(f64::from),
            per_area: 1.0 / area.abs() as f64,
        })
    }

    /// What no pixel of it can surpass.
    fn nearest(&self) -> Pixel {
        let [a, b, c] = self.inverse.map(|i| i as f32);
        pixel(highest(a, b, c), self.triangle)
    }

    /// 1 / depth where the corners have some weights: it is linear on the image.
    #[inline]
    fn mean(&self, weights: [i64; 3]) -> f64 {
        let part = |k: usize| weights[k] as f64 * self.inverse[k];
        (part(0) + part(1) + part(2)) * self.per_area
    }

    /// The first and last step to the right, of at most `most`, to a covered pixel.
    #[inline]
    fn covered(&self, most: usize) -> Option<(i64, i64)> {
        let (mut first, mut last) = (0, most as i64);
        for (here, right) in self.here.iter().zip(self.right) {
            if right > 0 {
                // Rounded up, so that the weight is not negative there.
                first = first.max(-here.div_euclid(right));
            } else if right < 0 {
                last = last.min(here.div_euclid(-right));
            } else if *here < 0 {
                return None;
            }
        }
        (first <= last).then_some((first, last))
    }
}

#[inline]
fn pixel(inverse: f32, triangle: u32) -> Pixel {
    u64::from(inverse.to_bits()) << 32 | u64::from(!triangle)
}

/// 1 / depth of what shows, 1/m; 0 where nothing is hit.
#[inline]
pub(super) fn inverse(pixel: Pixel) -> f32 {
    f32::from_bits((pixel >> 32) as u32)
}

/// Index in the mesh of what shows; `u32::MAX` where nothing is hit.
#[inline]
pub(super) fn triangle(pixel: Pixel) -> u32 {
    !(pixel as u32)
}

#[inline]
fn add(here: &mut [i64; 3], step: &[i64; 3]) {
    for (here, step) in here.iter_mut().zip(step) {
        *here += step;
    }
}

#[inline]
fn cross(p: [i64; 2], q: [i64; 2]) -> i64 {
    p[0] * q[1] - p[1] * q[0]
}

/// The greatest of numbers of which each is one.
#[inline]
fn highest(a: f32, b: f32, c: f32) -> f32 {
    let most = if a > b { a } else { b };
    if most > c { most } else { c }
}
