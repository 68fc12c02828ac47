//! Whole sessions on the built-in simulator: both experiments of the paper,
//! with libraries in code.

use std::path::Path;

use super::fixtures::{
    attribute, call, classes, degrees, feature, for_each_edge_of, length, library, or, rule, task, text, variable,
};
use vpl::geometry::{Camera, DepthRange, Intrinsics, Point, Pose, Rotation, Vector, frame_facing};
use vpl::plan::{Decision, End, Existence, Options, Outcome, Session, Update};
use vpl::primitives::{Default as Parameter, find};
use vpl::rules::{
    Backdrop, Call, Colour, Expr, FORMAT, FeatureKind, Goal, Library, Marker, Place, RuleSet, SceneObject, SensorModel,
    Space, Task, Thresholds, Value,
};
use vpl::sense::{Noise, Simulator};

/// A call with the registered defaults filled in, as the compiler does.
fn full<const N: usize>(primitive: &str, arguments: [(&str, Expr); N]) -> Call {
    let mut call = call(primitive, arguments);
    for p in find(primitive).unwrap().parameters {
        if let Parameter::Value(value) = p.default {
            call.arguments
                .entry(p.name.to_owned())
                .or_insert_with(|| Expr::Value(value()));
        }
    }
    call
}

fn colour(rgb: [u8; 3]) -> Expr {
    Expr::Value(Value::Colour(Colour(rgb)))
}

fn choice(word: &str) -> Expr {
    Expr::Value(Value::Choice(word.to_owned()))
}

fn kinect() -> Camera {
    let fov = |w, h, x: f64, y: f64| Intrinsics::with_fields_of_view(w, h, x.to_radians(), y.to_radians());
    Camera {
        depth: fov(512, 424, 70.6, 60.0),
        colour: fov(1920, 1080, 84.1, 53.8),
        range: DepthRange { min: 0.5, max: 4.5 },
    }
}

const RED: [u8; 3] = [200, 30, 30];
const GREEN: [u8; 3] = [30, 160, 50];
const BLUE: [u8; 3] = [40, 60, 200];

/// Fig. 7: bottom 0, prism side 1, pyramid side 2, prism 3, pyramid 4.
fn solids() -> Library {
    let features = vec![
        feature("bottom", FeatureKind::Polygon, false),
        feature("prism_side", FeatureKind::Polygon, true),
        feature("pyramid_side", FeatureKind::Polygon, true),
        feature("prism_shape", FeatureKind::Shell, false),
        feature("pyramid_shape", FeatureKind::Shell, false),
    ];
    let plane = |rgb| full("planar_region", [("colour", colour(rgb))]);
    let lowest = || full("outline", [("begin", choice("lowest"))]);
    let first = || full("outline", [("first", variable("edge"))]);
    let beside = |edge: Expr, angle: f64, within: f64, rgb| {
        let arguments = [
            ("edge", edge),
            ("dihedral", degrees(angle)),
            ("within", degrees(within)),
            ("colour", colour(rgb)),
        ];
        full("plane_beside", arguments)
    };
    let upright = full(
        "rectangle_on",
        [
            ("on", variable("edge")),
            ("dihedral", degrees(90.0)),
            ("height", or(attribute(1, "height"), length(0.3))),
        ],
    );
    let under = |side: u32| {
        let facing = Expr::Value(Value::Direction(-Vector::z()));
        full(
            "completed_square",
            [("edges", Expr::List(vec![attribute(side, "base")])), ("facing", facing)],
        )
    };
    let above = Expr::Call(full(
        "behind",
        [("face", attribute(0, "self")), ("depth", length(0.25))],
    ));
    let slanted = full(
        "triangle_to",
        [("on", variable("edge")), ("apex", or(attribute(2, "apex"), above))],
    );
    let seen = || full("mostly_seen", []);
    let rough = || full("rough_shape", []);
    let prism = full(
        "prism_over",
        [("base", attribute(0, "self")), ("height", attribute(1, "height"))],
    );
    let pyramid = full(
        "pyramid_over",
        [("base", attribute(0, "self")), ("apex", attribute(2, "apex"))],
    );
    let rules = vec![
        rule(&[], 0, plane(RED), full("outline", []), None),
        rule(&[], 1, plane(GREEN), lowest(), None),
        rule(&[], 2, plane(BLUE), lowest(), None),
        for_each_edge_of(
            0,
            rule(
                &[0],
                1,
                beside(variable("edge"), 90.0, 10.0, GREEN),
                first(),
                Some(upright),
            ),
        ),
        rule(
            &[1],
            0,
            beside(attribute(1, "base"), 90.0, 10.0, RED),
            full("outline", []),
            Some(under(1)),
        ),
        rule(&[0, 1], 3, seen(), rough(), Some(prism)),
        for_each_edge_of(
            0,
            rule(
                &[0],
                2,
                beside(variable("edge"), 58.0, 20.0, BLUE),
                first(),
                Some(slanted),
            ),
        ),
        rule(
            &[2],
            0,
            beside(attribute(2, "base"), 58.0, 20.0, RED),
            full("outline", []),
            Some(under(2)),
        ),
        rule(&[0, 2], 4, seen(), rough(), Some(pyramid)),
    ];
    library(features, classes(&["prism 11010", "pyramid 10101"]), rules)
}

