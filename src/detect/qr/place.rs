//! The pose of a decoded code: its corners in the image, the depth behind them.

use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion};

use super::Code;
use super::modules::Square;
use super::patch::Patch;
use crate::detect::account::Judgement;
use crate::detect::cloud::Cloud;
use crate::detect::plane_fit::{Plane, robust_plane};
use crate::detect::scan::Luma;
use crate::detect::segment::Region;
use crate::geometry::{Point, Pose, Vector};

/// Fewest points behind a code that place it.
const LEAST_POINTS: usize = 16;
/// Points this far off the region's plane may still be the print's: a plate
/// on a surface can share its region, metres.
const NEAR: f64 = 0.012;
/// Least share of the readings inside the square that lie on its plane.
const SUPPORT: f64 = 0.7;
/// Distances that count as on the plane, in units of the spread about it, and at least, metres.
const ON_PLANE: (f64, f64) = (3.0, 0.0025);

/// Where a decoded square lies; `None` where the depth image does not support
/// a plane there: what is drawn on a region's plane can belong to a surface
/// before or behind it.
pub fn placed(cloud: &Cloud, region: &Region, luma: &Luma, patch: &Patch, square: Square) -> Option<Code> {
    let eye = cloud.eye();
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| {
        let p = square.top_left + square.right * x + square.down * y;
        patch.point(p.x, p.y)
    });
    let plane = plane_behind(cloud, region, &corners)?.facing(&eye);
    let mut hit = corners;
    for corner in &mut hit {
        *corner = plane.hit(&eye, &(*corner - eye))?;
    }
    let [top_left, top_right, bottom_right, bottom_left] = hit;
    let right = (top_right - top_left) + (bottom_right - bottom_left);
    let up = (top_left - bottom_left) + (top_right - bottom_right);
    let pose = oriented(mean(&hit), right, up, plane.normal)?;
    let size = (right.norm() + up.norm()) / 4.0;
    let pixels = seen_area(cloud, luma, &hit)?;
    Some(Code {
        text: square.text,
        pose,
        size,
        pixels,
        judged: Judgement::default(),
    })
}

fn mean(corners: &[Point; 4]) -> Point {
    Point::from(corners.iter().map(|p| p.coords).sum::<Vector>() / 4.0)
}

/// The pose of orthonormal axes nearest to the measured directions.
fn oriented(centre: Point, right: Vector, up: Vector, out: Vector) -> Option<Pose> {
    // The bisector shares the error of squareness between both edges.
    let flat = |v: Vector| (v - out * out.dot(&v)).try_normalize(1e-9);
    let (x, y) = (flat(right)?, flat(up)?);
    let x = (x + y.cross(&out)).try_normalize(1e-9)?;
    let axes = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, out.cross(&x), out]));
    Some(Pose::from_parts(
        Translation3::from(centre.coords),
        UnitQuaternion::from_rotation_matrix(&axes),
    ))
}

/// The plane through the points seen inside the square; `None` where too few
/// of its readings lie on one.
fn plane_behind(cloud: &Cloud, region: &Region, corners: &[Point; 4]) -> Option<Plane> {
    let centre = mean(corners);
    let (x, y) = ((corners[1] - corners[0]) / 2.0, (corners[3] - corners[0]) / 2.0);
    let eye = cloud.eye();
    let inside = |pixel: &usize| {
        let ray = cloud.world_from_camera * cloud.ray(*pixel, 0.5, 0.5);
        region.plane.hit(&eye, &ray).is_some_and(|p| {
            let d = p - centre;
            d.dot(&x).abs() <= x.norm_squared() && d.dot(&y).abs() <= y.norm_squared()
        })
    };
    let seen: Vec<Point> = (0..cloud.points.len())
        .filter(|&p| cloud.holds(p))
        .filter(inside)
        .map(|p| cloud.points[p])
        .collect();
    let near = seen.iter().filter(|p| region.plane.distance(p).abs() <= NEAR);
    if near.clone().count() < LEAST_POINTS {
        return None;
    }
    let fit = robust_plane(near)?;
    let within = (ON_PLANE.0 * fit.rms).max(ON_PLANE.1);
    let on = seen.iter().filter(|p| fit.plane.distance(p).abs() <= within).count();
    (on as f64 >= SUPPORT * seen.len() as f64).then_some(fit.plane)
}

/// Pixels of the colour image inside the square.
fn seen_area(cloud: &Cloud, luma: &Luma, corners: &[Point; 4]) -> Option<f64> {
    let mut image = [(0.0, 0.0); 4];
    for (at, corner) in image.iter_mut().zip(corners) {
        *at = luma
            .intrinsics
            .project(&cloud.world_from_camera.inverse_transform_point(corner))?;
    }
    let twice: f64 = (0..4)
        .map(|k| (image[k], image[(k + 1) % 4]))
        .map(|(a, b)| a.0 * b.1 - b.0 * a.1)
        .sum();
    Some(twice.abs() / 2.0)
}
