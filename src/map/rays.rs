//! Rays through the voxels of a grid, in whole numbers.
//!
//! Voxels are met in order from the ray's origin to its end (Amanatides and Woo
//! 1987). Times of crossing are counted from where the ray enters the grid, in
//! 2⁻³² of a voxel, and the last one inside the grid is known from the outset: no
//! rounding leads out of it. Through an edge or a corner, x is crossed before y and
//! y before z.

use super::grid::{Grid, Voxel};
use super::walk::each;
use crate::geometry::{Intrinsics, Point, Pose, Vector};

/// A straight line of limited length.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    origin: Point,
    /// Of length 1.
    direction: Vector,
    length: f64,
}

impl Ray {
    /// The ray from `origin` along `direction`, of any length but 0, for `length`
    /// metres. One that is not finite meets nothing.
    pub fn new(origin: Point, direction: Vector, length: f64) -> Self {
        Self {
            origin,
            direction: direction.normalize(),
            length: length.max(0.0),
        }
    }

    /// The segment between two points, metres.
    pub fn between(from: &Point, to: &Point) -> Self {
        Self::new(*from, to - from, (to - from).norm())
    }

    /// Where it begins, metres.
    pub fn origin(&self) -> &Point {
        &self.origin
    }

    /// A point so many metres along it.
    pub fn at(&self, distance: f64) -> Point {
        self.origin + self.direction * distance
    }
}

/// The rays of an image through the middles of its cells of `every` × `every`
/// pixels, row by row, from the eye to the depth `far` along the optical axis, metres.
pub fn image_rays(
    image: &Intrinsics,
    every: u32,
    far: f64,
    world_from_camera: &Pose,
) -> impl Iterator<Item = Ray> + use<> {
    let (image, pose, every) = (*image, *world_from_camera, every.max(1));
    let rotation = pose.rotation.to_rotation_matrix();
    let eye = Point::from(pose.translation.vector);
    let [columns, rows] = [image.width, image.height].map(|n| n / every);
    let ray = move |u: u32, v: u32| {
        let middle = |cell: u32| (f64::from(cell) + 0.5) * f64::from(every);
        let along = image.ray(middle(u), middle(v));
        Ray::new(eye, rotation * along, far * along.norm())
    };
    (0..rows).flat_map(move |v| (0..columns).map(move |u| ray(u, v)))
}

/// One voxel in the fixed point of times.
const ONE: f64 = (1_u64 << 32) as f64;
/// A time past every end: no ray is 2¹⁸ voxels long inside a grid.
const NEVER: i64 = 1 << 50;

/// The voxels that a ray meets in a grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Track {
    /// Number of the first voxel.
    first: usize,
    /// From a voxel's number to its neighbour's along each axis.
    step: [usize; 3],
    /// When the next border of each axis is crossed.
    next: [i64; 3],
    period: [i64; 3],
    /// No border is crossed later.
    end: i64,
}

/// A grid with what every ray through it needs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tracks {
    origin: Point,
    per_metre: f64,
    size: [f64; 3],
    strides: [usize; 3],
}

impl Tracks {
    pub fn of(grid: &Grid) -> Self {
        let [x, y, _] = grid.size.map(|n| n as usize);
        Self {
            origin: grid.origin,
            per_metre: 1.0 / grid.voxel,
            size: grid.size.map(f64::from),
            strides: [1, x, x * y],
        }
    }

    /// The voxels on a ray; `None` where it misses the grid.
    #[inline(always)]
    pub fn track(&self, ray: &Ray) -> Option<Track> {
        let along = each(|k| ray.direction[k]);
        let inverse = each(|k| 1.0 / along[k]);
        let (start, length) = self.clip(ray, inverse)?;
        let cell = self.cell(start);
        let down = each(|k| along[k] < 0.0);
        let ahead = each(|k| {
            if down[k] {
                start[k] - cell[k]
            } else {
                cell[k] + 1.0 - start[k]
            }
        });
        let left = each(|k| if down[k] { cell[k] } else { self.size[k] - 1.0 - cell[k] });
        let units = |voxels: f64| ((voxels * ONE) as i64).min(NEVER);
        let period = each(|k| units(inverse[k].abs()));
        let next = each(|k| units(ahead[k] * inverse[k].abs()));
        // The crossing that leaves the grid, in the whole numbers that steps add up to.
        let leave = each(|k| next[k].saturating_add(period[k].saturating_mul(left[k] as i64)));
        let stride = self.strides;
        Some(Track {
            first: (0..3).map(|k| cell[k] as usize * stride[k]).sum(),
            step: each(|k| if down[k] { stride[k].wrapping_neg() } else { stride[k] }),
            next,
            period,
            end: units(length).min(leave[0].min(leave[1]).min(leave[2]) - 1),
        })
    }

    /// The part of a ray inside the grid, where it begins and how far it goes along
    /// each axis, in voxels; `None` where there is none.
    #[inline(always)]
    pub fn segment(&self, ray: &Ray) -> Option<([f64; 3], [f64; 3])> {
        let (start, length) = self.clip(ray, each(|k| 1.0 / ray.direction[k]))?;
        Some((start, each(|k| ray.direction[k] * length)))
    }

    /// The cell of a point inside the grid or on its border.
    #[inline(always)]
    pub fn cell(&self, point: [f64; 3]) -> [f64; 3] {
        each(|k| f64::from(point[k] as u32).min(self.size[k] - 1.0))
    }

    /// Where a ray begins to be inside the grid, and for how long, in voxels.
    #[inline(always)]
    fn clip(&self, ray: &Ray, inverse: [f64; 3]) -> Option<([f64; 3], f64)> {
        let from = each(|k| (ray.origin[k] - self.origin[k]) * self.per_metre);
        let along = ray.direction;
        let (mut enter, mut leave) = (0.0_f64, ray.length * self.per_metre);
        for k in 0..3 {
            if along[k] == 0.0 {
                if !(0.0 <= from[k] && from[k] < self.size[k]) {
                    return None;
                }
                continue;
            }
            let (a, b) = (-from[k] * inverse[k], (self.size[k] - from[k]) * inverse[k]);
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        // A sum is not finite where one of its terms is not.
        let finite = (from[0] + from[1] + from[2] + along[0] + along[1] + along[2]).is_finite();
        let start = each(|k| (from[k] + enter * along[k]).max(0.0).min(self.size[k]));
        (finite && enter < leave).then_some((start, leave - enter))
    }
}

impl Track {
    /// Meets the voxels in order until one ends the walk by `false`.
    #[inline(always)]
    pub fn walk(self, mut meet: impl FnMut(Voxel) -> bool) {
        let (mut at, [sx, sy, sz], [dx, dy, dz]) = (self.first, self.step, self.period);
        let ([mut x, mut y, mut z], end) = (self.next, self.end);
        // Branches on the axis: neighbouring rays repeat the pattern, so they are foretold.
        while meet(Voxel(at as u32)) {
            if x <= y {
                if x <= z {
                    if x > end {
                        return;
                    }
                    (at, x) = (at.wrapping_add(sx), x + dx);
                    continue;
                }
            } else if y <= z {
                if y > end {
                    return;
                }
                (at, y) = (at.wrapping_add(sy), y + dy);
                continue;
            }
            if z > end {
                return;
            }
            (at, z) = (at.wrapping_add(sz), z + dz);
        }
    }
}