fn reconstruction() -> Task {
    Task {
        goal: Goal {
            confident: false,
            exhausted: true,
        },
        camera: kinect(),
        space: Space {
            centre: Point::new(0.0, 0.0, 0.3),
            size: Vector::repeat(0.6),
            voxel: 0.01,
        },
        views: sphere(1.4),
        thresholds: Thresholds {
            near: 0.01,
            absent: 0.99,
            confidence: 0.99,
        },
        gain_floor: 5,
        // OctoMap's shipped values let two grazing misses undo a hit: surfaces
        // get cracks, and what shows through them is never used up.
        sensor_model: SensorModel {
            hit: 0.9,
            miss: 0.45,
            ..SensorModel::default()
        },
        ..task()
    }
}

fn sphere(radius: f64) -> Call {
    full(
        "fibonacci_sphere",
        [("radius", length(radius)), ("count", Expr::Value(Value::Count(64)))],
    )
}

/// Where the seven codes are: on flat places of the tank.
fn layout() -> [Pose; 7] {
    let at = |x: f64, y: f64, z: f64, facing: Vector| frame_facing(Point::new(x, y, z), facing);
    [
        at(0.455, 0.0, 0.165, Vector::x()),
        at(-0.455, 0.0, 0.165, -Vector::x()),
        at(0.2, 0.305, 0.178, Vector::y()),
        at(-0.2, 0.305, 0.178, Vector::y()),
        at(0.0, -0.305, 0.178, -Vector::y()),
        at(-0.3, 0.0, 0.345, Vector::z()),
        at(0.08, 0.0, 0.495, Vector::z()),
    ]
}

const TABLE: [&str; 12] = [
    "tk1 1010111",
    "tk2 1000011",
    "tk3 1011111",
    "tk4 0100100",
    "tk5 1110111",
    "tk6 1011011",
    "tk7 1000111",
    "tk8 1011010",
    "tk9 1100111",
    "tk10 1011101",
    "tk11 1001111",
    "tk12 1110101",
];

/// Fig. 8.
fn tanks() -> Library {
    let qr = |k: usize| full("qr", [("text", text(&format!("f{}", k + 1))), ("size", length(0.2))]);
    let measure = || full("marker_pose", []);
    let features = (1..=7).map(|k| feature(&format!("code[{k}]"), FeatureKind::Marker, false));
    let mut rules: Vec<_> = (0..7).map(|k| rule(&[], k as u32, qr(k), measure(), None)).collect();
    for (i, from) in layout().iter().enumerate() {
        for (j, to) in layout().iter().enumerate().filter(|(j, _)| *j != i) {
            let tied = Expr::Value(Value::Pose(from.inverse() * to));
            let arguments = [
                ("antecedent", attribute(i as u32, "pose")),
                ("antecedent_from_consequent", tied),
                ("size", length(0.2)),
            ];
            let predict = full("rigid_marker", arguments);
            rules.push(rule(&[i as u32], j as u32, qr(j), measure(), Some(predict)));
        }
    }
    library(features.collect(), classes(&TABLE), rules)
}

