//! Recorded frames as a run's camera: the candidate views are those that were
//! really taken.

use std::path::Path;

use super::Plan;
use crate::cli::recording::refused;
use crate::cli::{Failure, report};
use crate::geometry::{Camera, DepthRange, Intrinsics, Pose};
use crate::plan::{PlanError, Sensor};
use crate::rules::Task;
use crate::sense::Observation;
use crate::sense::frames::{Recording, suspicion};
use crate::show;

/// Frames that are looked at before a run, to warn of what cannot work.
const LOOKED_AT: usize = 4;

/// A recording in place of a scene.
pub(super) struct Recorded {
    recording: Recording,
    range: DepthRange,
}

/// Opens the recording of `--frames`.
pub(super) fn open(path: &Path, options: &Plan) -> Result<Recorded, Failure> {
    let unused = [
        ("--object", options.object.is_some()),
        ("--units", options.units.is_some()),
        ("--up", options.up.is_some()),
        ("--noise", options.noise != "none"),
    ];
    if let Some((option, _)) = unused.iter().find(|(_, set)| *set) {
        return Err(Failure::Usage(format!(
            "`{option}` is for the simulator, and `--frames` shows what was recorded"
        )));
    }
    let recording = options.recording.open(path)?;
    let range = recording.camera(0).range;
    Ok(Recorded { recording, range })
}

impl Recorded {
    /// The recording's name in the log.
    pub fn name(&self) -> String {
        self.recording.path.display().to_string()
    }

    /// Its cameras and where they stood.
    pub fn views(&self) -> Vec<(Camera, Pose)> {
        let camera = |k| Camera {
            range: self.range,
            ..self.recording.camera(k)
        };
        self.recording
            .poses()
            .into_iter()
            .enumerate()
            .map(|(k, pose)| (camera(k), pose))
            .collect()
    }

    /// Gives a task the camera that took the frames. The range stays the task's,
    /// up to the largest depth asked for.
    pub fn equip(&mut self, task: &mut Task) -> Result<(), Failure> {
        let taken = self.recording.camera(0);
        self.range = DepthRange {
            min: task.camera.range.min,
            max: task.camera.range.max.min(taken.range.max),
        };
        let differs = [(task.camera.depth, taken.depth), (task.camera.colour, taken.colour)];
        if let Some((stated, found)) = differs.iter().find(|(a, b)| !alike(a, b)) {
            report(&format!(
                "note: the camera is the recording's, {}; the task's has {}\n",
                brief(found),
                brief(stated)
            ))?;
        }
        let range = self.range;
        task.camera = Camera { range, ..taken };
        Ok(())
    }

    /// Warns of poses or scales that make frames disagree, of readings out of
    /// range, and of frames that show nothing of the space.
    pub fn warn(&self, task: &Task) -> Result<(), Failure> {
        let suspicion = suspicion(&self.recording).map_err(refused)?;
        if suspicion.better.is_some() {
            report(&format!(
                "warning: {}",
                show::recording::verdict(&self.recording, &suspicion)
            ))?;
        }
        for note in &self.recording.notes {
            report(&format!("note: {note}\n"))?;
        }
        let (mut readings, mut in_range, mut in_space) = (0, 0, 0);
        let count = self.recording.frames.len();
        for k in (0..count.min(LOOKED_AT)).map(|i| i * count / count.min(LOOKED_AT)) {
            let seen = self.recording.observe(k).map_err(refused)?;
            readings += seen.depth.metres.iter().filter(|z| **z > 0.0).count();
            let seen = within(seen, self.range);
            in_range += seen.depth.metres.iter().filter(|z| **z > 0.0).count();
            in_space += points_in(&seen, task);
        }
        let (min, max) = (self.range.min, self.range.max);
        if 2 * in_range < readings {
            let share = 100.0 * (1.0 - in_range as f64 / readings as f64);
            report(&format!(
                "warning: {share:.0} % of the readings lie outside the camera's range of {min} to {max} m and count as none\n"
            ))?;
        }
        if in_space == 0 {
            report(&format!(
                "warning: no reading lies in the space of task `{}`; `vpl inspect {}` says where they are\n",
                task.name,
                self.name()
            ))?;
        }
        Ok(())
    }

    /// The frames as a sensor.
    pub fn sensor(&self) -> Frames<'_> {
        Frames {
            recording: &self.recording,
            range: self.range,
        }
    }
}

/// Gives the frame that was taken at a view.
pub(super) struct Frames<'a> {
    recording: &'a Recording,
    range: DepthRange,
}

impl Sensor for Frames<'_> {
    fn measure(&mut self, _n: u32, view: usize, _world_from_camera: &Pose) -> Result<Observation, PlanError> {
        let seen = self.recording.observe(view);
        let seen = seen.map_err(|error| PlanError::Sensor(error.to_string()))?;
        Ok(within(seen, self.range))
    }
}

/// An observation without the readings that a range does not hold.
fn within(mut seen: Observation, range: DepthRange) -> Observation {
    for z in &mut seen.depth.metres {
        if !range.contains(f64::from(*z)) {
            *z = 0.0;
        }
    }
    seen.camera.range = range;
    seen
}

fn points_in(seen: &Observation, task: &Task) -> usize {
    let bounds = task.space.bounds();
    let pixels = (0..seen.depth.height).flat_map(|v| (0..seen.depth.width).map(move |u| (u, v)));
    pixels
        .filter_map(|(u, v)| seen.point(u, v))
        .filter(|p| bounds.contains(p))
        .count()
}

/// Whether two cameras see the same to a pixel.
fn alike(a: &Intrinsics, b: &Intrinsics) -> bool {
    let near = |x: f64, y: f64| (x - y).abs() <= 1.0;
    (a.width, a.height) == (b.width, b.height)
        && near(a.fx, b.fx)
        && near(a.fy, b.fy)
        && near(a.cx, b.cx)
        && near(a.cy, b.cy)
}

fn brief(k: &Intrinsics) -> String {
    format!("{} × {} with fx {:.1}, fy {:.1}", k.width, k.height, k.fx, k.fy)
}
