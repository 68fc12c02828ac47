//! The pose of a decoded code: its corners in the image, the depth behind them.

use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion};

use super::Code;
use super::modules::Square;
use super::patch::Patch;
use crate::detect::cloud::Cloud;
use crate::detect::plane_fit::{Plane, robust_plane};
use crate::detect::scan::Luma;
use crate::detect::segment::Region;
use crate::geometry::{Point, Pose, Vector};

/// Half the print's edge over half the code's: the quiet zone is part of the print.
const PRINT: f64 = 1.3;
/// Fewest points behind a code that place it better than its whole region.
const LEAST_POINTS: usize = 24;

/// Where a decoded square lies; `None` where its plane is seen from behind.
pub fn placed(cloud: &Cloud, region: &Region, luma: &Luma, patch: &Patch, square: Square) -> Option<Code> {
    let eye = cloud.eye();
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| {
        let p = square.top_left + square.right * x + square.down * y;
        patch.point(p.x, p.y)
    });
    let plane = plane_behind(cloud, region, &corners).facing(&eye);
    let mut hit = corners;
    for corner in &mut hit {
        *corner = plane.hit(&eye, &(*corner - eye))?;
    }
    let [top_left, top_right, bottom_right, bottom_left] = hit;
    let right = (top_right - top_left) + (bottom_right - bottom_left);
    let up = (top_left - bottom_left) + (top_right - bottom_right);
    let centre = Point::from(hit.iter().map(|p| p.coords).sum::<Vector>() / 4.0);
    let pose = oriented(centre, right, up, plane.normal)?;
    let size = (right.norm() + up.norm()) / 4.0;
    let pixels = seen_area(cloud, luma, &hit)?;
    Some(Code {
        text: square.text,
        pose,
        size,
        pixels,
    })
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

/// A plane through the points behind the print, or the region's where they are few.
fn plane_behind(cloud: &Cloud, region: &Region, corners: &[Point; 4]) -> Plane {
    let centre = Point::from(corners.iter().map(|p| p.coords).sum::<Vector>() / 4.0);
    let (x, y) = ((corners[1] - corners[0]) / 2.0, (corners[3] - corners[0]) / 2.0);
    let inside = |p: &&Point| {
        let d = **p - centre;
        d.dot(&x).abs() <= PRINT * x.norm_squared() && d.dot(&y).abs() <= PRINT * y.norm_squared()
    };
    let behind = region.pixels.iter().map(|&p| &cloud.points[p]).filter(inside);
    if behind.clone().count() < LEAST_POINTS {
        return region.plane;
    }
    robust_plane(behind).map_or(region.plane, |fit| fit.plane)
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
