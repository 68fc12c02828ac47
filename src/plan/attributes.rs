//! Attributes of measured features, as rules read them.
//!
//! [`crate::primitives::attributes`] declares them; here are their values.

use crate::detect::Measurement;
use crate::geometry::{Point, Polygon, Vector};
use crate::primitives::Datum;
use crate::rules::{BadArgument, Value};

/// An attribute of one instance. `self` is the whole face.
///
/// # Errors
/// Its kind of feature has no such attribute.
pub fn attribute(of: &Measurement, name: &str) -> Result<Datum, BadArgument> {
    let value = match of {
        Measurement::Face(face) => of_face(face, name),
        Measurement::Marker { pose, .. } => match name {
            "pose" => Some(Datum::Constant(Value::Pose(*pose))),
            "centre" => Some(point(Point::from(pose.translation.vector))),
            "normal" => Some(direction(pose * Vector::z())),
            _ => None,
        },
        Measurement::Shell(faces) => (name == "centre").then(|| point(centre_of_shell(faces))),
    };
    value.ok_or_else(|| BadArgument::new(name, "an attribute of this kind of feature"))
}

fn of_face(face: &Polygon, name: &str) -> Option<Datum> {
    Some(match name {
        "self" => Datum::Polygon(face.clone()),
        "edges" => Datum::Edges(face.edges()),
        "base" => Datum::Edge(face.edge(0)),
        "apex" => point(face.apex().0),
        "height" => Datum::Constant(Value::Length(face.apex().1)),
        "centre" => point(face.centre()),
        "normal" => direction(face.normal()),
        _ => return None,
    })
}

/// The mean of the distinct vertices.
fn centre_of_shell(faces: &[Polygon]) -> Point {
    let mut distinct: Vec<Point> = Vec::new();
    for vertex in faces.iter().flat_map(Polygon::vertices) {
        if distinct.iter().all(|d| (d - vertex).norm() > 1e-6) {
            distinct.push(*vertex);
        }
    }
    let sum: Vector = distinct.iter().map(|p| p.coords).sum();
    Point::from(sum / distinct.len().max(1) as f64)
}

/// The median of an attribute over instances: by component for points and
/// directions, the first instance's where there is no order. `None` without any.
pub fn median(values: &[Datum]) -> Option<Datum> {
    let first = values.first()?;
    let lengths = all(values, |d| match d {
        Datum::Constant(Value::Length(x)) => Some([*x, 0.0, 0.0]),
        _ => None,
    });
    let points = all(values, |d| match d {
        Datum::Constant(Value::Point(p)) => Some([p.x, p.y, p.z]),
        _ => None,
    });
    let directions = all(values, |d| match d {
        Datum::Constant(Value::Direction(v)) => Some([v.x, v.y, v.z]),
        _ => None,
    });
    if let Some(rows) = lengths {
        return Some(Datum::Constant(Value::Length(medians(&rows)[0])));
    }
    if let Some(rows) = points {
        return Some(point(Point::from(medians(&rows))));
    }
    if let Some(mean) = directions.and_then(|rows| Vector::from(medians(&rows)).try_normalize(1e-9)) {
        return Some(direction(mean));
    }
    Some(first.clone())
}

fn all(values: &[Datum], take: impl Fn(&Datum) -> Option<[f64; 3]>) -> Option<Vec<[f64; 3]>> {
    values.iter().map(take).collect()
}

fn medians(rows: &[[f64; 3]]) -> [f64; 3] {
    [0, 1, 2].map(|k| {
        let mut column: Vec<f64> = rows.iter().map(|row| row[k]).collect();
        column.sort_by(f64::total_cmp);
        let middle = column.len() / 2;
        if column.len() % 2 == 1 {
            column[middle]
        } else {
            (column[middle - 1] + column[middle]) / 2.0
        }
    })
}

fn point(p: Point) -> Datum {
    Datum::Constant(Value::Point(p))
}

fn direction(v: Vector) -> Datum {
    Datum::Constant(Value::Direction(v))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::frame_facing;
    use crate::primitives::attributes;
    use crate::rules::FeatureKind;

    fn triangle() -> Polygon {
        let at = |x: f64, y: f64| Point::new(x, y, 0.0);
        Polygon::new(vec![at(0., 0.), at(2., 0.), at(1., 3.)]).unwrap()
    }

    fn marker() -> Measurement {
        Measurement::Marker {
            pose: frame_facing(Point::new(1., 2., 3.), Vector::y()),
            size: 0.2,
        }
    }

    #[test]
    fn every_declared_attribute_has_a_value() {
        let cases = [
            (FeatureKind::Polygon, Measurement::Face(triangle())),
            (FeatureKind::Marker, marker()),
            (FeatureKind::Shell, Measurement::Shell(vec![triangle()])),
        ];
        for (kind, measurement) in cases {
            for declared in attributes(kind) {
                assert!(attribute(&measurement, declared.name).is_ok(), "`{}`", declared.name);
            }
            assert!(attribute(&measurement, "colour").is_err());
        }
    }

    #[test]
    fn apex_and_height_are_over_the_first_edge() {
        let face = Measurement::Face(triangle());
        assert_eq!(attribute(&face, "apex").unwrap(), point(Point::new(1., 3., 0.)));
        assert_eq!(attribute(&face, "height").unwrap(), Datum::Constant(Value::Length(3.0)));
    }

    #[test]
    fn the_centre_of_a_shell_counts_each_vertex_once() {
        let shell = Measurement::Shell(vec![triangle(), triangle(), triangle().facing(&-Vector::z())]);
        assert_eq!(attribute(&shell, "centre").unwrap(), point(Point::new(1., 1., 0.)));
    }

    #[test]
    fn a_median_is_by_component_and_means_the_middle_two() {
        let lengths = |xs: &[f64]| -> Vec<Datum> { xs.iter().map(|x| Datum::Constant(Value::Length(*x))).collect() };
        let length = |x| Some(Datum::Constant(Value::Length(x)));
        assert_eq!(median(&lengths(&[3., 1., 9.])), length(3.0));
        assert_eq!(median(&lengths(&[1., 4.])), length(2.5));
        assert_eq!(median(&[]), None);
        let points = [
            point(Point::new(0., 5., 1.)),
            point(Point::new(2., 1., 1.)),
            point(Point::new(9., 2., 1.)),
        ];
        assert_eq!(median(&points), Some(point(Point::new(2., 2., 1.))));
    }
}
