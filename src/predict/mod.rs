//! Predictors: from measured features to the place of one not yet seen.
//!
//! One file a primitive. Each takes evaluated arguments and gives polygons with
//! outward normals. Degenerate input (no length, no area, nothing finite) gives
//! no prediction. Which voxels a prediction covers is `plan`'s business.

mod behind;
mod completed_square;
mod face;
mod prism_over;
mod pyramid_over;
mod rectangle_by_marker;
mod rectangle_on;
mod rigid_marker;
mod triangle_to;

use crate::geometry::Polygon;
use crate::primitives::{Arguments, Datum};
use crate::rules::{BadArgument, Value};

/// Where a feature must be: polygons in world axes, metres, normals outward.
///
/// A face has one polygon, a marker the square of its plate, a shell all faces.
#[derive(Clone, Debug, PartialEq)]
pub struct Prediction {
    /// The faces.
    pub polygons: Vec<Polygon>,
}

type Predictor = fn(&Arguments) -> Result<Option<Prediction>, BadArgument>;
type ValueOf = fn(&Arguments) -> Result<Option<Datum>, BadArgument>;

const PREDICTORS: &[(&str, Predictor)] = &[
    ("rectangle_on", rectangle_on::predict),
    ("rectangle_by_marker", rectangle_by_marker::predict),
    ("triangle_to", triangle_to::predict),
    ("completed_square", completed_square::predict),
    ("prism_over", prism_over::predict),
    ("pyramid_over", pyramid_over::predict),
    ("rigid_marker", rigid_marker::predict),
];

const VALUES: &[(&str, ValueOf)] = &[
    ("behind", |a| {
        Ok(behind::point(a)?.map(|p| Datum::Constant(Value::Point(p))))
    }),
    ("polygon", |a| Ok(face::polygon(a)?.map(Datum::Polygon))),
    ("edge_of", |a| Ok(face::edge(a)?.map(Datum::Edge))),
];

/// pred(): the place of a rule's consequent; `None` where the arguments are degenerate.
///
/// # Errors
/// `primitive` is no predictor, or an argument is missing or of another kind.
pub fn predict(primitive: &str, arguments: &Arguments) -> Result<Option<Prediction>, BadArgument> {
    match PREDICTORS.iter().find(|(name, _)| *name == primitive) {
        Some((_, function)) => function(arguments),
        None => Err(BadArgument::new(primitive, "a predictor")),
    }
}

/// The point, face or edge that a primitive gives; `None` where the arguments are degenerate.
///
/// # Errors
/// `primitive` gives none of these, or an argument is missing or of another kind.
pub fn value(primitive: &str, arguments: &Arguments) -> Result<Option<Datum>, BadArgument> {
    match VALUES.iter().find(|(name, _)| *name == primitive) {
        Some((_, function)) => function(arguments),
        None => Err(BadArgument::new(
            primitive,
            "a primitive that gives a point, a face or an edge",
        )),
    }
}

impl Prediction {
    fn of(polygon: Option<Polygon>) -> Option<Self> {
        polygon.map(|p| Self { polygons: vec![p] })
    }
}

/// A length that something can be built on.
fn positive(length: f64) -> bool {
    length.is_finite() && length > 1e-9
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::primitives::{Type, all};

    #[test]
    fn every_declared_predictor_and_value_has_one_function() {
        let of =
            |types: &[Type]| -> Vec<&str> { all().filter(|p| types.contains(&p.result)).map(|p| p.name).collect() };
        let predictors: Vec<&str> = PREDICTORS.iter().map(|(name, _)| *name).collect();
        let values: Vec<&str> = VALUES.iter().map(|(name, _)| *name).collect();
        assert_eq!(predictors, of(&[Type::Predictor]));
        assert_eq!(values, of(&[Type::Point, Type::Polygon, Type::Edge]));
    }

    #[test]
    fn a_missing_argument_is_an_error_and_no_panic() {
        for (name, function) in PREDICTORS {
            assert!(function(&Arguments::default()).is_err(), "`{name}`");
        }
        for (name, function) in VALUES {
            assert!(function(&Arguments::default()).is_err(), "`{name}`");
        }
        assert!(predict("outline", &Arguments::default()).is_err());
    }
}

#[cfg(test)]
mod fixtures {
    use crate::geometry::{Edge, Point, Polygon, Vector};
    use crate::primitives::{Arguments, Datum};
    use crate::rules::Value;

    pub fn arguments<const N: usize>(pairs: [(&str, Datum); N]) -> Arguments {
        Arguments(
            pairs
                .into_iter()
                .map(|(name, datum)| (name.to_owned(), datum))
                .collect(),
        )
    }

    pub fn length(metres: f64) -> Datum {
        Datum::Constant(Value::Length(metres))
    }

    /// A unit square at z = 0 that faces down.
    pub fn bottom() -> Polygon {
        let corners = [(0., 0.), (0., 1.), (1., 1.), (1., 0.)];
        Polygon::new(corners.map(|(x, y)| Point::new(x, y, 0.0)).to_vec()).unwrap()
    }

    /// An edge of [`bottom`] along +x at y = 1; the object lies to its −y side.
    pub fn far_edge() -> Edge {
        let edge = bottom().edge(1);
        assert_eq!((edge.start, edge.end), (Point::new(0., 1., 0.), Point::new(1., 1., 0.)));
        assert!((edge.inward() + Vector::y()).norm() < 1e-12);
        edge
    }
}
