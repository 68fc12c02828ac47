//! Strong: the triangle of a common edge and an apex.

use super::{Prediction, positive};
use crate::geometry::{Edge, Point, Polygon};
use crate::primitives::Arguments;
use crate::rules::BadArgument;

pub(super) fn predict(arguments: &Arguments) -> Result<Option<Prediction>, BadArgument> {
    let (on, apex) = (arguments.edge("on")?, arguments.point("apex")?);
    Ok(Prediction::of(triangle(&on, apex)))
}

/// Apex first, then the common edge reversed, so that the triangle faces outward.
pub(super) fn triangle(on: &Edge, apex: Point) -> Option<Polygon> {
    let usable = positive(on.length()) && apex.coords.iter().all(|c| c.is_finite());
    let height = (apex - on.start).cross(&on.direction()).norm();
    (usable && positive(height)).then(|| Polygon::new(vec![apex, on.end, on.start]))?
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::far_edge;
    use super::*;

    #[test]
    fn a_pyramids_side_has_its_apex_first_and_faces_outward_and_up() {
        let apex = Point::new(0.5, 0.5, 1.0);
        let side = triangle(&far_edge(), apex).unwrap();
        assert_eq!(side.vertices(), [apex, Point::new(1., 1., 0.), Point::new(0., 1., 0.)]);
        assert!(side.normal().y > 0.5 && side.normal().z > 0.4);
    }

    #[test]
    fn an_apex_on_the_line_of_the_edge_predicts_nothing() {
        assert_eq!(triangle(&far_edge(), Point::new(3., 1., 0.)), None);
        assert_eq!(triangle(&far_edge(), Point::new(f64::NAN, 1., 0.)), None);
    }
}
