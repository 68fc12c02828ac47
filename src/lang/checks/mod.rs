//! Task checks: what can be known before the robot moves, one file an analysis.
//!
//! They read the rule set, so they see what the planner will see: families and
//! definitions expanded. Only libraries without errors are analysed.

mod alike;
mod backdrop;
mod confidence;
mod contradicting;
mod cost;
mod detectability;
mod faces;
mod features;
mod firing;
mod frustum;
mod layouts;
mod markers;
mod objects;
mod single;
mod space;
mod starts;
mod superfluous;
mod thresholds;
mod twins;
mod views;

use super::diagnostics::Diagnostic;
use super::lower::{Lowered, Placed, TaskSpans};
use crate::geometry::Pose;
use crate::primitives;
use crate::recognition::{Reach, Recognition};
use crate::rules::{Library, Task};

/// A task with what it needs.
struct Analysed<'a> {
    task: &'a Task,
    spans: &'a TaskSpans,
    /// Its library, where that is free of errors.
    library: Option<&'a Library>,
    /// Its classes, where they are to be told apart.
    recognition: Option<Recognition>,
    /// Its views; none where they or the space are not usable.
    views: Vec<Pose>,
}

/// Analyses everything that was lowered whole.
pub(super) fn check(lowered: &Lowered) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    let libraries = whole(lowered);
    for (library, layouts) in libraries.iter().filter_map(|(l, layouts)| Some((l.as_ref()?, layouts))) {
        of_library(library, layouts, &mut found);
    }
    let tasks = lowered.rules.tasks.iter().zip(&lowered.task_spans);
    let tasks: Vec<Analysed<'_>> = tasks
        .map(|(task, spans)| {
            let named = libraries
                .iter()
                .filter_map(|(l, _)| *l)
                .find(|l| l.name == task.library);
            analysed(task, spans, named, &mut found)
        })
        .collect();
    for task in &tasks {
        of_task(task, &mut found);
    }
    for (k, scene) in lowered.rules.scenes.iter().enumerate() {
        found.extend(backdrop::check(scene, lowered.backdrop_spans[k], &tasks));
        found.extend(objects::space(scene, &tasks));
        found.extend(objects::marks(scene, &lowered.marks[k], &libraries));
        found.extend(objects::foreign(scene, &tasks));
    }
    found
}

/// Every library that is free of errors, with its layouts.
fn whole(lowered: &Lowered) -> Vec<(Option<&Library>, &[Option<Placed>])> {
    let libraries = lowered.rules.libraries.iter().zip(&lowered.whole);
    let layouts = lowered.layouts.iter().map(Vec::as_slice);
    libraries.map(|(l, whole)| whole.then_some(l)).zip(layouts).collect()
}

fn of_library(library: &Library, layouts: &[Option<Placed>], found: &mut Vec<Diagnostic>) {
    let reach = Reach::new(library);
    found.extend(features::check(library));
    found.extend(firing::check(library, &reach));
    found.extend(starts::check(library, &reach));
    found.extend(single::check(library));
    found.extend(superfluous::check(library));
    found.extend(contradicting::check(library));
    found.extend(faces::check(library, layouts));
    found.extend(detectability::check(library));
    found.extend(alike::check(library));
    found.extend(layouts::check(library, layouts));
}

fn analysed<'a>(
    task: &'a Task,
    spans: &'a TaskSpans,
    library: Option<&'a Library>,
    found: &mut Vec<Diagnostic>,
) -> Analysed<'a> {
    let usable = space::check(task, spans, found);
    let confidence = task.thresholds.confidence;
    let told = library.filter(|_| task.goal.confident && 0.0 < confidence && confidence <= 1.0);
    Analysed {
        task,
        spans,
        library,
        recognition: told.and_then(|l| Recognition::of(l, confidence)),
        views: if usable {
            primitives::poses(&task.views, &task.space).unwrap_or_default()
        } else {
            Vec::new()
        },
    }
}

fn of_task(task: &Analysed<'_>, found: &mut Vec<Diagnostic>) {
    found.extend(thresholds::check(task));
    found.extend(views::check(task));
    found.extend(twins::check(task));
    found.extend(confidence::check(task));
    found.extend(cost::check(task));
    found.extend(features::common(task));
    found.extend(markers::check(task));
}

/// `a, b and c` in backticks, cut short where it is long.
fn names<'a>(all: impl IntoIterator<Item = &'a str>) -> String {
    super::names::suggest::one_of(all).replace(" or ", " and ")
}

#[cfg(test)]
mod testing {
    //! Programs for the tests of each analysis.

    use crate::lang::{Code, Diagnostic, Memory, Severity, compile};

    /// A library of two markers and a task, with parts replaced.
    pub fn program(replaced: &[(&str, &str)]) -> String {
        let mut text = PROGRAM.to_owned();
        for (from, to) in replaced {
            assert!(text.contains(from), "the program has no `{from}`");
            text = text.replace(from, to);
        }
        text
    }

    /// The codes that compiling that program gives, in the order of the text. W0403 is
    /// among them, other notes are not.
    pub fn codes(replaced: &[(&str, &str)]) -> Vec<Code> {
        codes_of(&program(replaced))
    }

    /// The same of any program.
    pub fn codes_of(text: &str) -> Vec<Code> {
        let all = compile("main.vpl", &Memory::of("main.vpl", text)).diagnostics;
        all.iter()
            .map(|d| d.code)
            .filter(|c| c.severity() != Severity::Note)
            .collect()
    }

    /// The notes that compiling a program gives.
    pub fn notes_of(text: &str) -> Vec<Diagnostic> {
        let mut all = compile("main.vpl", &Memory::of("main.vpl", text)).diagnostics;
        all.retain(|d| d.severity == Severity::Note);
        all
    }

    const PROGRAM: &str = r#"vpl 1
use std.cameras.kinect_v2
use std.views.sphere
library pair {
  feature left : marker
  feature right : marker
  class both { left, right }
  class one { left }
  class other { right }
  rule -> left {
    detect qr(text: "l", size: 200 mm)
    measure marker_pose()
  }
  rule -> right {
    detect qr(text: "r", size: 200 mm)
    measure marker_pose()
  }
  layout flat {
    left at [-300 mm, 0 mm, 0 mm] facing +z
    right at [300 mm, 0 mm, 0 mm] facing +z
  }
}
task tell {
  library pair
  goal confident
  camera kinect_v2
  space cube(1 m) at [0 mm, 0 mm, 500 mm] voxel 20 mm
  views sphere(radius: 1.5 m, count: 16)
  thresholds { near: 30 mm, absent: 95 %, confidence: 99 % }
  limit 20 views
}
scene room {
  backdrop sphere(radius: 2 m, colour: grey)
  object both = tank() at [0 mm, 0 mm, 500 mm] marked pair.flat as both
}
"#;

    #[test]
    fn the_program_of_these_tests_is_right() {
        assert_eq!(codes(&[]), []);
    }
}
