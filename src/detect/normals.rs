//! Local planes: one around each pixel.
//!
//! Over a plane, inverse depth is linear in image coordinates, so a linear fit
//! in a small window gives normal and distance without an eigenproblem.

use rayon::prelude::*;

use super::cloud::Cloud;
use super::plane_fit::Plane;
use crate::geometry::Vector;

/// Half edge of the window, pixels.
pub const RADIUS: usize = 3;
/// Half edge of the window in noisy images, pixels.
pub const WIDE_RADIUS: usize = 5;
/// Fewest readings in a window.
const LEAST: f64 = 9.0;
/// Steeper surfaces (tangent of incidence) are taken for a jump of depth.
const STEEPEST: f64 = 6.0;

/// The plane around a pixel and how well its window keeps to it.
#[derive(Clone, Copy, Debug)]
pub struct LocalPlane {
    /// The plane, its normal towards the camera, world axes.
    pub plane: Plane,
    /// Root mean square distance of the window's points, metres.
    pub rms: f64,
}

/// Local planes of the pixels that `wanted` names, from such pixels alone.
pub fn local_planes(cloud: &Cloud, wanted: &[bool], radius: usize) -> Vec<Option<LocalPlane>> {
    let inverse: Vec<f64> = cloud.depths.iter().map(|depth| 1.0 / depth).collect();
    let windows = Windows {
        cloud,
        wanted,
        inverse: &inverse,
        radius,
    };
    let planes = (0..wanted.len()).into_par_iter().with_min_len(AT_ONCE);
    planes
        .map(|pixel| wanted[pixel].then(|| windows.plane(pixel)).flatten())
        .collect()
}

/// Pixels worth a thread.
const AT_ONCE: usize = 2_048;

/// The windows about an image's pixels.
struct Windows<'a> {
    cloud: &'a Cloud,
    wanted: &'a [bool],
    /// 1 / depth of each pixel.
    inverse: &'a [f64],
    radius: usize,
}

impl Windows<'_> {
    /// The sums over a pixel's window: what is wanted there and no jump away.
    fn sums(&self, pixel: usize) -> Sums {
        let (cloud, radius) = (self.cloud, self.radius);
        let z = cloud.depths[pixel];
        let jump = z / cloud.intrinsics.fx * radius as f64 * STEEPEST;
        let (x, y) = cloud.place(pixel);
        let columns = x.saturating_sub(radius)..(x + radius + 1).min(cloud.width);
        let mut sums = Sums::default();
        for v in y.saturating_sub(radius)..(y + radius + 1).min(cloud.height) {
            let row = v * cloud.width;
            for u in columns.clone() {
                let other = row + u;
                if self.wanted[other] && (cloud.depths[other] - z).abs() <= jump {
                    sums.add(u as f64 - x as f64, v as f64 - y as f64, self.inverse[other]);
                }
            }
        }
        sums
    }

    fn plane(&self, pixel: usize) -> Option<LocalPlane> {
        let (per_u, per_v, here, rms) = self.sums(pixel).solve()?;
        Some(plane_of(self.cloud, pixel, (per_u, per_v, here), rms))
    }
}

/// The plane over which 1/z has these slopes and this value at a pixel.
fn plane_of(cloud: &Cloud, pixel: usize, (per_u, per_v, here): (f64, f64, f64), rms: f64) -> LocalPlane {
    let (k, z) = (&cloud.intrinsics, cloud.depths[pixel]);
    // 1/z = A x + B y + C over the plane A X + B Y + C Z = 1.
    let (a, b) = (per_u * k.fx, per_v * k.fy);
    let ray = cloud.ray(pixel, 0.5, 0.5);
    let inverse = Vector::new(a, b, here - a * ray.x - b * ray.y);
    let length = inverse.norm();
    let inward = cloud.world_from_camera * (inverse / length);
    let eye = cloud.eye();
    let plane = Plane {
        normal: -inward,
        offset: -inward.dot(&eye.coords) - 1.0 / length,
    };
    LocalPlane {
        plane,
        rms: rms * z / length,
    }
}

/// Normal equations of q = per_u · u + per_v · v + here.
#[derive(Default)]
struct Sums {
    n: f64,
    u: f64,
    v: f64,
    uu: f64,
    uv: f64,
    vv: f64,
    q: f64,
    uq: f64,
    vq: f64,
    qq: f64,
}

impl Sums {
    fn add(&mut self, u: f64, v: f64, q: f64) {
        self.n += 1.0;
        self.u += u;
        self.v += v;
        self.uu += u * u;
        self.uv += u * v;
        self.vv += v * v;
        self.q += q;
        self.uq += u * q;
        self.vq += v * q;
        self.qq += q * q;
    }

    /// Slopes, value at (0, 0) and root mean square residual; `None` where
    /// the window is too thin.
    fn solve(&self) -> Option<(f64, f64, f64, f64)> {
        if self.n < LEAST {
            return None;
        }
        let (mu, mv, mq) = (self.u / self.n, self.v / self.n, self.q / self.n);
        let (uu, uv, vv) = (
            self.uu / self.n - mu * mu,
            self.uv / self.n - mu * mv,
            self.vv / self.n - mv * mv,
        );
        let (uq, vq) = (self.uq / self.n - mu * mq, self.vq / self.n - mv * mq);
        let determinant = uu * vv - uv * uv;
        if determinant < 0.05 {
            return None;
        }
        let per_u = (vv * uq - uv * vq) / determinant;
        let per_v = (uu * vq - uv * uq) / determinant;
        let variance = self.qq / self.n - mq * mq - per_u * uq - per_v * vq;
        Some((per_u, per_v, mq - per_u * mu - per_v * mv, variance.max(0.0).sqrt()))
    }
}
