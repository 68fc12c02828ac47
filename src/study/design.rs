//! The runs of a study, in the order in which its rows stand.

use super::error::StudyError;
use crate::plan::{Options, PlanError, Session};
use crate::rules::{RuleSet, Study, Task, hex};
use crate::sense::Noise;
use sha2::{Digest, Sha256};

/// Most runs of a study.
pub const MOST_RUNS: u64 = 1_000_000;

/// What decides the views of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A method of the planner.
    Method(String),
    /// No planner could do better: the shape, or layout and pose, are known.
    Bound,
    /// The shape is known; always the view that shows most that is new.
    Oracle,
}

/// One way of running: a method under a noise and a variant of the task.
#[derive(Clone, Debug)]
pub struct Arm {
    /// What decides.
    pub kind: Kind,
    /// What happens to depth.
    pub noise: Noise,
    /// Index into [`Design::variants`].
    pub variant: usize,
    /// How tables call it: `gn`, `gn/fine`, `gn/structured_light`.
    pub label: String,
}

/// A variant with its task.
pub struct Variant {
    /// Its name; empty for the study's own settings.
    pub name: String,
    /// The program with the changed task.
    pub rules: RuleSet,
    /// The changed task.
    pub task: Task,
    /// What stands behind the objects, where the variant says so.
    pub backdrop: Option<Option<crate::rules::Backdrop>>,
    /// Number of candidate views.
    pub views: usize,
}

/// A run to be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Job {
    /// Its place in the order of the study.
    pub index: u64,
    /// Index into the study's objects.
    pub object: usize,
    /// Index into [`Design::arms`].
    pub arm: usize,
    /// First view.
    pub start: usize,
    /// Seed of noise and of methods that draw.
    pub seed: u64,
}

/// A study taken apart.
pub struct Design {
    /// The study.
    pub study: Study,
    /// Its variants, its own settings first.
    pub variants: Vec<Variant>,
    /// Methods first, then bounds.
    pub arms: Vec<Arm>,
    /// All runs.
    pub jobs: Vec<Job>,
}

impl Design {
    /// Takes a study apart.
    ///
    /// # Errors
    /// Too many runs or starts, an unknown method or noise, a task that cannot be run.
    pub fn new(study: Study) -> Result<Self, StudyError> {
        let variants: Vec<Variant> = study
            .variants
            .iter()
            .map(|v| variant(&study, v))
            .collect::<Result<_, _>>()?;
        let arms = arms(&study, &variants)?;
        let jobs = jobs(&study, &variants, &arms)?;
        Ok(Self {
            study,
            variants,
            arms,
            jobs,
        })
    }

    /// The variant of an arm.
    pub fn variant(&self, arm: usize) -> &Variant {
        &self.variants[self.arms[arm].variant]
    }

    /// Whether runs are about telling classes apart.
    pub fn is_recognition(&self) -> bool {
        self.variants.first().is_some_and(|v| v.task.goal.confident)
    }

    /// SHA-256 of everything that rows depend on, mesh files included.
    pub fn digest(&self) -> String {
        let text = serde_json::to_string(&self.study).unwrap_or_default();
        let mut digest = Sha256::new_with_prefix(text.as_bytes());
        for subject in &self.study.objects {
            if let Ok(file) = subject.object.shape.text("file") {
                // One that cannot be read is told of when it is to be shown.
                digest.update(std::fs::read(format!("{}{file}", subject.folder)).unwrap_or_default());
            }
        }
        hex(&digest.finalize())
    }
}

fn variant(study: &Study, variant: &crate::rules::Variant) -> Result<Variant, StudyError> {
    let mut rules = study.rules.clone();
    let what = if variant.name.is_empty() {
        format!("task `{}`", study.task)
    } else {
        format!("variant `{}`", variant.name)
    };
    let failed = |source: PlanError| StudyError::Plan {
        what: what.clone(),
        source,
    };
    let task = rules.tasks.iter_mut().find(|t| t.name == study.task);
    let task = task.ok_or_else(|| {
        failed(PlanError::UnknownTask {
            name: study.task.clone(),
            known: String::new(),
        })
    })?;
    variant.settings.apply(task);
    let task = task.clone();
    let session = Session::new(&rules, &task.name, Options::default()).map_err(failed)?;
    let views = session.views().len();
    if study.starts as usize > views {
        return Err(StudyError::Starts {
            starts: study.starts,
            views,
        });
    }
    Ok(Variant {
        name: variant.name.clone(),
        rules,
        task,
        backdrop: variant.settings.backdrop,
        views,
    })
}

