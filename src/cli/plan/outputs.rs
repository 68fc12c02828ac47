//! Where results go: no file that a run reads or writes is overwritten by another.

use std::fs;
use std::path::Path;

use super::Plan;
use super::record::Recorder;
use crate::cli::Failure;
use crate::cli::files::STDIN;
use crate::cli::output::{self, MapForm, by_ending, is_stdout, settled};
use crate::plan::Session;
use crate::show::export::{self, Face, Stop};
use crate::show::log::Record;

#[derive(Clone, Copy)]
enum CloudForm {
    Ply,
    Pcd,
}

#[derive(Clone, Copy)]
enum MeshForm {
    Ply,
    Obj,
}

#[derive(Clone, Copy)]
enum PoseForm {
    Tum,
    Transforms,
}

fn cloud_form(path: &Path) -> Result<CloudForm, Failure> {
    by_ending(
        "--cloud",
        path,
        CloudForm::Ply,
        &[(".ply", CloudForm::Ply), (".pcd", CloudForm::Pcd)],
    )
}

fn mesh_form(path: &Path) -> Result<MeshForm, Failure> {
    by_ending(
        "--predicted",
        path,
        MeshForm::Ply,
        &[(".ply", MeshForm::Ply), (".obj", MeshForm::Obj)],
    )
}

fn pose_form(path: &Path) -> Result<PoseForm, Failure> {
    by_ending(
        "--poses",
        path,
        PoseForm::Tum,
        &[(".txt", PoseForm::Tum), (".json", PoseForm::Transforms)],
    )
}

/// Every file that a run may write, the log first.
fn outputs(options: &Plan) -> Vec<(&'static str, &Path)> {
    let all = [
        ("--log", &options.log),
        ("--map", &options.map),
        ("--cloud", &options.cloud),
        ("--predicted", &options.predicted),
        ("--poses", &options.poses),
        ("--report", &options.report),
    ];
    all.into_iter()
        .filter_map(|(name, path)| Some((name, path.as_deref()?)))
        .collect()
}

/// Refuses a result that would take the place of something that the run reads,
/// or of another result, and endings that name no form. A log may replace the log
/// that it resumes.
///
/// # Errors
/// A usage failure that names the option and the file.
pub(super) fn check(options: &Plan) -> Result<(), Failure> {
    let program = Some(Path::new(&options.file)).filter(|file| *file != Path::new(STDIN));
    let inputs = [
        program,
        options.object.as_deref().map(Path::new),
        options.recording.calibration.as_deref(),
    ];
    let results = outputs(options);
    for (k, (option, out)) in results.iter().enumerate() {
        let resumed = options.resume.as_deref().filter(|_| *option != "--log");
        let others = inputs
            .into_iter()
            .chain([resumed])
            .flatten()
            .chain(results[..k].iter().map(|r| r.1));
        for other in others {
            if same(out, other) {
                let (out, other) = (out.display(), other.display());
                return Err(Failure::Usage(format!(
                    "`{option} {out}` would overwrite `{other}`; name another file"
                )));
            }
        }
        if let Some(frames) = &options.frames {
            output::outside(option, out, frames)?;
        }
    }
    options.map.as_deref().map_or(Ok(()), |p| MapForm::of(p).map(drop))?;
    options.cloud.as_deref().map_or(Ok(()), |p| cloud_form(p).map(drop))?;
    options
        .predicted
        .as_deref()
        .map_or(Ok(()), |p| mesh_form(p).map(drop))?;
    options.poses.as_deref().map_or(Ok(()), |p| pose_form(p).map(drop))
}

/// Refuses files that cannot be written, before the first view: a run is not
/// lost to a wrong path. The log is opened by its recorder.
pub(super) fn writable(options: &Plan) -> Result<(), Failure> {
    let results = outputs(options).into_iter().filter(|(option, _)| *option != "--log");
    results.map(|(_, path)| path).try_for_each(output::writable)
}

/// Writes what a run learnt.
pub(super) fn write(options: &Plan, session: &Session, recorder: &Recorder) -> Result<(), Failure> {
    if let Some(path) = &options.map {
        let form = MapForm::of(path)?;
        output::write(path, |to| form.write(session.map(), to))?;
    }
    if let Some(path) = &options.cloud {
        let (form, points) = (cloud_form(path)?, session.map().points());
        output::write(path, |to| match form {
            CloudForm::Ply => export::ply(&points, to),
            CloudForm::Pcd => export::pcd(&points, to),
        })?;
    }
    if let Some(path) = &options.predicted {
        let (form, faces) = (mesh_form(path)?, predicted(session));
        output::write(path, |to| match form {
            MeshForm::Ply => export::mesh_ply(&faces, to),
            MeshForm::Obj => export::obj(&faces, to),
        })?;
    }
    if let Some(path) = &options.poses {
        let (form, stops) = (pose_form(path)?, stops(session, recorder.records()));
        output::write(path, |to| match form {
            PoseForm::Tum => export::tum(&stops, to),
            PoseForm::Transforms => export::transforms(&stops, &session.task().camera, to),
        })?;
    }
    if let (Some(path), Some(page)) = (&options.report, recorder.page()) {
        output::write(path, |to| to.write_all(page.as_bytes()))?;
    }
    Ok(())
}

/// The faces that are still predicted at the end.
fn predicted(session: &Session) -> Vec<Face<'_>> {
    let features = session.library().features.iter().zip(&session.status().features);
    let mut faces = Vec::new();
    for (feature, status) in features {
        for (key, predicted) in &status.predicted {
            let face = |polygon| Face {
                feature: &feature.name,
                key,
                polygon,
            };
            faces.extend(predicted.polygons.iter().map(face));
        }
    }
    faces
}

fn stops(session: &Session, records: &[Record]) -> Vec<Stop> {
    let views = records.iter().filter_map(|record| match record {
        Record::View(view) => Some(view),
        _ => None,
    });
    let stop = |view: &crate::show::log::View| {
        let world_from_camera = *session.views().get(view.view)?;
        Some(Stop {
            n: view.n,
            view: view.view,
            world_from_camera,
        })
    };
    views.filter_map(|view| stop(view)).collect()
}

/// Whether a result goes to standard output, where nothing else then may.
pub(super) fn use_stdout(options: &Plan) -> bool {
    outputs(options).into_iter().any(|(_, out)| is_stdout(out))
}

/// Whether two paths name one file that writing could spoil; devices are none.
fn same(a: &Path, b: &Path) -> bool {
    if is_stdout(a) || is_stdout(b) {
        return is_stdout(a) && is_stdout(b);
    }
    let device = |path: &Path| fs::metadata(path).is_ok_and(|m| !m.is_file());
    !device(a) && settled(a) == settled(b)
}
