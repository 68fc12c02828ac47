//! Poses as recordings write them: rows of a matrix, a quaternion, a log.

use nalgebra::{Matrix3, Quaternion, Rotation3, Translation3, UnitQuaternion};

use crate::geometry::{Pose, Rotation, Vector};

/// How far a rotation's rows may be from orthonormal, and a quaternion from
/// unit length: files round.
const SLACK: f64 = 1e-2;

/// The rigid transform of 4 × 4 rows; what is wrong otherwise.
pub(super) fn from_rows(rows: &[[f64; 4]; 4]) -> Result<Pose, String> {
    if rows.iter().flatten().any(|x| !x.is_finite()) {
        return Err("a pose with numbers that are not finite".to_owned());
    }
    let bottom = rows[3];
    if (0..3).any(|k| bottom[k].abs() > SLACK) || (bottom[3] - 1.0).abs() > SLACK {
        return Err(format!("the last row of a pose is {bottom:?}; expected 0 0 0 1"));
    }
    let m = Matrix3::from_fn(|i, j| rows[i][j]);
    let translation = Translation3::new(rows[0][3], rows[1][3], rows[2][3]);
    Ok(Pose::from_parts(translation, rotation(&m)?))
}

/// The rotation nearest to a matrix that is one but for rounding.
pub(super) fn rotation(m: &Matrix3<f64>) -> Result<Rotation, String> {
    if (m.determinant() + 1.0).abs() < 10.0 * SLACK {
        return Err("a pose that mirrors (determinant −1): one axis points the wrong way".to_owned());
    }
    let off = (m * m.transpose() - Matrix3::identity()).abs().max();
    if off.is_nan() || off > SLACK {
        return Err(format!(
            "a pose that is not rigid: its rotation is {off:.2} from orthonormal"
        ));
    }
    let closest = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*m));
    Ok(UnitQuaternion::new_normalize(closest.into_inner()))
}

/// Translation x y z and quaternion x y z w.
pub(super) fn from_quaternion(t: [f64; 3], [x, y, z, w]: [f64; 4]) -> Result<Pose, String> {
    let q = Quaternion::new(w, x, y, z);
    let finite = t.iter().all(|c| c.is_finite()) && q.coords.iter().all(|c| c.is_finite());
    if !finite {
        return Err("a pose with numbers that are not finite".to_owned());
    }
    if (q.norm() - 1.0).abs() > SLACK {
        return Err(format!("a quaternion of length {:.3}; expected 1", q.norm()));
    }
    Ok(Pose::from_parts(
        Translation3::from(Vector::from(t)),
        UnitQuaternion::new_normalize(q),
    ))
}

/// A camera with OpenGL's axes (x right, y up, z backward) as one with OpenCV's.
pub(super) fn opencv_from_opengl(world_from_camera: &Pose) -> Pose {
    let half_turn = Rotation::from_axis_angle(&Vector::x_axis(), std::f64::consts::PI);
    world_from_camera * half_turn
}

/// The numbers of a text, separated by blanks or commas.
pub(super) fn numbers(text: &str) -> Result<Vec<f64>, String> {
    let words = text
        .split(|c: char| c.is_whitespace() || c == ',')
        .filter(|w| !w.is_empty());
    let number = |word: &str| {
        let short: String = word.chars().take(24).collect();
        word.parse::<f64>().map_err(|_| format!("`{short}` is no number"))
    };
    words.map(number).collect()
}

/// Sixteen numbers as rows.
pub(super) fn rows(numbers: &[f64]) -> Result<[[f64; 4]; 4], String> {
    let &[.., _] = numbers else {
        return Err("an empty pose; expected 16 numbers".to_owned());
    };
    if numbers.len() != 16 {
        return Err(format!("a pose of {} numbers; expected 16", numbers.len()));
    }
    Ok(std::array::from_fn(|i| std::array::from_fn(|j| numbers[4 * i + j])))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;

    #[test]
    fn a_pose_that_is_no_rigid_motion_is_named() {
        let with = |m: [f64; 3]| {
            [
                [m[0], 0., 0., 1.],
                [0., m[1], 0., 2.],
                [0., 0., m[2], 3.],
                [0., 0., 0., 1.],
            ]
        };
        assert_eq!(
            from_rows(&with([1., 1., 1.])).unwrap() * Point::origin(),
            Point::new(1., 2., 3.)
        );
        assert!(from_rows(&with([1., 1., -1.])).unwrap_err().contains("mirrors"));
        assert!(from_rows(&with([2., 2., 2.])).unwrap_err().contains("not rigid"));
        assert!(from_rows(&with([f64::NAN, 1., 1.])).unwrap_err().contains("finite"));
        assert!(
            from_quaternion([0.; 3], [0., 0., 0., 2.])
                .unwrap_err()
                .contains("length 2")
        );
        assert!(rows(&numbers("1 2 3").unwrap()).unwrap_err().contains("3 numbers"));
    }

    #[test]
    fn what_opengl_sees_ahead_lies_at_negative_z() {
        let camera = opencv_from_opengl(&Pose::identity());
        let ahead = camera * Point::new(0.1, 0.2, 1.0);
        assert!((ahead - Point::new(0.1, -0.2, -1.0)).norm() < 1e-12);
    }
}
