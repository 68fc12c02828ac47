//! Backdrops must enclose the views: a view behind one sees only its outside.

use super::Analysed;
use super::space::metres;
use super::views::eye;
use crate::lang::diagnostics::{Code, Diagnostic, Severity};
use crate::lang::source::Span;
use crate::rules::Scene;

/// An error where the scene fits no task, a warning where it fits another.
pub(super) fn check(scene: &Scene, span: Span, tasks: &[Analysed<'_>]) -> Vec<Diagnostic> {
    let Some(backdrop) = scene.backdrop else {
        return Vec::new();
    };
    let outside = tasks.iter().filter_map(|task| {
        let farthest = farthest(task)?;
        (farthest >= backdrop.radius).then_some((task, farthest))
    });
    let outside: Vec<_> = outside.collect();
    let severity = if outside.len() == tasks.len() {
        Severity::Error
    } else {
        Severity::Warning
    };
    outside
        .into_iter()
        .map(|(task, farthest)| {
            let message = format!("this backdrop does not enclose the views of task `{}`", task.task.name);
            Diagnostic::new(Code::E0501, span, message)
                .severity(severity)
                .related(
                    task.spans.views,
                    format!("as far as {} from the centre", metres(farthest)),
                )
                .help(format!(
                    "give it a radius above {}, or write `backdrop none`",
                    metres(farthest)
                ))
        })
        .collect()
}

/// Distance of the farthest view from the centre of the space, metres.
fn farthest(task: &Analysed<'_>) -> Option<f64> {
    let centre = task.task.space.centre;
    task.views
        .iter()
        .map(|v| (eye(v) - centre).norm())
        .max_by(f64::total_cmp)
}

#[cfg(test)]
mod tests {
    use super::super::testing::codes;
    use crate::lang::Code;

    #[test]
    fn fires_on_a_backdrop_in_front_of_the_views() {
        assert_eq!(codes(&[("sphere(radius: 2 m", "sphere(radius: 1 m")]), [Code::E0501]);
        assert_eq!(
            codes(&[
                ("radius: 1.5 m", "radius: 2.5 m"),
                ("backdrop sphere(radius: 2 m, colour: grey)", "")
            ]),
            [Code::E0501]
        );
    }

    #[test]
    fn keeps_quiet_without_a_backdrop() {
        let none = [
            ("backdrop sphere(radius: 2 m, colour: grey)", "backdrop none"),
            ("radius: 1.5 m", "radius: 2.5 m"),
        ];
        assert_eq!(codes(&none), []);
    }
}
