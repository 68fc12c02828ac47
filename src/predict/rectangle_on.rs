//! Strong: a rectangle on a common edge at a dihedral angle.

use super::{Prediction, positive};
use crate::geometry::{Edge, Polygon};
use crate::primitives::Arguments;
use crate::rules::BadArgument;

pub(super) fn predict(arguments: &Arguments) -> Result<Option<Prediction>, BadArgument> {
    let (on, dihedral) = (arguments.edge("on")?, arguments.angle("dihedral")?);
    Ok(Prediction::of(rectangle(&on, dihedral, arguments.length("height")?)))
}

/// The rectangle that reaches `height` from an edge of another face. It begins
/// with the common edge, reversed, so that its own face lies to the left.
///
/// With interior dihedral θ it extends along u = cos θ · inward − sin θ · normal:
/// θ = 0 folds it onto the face, θ = 180° continues the face's plane.
pub(super) fn rectangle(on: &Edge, dihedral: f64, height: f64) -> Option<Polygon> {
    if !(positive(height) && positive(on.length()) && dihedral.is_finite()) {
        return None;
    }
    let along = on.inward() * dihedral.cos() - on.face_normal * dihedral.sin();
    let reach = along * height;
    Polygon::new(vec![on.end, on.start, on.start + reach, on.end + reach])
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::far_edge;
    use super::*;
    use crate::geometry::{Point, Vector};

    #[test]
    fn an_upright_side_begins_with_the_common_edge_and_faces_outward() {
        let side = rectangle(&far_edge(), 90_f64.to_radians(), 2.0).unwrap();
        assert!((side.normal() - Vector::y()).norm() < 1e-12);
        assert_eq!(side.vertices()[0], Point::new(1., 1., 0.));
        assert_eq!(side.vertices()[1], Point::new(0., 1., 0.));
        assert!((side.vertices()[2] - Point::new(0., 1., 2.)).norm() < 1e-12);
    }

    #[test]
    fn an_acute_dihedral_leans_over_the_object() {
        let side = rectangle(&far_edge(), 60_f64.to_radians(), 1.0).unwrap();
        // u = (0, −cos 60°, sin 60°); the normal is (0, sin 60°, cos 60°).
        let (c, s) = (0.5, 60_f64.to_radians().sin());
        assert!((side.vertices()[3] - Point::new(1., 1. - c, s)).norm() < 1e-12);
        assert!((side.normal() - Vector::new(0., s, c)).norm() < 1e-12);
    }

    #[test]
    fn no_height_and_no_number_predict_nothing() {
        for height in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(rectangle(&far_edge(), 1.0, height), None);
        }
        assert_eq!(rectangle(&far_edge(), f64::NAN, 1.0), None);
        let mut point = far_edge();
        point.end = point.start;
        assert_eq!(rectangle(&point, 1.0, 1.0), None);
    }
}
