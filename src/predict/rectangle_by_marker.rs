//! Strong: a rectangular face whose place on the object a marker tells.

use nalgebra::{Rotation3, UnitQuaternion};

use super::{Prediction, positive};
use crate::geometry::{Point, Polygon, Pose, Vector};
use crate::primitives::Arguments;
use crate::rules::BadArgument;

pub(super) fn predict(arguments: &Arguments) -> Result<Option<Prediction>, BadArgument> {
    let world_from_marker = arguments.pose("marker")?;
    let (at, facing) = (arguments.point("at")?, arguments.direction("facing")?);
    let (width, height) = (arguments.length("width")?, arguments.length("height")?);
    let face = marker_from_face(at, facing).and_then(|face| rectangle(&(world_from_marker * face), width, height));
    Ok(Prediction::of(face))
}

/// The frame of a face at `at` that looks towards `facing`, both in a marker's axes:
/// x right and y up as one looks at the face, y as close to the marker's y as
/// `facing` allows, to its z where it looks straight up or down the print.
fn marker_from_face(at: Point, facing: Vector) -> Option<Pose> {
    let out = facing.try_normalize(1e-12)?;
    let up = if out.y.abs() > 1.0 - 1e-9 {
        Vector::z()
    } else {
        Vector::y()
    };
    let right = up.cross(&out).normalize();
    let axes = nalgebra::Matrix3::from_columns(&[right, out.cross(&right), out]);
    let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
    Some(Pose::from_parts(at.coords.into(), rotation))
}

/// Lower left, lower right, upper right, upper left as one looks at the face.
fn rectangle(world_from_face: &Pose, width: f64, height: f64) -> Option<Polygon> {
    if !(positive(width) && positive(height)) {
        return None;
    }
    let (w, h) = (width / 2.0, height / 2.0);
    let corners = [(-w, -h), (w, -h), (w, h), (-w, h)];
    Polygon::new(corners.map(|(x, y)| world_from_face * Point::new(x, y, 0.0)).to_vec())
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::{arguments, length};
    use super::*;
    use crate::geometry::frame_facing;
    use crate::primitives::Datum;
    use crate::rules::Value;

    /// A label on the front of a carton, which looks towards world +x: its x is world +y.
    fn lid(width: f64, height: f64) -> Option<Polygon> {
        let label = frame_facing(Point::new(0.2, 0.0, 0.1), Vector::x());
        let given = arguments([
            ("marker", Datum::Constant(Value::Pose(label))),
            ("at", Datum::Constant(Value::Point(Point::new(0.0, 0.1, -0.2)))),
            ("facing", Datum::Constant(Value::Direction(Vector::y()))),
            ("width", length(width)),
            ("height", length(height)),
        ]);
        predict(&given).unwrap().map(|p| p.polygons[0].clone())
    }

    #[test]
    fn a_label_on_the_front_tells_where_the_lid_is() {
        let lid = lid(0.3, 0.4).unwrap();
        assert!((lid.centre() - Point::new(0.0, 0.0, 0.2)).norm() < 1e-12);
        assert!((lid.normal() - Vector::z()).norm() < 1e-12);
        // `width` runs along the label's x, `height` into the depth of the carton.
        let reach = |axis: usize| {
            let along = lid.vertices().iter().map(|v| v[axis]);
            along.clone().fold(f64::MIN, f64::max) - along.fold(f64::MAX, f64::min)
        };
        assert!((reach(1) - 0.3).abs() < 1e-12);
        assert!((reach(0) - 0.4).abs() < 1e-12);
    }

    #[test]
    fn the_face_behind_a_label_stands_upright_too() {
        let face = marker_from_face(Point::new(0.0, 0.0, -0.4), -Vector::z()).unwrap();
        assert!((face * Vector::z() + Vector::z()).norm() < 1e-12);
        assert!((face * Vector::y() - Vector::y()).norm() < 1e-12);
    }

    #[test]
    fn no_area_and_no_direction_predict_nothing() {
        assert_eq!(lid(0.0, 0.4), None);
        assert_eq!(lid(0.3, f64::NAN), None);
        assert_eq!(marker_from_face(Point::origin(), Vector::zeros()), None);
    }
}
