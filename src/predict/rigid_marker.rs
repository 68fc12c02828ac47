//! Strong: a marker that a rigid layout ties to a detected one.

use super::{Prediction, positive};
use crate::geometry::{Polygon, Pose};
use crate::primitives::Arguments;
use crate::rules::BadArgument;

pub(super) fn predict(arguments: &Arguments) -> Result<Option<Prediction>, BadArgument> {
    let world_from_antecedent = arguments.pose("antecedent")?;
    let antecedent_from_consequent = arguments.pose("antecedent_from_consequent")?;
    let world_from_consequent = world_from_antecedent * antecedent_from_consequent;
    Ok(Prediction::of(plate(&world_from_consequent, arguments.length("size")?)))
}

/// The square of edge `size` about a marker's origin, facing its +z: lower
/// left, lower right, upper right, upper left as one looks at the print.
pub(crate) fn plate(world_from_marker: &Pose, size: f64) -> Option<Polygon> {
    positive(size).then(|| Polygon::square(world_from_marker, size))?
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::{arguments, length};
    use super::*;
    use crate::geometry::{Point, Vector, frame_facing};
    use crate::primitives::Datum;
    use crate::rules::Value;

    #[test]
    fn a_layout_carries_over_to_the_detected_frame() {
        // Layout: code 1 at x = 1 facing +x, code 2 at y = 1 facing +y. Code 1
        // is found at the origin facing +y: the object is turned by 90° and
        // moved by (0, −1, 0), so code 2 is at (−1, −1, 0) facing −x.
        let one = frame_facing(Point::new(1., 0., 0.), Vector::x());
        let two = frame_facing(Point::new(0., 1., 0.), Vector::y());
        let found = frame_facing(Point::origin(), Vector::y());
        let pose = |p: Pose| Datum::Constant(Value::Pose(p));
        let place = predict(&arguments([
            ("antecedent", pose(found)),
            ("antecedent_from_consequent", pose(one.inverse() * two)),
            ("size", length(0.2)),
        ]));
        let polygon = &place.unwrap().unwrap().polygons[0];
        assert!((polygon.centre() - Point::new(-1., -1., 0.)).norm() < 1e-12);
        assert!((polygon.normal() + Vector::x()).norm() < 1e-12);
        assert!((polygon.area() - 0.04).abs() < 1e-12);
    }

    #[test]
    fn a_plate_of_no_size_or_at_no_place_predicts_nothing() {
        assert_eq!(plate(&Pose::identity(), 0.0), None);
        assert_eq!(plate(&Pose::translation(f64::NAN, 0.0, 0.0), 0.2), None);
    }
}
