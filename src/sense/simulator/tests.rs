use super::*;
use crate::geometry::{DepthRange, Intrinsics, Vector, frame_facing, look_at};
use crate::rules::{Marker, Place};
use crate::sense::shapes::testing::*;

fn scene(object: SceneObject) -> Simulator {
    Simulator::new(&object, Some(backdrop()), &space(1.2), Path::new("")).unwrap()
}

fn object(shape: crate::rules::Call, markers: Vec<Marker>) -> SceneObject {
    SceneObject {
        name: "thing".into(),
        shape,
        world_from_object: Pose::identity(),
        markers,
        place: Place::default(),
    }
}

#[test]
fn markers_of_the_tank_decode_from_the_picture() {
    let places = [
        ([0.455, 0.0, 0.163], Vector::x()),
        ([-0.22, 0.305, 0.178], Vector::y()),
        ([0.08, 0.0, 0.495], Vector::z()),
    ];
    let markers = places.iter().enumerate().map(|(k, &(at, facing))| Marker {
        text: format!("f{}", k + 1),
        size: 0.2,
        object_from_marker: frame_facing(Point::from(at), facing),
    });
    let scene = scene(object(call("tank", &[]), markers.collect()));
    let mut camera = camera(64, 48);
    camera.colour = Intrinsics::with_fields_of_view(640, 480, 0.9, 0.7);
    for (k, (at, facing)) in places.into_iter().enumerate() {
        let at = Point::from(at);
        let eye = at + facing * 0.9 + Vector::new(0.15, 0.2, 0.1);
        let seen = scene.observe(&camera, &look_at(eye, at), Noise::None, 0, 0).colour;
        let mut image = rqrr::PreparedImage::prepare_from_greyscale(640, 480, |x, y| seen.at(x as u32, y as u32)[1]);
        let texts: Vec<String> = image
            .detect_grids()
            .iter()
            .filter_map(|g| Some(g.decode().ok()?.1))
            .collect();
        assert!(texts.contains(&format!("f{}", k + 1)), "{texts:?} at place {k}");
    }
}

#[test]
fn bytes_do_not_depend_on_the_number_of_threads() {
    let scene = scene(object(deformed_prism(), Vec::new()));
    let view = look_at(Point::new(0.8, 0.7, 0.5), Point::origin());
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| scene.observe(&camera(160, 120), &view, Noise::StructuredLight, 7, 3))
    };
    let (one, three) = (with(1), with(3));
    assert_eq!(one.colour, three.colour);
    assert_eq!(one.depth, three.depth);
}

#[test]
fn every_pixel_reads_the_object_or_the_backdrop_within_range() {
    let scene = scene(object(deformed_prism(), Vec::new()));
    let view = look_at(Point::new(1.0, 0.0, 0.0), Point::origin());
    let mut camera = camera(64, 48);
    let seen = scene.observe(&camera, &view, Noise::None, 0, 0);
    assert!(seen.depth.metres.iter().all(|&z| z > 0.0));
    let corner = seen.point(0, 0).unwrap();
    assert!((corner.coords.norm() - 2.0).abs() < 1e-5);
    camera.range = DepthRange { min: 0.5, max: 1.5 };
    let near = scene.observe(&camera, &view, Noise::None, 0, 0);
    assert_eq!(near.depth.at(0, 0), None);
    assert!(near.depth.at(32, 24).is_some());
}

#[test]
fn colours_stay_true_to_their_paint() {
    let scene = scene(object(deformed_prism(), Vec::new()));
    let below = look_at(Point::new(0.2, 0.1, -1.0), Point::origin());
    let seen = scene.observe(&camera(65, 65), &below, Noise::None, 0, 0).colour;
    let [r, g, b] = seen.at(36, 36);
    assert!(r > 150 && g < 40 && b < 40, "{r} {g} {b}");
    assert_eq!(seen.at(0, 0), [150, 150, 160]);
}

#[test]
fn inside_is_told_even_where_parts_overlap() {
    let scene = scene(object(call("tank", &[]), Vec::new()));
    for (p, inside) in [
        ([0.0, 0.0, 0.2], true),
        ([0.08, 0.0, 0.4], true),
        ([0.5, 0.0, 0.415], true),
        ([0.5, 0.0, 0.3], false),
        ([0.0, 0.0, 0.6], false),
        ([0.0, 0.0, -0.01], false),
    ] {
        assert_eq!(scene.contains(&Point::from(p)), inside, "{p:?}");
    }
}

#[test]
fn a_print_must_stand_out_of_the_surface_and_face_away() {
    let cube = || {
        call(
            "prism",
            &[("sides", count(4)), ("radius", mm(200.0)), ("height", mm(200.0))],
        )
    };
    // The top is at z = 100 mm.
    for (height, out, shown) in [
        (101.0, 1.0, true),
        (100.0, 1.0, false),
        (90.0, 1.0, false),
        (101.0, -1.0, false),
    ] {
        let marker = Marker {
            text: "top".into(),
            size: 0.1,
            object_from_marker: frame_facing(Point::new(0.0, 0.0, height / 1e3), Vector::z() * out),
        };
        let space = Space {
            centre: Point::origin(),
            size: Vector::repeat(1.0),
            voxel: 0.01,
        };
        let simulator = Simulator::new(&object(cube(), vec![marker]), None, &space, Path::new("."));
        assert_eq!(simulator.is_ok(), shown, "at {height} mm, facing {out}");
    }
}
