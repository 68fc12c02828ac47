//! Voxel numbering of a bounded space.

use crate::geometry::Point;
use crate::rules::Space;

/// Index of a voxel in its grid: x fastest, then y, then z.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Voxel(pub u32);

/// A regular grid of cubic voxels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// The corner with the smallest coordinates.
    pub origin: Point,
    /// Edge of a voxel, metres.
    pub voxel: f64,
    /// Voxels along x, y and z.
    pub size: [u32; 3],
}

impl Grid {
    /// The grid that covers a space, centred on it; `None` where it has more
    /// voxels than a `u32` numbers.
    pub fn covering(space: &Space) -> Option<Self> {
        let cells = |extent: f64| (extent / space.voxel - 1e-9).ceil().max(1.0);
        let n = [cells(space.size.x), cells(space.size.y), cells(space.size.z)];
        if !(n[0] * n[1] * n[2] < f64::from(u32::MAX)) {
            return None;
        }
        let half = nalgebra::Vector3::from(n) * (space.voxel / 2.0);
        Some(Self {
            origin: space.centre - half,
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
        [0, 1, 2].map(|k| ((p[k] - self.origin[k]) / self.voxel).floor() as i64)
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
}
