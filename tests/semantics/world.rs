//! Spaces made by hand: a row of characters a row of voxels, edge 1 m.
//!
//! `.` free (p = ¼), `#` occupied (p = 0.9, a measured point at its centre), `?` unknown. Rows
//! run along x; the first row of a layer is y = 0; layers are z = 0, 1, …, with
//! a blank line between. The grid's corner is the origin, so voxel (x, y, z)
//! has its centre at (x + ½, y + ½, z + ½).

use vpl::geometry::{Point, Vector};
use vpl::map::{Grid, Occupancy, Voxel};
use vpl::plan::World;

#[derive(Clone, Debug)]
pub struct MicroWorld {
    pub grid: Grid,
    pub states: Vec<Occupancy>,
    pub points: Vec<Point>,
    /// Eyes that measured every occupied voxel.
    pub eyes: Vec<Point>,
}

impl MicroWorld {
    pub fn parse(drawing: &str) -> Self {
        let lines: Vec<&str> = drawing.trim().lines().map(str::trim).collect();
        let layers: Vec<Vec<&str>> = lines.split(|l| l.is_empty()).map(<[&str]>::to_vec).collect();
        let (nx, ny, nz) = (layers[0][0].len(), layers[0].len(), layers.len());
        let states: Vec<Occupancy> = layers.iter().flatten().flat_map(|row| row.chars().map(state)).collect();
        assert_eq!(states.len(), nx * ny * nz, "rows of unequal length");
        Self::of([nx, ny, nz].map(|n| n as u32), states)
    }

    pub fn of(size: [u32; 3], states: Vec<Occupancy>) -> Self {
        let grid = Grid {
            origin: Point::origin(),
            voxel: 1.0,
            size,
        };
        let occupied = (0..grid.len())
            .map(Voxel)
            .filter(|v| states[v.0 as usize] == Occupancy::Occupied);
        Self {
            points: occupied.map(|v| grid.centre(v)).collect(),
            grid,
            states,
            eyes: Vec::new(),
        }
    }

    /// The same voxels with another edge, metres.
    pub fn scaled(mut self, voxel: f64) -> Self {
        let by = voxel / self.grid.voxel;
        self.grid.voxel = voxel;
        self.points.iter_mut().for_each(|p| *p *= by);
        self
    }

    pub fn at(&self, x: i64, y: i64, z: i64) -> Voxel {
        self.grid.at([x, y, z]).unwrap()
    }

    fn voxels_in(&self, state: Occupancy) -> impl Iterator<Item = Voxel> + '_ {
        (0..self.grid.len())
            .map(Voxel)
            .filter(move |v| self.occupancy(*v) == state)
    }
}

fn state(c: char) -> Occupancy {
    match c {
        '.' => Occupancy::Free,
        '#' => Occupancy::Occupied,
        '?' => Occupancy::Unknown,
        other => panic!("`{other}` is no voxel"),
    }
}

impl World for MicroWorld {
    fn grid(&self) -> &Grid {
        &self.grid
    }

    fn occupancy(&self, voxel: Voxel) -> Occupancy {
        self.states[voxel.0 as usize]
    }

    fn probability(&self, voxel: Voxel) -> Option<f64> {
        match self.occupancy(voxel) {
            Occupancy::Unknown => None,
            Occupancy::Free => Some(0.25),
            Occupancy::Occupied => Some(0.9),
        }
    }

    fn measured_within(&self, p: &Point, radius: f64) -> bool {
        self.points.iter().any(|q| (p - q).norm() <= radius)
    }

    /// Steps from voxel to voxel towards the eye.
    fn visible(&self, eye: &Point, voxel: Voxel, tolerance: f64) -> bool {
        let centre = self.grid.centre(voxel);
        let along: Vector = (eye - centre) / self.grid.voxel;
        let mut cell = self.grid.cell(voxel);
        let step = [0, 1, 2].map(|k| along[k].signum() as i64);
        let period = [0, 1, 2].map(|k| {
            if along[k] == 0.0 {
                f64::INFINITY
            } else {
                1.0 / along[k].abs()
            }
        });
        let mut next = period.map(|p| p / 2.0);
        loop {
            let axis = (0..3).min_by(|a, b| next[*a].total_cmp(&next[*b])).unwrap();
            if next[axis] >= 1.0 {
                return true;
            }
            next[axis] += period[axis];
            cell[axis] += step[axis];
            let Some(here) = self.grid.at(cell) else { return true };
            let near = (self.grid.centre(here) - centre).norm() <= tolerance + 1e-9;
            if self.occupancy(here) == Occupancy::Occupied && !near {
                return false;
            }
        }
    }

    fn occupied(&self) -> Vec<Voxel> {
        self.voxels_in(Occupancy::Occupied).collect()
    }

    fn rear_side(&self) -> Vec<Voxel> {
        let behind = |v: &Voxel| {
            let cell = self.grid.cell(*v);
            (0..6).any(|face| {
                let mut front = cell;
                let (axis, side) = (face / 2, if face % 2 == 0 { -1 } else { 1 });
                front[axis] += side;
                let Some(front) = self.grid.at(front) else { return false };
                let solid = self.occupancy(front) == Occupancy::Occupied;
                let away = |eye: &Point| (self.grid.centre(front)[axis] - eye[axis]) * -(side as f64) > 0.0;
                solid && self.eyes.iter().any(away)
            })
        };
        self.voxels_in(Occupancy::Unknown).filter(behind).collect()
    }
}
