//! Planes and their least-squares fits.
//!
//! Every fit here is total least squares on points; robustness comes from
//! trimming and fitting again, so results are deterministic.

use nalgebra::Matrix3;

use crate::geometry::{Point, Vector};

/// The plane `normal · p = offset`, world axes, metres; `normal` has length one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Unit normal.
    pub normal: Vector,
    /// Signed distance of the origin's foot along the normal.
    pub offset: f64,
}

impl Plane {
    /// Signed distance of a point, metres, positive on the normal's side.
    pub fn distance(&self, p: &Point) -> f64 {
        self.normal.dot(&p.coords) - self.offset
    }

    /// The same plane with its normal towards `eye`.
    pub fn facing(self, eye: &Point) -> Self {
        if self.distance(eye) >= 0.0 {
            self
        } else {
            Self {
                normal: -self.normal,
                offset: -self.offset,
            }
        }
    }

    /// Where the line `origin + t · direction` meets the plane; `None` where
    /// it runs (almost) along it or the plane lies behind.
    pub fn hit(&self, origin: &Point, direction: &Vector) -> Option<Point> {
        let along = self.normal.dot(direction);
        let t = -self.distance(origin) / along;
        (along.abs() > 1e-9 && t > 0.0).then(|| origin + direction * t)
    }
}

/// Sums of points and their products, from which a plane follows.
#[derive(Clone, Copy, Debug)]
pub struct Moments {
    count: f64,
    origin: Point,
    sum: Vector,
    products: Matrix3<f64>,
}

impl Moments {
    /// No points yet; `origin` is any point near them (for precision).
    pub fn about(origin: Point) -> Self {
        Self {
            count: 0.0,
            origin,
            sum: Vector::zeros(),
            products: Matrix3::zeros(),
        }
    }

    /// Adds a point.
    pub fn add(&mut self, p: &Point) {
        let d = p - self.origin;
        self.count += 1.0;
        self.sum += d;
        self.products += d * d.transpose();
    }

    /// The plane of least squared distances; `None` with fewer than three
    /// points or points on one line.
    pub fn plane(&self) -> Option<Plane> {
        if self.count < 3.0 {
            return None;
        }
        let mean = self.sum / self.count;
        let spread = self.products / self.count - mean * mean.transpose();
        let eigen = spread.symmetric_eigen();
        let smallest = eigen.eigenvalues.imin();
        let middle = (0..3)
            .filter(|&k| k != smallest)
            .map(|k| eigen.eigenvalues[k])
            .fold(f64::INFINITY, f64::min);
        if middle.is_nan() || middle <= 1e-12 {
            return None;
        }
        let normal: Vector = eigen.eigenvectors.column(smallest).into_owned();
        Some(Plane {
            normal,
            offset: normal.dot(&(self.origin + mean).coords),
        })
    }
}

/// A plane through points, outliers trimmed, and the spread of its inliers.
#[derive(Clone, Copy, Debug)]
pub struct RobustPlane {
    /// The plane; its normal's sign is arbitrary.
    pub plane: Plane,
    /// Root mean square distance of the inliers, metres.
    pub rms: f64,
}

/// Distances under this never count as outliers, metres.
const LEAST_TRIM: f64 = 0.001;

/// Iterated least squares, trimming at 2.5 times the inliers' spread.
///
/// `None` where the points span no plane.
pub fn robust_plane<'a>(points: impl Iterator<Item = &'a Point> + Clone) -> Option<RobustPlane> {
    let first = *points.clone().next()?;
    let (mut plane, mut rms, mut trim) = (None::<Plane>, 0.0, f64::INFINITY);
    for _ in 0..4 {
        let kept = |p: &&Point| plane.is_none_or(|q: Plane| q.distance(p).abs() <= trim);
        let mut moments = Moments::about(first);
        points.clone().filter(kept).for_each(|p| moments.add(p));
        let fitted = moments.plane()?;
        rms = spread(&fitted, points.clone(), trim);
        trim = (2.5 * rms).max(LEAST_TRIM);
        plane = Some(fitted);
    }
    plane.map(|plane| RobustPlane { plane, rms })
}

/// Root mean square distance of the points within `trim`.
fn spread<'a>(plane: &Plane, points: impl Iterator<Item = &'a Point>, trim: f64) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for d in points.map(|p| plane.distance(p)).filter(|d| d.abs() <= trim) {
        sum += d * d;
        count += 1.0;
    }
    f64::sqrt(sum / f64::max(count, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_robust_plane_ignores_a_dent() {
        let mut points = Vec::new();
        for x in 0..40 {
            for y in 0..40 {
                let dent = (10..20).contains(&x) && (10..20).contains(&y);
                let z = 0.2 * f64::from(x) * 0.01 - if dent { 0.03 } else { 0.0 };
                points.push(Point::new(f64::from(x) * 0.01, f64::from(y) * 0.01, z));
            }
        }
        let fit = robust_plane(points.iter()).unwrap();
        let truth = Vector::new(-0.2, 0.0, 1.0).normalize();
        assert!(fit.plane.normal.dot(&truth).abs() > 1.0 - 1e-9);
        assert!(fit.rms < 1e-6);
    }

    #[test]
    fn points_on_a_line_span_no_plane() {
        let points: Vec<Point> = (0..9).map(|k| Point::new(f64::from(k), 0.0, 0.0)).collect();
        assert!(robust_plane(points.iter()).is_none());
    }
}
