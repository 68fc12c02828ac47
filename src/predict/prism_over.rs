//! Strong: all faces of the upright prism over a base.

use super::rectangle_on::rectangle;
use super::{Prediction, positive};
use crate::geometry::Polygon;
use crate::primitives::Arguments;
use crate::rules::BadArgument;

pub(super) fn predict(arguments: &Arguments) -> Result<Option<Prediction>, BadArgument> {
    Ok(prism(arguments.polygon("base")?, arguments.length("height")?))
}

/// The base, a side an edge in the base's order, then the top.
fn prism(base: &Polygon, height: f64) -> Option<Prediction> {
    if !positive(height) {
        return None;
    }
    let upright = std::f64::consts::FRAC_PI_2;
    let rise = -base.normal() * height;
    let top = Polygon::new(base.vertices().iter().rev().map(|v| v + rise).collect())?;
    let sides = base.edges().into_iter().filter_map(|e| rectangle(&e, upright, height));
    let polygons = [base.clone()].into_iter().chain(sides).chain([top]).collect();
    Some(Prediction { polygons })
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::bottom;
    use super::*;
    use crate::geometry::{Point, Vector};

    #[test]
    fn a_prism_over_a_square_is_a_closed_box_that_faces_outward() {
        let faces = prism(&bottom(), 2.0).unwrap().polygons;
        assert_eq!(faces.len(), 6);
        let centre = Point::new(0.5, 0.5, 1.0);
        assert!(faces.iter().all(|f| f.height_of(&centre) < 0.0));
        // The vector areas of a closed surface sum to nothing.
        let sum: Vector = faces.iter().map(|f| f.normal() * f.area()).sum();
        assert!(sum.norm() < 1e-12);
        assert!((faces[5].normal() - Vector::z()).norm() < 1e-12);
    }

    #[test]
    fn no_height_predicts_nothing() {
        assert_eq!(prism(&bottom(), 0.0), None);
        assert_eq!(prism(&bottom(), f64::NAN), None);
    }
}
