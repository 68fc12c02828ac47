//! How far the shapes of scenes reach, from their arguments alone.

use std::f64::consts::{PI, TAU};

use crate::geometry::Point;
use crate::rules::Call;

/// Extreme points of a shape in its own frame: the shape reaches at least as far,
/// bumps and the top of a tapered and stretched prism somewhat farther. `None` where
/// the arguments do not say, as those of a mesh file.
pub fn extremes(shape: &Call) -> Option<Vec<Point>> {
    match shape.primitive.as_str() {
        "box" => cuboid(shape),
        "prism" => prism(shape),
        "pyramid" => pyramid(shape),
        "tank" => tank(shape),
        _ => None,
    }
}

fn cuboid(shape: &Call) -> Option<Vec<Point>> {
    let size = |name| Some(shape.length(name).ok()? / 2.0);
    let corner = Point::new(size("width")?, size("depth")?, size("height")?);
    Some(vec![corner, -corner])
}

fn prism(shape: &Call) -> Option<Vec<Point>> {
    let (height, lean, taper) = (
        shape.length("height").ok()?,
        shape.angle("lean").ok()?,
        shape.angle("taper").ok()?,
    );
    let mut points = base(shape, 1.0)?;
    let inradius = shape.length("radius").ok()? * (PI / shape.count("sides").ok()?.max(3) as f64).cos();
    let inset = height * taper.tan();
    // A base that is stretched does not keep its form when its sides move.
    let scale = match (shape.number("stretch").ok()?, inset) {
        (_, 0.0) => 1.0,
        (1.0, inset) if inset < inradius => 1.0 - inset / inradius,
        _ => 0.0,
    };
    let top = base(shape, scale)?.into_iter();
    points.extend(top.map(|p| Point::new(p.x + height * lean.tan(), p.y, -p.z)));
    Some(points)
}

fn pyramid(shape: &Call) -> Option<Vec<Point>> {
    let (height, lean) = (shape.length("height").ok()?, shape.angle("lean").ok()?);
    let mut points = base(shape, 1.0)?;
    points.push(Point::new(height * lean.tan(), 0.0, height / 2.0));
    Some(points)
}

/// The corners of the bottom, its circle scaled.
fn base(shape: &Call, scale: f64) -> Option<Vec<Point>> {
    let (n, radius) = (shape.count("sides").ok()?, shape.length("radius").ok()? * scale);
    let (stretch, height) = (shape.number("stretch").ok()?, shape.length("height").ok()?);
    let corner = |k: u64| {
        let turn = (k as f64 - 0.5) * TAU / n as f64;
        Point::new(radius * turn.cos() * stretch, radius * turn.sin(), -height / 2.0)
    };
    (3..=12).contains(&n).then(|| (0..n).map(corner).collect())
}

/// Tracks, hull, roof of the turret and muzzle.
fn tank(shape: &Call) -> Option<Vec<Point>> {
    let (length, width) = (shape.length("length").ok()?, shape.length("width").ok()?);
    let (turret, gun) = (shape.length("turret").ok()? / 2.0, shape.length("gun").ok()?);
    let (x, y) = (length / 0.90, width / 0.60);
    let mut points = Vec::new();
    for side in [-1.0, 1.0] {
        for end in [-1.0, 1.0] {
            points.push(Point::new(0.40 * x * end, 0.30 * y * side, 0.03 * y));
            points.push(Point::new(0.40 * x * end, 0.30 * y * side, 0.325 * y));
            points.push(Point::new(0.45 * x * end, 0.20 * y * side, 0.02 * y));
            points.push(Point::new(0.34 * x * end, 0.29 * y * side, 0.0));
        }
    }
    let roof = turret * (PI / 8.0).cos();
    let middle = 0.08 * x;
    points.extend([
        Point::new(middle, roof, 0.49 * y),
        Point::new(middle, -roof, 0.49 * y),
        Point::new(middle - roof, 0.0, 0.49 * y),
        Point::new(middle + roof + gun, 0.0, 0.415 * y),
    ]);
    Some(points)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::geometry::Bounds;
    use crate::lang::{Memory, compile};
    use crate::sense::shapes;

    fn shape(text: &str) -> Call {
        let text = format!("vpl 1\nscene s {{\n object o = {text} at [0 mm, 0 mm, 0 mm]\n}}\n");
        let rules = compile("main.vpl", &Memory::of("main.vpl", &text)).rules.unwrap();
        rules.scenes[0].objects[0].shape.clone()
    }

    /// How far the shape reaches beyond its extreme points, metres, along each way.
    fn beyond(text: &str) -> [f64; 6] {
        let call = shape(text);
        let built = shapes::mesh(&call, Path::new(".")).unwrap().bounds();
        let said = Bounds::around(&extremes(&call).unwrap()).unwrap();
        let (low, high) = (said.min - built.min, built.max - said.max);
        [low.x, low.y, low.z, high.x, high.y, high.z]
    }

    #[test]
    fn plain_shapes_reach_as_far_as_they_are_said_to() {
        for text in [
            "box(100 mm, 200 mm, 300 mm)",
            "prism(sides: 4, radius: 100 mm, height: 200 mm)",
            "prism(sides: 5, radius: 100 mm, height: 200 mm, lean: 12 deg)",
            "prism(sides: 3, radius: 100 mm, height: 200 mm, taper: -10 deg)",
            "prism(sides: 6, radius: 100 mm, height: 200 mm, taper: 10 deg, lean: 5 deg)",
            "prism(sides: 6, radius: 100 mm, height: 200 mm, stretch: 1.5)",
            "pyramid(sides: 4, radius: 100 mm, height: 200 mm, stretch: 0.5, lean: 30 deg)",
            "tank()",
        ] {
            assert!(
                beyond(text).iter().all(|d| d.abs() < 1e-6),
                "{text}: {:?}",
                beyond(text)
            );
        }
    }

    #[test]
    fn no_shape_is_said_to_reach_farther_than_it_does() {
        for text in [
            "prism(sides: 4, radius: 100 mm, height: 200 mm, stretch: 2, taper: -10 deg)",
            "prism(sides: 4, radius: 100 mm, height: 200 mm, deformed: [bump(side: 1, width: 50 mm, height: 50 mm, depth: 30 mm)])",
            "pyramid(sides: 6, radius: 190 mm, height: 240 mm, deformed: [notch(side: 1, width: 60 mm, depth: 75 mm)])",
            "tank(length: 500 mm, width: 700 mm, gun: 50 mm, turret: 600 mm)",
        ] {
            assert!(beyond(text).iter().all(|d| *d > -1e-6), "{text}: {:?}", beyond(text));
        }
    }

    #[test]
    fn a_mesh_file_is_not_read() {
        assert_eq!(extremes(&shape("mesh(file: \"part.stl\", units: mm, up: z)")), None);
    }
}