fn recognition() -> Task {
    Task {
        camera: kinect(),
        space: Space {
            centre: Point::new(0.0, 0.0, 0.6),
            size: Vector::repeat(1.2),
            voxel: 0.02,
        },
        views: sphere(1.65),
        thresholds: Thresholds {
            near: 0.03,
            absent: 0.95,
            confidence: 0.99,
        },
        gain_floor: 5,
        ..task()
    }
}

fn rule_set(library: Library, task: Task) -> RuleSet {
    RuleSet {
        format: FORMAT,
        language: 1,
        sources: Vec::new(),
        libraries: vec![library],
        tasks: vec![task],
        scenes: Vec::new(),
    }
}

fn scene(shape: Call, place: Pose, markers: Vec<Marker>, task: &Task) -> Simulator {
    let object = SceneObject {
        name: "object".to_owned(),
        shape,
        world_from_object: place,
        markers,
        place: Place::default(),
    };
    let backdrop = Backdrop {
        radius: 2.0,
        colour: Colour([128, 128, 128]),
    };
    Simulator::new(&object, Some(backdrop), &task.space, Path::new(".")).unwrap()
}

fn placed(x: f64, y: f64, z: f64, turned: f64) -> Pose {
    let turn = Rotation::from_axis_angle(&Vector::z_axis(), turned.to_radians());
    Pose::from_parts(Vector::new(x, y, z).into(), turn)
}

/// A run from a start view to its end.
fn run(rules: &RuleSet, scene: &Simulator, method: &str, start: usize) -> (Vec<Update>, Vec<Decision>, End) {
    let options = Options {
        method: Some(method.to_owned()),
        ..Options::default()
    };
    let mut session = Session::new(rules, "task", options).unwrap();
    let (mut updates, mut decisions, mut view) = (Vec::new(), Vec::new(), start);
    loop {
        let n = updates.len() as u32 + 1;
        let camera = session.task().camera;
        let seen = scene.observe(&camera, &session.views()[view], Noise::None, 0, n);
        let update = session.observe(view, &seen).unwrap();
        updates.push(update);
        let decision = session.next_view();
        decisions.push(decision.clone());
        match decision {
            Decision::Next(next) => view = next.chosen.view,
            Decision::End(end) => return (updates, decisions, end),
        }
    }
}

fn prism(sides: u64) -> Call {
    full(
        "prism",
        [
            ("sides", Expr::Value(Value::Count(sides))),
            ("radius", length(0.14)),
            ("height", length(0.3)),
        ],
    )
}

#[test]
fn a_prism_is_found_to_be_one_and_seen_all_over() {
    let task = reconstruction();
    let scene = scene(prism(4), placed(0.01, -0.015, 0.308, 33.0), Vec::new(), &task);
    let rules = rule_set(solids(), task);
    for (method, start) in [("gn", 0), ("gno", 21), ("gn", 63)] {
        let (updates, _, end) = run(&rules, &scene, method, start);
        assert_eq!(
            (end.outcome, end.class.as_deref()),
            (Outcome::Goal, Some("prism")),
            "{method} {start}"
        );
        assert!(updates.len() <= 8, "{method} from {start} took {}", updates.len());
        let last = updates.last().unwrap();
        assert_eq!([0, 1, 2, 3, 4].map(|f| last.features[f].state.code()), [1, 1, 3, 1, 3]);
        let measured = last.features[1]
            .instances
            .iter()
            .filter(|i| i.state == Existence::Detected);
        assert_eq!(measured.count(), 4, "every side is measured once");
    }
}

#[test]
fn a_pyramid_is_found_to_be_one() {
    let task = reconstruction();
    let pyramid = full(
        "pyramid",
        [
            ("sides", Expr::Value(Value::Count(4))),
            ("radius", length(0.16)),
            ("height", length(0.25)),
            ("side", colour(BLUE)),
        ],
    );
    let scene = scene(pyramid, placed(0.0, 0.01, 0.3, 12.0), Vec::new(), &task);
    let (updates, _, end) = run(&rule_set(solids(), task), &scene, "gn", 5);
    assert_eq!((end.outcome, end.class.as_deref()), (Outcome::Goal, Some("pyramid")));
    let last = updates.last().unwrap();
    assert_eq!([0, 1, 2].map(|f| last.features[f].state.code()), [1, 3, 1]);
}

