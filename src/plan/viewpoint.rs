//! A camera at a place: what lies inside its images and a detector's envelope.
//!
//! Whether something hides a voxel is the world's answer, not this one's.

use crate::geometry::{Camera, Point, Pose, Vector};
use crate::primitives::{Envelope, ImageKind};

/// A camera at a pose.
#[derive(Clone, Debug)]
pub struct Viewpoint {
    camera: Camera,
    world_from_camera: Pose,
    camera_from_world: Pose,
    eye: Point,
}

impl Viewpoint {
    /// A camera at `world_from_camera`.
    pub fn new(camera: Camera, world_from_camera: &Pose) -> Self {
        Self {
            camera,
            world_from_camera: *world_from_camera,
            camera_from_world: world_from_camera.inverse(),
            eye: Point::from(world_from_camera.translation.vector),
        }
    }

    /// The camera.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// Its place: `world_from_camera`.
    pub fn pose(&self) -> &Pose {
        &self.world_from_camera
    }

    /// Where the camera stands, world axes.
    pub fn eye(&self) -> &Point {
        &self.eye
    }

    /// Whether a point lies inside the depth image and the depth range.
    pub fn measures(&self, p: &Point) -> bool {
        self.depth_of(p).is_some()
    }

    /// Whether a detector could succeed on a surface at `p` with an outward
    /// normal, if nothing hides it: inside the depth image and range, inside
    /// the image that the detector reads, not too oblique and not too far.
    ///
    /// A detector on colour needs the depth image too: the feature is placed by it.
    pub fn could_detect(&self, p: &Point, normal: &Vector, envelope: &Envelope) -> bool {
        // First what rules out most and costs least.
        if !self.faces(p, normal, envelope) {
            return false;
        }
        let Some(depth) = self.depth_of(p) else {
            return false;
        };
        let image = match envelope.image {
            ImageKind::Depth => &self.camera.depth,
            ImageKind::Colour => &self.camera.colour,
        };
        let resolved = image.fx / depth >= envelope.min_pixels_per_metre;
        resolved && image.project(&(self.camera_from_world * p)).is_some()
    }

    /// The rays of the depth image through the centres of every k-th pixel of every
    /// k-th row, k being the least that leaves at most `a_row` of a row: where each
    /// enters and leaves the depth range, world axes.
    pub fn rays(&self, a_row: u32) -> impl Iterator<Item = (Point, Point)> + use<> {
        let (image, range) = (self.camera.depth, self.camera.range);
        let world_from_camera = self.camera_from_world.inverse();
        let every = image.width.div_ceil(a_row.max(1)).max(1) as usize;
        let along = move |n: u32| (every / 2..n as usize).step_by(every).map(|k| k as f64 + 0.5);
        let pixels = along(image.height).flat_map(move |v| along(image.width).map(move |u| (u, v)));
        pixels.map(move |(u, v)| {
            let ray = image.ray(u, v);
            let at = |depth: f64| world_from_camera * Point::from(ray * depth);
            (at(range.min), at(range.max))
        })
    }

    /// The area across the line of sight that one of [`Viewpoint::rays`] stands for at
    /// the depth of a point, m².
    pub fn ray_area(&self, p: &Point, a_row: u32) -> f64 {
        let image = &self.camera.depth;
        let every = f64::from(image.width.div_ceil(a_row.max(1)).max(1));
        let depth = (self.camera_from_world * p).z.max(0.0);
        let cosine = depth / (p - self.eye).norm().max(1e-12);
        every * every * depth * depth / (image.fx * image.fy) * cosine
    }

    fn faces(&self, p: &Point, normal: &Vector, envelope: &Envelope) -> bool {
        let sight = self.eye - p;
        let along = normal.dot(&sight);
        let turned_away = along < 0.0 && envelope.max_incidence <= std::f64::consts::FRAC_PI_2;
        !turned_away && along >= envelope.max_incidence.cos() * sight.norm()
    }

    /// z-depth of a point inside the depth image and range, metres.
    fn depth_of(&self, p: &Point) -> Option<f64> {
        let local = self.camera_from_world * p;
        let inside = self.camera.range.contains(local.z) && self.camera.depth.project(&local).is_some();
        inside.then_some(local.z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{DepthRange, Intrinsics, look_at};

    /// At x = 2 looking at the origin; 100 × 100 pixels over 60° in depth
    /// (f = 86.6), colour over 30°.
    fn view() -> Viewpoint {
        let image = |fov: f64| Intrinsics::with_fields_of_view(100, 100, fov.to_radians(), fov.to_radians());
        let camera = Camera {
            depth: image(60.0),
            colour: image(30.0),
            range: DepthRange { min: 0.5, max: 3.0 },
        };
        Viewpoint::new(camera, &look_at(Point::new(2., 0., 0.), Point::origin()))
    }

    fn envelope(image: ImageKind, min_pixels_per_metre: f64) -> Envelope {
        Envelope {
            max_incidence: 60_f64.to_radians(),
            image,
            min_pixels_per_metre,
            whole: false,
        }
    }

    #[test]
    fn a_point_is_measured_inside_image_and_range() {
        assert!(view().measures(&Point::origin()));
        assert!(view().measures(&Point::new(0., 1.1, 0.)));
        assert!(!view().measures(&Point::new(0., 1.2, 0.)));
        assert!(!view().measures(&Point::new(1.6, 0., 0.)));
        assert!(!view().measures(&Point::new(-1.1, 0., 0.)));
    }

    #[test]
    fn an_envelope_bounds_incidence_resolution_and_image() {
        let sees = |p: Point, degrees: f64, e: Envelope| {
            let turn = degrees.to_radians();
            view().could_detect(&p, &Vector::new(turn.cos(), turn.sin(), 0.), &e)
        };
        let depth = envelope(ImageKind::Depth, 43.0);
        assert!(sees(Point::origin(), 59.9, depth));
        assert!(!sees(Point::origin(), 60.1, depth));
        // 86.6 pixels / 2 m = 43.3 a metre.
        assert!(!sees(Point::origin(), 0.0, envelope(ImageKind::Depth, 43.4)));
        // tan 15° · 2 m = 0.536 m is the border of the colour image.
        let colour = envelope(ImageKind::Colour, 43.0);
        assert!(sees(Point::new(0., 0.53, 0.), 0.0, colour));
        assert!(!sees(Point::new(0., 0.55, 0.), 0.0, colour));
        assert!(sees(Point::new(0., 0.55, 0.), 0.0, depth));
    }
}
