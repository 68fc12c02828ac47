//! What a run would do, for `--dry-run`.

use std::fmt::Write as _;

use super::log::Start;
use crate::plan::Session;
use crate::rules::Visibility;

/// The effective configuration of a run that would begin at view `start`.
pub fn configuration(head: &Start, session: &Session, start: usize) -> String {
    let task = session.task();
    let (space, camera, thresholds) = (&task.space, &task.camera, &task.thresholds);
    let voxels = space.size / space.voxel;
    let goal = match (task.goal.confident, task.goal.exhausted) {
        (true, true) => "confident and exhausted",
        (true, false) => "confident",
        _ => "exhausted",
    };
    let mut text = String::new();
    let mut row = |name: &str, value: String| {
        let _ = writeln!(text, "{name:<12}{value}");
    };
    row("task", format!("{} ({}), goal {goal}", task.name, head.file));
    row("object", head.object.clone());
    row(
        "library",
        format!(
            "{}: {} features, {} classes, {} rules",
            session.library().name,
            session.library().features.len(),
            session.library().classes.len(),
            session.library().rules.len()
        ),
    );
    row(
        "camera",
        format!(
            "depth {} × {} px, colour {} × {} px, {} to {} m",
            camera.depth.width,
            camera.depth.height,
            camera.colour.width,
            camera.colour.height,
            camera.range.min,
            camera.range.max
        ),
    );
    row(
        "space",
        format!(
            "{:.3} × {:.3} × {:.3} m, voxels of {} mm: {:.0} of them",
            space.size.x,
            space.size.y,
            space.size.z,
            space.voxel * 1000.0,
            voxels.x.ceil() * voxels.y.ceil() * voxels.z.ceil()
        ),
    );
    row(
        "views",
        format!(
            "{} candidates, first {start}, at most {} measured",
            head.candidates, head.limit
        ),
    );
    row(
        "thresholds",
        format!(
            "near {} mm, absent {} %, confidence {} %, gain floor {} voxels",
            thresholds.near * 1000.0,
            thresholds.absent * 100.0,
            thresholds.confidence * 100.0,
            task.gain_floor
        ),
    );
    row("method", format!("{}, overlap {} %", head.method, task.overlap * 100.0));
    let visibility = match task.visibility {
        Visibility::Exact => "exact",
        Visibility::Centre => "centre",
    };
    row("visibility", visibility.to_owned());
    row("noise", format!("{}, seed {}", head.noise, head.seed));
    row("rules", head.rules.clone());
    let weights: Vec<String> = head
        .weights
        .0
        .iter()
        .map(|(name, bits)| format!("{name} {bits:.4}"))
        .collect();
    row("weights", format!("{} bits", weights.join(", ")));
    text
}
