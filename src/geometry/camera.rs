//! The pinhole camera pair of an RGB-D sensor.

use serde::{Deserialize, Serialize};

use super::frame::{Point, Vector};

/// A pinhole image: size and focal lengths in pixels.
///
/// Pixel (u, v) covers [u, u+1) × [v, v+1); its centre is (u + 0.5, v + 0.5).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Intrinsics {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Horizontal focal length, pixels.
    pub fx: f64,
    /// Vertical focal length, pixels.
    pub fy: f64,
    /// Column of the principal point, pixels.
    pub cx: f64,
    /// Row of the principal point, pixels.
    pub cy: f64,
}

impl Intrinsics {
    /// An image with full horizontal and vertical fields of view in radians,
    /// the principal point at its centre.
    pub fn with_fields_of_view(width: u32, height: u32, horizontal: f64, vertical: f64) -> Self {
        let (w, h) = (f64::from(width), f64::from(height));
        Self {
            width,
            height,
            fx: w / 2.0 / (horizontal / 2.0).tan(),
            fy: h / 2.0 / (vertical / 2.0).tan(),
            cx: w / 2.0,
            cy: h / 2.0,
        }
    }

    /// Image coordinates of a point in camera axes; `None` behind the camera
    /// or outside the image.
    pub fn project(&self, p_in_camera: &Point) -> Option<(f64, f64)> {
        if p_in_camera.z <= 0.0 {
            return None;
        }
        let u = self.fx * p_in_camera.x / p_in_camera.z + self.cx;
        let v = self.fy * p_in_camera.y / p_in_camera.z + self.cy;
        let inside = u >= 0.0 && v >= 0.0 && u < f64::from(self.width) && v < f64::from(self.height);
        inside.then_some((u, v))
    }

    /// The direction with z = 1 of image coordinates (u, v), camera axes.
    pub fn ray(&self, u: f64, v: f64) -> Vector {
        Vector::new((u - self.cx) / self.fx, (v - self.cy) / self.fy, 1.0)
    }

    /// Number of pixels.
    pub fn pixels(&self) -> usize {
        self.width as usize * self.height as usize
    }
}

/// The z-depths at which a sensor gives readings, metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct DepthRange {
    /// Nearest reading.
    pub min: f64,
    /// Farthest reading.
    pub max: f64,
}

impl DepthRange {
    /// Whether a z-depth can be read.
    pub fn contains(&self, depth: f64) -> bool {
        self.min <= depth && depth <= self.max
    }
}

/// An RGB-D camera. Depth is registered: both images share one pose and
/// optical centre, and may differ in resolution and field of view.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Camera {
    /// The depth image.
    pub depth: Intrinsics,
    /// The colour image.
    pub colour: Intrinsics,
    /// Where depth is read.
    pub range: DepthRange,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn projection_and_ray_are_inverse() {
        let k = Intrinsics::with_fields_of_view(640, 480, 1.0, 0.8);
        let p = Point::new(0.2, -0.1, 1.5);
        let (u, v) = k.project(&p).unwrap();
        let back = k.ray(u, v) * p.z;
        assert!((back - p.coords).norm() < 1e-12);
        assert_eq!(k.project(&Point::new(0.0, 0.0, -1.0)), None);
    }

    #[test]
    fn the_field_of_view_spans_the_image() {
        let k = Intrinsics::with_fields_of_view(512, 424, 70.6_f64.to_radians(), 60_f64.to_radians());
        let edge = k.ray(0.0, 212.0);
        assert!((edge.x.atan().to_degrees() + 35.3).abs() < 1e-9);
    }
}
