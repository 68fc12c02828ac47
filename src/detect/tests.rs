//! Scenes of the built-in simulator that the detectors are held to.

use std::path::Path;

use crate::geometry::{Camera, DepthRange, Intrinsics, Point, Polygon, Pose, Vector, frame_facing};
use crate::primitives::{Arguments, Datum, poses};
use crate::rules::{Backdrop, Call, Colour, Expr, Marker, Place, SceneObject, Space, Value};
use crate::sense::{Noise, Observation, Simulator};

use super::*;

#[cfg(any())]
mod explore;

pub fn kinect() -> Camera {
    let fov = |w, h, x: f64, y: f64| Intrinsics::with_fields_of_view(w, h, x.to_radians(), y.to_radians());
    Camera {
        depth: fov(512, 424, 70.6, 60.0),
        colour: fov(1920, 1080, 84.1, 53.8),
        range: DepthRange { min: 0.5, max: 4.5 },
    }
}

pub fn call(primitive: &str, arguments: &[(&str, Value)]) -> Call {
    let mut arguments: std::collections::BTreeMap<String, Expr> = arguments
        .iter()
        .map(|(n, v)| ((*n).to_owned(), Expr::Value(v.clone())))
        .collect();
    for p in crate::primitives::find(primitive).unwrap().parameters {
        if let crate::primitives::Default::Value(value) = p.default {
            arguments
                .entry(p.name.to_owned())
                .or_insert_with(|| Expr::Value(value()));
        }
    }
    Call {
        primitive: primitive.to_owned(),
        arguments,
    }
}

pub fn arguments(pairs: &[(&str, Datum)]) -> Arguments {
    Arguments(pairs.iter().map(|(n, d)| ((*n).to_owned(), d.clone())).collect())
}

pub fn constant(value: Value) -> Datum {
    Datum::Constant(value)
}

pub fn cube(edge: f64, voxel: f64) -> Space {
    Space {
        centre: Point::origin(),
        size: Vector::repeat(edge),
        voxel,
    }
}

pub fn simulator(shape: Call, place: Pose, markers: Vec<Marker>, space: &Space) -> Simulator {
    let object = SceneObject {
        name: "o".into(),
        shape,
        world_from_object: place,
        markers,
        place: Place::default(),
    };
    let backdrop = Backdrop {
        radius: 2.0,
        colour: Colour([128, 128, 128]),
    };
    Simulator::new(&object, Some(backdrop), space, Path::new(".")).unwrap()
}

pub fn sphere(space: &Space, radius: f64, count: u64) -> Vec<Pose> {
    poses(
        &call(
            "sphere",
            &[("radius", Value::Length(radius)), ("count", Value::Count(count))],
        ),
        space,
    )
    .unwrap()
}

pub const SIZE: f64 = 0.2;

/// Markers on the flat places of a tank, object frame.
pub fn tank_markers() -> Vec<Marker> {
    let at = |k: usize, x: f64, y: f64, z: f64, facing: Vector| Marker {
        text: format!("f{k}"),
        size: SIZE,
        object_from_marker: frame_facing(Point::new(x, y, z), facing),
    };
    vec![
        at(1, 0.455, 0.0, 0.165, Vector::x()),
        at(2, -0.455, 0.0, 0.165, -Vector::x()),
        at(3, 0.2, 0.305, 0.178, Vector::y()),
        at(4, -0.2, 0.305, 0.178, Vector::y()),
        at(5, 0.0, -0.305, 0.178, -Vector::y()),
        at(6, -0.3, 0.0, 0.345, Vector::z()),
        at(7, 0.08, 0.0, 0.495, Vector::z()),
    ]
}

/// Share of a square about a marker that nothing hides, by noise-free depth.
pub fn visible_share(observation: &Observation, world_from_marker: &Pose, half: f64) -> f64 {
    let k = &observation.camera.depth;
    let mut seen = 0;
    let n = 12;
    for i in 0..=n {
        for j in 0..=n {
            let at = |t: i32| (f64::from(t) / f64::from(n) * 2.0 - 1.0) * half;
            let p = world_from_marker * Point::new(at(i), at(j), 0.0);
            let c = observation.world_from_camera.inverse_transform_point(&p);
            let Some((u, v)) = k.project(&c) else { continue };
            let Some(z) = observation.depth.at(u as u32, v as u32) else {
                continue;
            };
            seen += i32::from((z - c.z).abs() < 0.03);
        }
    }
    f64::from(seen) / f64::from((n + 1) * (n + 1))
}

pub fn polygon_of(measurement: &Measurement) -> &Polygon {
    match measurement {
        Measurement::Face(p) => p,
        _ => panic!("not a face"),
    }
}
