//! What the simulator shows in a run: an object of the scene or a mesh file.

use std::path::Path;

use super::{AxisOption, Plan, UnitsOption, listed};
use crate::cli::{Failure, report};
use crate::geometry::{Camera, Point, Pose};
use crate::lang::{Code, Compilation, Diagnostic};
use crate::plan::{Session, Simulated};
use crate::rules::{Backdrop, Colour, Place, RuleSet, Scene, SceneObject, Task};
use crate::sense::{Axis, Mesh, MeshError, MeshOptions, Noise, SceneError, Simulator, Units, mesh};

/// The simulator with its object.
pub(super) struct Stage {
    /// The object's name, or the mesh file.
    pub name: String,
    /// What shows it.
    pub simulator: Simulator,
    /// Where diagnostics about it point.
    place: Place,
}

impl Stage {
    /// The simulator behind a task's camera.
    pub fn sensor(&self, camera: Camera, noise: Noise, seed: u64) -> Simulated<'_> {
        Simulated {
            simulator: &self.simulator,
            camera,
            noise,
            seed,
        }
    }
}

type Set = Result<Result<Stage, Diagnostic>, Failure>;

/// Finds the object and builds it.
pub(super) fn set(options: &Plan, compiled: &Compilation, rules: &RuleSet, task: &Task) -> Set {
    let objects = || {
        rules
            .scenes
            .iter()
            .flat_map(|scene| scene.objects.iter().map(move |o| (scene, o)))
    };
    let Some(name) = options.object.as_deref() else {
        return match objects().next() {
            Some((scene, object)) => of_scene(scene, object, options, compiled, task),
            None => Err(Failure::Usage(
                "the file has no scene with an object; name a mesh with `--object part.stl`".into(),
            )),
        };
    };
    if let Some((scene, object)) = objects().find(|(_, o)| o.name == name) {
        return of_scene(scene, object, options, compiled, task);
    }
    if Path::new(name).extension().is_none() {
        let known: Vec<String> = objects().map(|(_, o)| format!("`{}`", o.name)).collect();
        let text = format!(
            "there is no object `{name}`; the file has {}, or name a mesh file",
            listed(&known)
        );
        return Err(Failure::Usage(text));
    }
    of_mesh(name, options, rules.scenes.first(), task)
}

fn of_scene(scene: &Scene, object: &SceneObject, options: &Plan, compiled: &Compilation, task: &Task) -> Set {
    if options.units.is_some() || options.up.is_some() {
        return Err(Failure::Usage(format!(
            "`--units` and `--up` are for a mesh file, and `{}` is an object of the scene",
            object.name
        )));
    }
    let folder = compiled
        .sources
        .get(crate::lang::FileId(0))
        .map(|f| Path::new(&f.display));
    let base = folder.and_then(Path::parent).unwrap_or(Path::new("."));
    let simulator = match Simulator::new(object, scene.backdrop, &task.space, base) {
        Ok(simulator) => simulator,
        Err(error) => return Ok(Err(unusable(&error, object.place))),
    };
    warn(simulator.mesh(), &object.name)?;
    let stage = Stage {
        name: object.name.clone(),
        simulator,
        place: object.place,
    };
    let help = match object.shape.primitive.as_str() {
        "mesh" => units_that_fit(&stage, task, "units: ", " in the scene"),
        _ => None,
    };
    sized(stage, task, help)
}

/// A mesh of the user's, upright, the centre of its box at the centre of the space.
fn of_mesh(name: &str, options: &Plan, scene: Option<&Scene>, task: &Task) -> Set {
    let stated = MeshOptions {
        units: options.units.map(units),
        up: options.up.map(axis),
    };
    let part = match mesh::read(Path::new(name), &stated) {
        Ok(part) => part,
        Err(error) => return Ok(Err(unreadable(&error, task.place))),
    };
    warn(&part, name)?;
    let world_from_object = to_centre(&part, &task.space.centre);
    let backdrop = match scene {
        Some(scene) => scene.backdrop,
        None => Some(Backdrop {
            radius: 2.0,
            colour: Colour([128, 128, 128]),
        }),
    };
    let simulator = Simulator::from_mesh(part, world_from_object, backdrop, &task.space);
    let stage = Stage {
        name: name.to_owned(),
        simulator,
        place: task.place,
    };
    let help = units_that_fit(&stage, task, "--units ", "");
    sized(stage, task, help)
}

fn to_centre(part: &Mesh, centre: &Point) -> Pose {
    let shift = centre - part.bounds().centre();
    Pose::translation(shift.x, shift.y, shift.z)
}

