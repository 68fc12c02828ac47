//! Objects of scenes: in the space, and marked as what they are.

use std::collections::BTreeSet;

use super::space::metres;
use super::{Analysed, names};
use crate::geometry::{Bounds, Point};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::lower::{Mark, Placed};
use crate::primitives::extremes;
use crate::rules::{Library, Scene, SceneObject};

/// Reaching out by less than this is rounding, metres.
const ROUNDING: f64 = 1e-6;
/// Most objects that are pointed at one by one.
const MOST_SHOWN: usize = 4;

/// Objects outside the space of every task, and ones that reach out of each.
pub(super) fn space(scene: &Scene, tasks: &[Analysed<'_>]) -> Vec<Diagnostic> {
    let (mut outside, mut out) = (Vec::new(), Vec::new());
    for object in &scene.objects {
        let Some(object_bounds) = bounds(object) else { continue };
        let spaces: Vec<Bounds> = tasks.iter().map(|t| t.task.space.bounds()).collect();
        let fits = spaces.iter().map(|space| Fit::of(&object_bounds, space));
        match fits.reduce(Fit::better) {
            Some(Fit::Outside) => outside.push((object, 0.0)),
            Some(Fit::Reaches(by)) => out.push((object, by)),
            Some(Fit::Inside) | None => {}
        }
    }
    let mut found = Vec::new();
    found.extend(report(Code::E0505, &outside, tasks));
    found.extend(report(Code::N0403, &out, tasks));
    found
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Fit {
    Inside,
    /// By how much at most, metres.
    Reaches(f64),
    Outside,
}

impl Fit {
    fn of(object: &Bounds, space: &Bounds) -> Self {
        let apart = (0..3).any(|k| object.max[k] < space.min[k] || space.max[k] < object.min[k]);
        let (low, high) = (space.min - object.min, object.max - space.max);
        let by = low.sup(&high).max();
        match by > ROUNDING {
            _ if apart => Self::Outside,
            true => Self::Reaches(by),
            false => Self::Inside,
        }
    }

    fn better(self, other: Self) -> Self {
        match (self, other) {
            (Self::Inside, _) | (_, Self::Inside) => Self::Inside,
            (Self::Reaches(a), Self::Reaches(b)) => Self::Reaches(a.min(b)),
            (Self::Reaches(by), _) | (_, Self::Reaches(by)) => Self::Reaches(by),
            _ => Self::Outside,
        }
    }
}

fn bounds(object: &SceneObject) -> Option<Bounds> {
    let points: Vec<Point> = extremes(&object.shape)?
        .iter()
        .map(|p| object.world_from_object * p)
        .collect();
    Bounds::around(&points)
}

fn report(code: Code, objects: &[(&SceneObject, f64)], tasks: &[Analysed<'_>]) -> Option<Diagnostic> {
    let (first, _) = objects.first()?;
    let all = names(objects.iter().map(|(o, _)| o.name.as_str()));
    let one = objects.len() == 1;
    let (message, help) = match (code, one) {
        (Code::E0505, true) => (format!("{all} stands outside the space"), "move it into the space"),
        (Code::E0505, false) => (format!("{all} stand outside the space"), "move them into the space"),
        (_, true) => (
            format!("{all} reaches out of the space"),
            "move it, or make the space larger",
        ),
        (_, false) => (
            format!("{all} reach out of the space"),
            "move them, or make the space larger",
        ),
    };
    let label = |by: f64| {
        if by > 0.0 {
            format!("by {}", metres(by))
        } else {
            String::new()
        }
    };
    let mut out = Diagnostic::new(code, first.place, message).label(label(objects[0].1));
    for (object, by) in objects.iter().take(MOST_SHOWN).skip(1) {
        out = out.related(object.place, label(*by));
    }
    if let Some(task) = tasks.first() {
        out = out.related(task.spans.space, "the space");
    }
    Some(out.help(format!("{help}: only what lies inside is modelled")))
}

/// What the marks of a scene's objects have to do with their names and layouts.
pub(super) fn marks(
    scene: &Scene,
    marks: &[Mark],
    libraries: &[(Option<&Library>, &[Option<Placed>])],
) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for mark in marks {
        let (Some(object), Some((Some(library), layouts))) =
            (scene.objects.get(mark.object), libraries.get(mark.library))
        else {
            continue;
        };
        let Some(class) = library.classes.get(mark.class) else {
            continue;
        };
        let namesake = library.classes.iter().find(|c| c.name == object.name);
        if let Some(namesake) = namesake.filter(|c| c.name != class.name) {
            let message = format!(
                "`{}` is marked as `{}`, and its name is that of another class",
                object.name, class.name
            );
            found.push(
                Diagnostic::new(Code::W0415, mark.span, message)
                    .related(namesake.place, "the name of an object is its true class")
                    .help(format!("mark it as `{}`, or give it another name", object.name)),
            );
        }
        let layout = layouts.get(mark.layout).and_then(Option::as_ref);
        let bare = |l: &&Placed| !l.places.iter().any(|(f, _, _)| class.presence.has(*f));
        if let Some(layout) = layout.filter(bare) {
            let message = format!("`{}` has no code that layout `{}` places", class.name, layout.name);
            found.push(
                Diagnostic::new(Code::W0416, mark.span, message)
                    .related(layout.span, "the layout")
                    .related(class.place, "the class")
                    .help("nothing is printed on the object: leave `marked` out, or name another layout"),
            );
        }
    }
    found
}

/// Objects whose recognition cannot be judged, as a note.
pub(super) fn foreign(scene: &Scene, tasks: &[Analysed<'_>]) -> Option<Diagnostic> {
    let confident = tasks.iter().filter(|t| t.task.goal.confident);
    let libraries: Vec<&Library> = confident.filter_map(|t| t.library).collect();
    let classes = libraries.iter().flat_map(|l| &l.classes);
    let classes: BTreeSet<&str> = classes.map(|c| c.name.as_str()).collect();
    if classes.is_empty() {
        return None;
    }
    let foreign: Vec<&SceneObject> = scene
        .objects
        .iter()
        .filter(|o| !classes.contains(o.name.as_str()))
        .collect();
    let all = names(foreign.iter().map(|o| o.name.as_str()));
    let message = format!("no class is named {}", all.replace(" and ", " or "));
    Some(
        Diagnostic::new(Code::N0402, foreign.first()?.place, message)
            .help("the name of an object is its true class; whether another is recognised rightly is not known"),
    )
}

#[cfg(test)]
mod tests {
    use super::super::testing::{codes, notes_of, program};
    use crate::lang::Code;

    fn at(place: &'static str) -> (&'static str, &'static str) {
        ("tank() at [0 mm, 0 mm, 500 mm]", place)
    }

    #[test]
    fn fires_on_an_object_outside() {
        assert_eq!(codes(&[at("tank() at [3 m, 0 mm, 500 mm]")]), [Code::E0505]);
    }

    #[test]
    fn fires_on_an_object_that_reaches_out() {
        let reaches = |object: &str| {
            let notes = notes_of(&program(&[("tank() at [0 mm, 0 mm, 500 mm]", object)]));
            notes.iter().any(|d| d.code == Code::N0403)
        };
        assert!(reaches("tank(gun: 100 mm) at [0 mm, 0 mm, 600 mm]"));
        assert!(reaches("tank(gun: 1 m) at [0 mm, 0 mm, 500 mm]"));
        assert!(!reaches("tank(gun: 100 mm) at [0 mm, 0 mm, 500 mm]"));
        let prism = "prism(sides: 4, radius: 600 mm, height: 200 mm) at [0 mm, 0 mm, 500 mm]";
        assert!(!reaches(prism));
        assert!(reaches(&format!("{prism} turned 45 deg")));
    }

    #[test]
    fn fires_where_no_task_has_the_object_in_its_space() {
        let second = |at: &str| {
            let text = program(&[]);
            let task = &text[text.find("task tell").unwrap()..text.find("scene room").unwrap()];
            let task = task
                .replace("task tell", "task again")
                .replace("[0 mm, 0 mm, 500 mm]", at);
            format!("{task}scene room")
        };
        let away = at("tank() at [3 m, 0 mm, 500 mm]");
        let backdrop = ("backdrop sphere(radius: 2 m, colour: grey)", "backdrop none");
        assert_eq!(
            codes(&[away, backdrop, ("scene room", &second("[3 m, 0 mm, 500 mm]"))]),
            []
        );
        assert_eq!(
            codes(&[away, backdrop, ("scene room", &second("[9 m, 0 mm, 500 mm]"))]),
            [Code::E0505]
        );
    }

    #[test]
    fn fires_on_a_mark_of_another_class() {
        assert_eq!(codes(&[("flat as both", "flat as one")]), [Code::W0415]);
        assert_eq!(codes(&[("object both", "object thing")]), []);
    }

    #[test]
    fn fires_on_a_mark_without_a_print() {
        let bare = [
            ("class other { right }", "class other { right }\n class bare { }"),
            ("object both", "object bare"),
            ("flat as both", "flat as bare"),
        ];
        // On a bare object nothing is predicted, so nothing is found absent.
        assert_eq!(codes(&bare), [Code::W0409, Code::W0416]);
    }

    #[test]
    fn notes_objects_of_no_class() {
        let notes = |replaced: &[(&str, &str)]| {
            let notes = notes_of(&program(replaced));
            notes.iter().filter(|d| d.code == Code::N0402).count()
        };
        assert_eq!(notes(&[("object both", "object thing")]), 1);
        assert_eq!(notes(&[]), 0);
        assert_eq!(
            notes(&[("object both", "object thing"), ("goal confident", "goal exhausted")]),
            0
        );
    }
}
