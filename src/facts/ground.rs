//! The task that a library is tried with: thresholds and space for its facts.

use crate::geometry::{Bounds, Camera, DepthRange, Intrinsics, Point, Vector};
use crate::rules::{
    Call, Fact, Given, Goal, Insertion, Inspected, Library, Place, RuleSet, SensorModel, Space, Task, Thresholds,
    Visibility,
};

/// ξ, ξ_ned and ξ_cfd where no task says: the paper's.
const USUAL: Thresholds = Thresholds {
    near: 0.01,
    absent: 0.99,
    confidence: 0.99,
};
/// How much larger the space is than what is given in it, where no task says.
const ROOM: f64 = 20.0;
/// Voxels along an edge of that space.
const VOXELS: f64 = 128.0;

/// The first task of a fact's library; a usual one around the evidence where
/// the program has none.
pub(super) fn task(rules: &RuleSet, library: &Library, fact: &Fact) -> Task {
    let declared = rules.tasks.iter().find(|t| t.library == library.name);
    declared.cloned().unwrap_or_else(|| usual(library, space(fact)))
}

fn space(fact: &Fact) -> Space {
    let points: Vec<Point> = fact.given.iter().flat_map(|(_, given)| points(given)).collect();
    let bounds = Bounds::around(&points).unwrap_or(Bounds::centred(Point::origin(), Vector::zeros()));
    let edge = (bounds.max - bounds.min).amax().max(1.0) * ROOM;
    Space {
        centre: bounds.centre(),
        size: Vector::repeat(edge),
        voxel: edge / VOXELS,
    }
}

fn points(given: &Given) -> Vec<Point> {
    match given {
        Given::Detected | Given::Absent => Vec::new(),
        Given::Face(face) => face.vertices().to_vec(),
        Given::Marker { pose, .. } => vec![pose.translation.vector.into()],
    }
}

/// Nothing is looked at, so its camera and views serve only to make it whole.
fn usual(library: &Library, space: Space) -> Task {
    let image = Intrinsics::with_fields_of_view(640, 480, 1.0, 0.8);
    Task {
        name: library.name.clone(),
        library: library.name.clone(),
        goal: Goal {
            confident: true,
            exhausted: false,
        },
        camera: Camera {
            depth: image,
            colour: image,
            range: DepthRange { min: 0.5, max: 4.5 },
        },
        space,
        views: Call {
            primitive: "positions".to_owned(),
            arguments: Default::default(),
        },
        thresholds: USUAL,
        overlap: 0.2,
        method: "gn".to_owned(),
        limit: 1,
        gain_floor: 1,
        inspected: Inspected::Observed,
        insertion: Insertion::default(),
        visibility: Visibility::Exact,
        verify: false,
        sensor_model: SensorModel::default(),
        place: Place::default(),
    }
}
