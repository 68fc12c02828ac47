use proptest::prelude::*;

use super::testing::*;
use super::*;
use crate::geometry::{Point, Pose, Vector, frame_facing};
use crate::rules::{Colour, Expr, Marker, Value};

fn volume(mesh: &Mesh) -> f64 {
    (0..mesh.triangles.len())
        .map(|k| {
            let [a, b, c] = mesh.corners(k).map(|p| p.coords);
            a.dot(&b.cross(&c)) / 6.0
        })
        .sum()
}

/// Volume between a rim and a floor inset by the walls' run (prismatoid).
fn pocket_volume([w, h, d]: [f64; 3]) -> f64 {
    let area = |inset: f64| (w - 2.0 * inset) * (h - 2.0 * inset);
    d / 6.0 * (area(0.0) + 4.0 * area(0.07 * d) + area(0.14 * d)) * 1e-9
}

#[test]
fn a_deformed_prism_is_closed_and_has_the_volume_of_its_parts() {
    let mesh = build(&deformed_prism()).unwrap();
    assert_eq!(mesh.open_edges(), 0);
    let edge = 0.14 * 2_f64.sqrt();
    let expected = edge * edge * 0.3 - 0.04 * 0.05 * 0.3 - pocket_volume([60.0, 80.0, 40.0])
        + pocket_volume([50.0, 60.0, 30.0])
        - pocket_volume([40.0, 50.0, 20.0]);
    assert!((volume(&mesh) - expected).abs() < 1e-9, "{} {expected}", volume(&mesh));
}

#[test]
fn side_one_of_a_prism_faces_x_and_the_colours_tell_the_faces() {
    let prism = call(
        "prism",
        &[("sides", count(4)), ("radius", mm(100.0)), ("height", mm(200.0))],
    );
    let mesh = build(&prism).unwrap();
    let colour = |towards: Vector| {
        let k = (0..mesh.triangles.len())
            .find(|&k| mesh.vector_area(k).normalize().dot(&towards) > 0.999)
            .unwrap();
        mesh.paints[k].clone()
    };
    assert_eq!(colour(-Vector::z()), mesh::Paint::Flat([200, 30, 30]));
    assert_eq!(colour(Vector::z()), mesh::Paint::Flat([200, 200, 200]));
    assert_eq!(colour(Vector::x()), mesh::Paint::Flat([30, 160, 50]));
    assert!((mesh.bounds().max - Point::new(0.0707107, 0.0707107, 0.1)).norm() < 1e-6);
}

#[test]
fn a_box_is_closed_and_each_face_has_its_colour() {
    let colour = |c: [u8; 3]| Expr::Value(Value::Colour(Colour(c)));
    let sizes = [("width", mm(100.0)), ("depth", mm(200.0)), ("height", mm(300.0))];
    let painted = [
        ("colour", colour([9, 9, 9])),
        ("right", colour([0, 0, 200])),
        ("top", colour([200, 0, 0])),
    ];
    let mesh = build(&call("box", &[&sizes[..], &painted[..]].concat())).unwrap();
    assert_eq!(mesh.open_edges(), 0);
    assert!((volume(&mesh) - 0.1 * 0.2 * 0.3).abs() < 1e-12);
    for k in 0..mesh.triangles.len() {
        let normal = mesh.vector_area(k).normalize();
        let expected = match normal {
            n if n.y < -0.5 => [0, 0, 200],
            n if n.z > 0.5 => [200, 0, 0],
            _ => [9, 9, 9],
        };
        assert_eq!(mesh.paints[k], mesh::Paint::Flat(expected), "{normal}");
    }
    assert!((mesh.bounds().max - Point::new(0.05, 0.1, 0.15)).norm() < 1e-12);
}

