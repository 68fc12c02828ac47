//! Candidate views: outside the space, and with some of it in sight.

use super::Analysed;
use super::frustum::sees;
use super::space::metres;
use crate::geometry::{Bounds, Point, Pose};
use crate::lang::diagnostics::{Code, Diagnostic};

pub(super) fn check(task: &Analysed<'_>) -> Vec<Diagnostic> {
    let bounds = task.task.space.bounds();
    let mut found = Vec::new();
    let count = task.views.len();
    let inside = task.views.iter().filter(|v| bounds.contains(&eye(v))).count();
    if inside > 0 {
        found.push(
            Diagnostic::new(
                Code::E0403,
                task.spans.views,
                format!("{} inside the object space", some(inside, count)),
            )
            .related(task.spans.space, "the space")
            .help("move the views out, or make the space smaller: objects may stand anywhere in it"),
        );
        return found;
    }
    let range = task.task.camera.range;
    let blind = |v: &&Pose| !sees(&task.task.camera, v, &bounds);
    let blind = task.views.iter().filter(blind).count();
    if blind > 0 {
        let code = if blind == count { Code::E0403 } else { Code::W0408 };
        let reads = format!("it reads depths from {} to {}", metres(range.min), metres(range.max));
        found.push(
            Diagnostic::new(code, task.spans.views, blind_message(blind, count))
                .related(task.spans.space, "the space")
                .help(format!("{reads}: move the views, or take another camera")),
        );
    }
    found
}

pub(super) fn eye(view: &Pose) -> Point {
    Point::from(view.translation.vector)
}

/// Distance from a view to the nearest point of a box, metres.
pub(super) fn nearest(bounds: &Bounds, view: &Pose) -> f64 {
    let p = eye(view);
    let clamped = p.coords.sup(&bounds.min.coords).inf(&bounds.max.coords);
    (p.coords - clamped).norm()
}

fn blind_message(n: usize, of: usize) -> String {
    match n == of {
        true => "the camera sees nothing of the space from any view".into(),
        false => format!("the camera sees nothing of the space from {n} of {of} views"),
    }
}

fn some(n: usize, of: usize) -> String {
    match (n, n == of) {
        (1, true) => "the only view is".into(),
        (_, true) => "all views are".into(),
        (1, _) => format!("1 of {of} views is"),
        _ => format!("{n} of {of} views are"),
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::codes;
    use super::*;
    use crate::geometry::{Vector, look_at};

    #[test]
    fn distances_by_hand() {
        let bounds = Bounds::centred(Point::origin(), Vector::repeat(2.0));
        let view = look_at(Point::new(4.0, 5.0, 0.0), Point::origin());
        assert!((nearest(&bounds, &view) - 5.0).abs() < 1e-12);
    }

    #[test]
    fn fires_on_views_in_the_space() {
        assert_eq!(codes(&[("radius: 1.5 m", "radius: 450 mm")]), [Code::E0403]);
        assert_eq!(codes(&[("radius: 1.5 m", "radius: 0.9 m")]), []);
    }

    #[test]
    fn fires_on_views_that_read_nothing() {
        let far = [
            ("radius: 1.5 m", "radius: 7 m"),
            ("sphere(radius: 2 m", "sphere(radius: 9 m"),
        ];
        assert!(codes(&far).contains(&Code::E0403));
        let listed = "views positions([[1.5 m, 0 m, 0.5 m], [1.5 m, 9 m, 0.5 m]])";
        let some = [
            ("views sphere(radius: 1.5 m, count: 16)", listed),
            ("sphere(radius: 2 m", "sphere(radius: 12 m"),
        ];
        assert_eq!(codes(&some), [Code::W0408]);
    }
}
