//! Calls, cameras and a reference ray caster for tests.

use std::path::Path;

use crate::geometry::{Camera, DepthRange, Intrinsics, Point, Vector};
use crate::primitives::{Default, find};
use crate::rules::{Backdrop, Call, Colour, Expr, Space, Value};
use crate::sense::{Mesh, SceneError};

/// A call with the registry's defaults filled in, as the compiler writes it.
pub(in crate::sense) fn call(primitive: &str, arguments: &[(&str, Expr)]) -> Call {
    let declared = find(primitive).unwrap().parameters.iter();
    let defaults = declared.filter_map(|p| match p.default {
        Default::Value(value) => Some((p.name.to_owned(), Expr::Value(value()))),
        _ => None,
    });
    let given = arguments
        .iter()
        .map(|(name, value)| ((*name).to_owned(), value.clone()));
    Call {
        primitive: primitive.to_owned(),
        arguments: defaults.chain(given).collect(),
    }
}

pub(in crate::sense) fn mm(x: f64) -> Expr {
    Expr::Value(Value::Length(x / 1e3))
}

pub(in crate::sense) fn deg(x: f64) -> Expr {
    Expr::Value(Value::Angle(x.to_radians()))
}

pub(in crate::sense) fn count(n: u64) -> Expr {
    Expr::Value(Value::Count(n))
}

pub(in crate::sense) fn share(x: f64) -> Expr {
    Expr::Value(Value::Share(x))
}

pub(in crate::sense) fn calls(list: &[Call]) -> Expr {
    Expr::List(list.iter().cloned().map(Expr::Call).collect())
}

pub(in crate::sense) fn build(shape: &Call) -> Result<Mesh, SceneError> {
    super::mesh(shape, Path::new(""))
}

/// A pocket of width, height and depth, mm.
pub(in crate::sense) fn pocket(kind: &str, side: u64, [w, h, d]: [f64; 3]) -> Call {
    call(
        kind,
        &[
            ("side", count(side)),
            ("width", mm(w)),
            ("height", mm(h)),
            ("depth", mm(d)),
        ],
    )
}

/// A four-sided prism with a dent, a bump and a notch.
pub(in crate::sense) fn deformed_prism() -> Call {
    let notch = call("notch", &[("side", count(2)), ("width", mm(40.0)), ("depth", mm(50.0))]);
    let deformed = calls(&[
        pocket("dent", 1, [60.0, 80.0, 40.0]),
        pocket("bump", 4, [50.0, 60.0, 30.0]),
        pocket("dent", 0, [40.0, 50.0, 20.0]),
        notch,
    ]);
    call(
        "prism",
        &[
            ("sides", count(4)),
            ("radius", mm(140.0)),
            ("height", mm(300.0)),
            ("deformed", deformed),
        ],
    )
}

pub(in crate::sense) fn camera(width: u32, height: u32) -> Camera {
    let image = Intrinsics::with_fields_of_view(width, height, 1.2, 1.0);
    Camera {
        depth: image,
        colour: image,
        range: DepthRange { min: 0.1, max: 10.0 },
    }
}

pub(in crate::sense) fn space(edge: f64) -> Space {
    Space {
        centre: Point::origin(),
        size: Vector::repeat(edge),
        voxel: 0.01,
    }
}

pub(in crate::sense) fn backdrop() -> Backdrop {
    Backdrop {
        radius: 2.0,
        colour: Colour([150, 150, 160]),
    }
}

/// Nearest hit of a ray with a mesh, every triangle tried (Möller and Trumbore).
pub(in crate::sense) fn cast(mesh: &Mesh, origin: &Point, ray: &Vector) -> Option<f64> {
    (0..mesh.triangles.len())
        .filter_map(|k| {
            let [a, b, c] = mesh.corners(k);
            let (ab, ac) = (b - a, c - a);
            let p = ray.cross(&ac);
            let scale = ab.dot(&p);
            let from_a = origin - a;
            let u = from_a.dot(&p) / scale;
            let q = from_a.cross(&ab);
            let v = ray.dot(&q) / scale;
            let t = ac.dot(&q) / scale;
            (u >= -1e-9 && v >= -1e-9 && u + v <= 1.0 + 1e-9 && t > 0.0).then_some(t)
        })
        .min_by(f64::total_cmp)
}