#[test]
fn taper_and_lean_set_the_dihedral_angles_at_the_bottom() {
    for (taper, lean, expected) in [
        (-14.0, 0.0, [104.0; 4]),
        (0.0, 13.0, [103.0, 90.0, 77.0, 90.0]),
        (5.0, 0.0, [85.0; 4]),
    ] {
        let prism = call(
            "prism",
            &[
                ("sides", count(4)),
                ("radius", mm(140.0)),
                ("height", mm(250.0)),
                ("taper", deg(taper)),
                ("lean", deg(lean)),
            ],
        );
        let mesh = build(&prism).unwrap();
        for (side, angle) in expected.iter().enumerate() {
            let turn = std::f64::consts::FRAC_PI_2 * side as f64;
            let towards = Vector::new(turn.cos(), turn.sin(), 0.0);
            let normal = (0..mesh.triangles.len())
                .map(|k| mesh.vector_area(k).normalize())
                .max_by(|a, b| a.dot(&towards).total_cmp(&b.dot(&towards)))
                .unwrap();
            let dihedral = 180.0 - normal.angle(&-Vector::z()).to_degrees();
            assert!((dihedral - angle).abs() < 1e-6, "{dihedral} {angle}");
        }
    }
}

#[test]
fn a_pyramid_is_closed_with_its_notch_up_to_the_apex() {
    let notch = call("notch", &[("side", count(2)), ("width", mm(40.0)), ("depth", mm(50.0))]);
    let pyramid = call(
        "pyramid",
        &[
            ("sides", count(4)),
            ("radius", mm(200.0)),
            ("height", mm(240.0)),
            ("lean", deg(5.0)),
            ("deformed", calls(&[notch])),
        ],
    );
    let mesh = build(&pyramid).unwrap();
    assert_eq!(mesh.open_edges(), 0);
    let base = 0.2 * 0.2 * 2.0 - 0.04 * 0.05;
    assert!((volume(&mesh) - base * 0.24 / 3.0).abs() < 1e-12);
}

#[test]
fn what_cannot_be_built_is_refused_in_the_authors_units() {
    let with = |changes: &[(&str, Expr)]| {
        let mut prism = deformed_prism();
        for (name, value) in changes {
            prism.arguments.insert((*name).to_owned(), value.clone());
        }
        build(&prism).unwrap_err().to_string()
    };
    assert_eq!(
        with(&[("radius", mm(0.0))]),
        "`radius` of `prism` is 0 mm; expected 5 mm to 10000 mm"
    );
    assert!(with(&[("sides", count(2))]).contains("is 2; expected 3 to 12"));
    assert!(with(&[("height", Expr::Value(Value::Length(f64::NAN)))]).contains("NaN mm"));
    assert!(with(&[("taper", deg(40.0))]).contains("leaves a top"));
    let dent = |call| with(&[("deformed", calls(&[call]))]);
    assert!(dent(pocket("dent", 5, [20.0, 20.0, 9.0])).contains("`side` of `dent` is 5; expected 0 to 4"));
    assert!(dent(pocket("dent", 1, [250.0, 20.0, 9.0])).contains("does not fit a flat part of side 1"));
    assert!(dent(pocket("dent", 1, [90.0, 90.0, 210.0])).contains("run into each other or through a side"));
    let two = calls(&[
        pocket("dent", 1, [60.0, 60.0, 20.0]),
        pocket("bump", 1, [80.0, 40.0, 20.0]),
    ]);
    assert!(with(&[("deformed", two)]).contains("meet on one face"));
    let mut unknown = deformed_prism();
    unknown.primitive = "sphere".into();
    assert_eq!(build(&unknown).unwrap_err().code(), "unknown_shape");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn whatever_is_built_is_closed_and_turned_outwards(
        sides in 3_u64..9, radius in 60.0..250.0_f64, height in 100.0..400.0_f64,
        lean in -20.0..20.0_f64, stretch in 0.5..2.0_f64, pyramid: bool,
        dents in proptest::collection::vec(
            (0_u64..9, 0.1..0.9_f64, 0.1..0.9_f64, 10.0..80.0_f64, 10.0..80.0_f64, 3.0..60.0_f64, any::<bool>()), 0..5),
        notch in (1_u64..9, 0.2..0.8_f64, 10.0..60.0_f64, 5.0..60.0_f64),
    ) {
        let mut deformed: Vec<Call> = dents.iter().map(|&(side, across, up, w, h, d, out)| {
            let mut one = pocket(if out { "bump" } else { "dent" }, side.min(sides), [w, h, d]);
            one.arguments.insert("across".into(), share(across));
            one.arguments.insert("up".into(), share(up));
            one
        }).collect();
        deformed.push(call("notch", &[
            ("side", count(notch.0.min(sides))), ("at", share(notch.1)), ("width", mm(notch.2)), ("depth", mm(notch.3)),
        ]));
        let shape = call(if pyramid { "pyramid" } else { "prism" }, &[
            ("sides", count(sides)), ("radius", mm(radius)), ("height", mm(height)), ("lean", deg(lean)),
            ("stretch", Expr::Value(Value::Number(stretch))), ("deformed", calls(&deformed)),
        ]);
        match build(&shape) {
            Err(error) => prop_assert_eq!(error.code(), "out_of_range"),
            Ok(mesh) => {
                prop_assert_eq!(mesh.open_edges(), 0);
                prop_assert!(volume(&mesh) > 0.0);
                prop_assert!((mesh.winding_number(&Point::new(9.0, 9.0, 9.0))).abs() < 1e-9);
            }
        }
    }
}

