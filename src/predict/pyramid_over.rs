//! Strong: all faces of the pyramid over a base.

use super::triangle_to::triangle;
use super::{Prediction, positive};
use crate::geometry::{Point, Polygon};
use crate::primitives::Arguments;
use crate::rules::BadArgument;

pub(super) fn predict(arguments: &Arguments) -> Result<Option<Prediction>, BadArgument> {
    Ok(pyramid(arguments.polygon("base")?, arguments.point("apex")?))
}

/// The base, then a side an edge in the base's order. An apex that is not
/// behind the base spans no pyramid.
fn pyramid(base: &Polygon, apex: Point) -> Option<Prediction> {
    if !positive(-base.height_of(&apex)) {
        return None;
    }
    let sides = base.edges().into_iter().filter_map(|e| triangle(&e, apex));
    let polygons = [base.clone()].into_iter().chain(sides).collect();
    Some(Prediction { polygons })
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::bottom;
    use super::*;
    use crate::geometry::Vector;

    #[test]
    fn a_pyramid_over_a_square_is_closed_and_faces_outward() {
        let faces = pyramid(&bottom(), Point::new(0.5, 0.5, 2.0)).unwrap().polygons;
        assert_eq!(faces.len(), 5);
        let inside = Point::new(0.5, 0.5, 0.5);
        assert!(faces.iter().all(|f| f.height_of(&inside) < 0.0));
        let sum: Vector = faces.iter().map(|f| f.normal() * f.area()).sum();
        assert!(sum.norm() < 1e-12);
    }

    #[test]
    fn an_apex_on_the_wrong_side_predicts_nothing() {
        assert_eq!(pyramid(&bottom(), Point::new(0.5, 0.5, -1.0)), None);
        assert_eq!(pyramid(&bottom(), Point::new(0.5, 0.5, 0.0)), None);
        assert_eq!(pyramid(&bottom(), Point::new(0.5, f64::NAN, 1.0)), None);
    }
}
