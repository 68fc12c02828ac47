//! Voxel numbering of a bounded space.

use super::walk::{Walk, each};
use crate::geometry::Point;
use crate::rules::Space;

/// Most voxels along an axis: what OctoMap's 16-bit keys count.
const MAX_AXIS: f64 = 65_536.0;

/// Index of a voxel in its grid: x fastest, then y, then z.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Voxel(pub u32);

/// A regular grid of cubic voxels.
///
/// The borders of voxels lie at whole multiples of the voxel's edge, as in
/// OctoMap: the voxel of integer coordinates c is the one of OctoMap's key
/// `origin / voxel + c + 32768`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// The corner with the smallest coordinates, a multiple of `voxel`.
    pub origin: Point,
    /// Edge of a voxel, metres.
    pub voxel: f64,
    /// Voxels along x, y and z.
    pub size: [u32; 3],
}

impl Grid {
    /// The smallest aligned grid that covers a space; a space whose borders are
    /// no multiples of the voxel is exceeded by less than a voxel a side.
    /// `None` where it has more voxels than a `u32` numbers, more than 65,536
    /// along an axis, or no finite extent.
    pub fn covering(space: &Space) -> Option<Self> {
        let bounds = space.bounds();
        let (low, n) = aligned(&bounds.min, &bounds.max, space.voxel);
        let fits = n.iter().all(|c| (1.0..=MAX_AXIS).contains(c)) && n[0] * n[1] * n[2] < f64::from(u32::MAX);
        fits.then(|| Self {
            origin: Point::from(low.map(|k| k * space.voxel)),
            voxel: space.voxel,
            size: n.map(|c| c as u32),
        })
    }

    /// Number of voxels.
    pub fn len(&self) -> u32 {
        self.size.iter().product()
    }

    /// Whether there is no voxel. A grid always has one.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The voxel of integer coordinates; `None` outside.
    pub fn at(&self, cell: [i64; 3]) -> Option<Voxel> {
        let inside = (0..3).all(|k| 0 <= cell[k] && cell[k] < i64::from(self.size[k]));
        inside.then(|| {
            let [x, y, z] = cell.map(|c| c as u32);
            Voxel((z * self.size[1] + y) * self.size[0] + x)
        })
    }

    /// The voxel that contains a point; `None` outside.
    pub fn containing(&self, p: &Point) -> Option<Voxel> {
        self.at(self.cell_of(p))
    }

    /// Integer coordinates of a point, which may lie outside.
    pub fn cell_of(&self, p: &Point) -> [i64; 3] {
        self.in_voxels(p).map(|c| c.floor() as i64)
    }

    /// Integer coordinates of a voxel.
    pub fn cell(&self, v: Voxel) -> [i64; 3] {
        let (nx, ny) = (self.size[0], self.size[1]);
        [v.0 % nx, v.0 / nx % ny, v.0 / nx / ny].map(i64::from)
    }

    /// Centre of a voxel.
    pub fn centre(&self, v: Voxel) -> Point {
        let cell = self.cell(v);
        Point::from([0, 1, 2].map(|k| self.origin[k] + (cell[k] as f64 + 0.5) * self.voxel))
    }

    /// The voxels that the segment from one point to another passes through, in
    /// that order, clipped to the grid. Where it passes exactly through an edge
    /// or a corner, x is crossed before y and y before z.
    pub fn along(&self, from: &Point, to: &Point) -> impl Iterator<Item = Voxel> + use<> {
        let grid = *self;
        let mut walk = Walk::clipped(self.size, self.in_voxels(from), self.in_voxels(to));
        std::iter::from_fn(move || {
            let here = grid.at(walk.as_ref()?.cell.map(|c| c as i64));
            if !walk.as_mut()?.advance() {
                walk = None;
            }
            here
        })
    }

    /// A point in units of voxels from the origin of the grid.
    pub(super) fn in_voxels(&self, p: &Point) -> [f64; 3] {
        each(|k| (p[k] - self.origin[k]) / self.voxel)
    }
}

/// Smallest key and number of voxels along each axis. A border within a
/// millionth of a voxel of a multiple counts as on it.
fn aligned(min: &Point, max: &Point, voxel: f64) -> ([f64; 3], [f64; 3]) {
    const SLACK: f64 = 1e-6;
    let low = [0, 1, 2].map(|k| (min[k] / voxel + SLACK).floor());
    let high = [0, 1, 2].map(|k| (max[k] / voxel - SLACK).ceil());
    let cells = |n: f64| if n < 1.0 { 1.0 } else { n };
    (low, [0, 1, 2].map(|k| cells(high[k] - low[k])))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;

    fn space(centre: [f64; 3], size: f64, voxel: f64) -> Space {
        Space {
            centre: Point::from(centre),
            size: Vector::repeat(size),
            voxel,
        }
    }

    #[test]
    fn an_aligned_space_is_covered_exactly() {
        let grid = Grid::covering(&space([0.0, 0.0, 0.3], 0.6, 0.01)).unwrap();
        assert_eq!(grid.size, [60, 60, 60]);
        assert!((grid.origin - Point::new(-0.3, -0.3, 0.0)).norm() < 1e-12);
    }

    #[test]
    fn any_other_space_is_exceeded_by_less_than_a_voxel_a_side() {
        let grid = Grid::covering(&space([0.003, 0.0, 0.0], 0.65, 0.05)).unwrap();
        assert_eq!(grid.size, [14, 14, 14]);
        assert!((grid.origin - Point::new(-0.35, -0.35, -0.35)).norm() < 1e-12);
    }

    #[test]
    fn a_space_that_no_key_counts_has_no_grid() {
        assert_eq!(Grid::covering(&space([0.0; 3], 10.0, 0.001)), None);
        assert_eq!(Grid::covering(&space([0.0; 3], f64::NAN, 0.001)), None);
        assert_eq!(Grid::covering(&space([0.0; 3], 1.0, 0.0)), None);
        let rod = Space {
            size: Vector::new(100.0, 0.001, 0.001),
            ..space([0.0; 3], 1.0, 0.001)
        };
        assert_eq!(Grid::covering(&rod), None);
    }

    #[test]
    fn a_diagonal_crosses_x_before_y_before_z() {
        let grid = Grid::covering(&space([0.0; 3], 4.0, 1.0)).unwrap();
        let path: Vec<_> = grid
            .along(&Point::new(-1.5, -1.5, -1.5), &Point::new(-0.5, -0.5, -0.5))
            .collect();
        let cells = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, 1]];
        assert_eq!(path, cells.map(|c| grid.at(c).unwrap()));
    }
}