/// The seven places of the default tank, mm, and where they face.
const PLACES: [([f64; 3], [f64; 3]); 7] = [
    ([455.0, 0.0, 163.0], [1.0, 0.0, 0.0]),
    ([-455.0, 0.0, 165.0], [-1.0, 0.0, 0.0]),
    ([220.0, 305.0, 178.0], [0.0, 1.0, 0.0]),
    ([-220.0, -305.0, 178.0], [0.0, -1.0, 0.0]),
    ([-300.0, 0.0, 345.0], [0.0, 0.0, 1.0]),
    ([80.0, 0.0, 495.0], [0.0, 0.0, 1.0]),
    ([-220.0, 305.0, 178.0], [0.0, 1.0, 0.0]),
];

fn place(k: usize) -> Pose {
    let (at, facing) = PLACES[k];
    frame_facing(Point::from(at) / 1e3, Vector::from(facing))
}

#[test]
fn the_tank_holds_seven_plates_flat_and_in_the_open() {
    let tank = build(&call("tank", &[])).unwrap();
    assert_eq!(tank.open_edges(), 0);
    assert!(tank.bounds().size().x < 1.1 && tank.bounds().min.z.abs() < 1e-12);
    for k in 0..PLACES.len() {
        for (x, y) in [(0.0, 0.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)] {
            let at = place(k) * Point::new(0.138 * x, 0.138 * y, 0.0);
            let out = place(k) * Vector::z();
            assert_eq!(cast(&tank, &at, &out), None, "place {} is covered", k + 1);
            let gap = cast(&tank, &at, &-out).unwrap();
            assert!((gap - 0.005).abs() < 1e-9, "place {} lies {gap} m off", k + 1);
        }
    }
}

#[test]
fn a_plate_has_the_size_of_its_code_and_quiet_zone() {
    let marker = Marker {
        text: "f1".into(),
        size: 0.21,
        object_from_marker: Pose::translation(0.0, 0.0, 1.0),
    };
    let mesh = plate(&marker).unwrap();
    assert_eq!(mesh.open_edges(), 0);
    let bounds = mesh.bounds();
    assert!((bounds.size() - Vector::new(0.29, 0.29, 0.004)).norm() < 1e-12);
    assert!((bounds.max.z - 1.0).abs() < 1e-12);
    let image = &mesh.textures[0];
    assert_eq!((image.width, image.height), (29, 29));
    // Finder patterns stand at top left, top right and bottom left.
    let dark = |x: usize, y: usize| image.pixels[y * 29 + x][0] < 100;
    assert!(dark(4, 4) && dark(24, 4) && dark(4, 24) && !dark(3, 3));
    let corner = [24, 24];
    assert!(!(0..7).all(|k| dark(corner[0] - k, corner[1])));
    let long = Marker {
        text: "x".repeat(4000),
        ..marker
    };
    assert_eq!(plate(&long).unwrap_err().code(), "bad_marker");
}