/// The tank of a row of the table, at a place.
fn tank(row: usize, task: &Task) -> Simulator {
    let presence = TABLE[row].split_once(' ').unwrap().1;
    let marked = layout().into_iter().zip(presence.chars()).enumerate();
    let markers = marked.filter(|(_, (_, c))| *c == '1').map(|(k, (pose, _))| Marker {
        text: format!("f{}", k + 1),
        size: 0.2,
        object_from_marker: pose,
    });
    scene(
        full("tank", []),
        placed(0.012, -0.008, 0.4, 24.0),
        markers.collect(),
        task,
    )
}

#[test]
fn tanks_are_told_apart_by_codes_found_and_codes_missing() {
    let task = recognition();
    let rules = rule_set(tanks(), task.clone());
    for (row, start) in [(0, 20), (3, 7), (8, 40)] {
        let (_, _, end) = run(&rules, &tank(row, &task), "gn", start);
        let name = TABLE[row].split_once(' ').unwrap().0;
        assert_eq!((end.outcome, end.class.as_deref()), (Outcome::Goal, Some(name)));
        assert!(end.confidence >= 0.99);
    }
}

#[test]
fn the_same_observations_give_the_same_decisions_on_any_number_of_threads() {
    let task = recognition();
    let rules = rule_set(tanks(), task.clone());
    let scene = tank(1, &task);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run(&rules, &scene, "gno", 11))
    };
    assert_eq!(on(1), on(4));
}

#[test]
fn a_session_is_restored_by_replay_and_continues_as_a_clone() {
    let task = reconstruction();
    let scene = scene(prism(5), placed(0.0, 0.0, 0.3, 7.0), Vec::new(), &task);
    let rules = rule_set(solids(), task.clone());
    let mut first = Session::new(&rules, "task", Options::default()).unwrap();
    let seen = |s: &Session, view: usize| scene.observe(&task.camera, &s.views()[view], Noise::None, 0, 1);
    let start = first.start();
    first.observe(start, &seen(&first, start)).unwrap();
    let mut copy = first.clone();
    let mut replayed = Session::new(&rules, "task", Options::default()).unwrap();
    replayed.observe(start, &seen(&replayed, start)).unwrap();
    let Decision::Next(next) = first.next_view() else {
        panic!("one view cannot be enough");
    };
    for other in [&mut copy, &mut replayed] {
        assert_eq!(other.next_view(), first.next_view());
        let update = other
            .observe(next.chosen.view, &seen(&first, next.chosen.view))
            .unwrap();
        assert_eq!(update.n, 2);
    }
    assert_eq!(copy.next_view(), replayed.next_view());
    assert_eq!(copy.map(), replayed.map());
}

#[test]
fn the_start_view_depends_on_the_seed_alone() {
    let start = |library: Library, task: Task, method: &str, seed: u64| {
        let options = Options {
            method: Some(method.to_owned()),
            seed,
            ..Options::default()
        };
        Session::new(&rule_set(library, task), "task", options).unwrap().start()
    };
    let starts: Vec<usize> = (0..20).map(|s| start(solids(), reconstruction(), "gn", s)).collect();
    for (seed, first) in starts.iter().enumerate() {
        assert_eq!(start(tanks(), recognition(), "Random", seed as u64), *first);
    }
    assert!(starts.iter().any(|s| *s != starts[0]));
}

#[test]
fn wrong_input_is_refused_with_its_reason() {
    let rules = rule_set(solids(), reconstruction());
    let open = |task: &str, method: Option<&str>| {
        let options = Options {
            method: method.map(str::to_owned),
            ..Options::default()
        };
        Session::new(&rules, task, options).err().map(|e| e.to_string())
    };
    assert_eq!(
        open("reconstruct", None).unwrap(),
        "there is no task `reconstruct`; the file has `task`"
    );
    assert!(open("task", Some("best")).unwrap().contains("`best`"));
    let mut session = Session::new(&rules, "task", Options::default()).unwrap();
    let task = reconstruction();
    let scene = scene(prism(4), placed(0.0, 0.0, 0.3, 0.0), Vec::new(), &task);
    let mut seen = scene.observe(&task.camera, &session.views()[0], Noise::None, 0, 1);
    assert!(session.observe(64, &seen).is_err());
    seen.depth.metres.pop();
    assert!(session.observe(0, &seen).is_err());
}
