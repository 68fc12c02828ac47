use super::*;
use crate::geometry::{Vector, look_at};
use crate::rules::Call;
use crate::sense::shapes::testing::*;
use crate::sense::{Noise, Simulator};

fn scene(shape: &Call, edge: f64) -> Simulator {
    Simulator::from_mesh(build(shape).unwrap(), Pose::identity(), Some(backdrop()), &space(edge))
}

fn around(eyes: &[[f64; 3]]) -> Vec<Pose> {
    eyes.iter().map(|&e| look_at(Point::from(e), Point::origin())).collect()
}

fn box_of_200_mm() -> Call {
    let radius = mm(100.0 * 2_f64.sqrt());
    call(
        "prism",
        &[("sides", count(4)), ("radius", radius), ("height", mm(200.0))],
    )
}

const SIX: [[f64; 3]; 6] = [
    [1., 0., 0.],
    [-1., 0., 0.],
    [0., 1., 0.],
    [0., -1., 0.],
    [0., 0., 1.],
    [0., 0., -1.],
];

#[test]
fn one_face_of_a_box_is_a_sixth_and_its_border() {
    let scene = scene(&box_of_200_mm(), 0.6);
    let (camera, views) = (camera(200, 160), around(&SIX));
    let mut coverage = Coverage::new(&scene, &camera, &views, 0.01);
    // 0.24 m² at 4 mm² a sample.
    assert!((coverage.samples().len() as f64 / 60_000.0 - 1.0).abs() < 0.001);
    assert_eq!(coverage.share(), Some(0.0));
    let first = scene.observe(&camera, &views[0], Noise::None, 0, 0);
    let added = coverage.observe(&first);
    // The face, and of its four neighbours up to 10 mm: pixels are 7 mm apart.
    let expected = (0.04 + 4.0 * 0.2 * 0.01) / 0.24;
    let share = coverage.share().unwrap();
    assert!((share - expected).abs() < 0.01, "{share} {expected}");
    assert_eq!(added, coverage.seen().iter().filter(|&&s| s).count());
    assert_eq!(coverage.observe(&first), 0);
    for view in &views[1..] {
        coverage.observe(&scene.observe(&camera, view, Noise::None, 0, 0));
    }
    assert_eq!(coverage.share(), Some(1.0));
    assert_eq!(coverage.within(0.005).share(), Some(0.0));
}

#[test]
fn only_what_some_view_shows_is_observable() {
    let scene = scene(&box_of_200_mm(), 0.6);
    let seen = Coverage::new(&scene, &camera(200, 160), &around(&SIX[..1]), 0.01);
    assert!(seen.samples().iter().all(|p| p.x > 0.099));
    let none = Coverage::new(&scene, &camera(200, 160), &[], 0.01);
    assert_eq!(none.share(), None);
}

#[test]
fn the_space_clips_samples_and_points() {
    let scene = scene(&box_of_200_mm(), 0.1);
    assert_eq!(
        Coverage::new(&scene, &camera(100, 80), &around(&SIX), 0.01).share(),
        None
    );
    let mut space = space(0.6);
    space.centre = Point::from(Vector::new(0.3, 0.0, 0.0));
    let half = Simulator::from_mesh(build(&box_of_200_mm()).unwrap(), Pose::identity(), None, &space);
    let coverage = Coverage::new(&half, &camera(200, 160), &around(&SIX), 0.01);
    assert!((coverage.samples().len() as f64 / 30_000.0 - 1.0).abs() < 0.01);
    assert!(coverage.samples().iter().all(|p| p.x >= 0.0));
}

#[test]
fn a_deep_pocket_needs_more_views_than_a_plain_box() {
    let views: Vec<Pose> = (0..24)
        .map(|k| {
            let z = 1.0 - 2.0 * (f64::from(k) + 0.5) / 24.0;
            let (r, turn) = ((1.0 - z * z).sqrt(), 2.399963 * f64::from(k));
            look_at(Point::new(r * turn.cos(), r * turn.sin(), z), Point::origin())
        })
        .collect();
    let least = |shape: &Call| {
        let (scene, camera) = (scene(shape, 0.6), camera(120, 100));
        let whole = Coverage::new(&scene, &camera, &views, 0.01);
        let rows: Vec<Vec<bool>> = views
            .iter()
            .map(|view| {
                let mut one = whole.within(0.01);
                one.observe(&scene.observe(&camera, view, Noise::None, 0, 0));
                one.seen().to_vec()
            })
            .collect();
        least_views(&rows, 0.97).unwrap().len()
    };
    let mut pocketed = box_of_200_mm();
    let pockets: Vec<Call> = (1..=4).map(|k| pocket("dent", k, [80.0, 80.0, 50.0])).collect();
    pocketed.arguments.insert("deformed".into(), calls(&pockets));
    let (plain, deep) = (least(&box_of_200_mm()), least(&pocketed));
    assert!(plain <= 3 && deep > plain, "{plain} {deep}");
}
