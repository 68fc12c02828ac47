//! Which samples are still uncovered, by cells of a grid.

use crate::geometry::{Bounds, Point, Vector};

/// Uncovered samples in cells of edge ξ or more.
#[derive(Clone, Debug)]
pub(super) struct Index {
    origin: Point,
    edge: f64,
    size: [i64; 3],
    cells: Vec<Vec<u32>>,
}

/// Most cells along an axis.
const MOST: f64 = 200.0;

impl Index {
    /// All samples, none covered.
    pub(super) fn of(points: &[Point], near: f64) -> Self {
        let bounds = Bounds::around(points).unwrap_or(Bounds {
            min: Point::origin(),
            max: Point::origin(),
        });
        let extent = bounds.size();
        let edge = near.max(extent.max() / MOST).max(1e-6);
        let size = [0, 1, 2].map(|k| (extent[k] / edge) as i64 + 1);
        let mut index = Self {
            origin: bounds.min,
            edge,
            size,
            cells: vec![Vec::new(); (size[0] * size[1] * size[2]) as usize],
        };
        for (k, p) in points.iter().enumerate() {
            if let Some(cell) = index.cell(index.coordinates(p)) {
                index.cells[cell].push(k as u32);
            }
        }
        index
    }

    /// Removes and gives the samples within `near` of a point.
    pub(super) fn take_within(&mut self, p: &Point, near: f64, points: &[Point]) -> Vec<u32> {
        let middle = self.coordinates(p);
        let mut taken = Vec::new();
        for offset in 0..27 {
            let step = [offset % 3 - 1, offset / 3 % 3 - 1, offset / 9 - 1];
            let Some(cell) = self.cell([0, 1, 2].map(|k| middle[k] + step[k])) else {
                continue;
            };
            self.cells[cell].retain(|&k| {
                let far = (points[k as usize] - p).norm_squared() > near * near;
                if !far {
                    taken.push(k);
                }
                far
            });
        }
        taken
    }

    fn coordinates(&self, p: &Point) -> [i64; 3] {
        let d: Vector = (p - self.origin) / self.edge;
        [d.x, d.y, d.z].map(|c| c.floor() as i64)
    }

    fn cell(&self, at: [i64; 3]) -> Option<usize> {
        let [nx, ny, nz] = self.size;
        let inside = (0..3).all(|k| (0..self.size[k]).contains(&at[k]));
        debug_assert!(nx > 0 && ny > 0 && nz > 0);
        inside.then(|| ((at[2] * ny + at[1]) * nx + at[0]) as usize)
    }
}
