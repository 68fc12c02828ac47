//! Scenes of the built-in simulator that the detectors are held to.

use std::path::Path;

use crate::geometry::{Camera, DepthRange, Intrinsics, Point, Polygon, Pose, Vector, frame_facing};
use crate::primitives::{Arguments, Datum, poses};
use crate::rules::{Backdrop, Call, Colour, Expr, Marker, Place, SceneObject, Space, Value};
use crate::sense::{Noise, Observation, Simulator};

use super::*;

fn kinect() -> Camera {
    let fov = |w, h, x: f64, y: f64| Intrinsics::with_fields_of_view(w, h, x.to_radians(), y.to_radians());
    Camera {
        depth: fov(512, 424, 70.6, 60.0),
        colour: fov(1920, 1080, 84.1, 53.8),
        range: DepthRange { min: 0.5, max: 4.5 },
    }
}

fn call(primitive: &str, arguments: &[(&str, Value)]) -> Call {
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

fn arguments(pairs: &[(&str, Datum)]) -> Arguments {
    Arguments(pairs.iter().map(|(n, d)| ((*n).to_owned(), d.clone())).collect())
}

fn constant(value: Value) -> Datum {
    Datum::Constant(value)
}

fn cube(edge: f64, voxel: f64) -> Space {
    Space {
        centre: Point::origin(),
        size: Vector::repeat(edge),
        voxel,
    }
}

fn simulator(shape: Call, place: Pose, markers: Vec<Marker>, space: &Space) -> Simulator {
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

fn sphere(space: &Space, radius: f64, count: u64) -> Vec<Pose> {
    poses(
        &call(
            "fibonacci_sphere",
            &[("radius", Value::Length(radius)), ("count", Value::Count(count))],
        ),
        space,
    )
    .unwrap()
}

const SIZE: f64 = 0.2;

/// Markers on the flat places of a tank, object frame.
fn tank_markers() -> Vec<Marker> {
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
fn visible_share(observation: &Observation, world_from_marker: &Pose, half: f64) -> f64 {
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

fn polygon_of(measurement: &Measurement) -> &Polygon {
    match measurement {
        Measurement::Face(p) => p,
        _ => panic!("not a face"),
    }
}

fn tank(space: &Space, turn: f64) -> (Simulator, Vec<(Marker, Pose)>) {
    let place = Pose::new(Vector::new(0.01, -0.01, -0.25), Vector::z() * turn);
    let markers = tank_markers();
    let placed = markers
        .iter()
        .map(|m| (m.clone(), place * m.object_from_marker))
        .collect();
    (simulator(call("tank", &[]), place, markers, space), placed)
}

/// Whether the planner would count a look at a marker as inside the detector's envelope.
fn inside_envelope(o: &Observation, world_from_marker: &Pose) -> bool {
    let detector = call(
        "qr",
        &[("text", Value::Text("f1".into())), ("size", Value::Length(SIZE))],
    );
    let envelope = crate::primitives::envelope(&detector).unwrap();
    let centre = Point::from(world_from_marker.translation.vector);
    let incidence = (world_from_marker * Vector::z()).angle(&(o.eye() - centre));
    let depth = o.world_from_camera.inverse_transform_point(&centre).z;
    incidence <= envelope.max_incidence && o.camera.colour.fx / depth >= envelope.min_pixels_per_metre
}

/// Recall of the `qr` detector over a few of the views that its envelope was
/// measured on: whatever is inside and unhidden is read, once, and in place.
#[test]
fn every_unhidden_marker_inside_the_envelope_is_read() {
    let space = cube(1.2, 0.02);
    let (sim, markers) = tank(&space, 0.37);
    let mut looks = 0;
    for (n, pose) in sphere(&space, 1.65, 24).iter().enumerate().skip(1).step_by(3) {
        let clean = sim.observe(&kinect(), pose, Noise::None, 1, n as u32);
        let mut noisy = clean.clone();
        noisy.depth = sim.depth(&kinect(), pose, Noise::StructuredLight, 1, n as u32);
        for (observation, most) in [(&clean, 0.003), (&noisy, 0.01)] {
            let scan = Scan::new(observation, &space);
            for (marker, truth) in &markers {
                if !inside_envelope(&clean, truth) || visible_share(&clean, truth, SIZE / 2.0) < 1.0 {
                    continue;
                }
                looks += 1;
                let text = constant(Value::Text(marker.text.clone()));
                let asked = arguments(&[("text", text), ("size", constant(Value::Length(SIZE)))]);
                let found = detect("qr", &asked, &scan).unwrap().0;
                assert_eq!(found.len(), 1, "`{}` in view {n}", marker.text);
                let measured = measure("marker_pose", &Arguments::default(), &found[0]).unwrap();
                let Some(Measurement::Marker { pose, .. }) = measured else {
                    panic!("no pose")
                };
                assert!((pose.translation.vector - truth.translation.vector).norm() < most);
                assert!(pose.rotation.angle_to(&truth.rotation) < 0.05);
            }
        }
    }
    assert!(looks >= 20, "{looks} looks");
}

#[test]
fn a_code_of_another_text_or_size_is_not_this_one() {
    let space = cube(1.2, 0.02);
    let (sim, _) = tank(&space, 0.0);
    let from_above = crate::geometry::look_at(Point::new(0.3, 0.0, 1.55), Point::origin());
    let scan = Scan::new(&sim.observe(&kinect(), &from_above, Noise::None, 1, 0), &space);
    let count = |text: &str, size: f64| qr::qr(&scan, text, size).0.len();
    assert_eq!(
        (
            count("f7", SIZE),
            count("f7", 0.3),
            count("f70", SIZE),
            count("f2", SIZE)
        ),
        (1, 0, 0, 0)
    );
}

/// A square prism with a dent, a groove and a bump, and its bottom.
fn deformed(space: &Space) -> (Simulator, Polygon) {
    let l = Value::Length;
    let part = |name: &str, side: u64, sizes: &[(&str, f64)]| {
        let mut given = vec![("side", Value::Count(side))];
        given.extend(sizes.iter().map(|(n, x)| (*n, l(*x))));
        Expr::Call(call(name, &given))
    };
    let mut shape = call(
        "prism",
        &[("sides", Value::Count(4)), ("radius", l(0.18)), ("height", l(0.3))],
    );
    let parts = vec![
        part("dent", 1, &[("width", 0.1), ("height", 0.1), ("depth", 0.025)]),
        part("notch", 2, &[("width", 0.04), ("depth", 0.05)]),
        part("bump", 3, &[("width", 0.08), ("height", 0.1), ("depth", 0.03)]),
    ];
    shape.arguments.insert("deformed".into(), Expr::List(parts));
    let place = Pose::new(Vector::new(0.01, -0.015, 0.008), Vector::z() * 0.57);
    let half = 0.18 * std::f64::consts::FRAC_1_SQRT_2;
    let corners = [(-1., -1.), (-1., 1.), (1., 1.), (1., -1.)];
    let bottom = corners.map(|(x, y)| place * Point::new(x * half, y * half, -0.15));
    (
        simulator(shape, place, vec![], space),
        Polygon::new(bottom.to_vec()).unwrap(),
    )
}

/// Recall by part of `plane_beside`, and that a dent, a groove or a bump
/// leaves a face one face of four corners, but for one look in the lot.
#[test]
fn a_deformed_side_is_one_rectangle_on_its_edge() {
    let space = cube(0.6, 0.01);
    let (sim, bottom) = deformed(&space);
    let (mut looks, mut ragged) = (0, 0);
    for (n, pose) in sphere(&space, 1.4, 16).iter().enumerate() {
        let scan = Scan::new(&sim.observe(&kinect(), pose, Noise::None, 1, n as u32), &space);
        for edge in bottom.edges() {
            let middle = edge.midpoint() + Vector::z() * 0.15;
            let incidence = (-edge.inward()).angle(&(scan.cloud.eye() - middle));
            let angles =
                [("dihedral", 90_f64), ("within", 10.0)].map(|(n, a)| (n, constant(Value::Angle(a.to_radians()))));
            let mut asked = arguments(&angles);
            asked.0.insert("edge".into(), Datum::Edge(edge));
            let found = detect("plane_beside", &asked, &scan).unwrap().0;
            if incidence > 100_f64.to_radians() {
                assert!(found.is_empty(), "view {n} sees a side from behind");
            }
            if incidence > 65_f64.to_radians() {
                continue;
            }
            looks += 1;
            let measured = measure("outline", &arguments(&[("first", Datum::Edge(edge))]), &found[0])
                .unwrap()
                .unwrap();
            let face = polygon_of(&measured);
            // Where an edge runs along a row of pixels, an outline now and then gains a corner.
            if face.vertices().len() != 4 {
                ragged += 1;
                continue;
            }
            let base = face.edge(0);
            assert!((base.length() - edge.length()).abs() < 0.015 && edge.distance(&base.midpoint()) < 0.012);
            assert!((face.edge(1).length() - 0.3).abs() < 0.015);
        }
    }
    assert!(looks >= 16 && ragged <= 1, "{ragged} of {looks} looks");
}

/// Recall of `planar_region`, with noise: every side of a hexagonal prism is
/// found alone though all have one colour.
#[test]
fn neighbouring_sides_of_one_colour_are_told_apart() {
    let space = cube(0.6, 0.01);
    let sizes = [
        ("radius", Value::Length(0.15)),
        ("height", Value::Length(0.3)),
        ("sides", Value::Count(6)),
    ];
    let sim = simulator(call("prism", &sizes), Pose::identity(), vec![], &space);
    let asked = arguments(&[
        ("colour", constant(Value::Colour(Colour([30, 160, 50])))),
        ("smallest", constant(Value::Length(0.04))),
    ]);
    let view = crate::geometry::look_at(Point::new(1.35, 0.1, 0.4), Point::origin());
    for noise in [Noise::None, Noise::StructuredLight] {
        let scan = Scan::new(&sim.observe(&kinect(), &view, noise, 3, 0), &space);
        let found = detect("planar_region", &asked, &scan).unwrap().0;
        let faces: Vec<Measurement> = found
            .iter()
            .filter_map(|e| measure("outline", &Arguments::default(), e).unwrap())
            .collect();
        assert_eq!(faces.len(), 3);
        for face in &faces {
            let face = polygon_of(face);
            assert!(face.normal().z.abs() < 0.05 && (face.area() - 0.045).abs() < 0.005);
        }
        let turn = polygon_of(&faces[0]).normal().angle(&polygon_of(&faces[1]).normal());
        assert!((turn.to_degrees() - 60.0).abs() < 3.0);
    }
}

/// Views of one face merge into its whole outline, and stay bounded.
#[test]
fn views_of_one_face_merge() {
    let space = cube(0.6, 0.01);
    let sizes = [
        ("radius", Value::Length(0.14)),
        ("height", Value::Length(0.25)),
        ("sides", Value::Count(4)),
    ];
    let sim = simulator(call("prism", &sizes), Pose::identity(), vec![], &space);
    let red = constant(Value::Colour(Colour([200, 30, 30])));
    let asked = arguments(&[("colour", red), ("smallest", constant(Value::Length(0.04)))]);
    let mut merged: Option<Evidence> = None;
    for n in 0..10 {
        let turn = f64::from(n) * 0.7;
        let eye = Point::new(0.9 * turn.cos(), 0.9 * turn.sin(), -1.1);
        let view = crate::geometry::look_at(eye, Point::origin());
        let scan = Scan::new(&sim.observe(&kinect(), &view, Noise::StructuredLight, 5, n), &space);
        let found = detect("planar_region", &asked, &scan).unwrap().0.remove(0);
        match &mut merged {
            Some(evidence) => evidence.merge(found),
            None => merged = Some(found),
        }
    }
    let merged = merged.unwrap();
    let Evidence::Face(face) = &merged else {
        panic!("not a face")
    };
    assert!(face.points.len() < 10_000);
    let bottom = measure("outline", &Arguments::default(), &merged).unwrap().unwrap();
    let bottom = polygon_of(&bottom);
    assert_eq!(bottom.vertices().len(), 4);
    assert!((bottom.normal() + Vector::z()).norm() < 0.02);
    let side = 0.14 * std::f64::consts::SQRT_2;
    assert!(bottom.edges().iter().all(|e| (e.length() - side).abs() < 0.02));
}

/// A test holds every declared detector and measure to its function.
#[test]
fn every_declared_detector_and_measure_is_there() {
    use crate::primitives::Type;
    let space = cube(0.6, 0.02);
    let sim = simulator(
        call(
            "prism",
            &[
                ("sides", Value::Count(4)),
                ("radius", Value::Length(0.1)),
                ("height", Value::Length(0.2)),
            ],
        ),
        Pose::identity(),
        vec![],
        &space,
    );
    let view = crate::geometry::look_at(Point::new(1.4, 0.0, 0.0), Point::origin());
    let scan = Scan::new(&sim.observe(&kinect(), &view, Noise::None, 1, 0), &space);
    let unknown = detect("no_such", &Arguments::default(), &scan).unwrap_err().to_string();
    assert!(unknown.contains("is not a detector"));
    for p in crate::primitives::all().filter(|p| p.result == Type::Detector && p.name != "mostly_seen") {
        let said = detect(p.name, &Arguments::default(), &scan).map_err(|e| e.to_string());
        assert!(!said.is_err_and(|e| e.contains("a detector")), "`{}`", p.name);
    }
    let marker = Evidence::Marker(MarkerEvidence {
        looks: vec![],
        size: SIZE,
    });
    for p in crate::primitives::all().filter(|p| p.result == Type::Measure) {
        assert_eq!(
            measure(p.name, &Arguments::default(), &marker),
            Ok(None),
            "`{}`",
            p.name
        );
    }
}
