//! Sets of candidate views.

use super::{Parameter, Primitive, Type};
use crate::geometry::{Point, Pose, Vector, look_at};
use crate::rules::{BadArgument, Call, Expr, Space, Value};

const RADIUS: Parameter = Parameter::required("radius", Type::Length, "Distance from the centre of the space.");

pub(super) const ALL: &[Primitive] = &[
    Primitive {
        name: "fibonacci_sphere",
        result: Type::Views,
        features: &[],
        parameters: &[RADIUS, Parameter::required("count", Type::Count, "Number of views.")],
        doc: "Views spread evenly over a sphere about the space, on a Fibonacci spiral, looking at its centre.",
    },
    Primitive {
        name: "fibonacci_hemisphere",
        result: Type::Views,
        features: &[],
        parameters: &[RADIUS, Parameter::required("count", Type::Count, "Number of views.")],
        doc: "Views spread evenly over the upper half of a sphere about the space, looking at its centre.",
    },
    Primitive {
        name: "circle",
        result: Type::Views,
        features: &[],
        parameters: &[
            RADIUS,
            Parameter::required("count", Type::Count, "Number of views."),
            Parameter::or(
                "elevation",
                Type::Angle,
                || Value::Angle(0.0),
                "Angle above the horizon as seen from the centre.",
            ),
        ],
        doc: "Views on a horizontal circle, looking at the centre of the space.",
    },
    Primitive {
        name: "box_grid",
        result: Type::Views,
        features: &[],
        parameters: &[
            Parameter::required(
                "size",
                Type::List(&Type::Length),
                "Extents of the box along x, y and z.",
            ),
            Parameter::required("step", Type::Length, "Largest distance between neighbours."),
        ],
        doc: "Views on a grid over the four sides and the top of a box about the space, looking at its centre.",
    },
    Primitive {
        name: "positions",
        result: Type::Views,
        features: &[],
        parameters: &[Parameter::required(
            "points",
            Type::List(&Type::Point),
            "Positions of the camera, world axes.",
        )],
        doc: "Views from listed positions, looking at the centre of the space.",
    },
];

/// The `world_from_camera` poses of a views primitive, in order.
///
/// # Errors
/// The call is not of a views primitive, lacks an argument, or has one out of range.
pub fn poses(views: &Call, space: &Space) -> Result<Vec<Pose>, BadArgument> {
    let centre = space.centre;
    let offsets = match views.primitive.as_str() {
        "fibonacci_sphere" => spiral(views.count("count")?, -1.0, views.length("radius")?),
        "fibonacci_hemisphere" => spiral(views.count("count")?, 0.0, views.length("radius")?),
        "circle" => ring(
            views.count("count")?,
            views.length("radius")?,
            views.angle("elevation")?,
        ),
        "box_grid" => grid_on_box(views.lengths("size")?, views.length("step")?)?,
        "positions" => return listed(views, centre),
        other => return Err(BadArgument::new(other, "a set of views")),
    };
    Ok(offsets.into_iter().map(|d| look_at(centre + d, centre)).collect())
}

/// Most views a task may have.
pub const MOST_VIEWS: u64 = 100_000;

/// Fibonacci spiral over the part of a sphere above `lowest` (−1: all, 0: upper half).
fn spiral(count: u64, lowest: f64, radius: f64) -> Vec<Vector> {
    let golden = std::f64::consts::PI * (3.0 - 5_f64.sqrt());
    let n = count.min(MOST_VIEWS);
    (0..n)
        .map(|k| {
            let z = 1.0 - (1.0 - lowest) * (k as f64 + 0.5) / n as f64;
            let r = (1.0 - z * z).max(0.0).sqrt();
            let turn = golden * k as f64;
            Vector::new(r * turn.cos(), r * turn.sin(), z) * radius
        })
        .collect()
}

fn ring(count: u64, radius: f64, elevation: f64) -> Vec<Vector> {
    let n = count.min(MOST_VIEWS);
    (0..n)
        .map(|k| {
            let turn = std::f64::consts::TAU * k as f64 / n as f64;
            Vector::new(
                turn.cos() * elevation.cos(),
                turn.sin() * elevation.cos(),
                elevation.sin(),
            ) * radius
        })
        .collect()
}

/// The sides in the order +x, +y, −x, −y, then the top; row by row from below.
fn grid_on_box(size: Vec<f64>, step: f64) -> Result<Vec<Vector>, BadArgument> {
    let &[sx, sy, sz] = size.as_slice() else {
        return Err(BadArgument::new("size", "three lengths"));
    };
    let cells = |extent: f64| (extent / step).ceil().clamp(1.0, 1_000.0) as usize;
    let middle = |extent: f64, n: usize, k: usize| extent * ((k as f64 + 0.5) / n as f64 - 0.5);
    let mut offsets = Vec::new();
    for (out, along, width, half) in [
        (Vector::x(), Vector::y(), sy, sx / 2.0),
        (Vector::y(), -Vector::x(), sx, sy / 2.0),
        (-Vector::x(), -Vector::y(), sy, sx / 2.0),
        (-Vector::y(), Vector::x(), sx, sy / 2.0),
    ] {
        let (columns, rows) = (cells(width), cells(sz));
        for row in 0..rows {
            for column in 0..columns {
                offsets.push(out * half + along * middle(width, columns, column) + Vector::z() * middle(sz, rows, row));
            }
        }
    }
    let (columns, rows) = (cells(sx), cells(sy));
    for row in 0..rows {
        for column in 0..columns {
            offsets.push(Vector::new(
                middle(sx, columns, column),
                middle(sy, rows, row),
                sz / 2.0,
            ));
        }
    }
    Ok(offsets)
}

fn listed(views: &Call, centre: Point) -> Result<Vec<Pose>, BadArgument> {
    let Some(Expr::List(points)) = views.arguments.get("points") else {
        return Err(BadArgument::new("points", "a list of points"));
    };
    points
        .iter()
        .map(|p| match p {
            Expr::Value(Value::Point(eye)) => Ok(look_at(*eye, centre)),
            _ => Err(BadArgument::new("points", "a list of points")),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spiral_is_even_and_on_its_sphere() {
        let views = spiral(64, -1.0, 1.4);
        let mean: Vector = views.iter().sum::<Vector>() / 64.0;
        assert!(mean.norm() < 0.02);
        assert!(views.iter().all(|v| (v.norm() - 1.4).abs() < 1e-12));
        let nearest = |k: usize| {
            (0..64)
                .filter(|&j| j != k)
                .map(|j| (views[j] - views[k]).norm())
                .fold(f64::INFINITY, f64::min)
        };
        assert!((0..64).all(|k| nearest(k) > 0.3));
        assert!(spiral(10, 0.0, 1.0).iter().all(|v| v.z > 0.0));
    }

    #[test]
    fn a_box_grid_covers_four_sides_and_the_top() {
        let offsets = grid_on_box(vec![2.0, 2.0, 1.0], 1.0).unwrap();
        assert_eq!(offsets.len(), 4 * 2 + 4);
        assert!(offsets.iter().all(|o| o.z > -0.5));
    }
}
