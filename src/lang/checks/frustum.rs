//! Whether a view sees any of a box: image and depth range against its faces.

use crate::geometry::{Bounds, Camera, Point, Pose};

/// Whether some point of the box lies in the depth image and the depth range.
pub(super) fn sees(camera: &Camera, world_from_camera: &Pose, bounds: &Bounds) -> bool {
    let k = &camera.depth;
    let (left, right) = (k.cx / k.fx, (f64::from(k.width) - k.cx) / k.fx);
    let (top, bottom) = (k.cy / k.fy, (f64::from(k.height) - k.cy) / k.fy);
    let (near, far) = (camera.range.min, camera.range.max);
    // Above zero inside, camera axes.
    let planes: [&dyn Fn(&Point) -> f64; 6] = [
        &|p| p.z - near,
        &|p| far - p.z,
        &|p| p.x + left * p.z,
        &|p| right * p.z - p.x,
        &|p| p.y + top * p.z,
        &|p| bottom * p.z - p.y,
    ];
    // Where no face passes through the frustum, it lies in the box whole, or apart.
    let within = world_from_camera * Point::new(0.0, 0.0, near.midpoint(far));
    bounds.contains(&within)
        || faces(bounds).into_iter().any(|face| {
            let mut outline: Vec<Point> = face
                .iter()
                .map(|p| world_from_camera.inverse_transform_point(p))
                .collect();
            for plane in planes {
                outline = clipped(&outline, plane);
            }
            !outline.is_empty()
        })
}

/// The part of a convex outline where `inside` is not below zero.
fn clipped(outline: &[Point], inside: &dyn Fn(&Point) -> f64) -> Vec<Point> {
    let mut out = Vec::with_capacity(outline.len() + 1);
    for (k, p) in outline.iter().enumerate() {
        let q = &outline[(k + 1) % outline.len()];
        let (a, b) = (inside(p), inside(q));
        if a >= 0.0 {
            out.push(*p);
        }
        if (a < 0.0) != (b < 0.0) {
            out.push(p + (q - p) * (a / (a - b)));
        }
    }
    out
}

fn faces(bounds: &Bounds) -> [[Point; 4]; 6] {
    let corner = |k: usize| {
        let at = |axis: usize| {
            let end = if k >> axis & 1 == 0 { &bounds.min } else { &bounds.max };
            end[axis]
        };
        Point::new(at(0), at(1), at(2))
    };
    let face = |corners: [usize; 4]| corners.map(corner);
    [
        face([0, 2, 6, 4]),
        face([1, 3, 7, 5]),
        face([0, 1, 5, 4]),
        face([2, 3, 7, 6]),
        face([0, 1, 3, 2]),
        face([4, 5, 7, 6]),
    ]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::geometry::{DepthRange, Intrinsics, Vector, look_at};

    fn camera(min: f64, max: f64) -> Camera {
        let image = Intrinsics::with_fields_of_view(512, 424, 1.2, 1.0);
        Camera {
            depth: image,
            colour: image,
            range: DepthRange { min, max },
        }
    }

    #[test]
    fn by_hand() {
        let cube = Bounds::centred(Point::origin(), Vector::repeat(2.0));
        let from = |x: f64, target: Point| look_at(Point::new(x, 0.0, 0.0), target);
        let (ahead, aside) = (Point::origin(), Point::new(3.0, 4.0, 0.0));
        assert!(sees(&camera(0.5, 4.5), &from(3.0, ahead), &cube));
        assert!(!sees(&camera(0.5, 1.9), &from(3.0, ahead), &cube));
        assert!(!sees(&camera(4.1, 9.0), &from(3.0, ahead), &cube));
        assert!(!sees(&camera(0.5, 4.5), &from(3.0, aside), &cube));
        // A frustum that is in the box whole.
        let room = Bounds::centred(Point::origin(), Vector::repeat(50.0));
        assert!(sees(&camera(0.5, 4.5), &from(3.0, ahead), &room));
    }

    proptest! {
        /// A point of the box that projects into the image at a depth in range is seen.
        #[test]
        fn what_a_point_shows_is_seen(
            eye in prop::array::uniform3(-4.0..4.0_f64),
            at in prop::array::uniform3(-2.0..2.0_f64),
            p in prop::array::uniform3(-1.0..1.0_f64),
        ) {
            let cube = Bounds::centred(Point::origin(), Vector::repeat(2.0));
            let (camera, view) = (camera(0.5, 2.5), look_at(eye.into(), at.into()));
            let p = view.inverse_transform_point(&Point::from(p));
            if camera.range.contains(p.z) && camera.depth.project(&p).is_some() {
                prop_assert!(sees(&camera, &view, &cube));
            }
        }
    }
}