/// Refuses what is absurdly large or small for the space: its units are wrong.
/// Warns of what only reaches out of it.
fn sized(stage: Stage, task: &Task, help: Option<String>) -> Set {
    let (object, space) = (stage.simulator.bounds(), task.space.bounds());
    let size = object.size();
    let Some(problem) = misfit(size.max(), task) else {
        if (0..3).any(|k| object.max[k] < space.min[k] || space.max[k] < object.min[k]) {
            let message = format!("`{}` stands outside the space of task `{}`", stage.name, task.name);
            return Ok(Err(Diagnostic::at_place(Code::E0504, stage.place, message)
                .help("place it in the space: `at` its centre is a start")));
        }
        if !(space.contains(&object.min) && space.contains(&object.max)) {
            let text = "reaches out of the space; only what lies inside is modelled";
            report(&format!("warning: `{}` {text}\n", stage.name))?;
        }
        return Ok(Ok(stage));
    };
    let message = format!(
        "`{}` is {} × {} × {} m, {problem} the space of task `{}`",
        stage.name,
        brief(size.x),
        brief(size.y),
        brief(size.z),
        task.name
    );
    let help = help.unwrap_or_else(|| {
        format!(
            "the space is {} m across with voxels of {} mm",
            brief(space.size().min()),
            task.space.voxel * 1000.0
        )
    });
    Ok(Err(Diagnostic::at_place(Code::E0504, stage.place, message).help(help)))
}

/// What is wrong with an object of a largest extent, if anything.
fn misfit(extent: f64, task: &Task) -> Option<&'static str> {
    if extent > 2.0 * task.space.size.min() {
        Some("far larger than")
    } else if extent < 3.0 * task.space.voxel {
        Some("hardly a speck in")
    } else {
        None
    }
}

/// The units in which a mesh would fit, whatever they are now.
fn units_that_fit(stage: &Stage, task: &Task, before: &str, after: &str) -> Option<String> {
    let extent = stage.simulator.bounds().size().max();
    let all = [("mm", 0.001), ("cm", 0.01), ("in", 0.0254), ("m", 1.0)];
    let fits = |factor: f64| misfit(extent * factor, task).is_none();
    let any: Vec<String> = all
        .iter()
        .filter(|(_, to)| all.iter().any(|(_, from)| fits(to / from)))
        .map(|(unit, _)| format!("`{before}{unit}`"))
        .collect();
    (!any.is_empty()).then(|| format!("is it in other units? it would fit with {}{after}", any.join(" or ")))
}

/// Metres to a tenth of a millimetre, or a power of ten where that is long.
fn brief(metres: f64) -> String {
    if (1e-4..1e5).contains(&metres) {
        format!("{metres:.4}")
    } else {
        format!("{metres:.1e}")
    }
}

/// The views that stand inside the object, as a diagnostic.
pub(super) fn views_inside(stage: &Stage, session: &Session) -> Option<Diagnostic> {
    let eye = |pose: &Pose| Point::from(pose.translation.vector);
    let views = session.views().iter().enumerate();
    let inside: Vec<String> = views
        .filter(|(_, pose)| stage.simulator.contains(&eye(pose)))
        .map(|(k, _)| k.to_string())
        .collect();
    let (first, task) = (inside.first()?, session.task());
    let message = match inside.len() {
        1 => format!("view {first} of task `{}` is inside `{}`", task.name, stage.name),
        n => format!(
            "{n} views of task `{}` are inside `{}`, view {first} among them",
            task.name, stage.name
        ),
    };
    Some(
        Diagnostic::at_place(Code::E0503, task.place, message)
            .help("give `views` a larger radius, or show a smaller object"),
    )
}

fn unusable(error: &SceneError, place: Place) -> Diagnostic {
    match error {
        SceneError::Mesh(error) => unreadable(error, place),
        SceneError::Marker { .. } => Diagnostic::at_place(Code::E0502, place, error.to_string()),
        other => Diagnostic::at_place(Code::E0309, place, other.to_string()),
    }
}

fn unreadable(error: &MeshError, place: Place) -> Diagnostic {
    let help = match error {
        MeshError::UnitsNeeded { .. } => Some("say `--units mm` on the command line, or `units: mm` in the scene"),
        MeshError::UpNeeded { .. } => Some("say `--up z` on the command line, or `up: z` in the scene"),
        _ => None,
    };
    Diagnostic::at_place(Code::E0504, place, error.to_string()).maybe_help(help.map(str::to_owned))
}

fn warn(part: &Mesh, name: &str) -> Result<(), Failure> {
    part.warnings
        .iter()
        .try_for_each(|warning| report(&format!("warning: `{name}`: {warning}\n")))
}

fn units(option: UnitsOption) -> Units {
    match option {
        UnitsOption::Mm => Units::Millimetres,
        UnitsOption::Cm => Units::Centimetres,
        UnitsOption::M => Units::Metres,
        UnitsOption::In => Units::Inches,
    }
}

fn axis(option: AxisOption) -> Axis {
    match option {
        AxisOption::X => Axis::X,
        AxisOption::Y => Axis::Y,
        AxisOption::Z => Axis::Z,
    }
}
