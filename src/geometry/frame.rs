//! Points, directions and rigid transforms, and the frames built from them.

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};

/// A point, in metres.
pub type Point = Point3<f64>;
/// A displacement or a direction; metres where it is a displacement.
pub type Vector = Vector3<f64>;
/// A rotation.
pub type Rotation = UnitQuaternion<f64>;
/// A rigid transform. Name values by what they map, e.g. `world_from_camera`.
pub type Pose = Isometry3<f64>;

/// `world_from_camera` of a camera at `eye` whose optical axis passes through `target`.
///
/// The image's up direction is as close to world +z as the optical axis allows
/// (towards +y where the axis is vertical), so no view is rolled.
pub fn look_at(eye: Point, target: Point) -> Pose {
    let forward = (target - eye).try_normalize(1e-12).unwrap_or_else(Vector::x);
    let up = if forward.z.abs() > 1.0 - 1e-9 {
        Vector::y()
    } else {
        Vector::z()
    };
    let right = forward.cross(&up).normalize();
    let down = forward.cross(&right);
    pose_of_axes(eye, right, down, forward)
}

/// `world_from_place` of a flat place at `origin` whose outward normal is `facing`.
///
/// The place's own axes are x right and y up as seen by somebody who looks at
/// it, z towards the onlooker. Its y axis is as close to world +z as `facing`
/// allows (+x where it faces straight up or down).
pub fn frame_facing(origin: Point, facing: Vector) -> Pose {
    let out = facing.try_normalize(1e-12).unwrap_or_else(Vector::z);
    let up_hint = if out.z.abs() > 1.0 - 1e-9 {
        Vector::x()
    } else {
        Vector::z()
    };
    let right = up_hint.cross(&out).normalize();
    let up = out.cross(&right);
    pose_of_axes(origin, right, up, out)
}

/// The word for a direction along an axis: `+x`, `-z`.
pub fn axis_word(direction: &Vector) -> Option<&'static str> {
    const WORDS: [[&str; 2]; 3] = [["+x", "-x"], ["+y", "-y"], ["+z", "-z"]];
    let axis = direction.iter().position(|c| c.abs() > 1.0 - 1e-6)?;
    Some(WORDS[axis][usize::from(direction[axis] < 0.0)])
}

/// The pose whose rotation has the given orthonormal, right-handed columns.
fn pose_of_axes(origin: Point, x: Vector, y: Vector, z: Vector) -> Pose {
    let rotation = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, z]));
    Pose::from_parts(
        Translation3::from(origin.coords),
        UnitQuaternion::from_rotation_matrix(&rotation),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_camera_looks_at_its_target_with_the_image_upright() {
        let pose = look_at(Point::new(2.0, 0.0, 1.0), Point::new(0.0, 0.0, 1.0));
        let ahead = pose * Vector::z();
        let down = pose * Vector::y();
        assert!((ahead - Vector::new(-1.0, 0.0, 0.0)).norm() < 1e-12);
        assert!((down - Vector::new(0.0, 0.0, -1.0)).norm() < 1e-12);
    }

    #[test]
    fn a_vertical_view_is_a_proper_rotation() {
        for eye_z in [3.0, -3.0] {
            let pose = look_at(Point::new(0.0, 0.0, eye_z), Point::origin());
            let m = pose.rotation.to_rotation_matrix();
            assert!((m.matrix().determinant() - 1.0).abs() < 1e-12);
            assert!((pose * Vector::z() - Vector::new(0.0, 0.0, -eye_z.signum())).norm() < 1e-12);
        }
    }

    #[test]
    fn a_place_faces_where_it_is_told() {
        let place = frame_facing(Point::new(1.0, 2.0, 3.0), Vector::x());
        assert!((place * Vector::z() - Vector::x()).norm() < 1e-12);
        assert!((place * Vector::y() - Vector::z()).norm() < 1e-12);
    }
}
