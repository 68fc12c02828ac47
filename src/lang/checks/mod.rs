//! Task checks: what can be known before the robot moves, one file an analysis.
//!
//! They read the rule set, so they see what the planner will see: families and
//! definitions expanded. Only libraries without errors are analysed.

mod backdrop;
mod features;
mod firing;
mod markers;
mod reach;
mod space;
mod starts;
mod thresholds;
mod twins;
mod views;

use super::diagnostics::Diagnostic;
use super::lower::{Lowered, TaskSpans};
use crate::geometry::Pose;
use crate::primitives;
use crate::rules::{Library, Task};

/// A task with what it needs.
struct Analysed<'a> {
    task: &'a Task,
    spans: &'a TaskSpans,
    /// Its library, where that is free of errors.
    library: Option<&'a Library>,
    /// Its views; none where they or the space are not usable.
    views: Vec<Pose>,
}

/// Analyses everything that was lowered whole.
pub(super) fn check(lowered: &Lowered) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    let whole = |name: &str| {
        let libraries = lowered.rules.libraries.iter().zip(&lowered.whole);
        libraries
            .filter(|(l, whole)| l.name == name && **whole)
            .map(|(l, _)| l)
            .next()
    };
    for (library, _) in lowered
        .rules
        .libraries
        .iter()
        .zip(&lowered.whole)
        .filter(|(_, whole)| **whole)
    {
        found.extend(features::check(library));
        found.extend(firing::check(library));
        found.extend(starts::check(library));
    }
    let tasks: Vec<Analysed<'_>> = lowered
        .rules
        .tasks
        .iter()
        .zip(&lowered.task_spans)
        .map(|(task, spans)| {
            let usable = space::check(task, spans, &mut found);
            Analysed {
                task,
                spans,
                library: whole(&task.library),
                views: if usable {
                    primitives::poses(&task.views, &task.space).unwrap_or_default()
                } else {
                    Vec::new()
                },
            }
        })
        .collect();
    for task in &tasks {
        found.extend(thresholds::check(task));
        found.extend(views::check(task));
        found.extend(twins::check(task));
        found.extend(features::common(task));
        found.extend(markers::check(task));
    }
    for (scene, span) in lowered.rules.scenes.iter().zip(&lowered.backdrop_spans) {
        found.extend(backdrop::check(scene, *span, &tasks));
    }
    found
}

/// `a, b and c` in backticks, cut short where it is long.
fn names<'a>(all: impl IntoIterator<Item = &'a str>) -> String {
    super::names::suggest::one_of(all).replace(" or ", " and ")
}

#[cfg(test)]
mod testing {
    //! Programs for the tests of each analysis.

    use crate::lang::{Code, Memory, compile};

    /// A library of two markers and a task, with parts replaced.
    pub fn program(replaced: &[(&str, &str)]) -> String {
        let mut text = PROGRAM.to_owned();
        for (from, to) in replaced {
            assert!(text.contains(from), "the program has no `{from}`");
            text = text.replace(from, to);
        }
        text
    }

    /// The codes that compiling a program gives, in the order of the text.
    pub fn codes(replaced: &[(&str, &str)]) -> Vec<Code> {
        let compiled = compile("main.vpl", &Memory::of("main.vpl", &program(replaced)));
        compiled.diagnostics.iter().map(|d| d.code).collect()
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
