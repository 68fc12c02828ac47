//! What a recording was probably mistaken for: poses the other way round, axes
//! of the other convention, another depth scale.
//!
//! Successive frames are compared under every such reading. One that makes them
//! agree far better than the reading they were given is the likely mistake.

use super::agreement::{Look, median, spread};
use super::{FrameError, Recording};
use crate::geometry::{Pose, Rotation, Vector};

/// Pairs that are compared.
const PAIRS: usize = 8;
/// Every so many pixels a point is compared.
const STRIDE: u32 = 8;
/// Least share of the points that must fall on a reading.
const SHARED: f64 = 0.15;
/// Frames agree where depths differ by less than this share.
const AGREES: f64 = 0.05;
/// A reading is far better where what differs is this share of what differed.
const FAR_BETTER: f64 = 0.4;
/// By what depths are multiplied.
const FACTORS: [f64; 7] = [1.0, 1000.0, 0.001, 5.0, 0.2, 10.0, 0.1];

/// How poses can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Poses {
    /// As they were.
    AsTaken,
    /// The other way round.
    Inverse,
    /// With y and z of the camera turned over: OpenGL for OpenCV or back.
    OtherAxes,
    /// Both.
    InverseOtherAxes,
}

const READINGS: [Poses; 4] = [
    Poses::AsTaken,
    Poses::Inverse,
    Poses::OtherAxes,
    Poses::InverseOtherAxes,
];

/// How a recording's frames agree, and a reading under which they agree far better.
#[derive(Clone, Debug, PartialEq)]
pub struct Suspicion {
    /// Median difference as a share of depth, as taken; `None` where frames do not overlap.
    pub difference: Option<f64>,
    /// The better reading.
    pub better: Option<Better>,
}

/// A reading that agrees far better.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Better {
    /// How poses are read.
    pub poses: Poses,
    /// By what depths are multiplied.
    pub factor: f64,
    /// Median difference as a share of depth.
    pub difference: f64,
}

impl Suspicion {
    /// Whether frames overlap and agree.
    pub fn agrees(&self) -> bool {
        self.better.is_none() && self.difference.is_some_and(|d| d < AGREES)
    }
}

/// Compares the frames under all readings.
///
/// # Errors
/// A frame cannot be read.
pub fn suspicion(recording: &Recording) -> Result<Suspicion, FrameError> {
    let firsts = spread(recording.frames.len().saturating_sub(1), PAIRS);
    let pair = |k: usize| Ok((Look::of(recording, k)?, Look::of(recording, k + 1)?));
    let pairs = firsts.into_iter().map(pair).collect::<Result<Vec<_>, FrameError>>()?;
    let taken = difference(&pairs, Poses::AsTaken, 1.0);
    let mut best: Option<Better> = None;
    for (poses, factor) in READINGS.into_iter().flat_map(|p| FACTORS.map(|f| (p, f))) {
        if let Some(difference) = difference(&pairs, poses, factor)
            && best.is_none_or(|b| difference < b.difference)
        {
            best = Some(Better {
                poses,
                factor,
                difference,
            });
        }
    }
    let far = |b: &Better| b.difference < AGREES && taken.is_none_or(|d| b.difference < FAR_BETTER * d);
    Ok(Suspicion {
        difference: taken,
        better: best.filter(far),
    })
}

/// Median share of depth by which frames differ; `None` where under half of the
/// pairs overlap.
fn difference(pairs: &[(Look, Look)], poses: Poses, factor: f64) -> Option<f64> {
    let each: Vec<f64> = pairs.iter().filter_map(|(a, b)| between(a, b, poses, factor)).collect();
    if 2 * each.len() < pairs.len() {
        return None;
    }
    median(each)
}

fn between(a: &Look, b: &Look, poses: Poses, factor: f64) -> Option<f64> {
    let b_from_a = poses.read(&b.world_from_camera).inverse() * poses.read(&a.world_from_camera);
    let (mut all, mut differences) = (0.0, Vec::new());
    for p in a.points(STRIDE) {
        all += 1.0;
        let seen = b_from_a * (p * factor);
        if let Some((z, _)) = b.reading(&seen) {
            differences.push((z * factor - seen.z).abs() / (z * factor));
        }
    }
    let enough = differences.len() as f64 >= SHARED * all;
    enough.then(|| median(differences))?
}

impl Poses {
    fn read(self, pose: &Pose) -> Pose {
        let turned = Rotation::from_axis_angle(&Vector::x_axis(), std::f64::consts::PI);
        match self {
            Self::AsTaken => *pose,
            Self::Inverse => pose.inverse(),
            Self::OtherAxes => pose * turned,
            Self::InverseOtherAxes => pose.inverse() * turned,
        }
    }
}