fn arms(study: &Study, variants: &[Variant]) -> Result<Vec<Arm>, StudyError> {
    let noises: Vec<Noise> = study.noises.iter().map(|n| n.parse()).collect::<Result<_, _>>()?;
    let mut arms = Vec::new();
    for (variant, changed) in variants.iter().enumerate() {
        for noise in &noises {
            for method in &study.methods {
                crate::plan::methods::method(method).map_err(|source| StudyError::Plan {
                    what: format!("study `{}`", study.name),
                    source,
                })?;
                let qualified = noises.len() > 1 || *noise != Noise::None;
                arms.push(Arm {
                    kind: Kind::Method(method.clone()),
                    noise: *noise,
                    variant,
                    label: label(method, changed, qualified.then(|| noise.name())),
                });
            }
        }
    }
    for (variant, changed) in variants.iter().enumerate() {
        if variant > 0 && same_sight(&variants[0], changed) {
            continue;
        }
        let mut bounds = vec![("bound", Kind::Bound)];
        if !changed.task.goal.confident {
            bounds.push(("oracle", Kind::Oracle));
        }
        arms.extend(bounds.into_iter().map(|(name, kind)| Arm {
            kind,
            noise: Noise::None,
            variant,
            label: label(name, changed, None),
        }));
    }
    Ok(arms)
}

/// Whether what views show is the same in two variants, and so are the bounds.
fn same_sight(a: &Variant, b: &Variant) -> bool {
    let of = |v: &Variant| {
        (
            v.task.camera,
            v.task.views.clone(),
            v.task.thresholds,
            v.task.limit,
            v.task.goal,
        )
    };
    of(a) == of(b)
}

fn label(method: &str, variant: &Variant, noise: Option<&str>) -> String {
    let parts = [Some(method), Some(variant.name.as_str()), noise];
    let parts: Vec<&str> = parts.into_iter().flatten().filter(|p| !p.is_empty()).collect();
    parts.join("/")
}

fn jobs(study: &Study, variants: &[Variant], arms: &[Arm]) -> Result<Vec<Job>, StudyError> {
    let repeated = |arm: &Arm| match &arm.kind {
        Kind::Method(name) if name == "random" || arm.noise != Noise::None => u64::from(study.seeds),
        _ => 1,
    };
    let one = arms.iter().map(|arm| u128::from(repeated(arm))).sum::<u128>();
    let runs = one * u128::from(study.starts) * study.objects.len() as u128;
    if runs > u128::from(MOST_RUNS) {
        return Err(StudyError::TooMany {
            study: study.name.clone(),
            runs,
            most: MOST_RUNS,
        });
    }
    let mut jobs = Vec::with_capacity(runs as usize);
    for object in 0..study.objects.len() {
        for (k, arm) in arms.iter().enumerate() {
            let views = variants[arm.variant].views as u64;
            for start in 0..u64::from(study.starts) {
                let start = start * views / u64::from(study.starts);
                // As `vpl plan --start START --seed SEED`; the first seed is the start.
                jobs.extend((0..repeated(arm)).map(|repeat| (object, k, start, start + repeat * views)));
            }
        }
    }
    let numbered = jobs.into_iter().enumerate();
    Ok(numbered
        .map(|(index, (object, arm, start, seed))| Job {
            index: index as u64,
            object,
            arm,
            start: start as usize,
            seed,
        })
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lang::vocabulary;
    use crate::sense::UnknownNoise;

    #[test]
    fn the_language_and_the_simulator_know_the_same_noises() {
        for name in vocabulary::words("noise") {
            let parsed = name.parse::<Noise>();
            assert!(!matches!(parsed, Err(UnknownNoise::Unknown(_))), "{name}");
        }
    }
}
