//! From three finder patterns to the bits of a code, and from bits to text.

use std::panic::{AssertUnwindSafe, catch_unwind};

use nalgebra::{Point2, Vector2};

use super::finder::Finder;
use super::patch::Patch;

/// A decoded square in patch coordinates.
pub struct Square {
    /// The decoded text.
    pub text: String,
    /// Corner next to the first finder (top left on the print).
    pub top_left: Point2<f64>,
    /// From there along the print's upper edge to its end.
    pub right: Vector2<f64>,
    /// From there along the print's left edge to its end.
    pub down: Vector2<f64>,
}

/// Most difference of a triple's legs, as a share of their mean.
const LEGS_WITHIN: f64 = 0.2;
/// Most cosine between a triple's legs.
const SQUARE_WITHIN: f64 = 0.2;
/// Module sizes of a triple's finders differ by less than this factor.
const MODULES_WITHIN: f64 = 1.6;
/// Shifts of the sampling grid that are tried, modules.
const SHIFTS: [f64; 3] = [0.0, 0.25, -0.25];

/// Every code whose three finder patterns are among `finders`.
pub fn decode(patch: &Patch, finders: &[Finder]) -> Vec<Square> {
    let mut squares = Vec::new();
    let mut used = vec![false; finders.len()];
    for corner in 0..finders.len() {
        for right in 0..finders.len() {
            for down in 0..finders.len() {
                let free = !(used[corner] || used[right] || used[down]);
                if free && let Some(square) = decode_triple(patch, [finders[corner], finders[right], finders[down]]) {
                    [corner, right, down].iter().for_each(|&k| used[k] = true);
                    squares.push(square);
                }
            }
        }
    }
    squares
}

fn decode_triple(patch: &Patch, [corner, right, down]: [Finder; 3]) -> Option<Square> {
    let to_right = Vector2::new(right.x - corner.x, right.y - corner.y);
    let to_down = Vector2::new(down.x - corner.x, down.y - corner.y);
    let (a, b) = (to_right.norm(), to_down.norm());
    let sizes = [corner.module, right.module, down.module];
    let (least, most) = (
        sizes.iter().copied().fold(f64::INFINITY, f64::min),
        sizes.iter().copied().fold(0.0, f64::max),
    );
    let shaped = to_right.perp(&to_down) > 0.0
        && (a - b).abs() <= LEGS_WITHIN * (a + b) / 2.0
        && to_right.dot(&to_down).abs() <= SQUARE_WITHIN * a * b
        && most <= MODULES_WITHIN * least;
    if !shaped {
        return None;
    }
    // Finder centres are N − 7 modules apart.
    let across = (a + b) / 2.0 / (sizes.iter().sum::<f64>() / 3.0) + 7.0;
    let nominal = 17 + 4 * (((across - 17.0) / 4.0).round().clamp(1.0, 40.0) as usize);
    let centre = Point2::new(corner.x, corner.y);
    let at_least = |n: usize| (n >= 21).then_some(n);
    [Some(nominal), at_least(nominal - 4), Some(nominal + 4)]
        .into_iter()
        .flatten()
        .find_map(|n| Lattice::new(centre, to_right, to_down, n).read(patch))
}

/// The grid of modules: module (x, y) has its centre at `origin + (x + ½) right + (y + ½) down`.
#[derive(Clone, Copy)]
struct Lattice {
    origin: Point2<f64>,
    right: Vector2<f64>,
    down: Vector2<f64>,
    modules: usize,
}

impl Lattice {
    fn new(corner: Point2<f64>, to_right: Vector2<f64>, to_down: Vector2<f64>, modules: usize) -> Self {
        let between = (modules - 7) as f64;
        let (right, down) = (to_right / between, to_down / between);
        Self {
            origin: corner - (right + down) * 3.5,
            right,
            down,
            modules,
        }
    }

    fn centre(&self, x: f64, y: f64) -> Point2<f64> {
        self.origin + self.right * (x + 0.5) + self.down * (y + 0.5)
    }

    fn read(self, patch: &Patch) -> Option<Square> {
        let threshold = self.threshold(patch)?;
        SHIFTS
            .iter()
            .flat_map(|&dy| SHIFTS.iter().map(move |&dx| (dx, dy)))
            .find_map(|(dx, dy)| {
                let dark = |x: usize, y: usize| self.value(patch, x as f64 + dx, y as f64 + dy) < threshold;
                let text = text_of(self.modules, dark)?;
                let n = self.modules as f64;
                Some(Square {
                    text,
                    top_left: self.origin,
                    right: self.right * n,
                    down: self.down * n,
                })
            })
    }

    /// Mean brightness about the middle of a module.
    fn value(&self, patch: &Patch, x: f64, y: f64) -> f64 {
        let offsets = [(0.0, 0.0), (0.2, 0.0), (-0.2, 0.0), (0.0, 0.2), (0.0, -0.2)];
        let sum: f64 = offsets
            .iter()
            .map(|(u, v)| {
                let p = self.centre(x + u, y + v);
                patch.at(p.x, p.y)
            })
            .sum();
        sum / offsets.len() as f64
    }

    /// Halfway between the dark and the light modules of the finder patterns;
    /// `None` where those do not look like finder patterns.
    fn threshold(&self, patch: &Patch) -> Option<f64> {
        let far = self.modules as f64 - 7.0;
        let (mut dark, mut light) = (0.0, 0.0);
        for (x, y) in [(0.0, 0.0), (far, 0.0), (0.0, far)] {
            for k in 0..7 {
                dark += self.value(patch, x + f64::from(k), y) + self.value(patch, x, y + f64::from(k));
            }
            for k in 1..6 {
                light += self.value(patch, x + f64::from(k), y + 1.0) + self.value(patch, x + 1.0, y + f64::from(k));
            }
        }
        let (dark, light) = (dark / 42.0, light / 30.0);
        (light > dark + 6.0).then_some((dark + light) / 2.0)
    }
}

/// The text of a square of modules. The decoder asserts some of what it
/// expects of its input, so a panic counts as *not a code*.
fn text_of(modules: usize, dark: impl Fn(usize, usize) -> bool) -> Option<String> {
    let bits: Vec<bool> = (0..modules * modules).map(|k| dark(k % modules, k / modules)).collect();
    let grid = rqrr::Grid::new(rqrr::SimpleGrid::from_func(modules, |x, y| bits[y * modules + x]));
    let decoded = catch_unwind(AssertUnwindSafe(|| grid.decode().ok()));
    decoded.ok().flatten().map(|(_, text)| text)
}
