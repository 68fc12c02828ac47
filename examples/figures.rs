//! The figures of `docs/figures.md`: every object of an experiment from evenly
//! spread start views, as a Markdown table.
//!
//! ```text
//! cargo run --release --example figures -- FILE [--starts N] [--method NAME] [--noise NAME] [--limit N]
//!     [--visibility exact|centre]
//! ```
//!
//! Start views are ⌊k · count / N⌋. Exits with 1 where a run does not reach its
//! goal, or names a class that is not the object's own.

use std::process::ExitCode;

use rayon::prelude::*;
use vpl::cli::Disk;
use vpl::lang;
use vpl::plan::{ClosedLoop, Decision, End, Options, Outcome, Part, Phase, Session, Simulated};
use vpl::rules::{RuleSet, Scene, SceneObject, Task, Visibility};
use vpl::sense::{Coverage, Noise, Simulator};

type Failure = Box<dyn std::error::Error + Send + Sync>;

fn main() -> ExitCode {
    match table(std::env::args().skip(1)) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

struct Settings {
    starts: usize,
    method: Option<String>,
    noise: Noise,
    limit: Option<u32>,
    visibility: Option<Visibility>,
}

/// One run.
struct Run {
    end: End,
    views: usize,
    coverage: Option<f64>,
    /// Seconds in sensing, detecting, mapping and scoring.
    seconds: [f64; 4],
}

fn table(mut arguments: impl Iterator<Item = String>) -> Result<bool, Failure> {
    let file = arguments.next().ok_or("which program?")?;
    let mut settings = Settings {
        starts: 16,
        method: None,
        noise: Noise::None,
        limit: None,
        visibility: None,
    };
    while let Some(option) = arguments.next() {
        let value = arguments.next().ok_or_else(|| format!("`{option}` needs a value"))?;
        match option.as_str() {
            "--starts" => settings.starts = value.parse()?,
            "--method" => settings.method = Some(value),
            "--noise" => settings.noise = value.parse()?,
            "--limit" => settings.limit = Some(value.parse()?),
            "--visibility" => settings.visibility = Some(serde_json::from_value(value.into())?),
            _ => return Err(format!("unknown option `{option}`").into()),
        }
    }
    let mut rules = lang::compile(&file, &Disk)
        .rules
        .ok_or("the program has errors; see `vpl check`")?;
    if let (Some(visibility), Some(task)) = (settings.visibility, rules.tasks.first_mut()) {
        task.visibility = visibility;
    }
    let (task, scene) = (rules.tasks.first(), rules.scenes.first());
    let (task, scene) = task.zip(scene).ok_or("the program needs a task and a scene")?;
    println!("| object | runs | goal | right | wrong | views mean | min | max | coverage mean | worst |");
    println!("|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|");
    let mut all = Vec::new();
    let recognition = task.goal.confident;
    for object in &scene.objects {
        let runs = runs(&rules, task, scene, object, &settings)?;
        println!(
            "{}",
            row(
                &object.name,
                &runs.iter().map(|r| (object.name.as_str(), r)).collect::<Vec<_>>(),
                recognition
            )
        );
        all.extend(runs.into_iter().map(|run| (object.name.as_str(), run)));
    }
    let all: Vec<(&str, &Run)> = all.iter().map(|(name, run)| (*name, run)).collect();
    println!("{}", row("all", &all, recognition));
    let part = |k: usize| all.iter().map(|(_, r)| r.seconds[k]).sum::<f64>() / all.len() as f64;
    println!();
    println!(
        "seconds a run: sense {:.2}, detect {:.2}, map {:.2}, score {:.2}",
        part(0),
        part(1),
        part(2),
        part(3)
    );
    Ok(all.iter().all(|(_, r)| r.end.outcome == Outcome::Goal) && wrong(&all, recognition) == 0)
}

fn runs(
    rules: &RuleSet,
    task: &Task,
    scene: &Scene,
    object: &SceneObject,
    settings: &Settings,
) -> Result<Vec<Run>, Failure> {
    let simulator = Simulator::new(object, scene.backdrop, &task.space, std::path::Path::new("."))?;
    let views = Session::new(rules, &task.name, Options::default())?.views().to_vec();
    let coverage = Coverage::new(&simulator, &task.camera, &views, task.thresholds.near);
    let starts: Vec<usize> = (0..settings.starts)
        .map(|k| k * views.len() / settings.starts)
        .collect();
    let one = |&start: &usize| {
        run(
            rules,
            task,
            &simulator,
            coverage.within(task.thresholds.near),
            start,
            settings,
        )
    };
    starts.par_iter().map(one).collect()
}

fn run(
    rules: &RuleSet,
    task: &Task,
    simulator: &Simulator,
    mut coverage: Coverage,
    start: usize,
    settings: &Settings,
) -> Result<Run, Failure> {
    let seed = start as u64;
    let options = Options {
        method: settings.method.clone(),
        seed,
        limit: settings.limit,
        ..Options::default()
    };
    let mut session = Session::new(rules, &task.name, options)?;
    let sensor = Simulated {
        simulator,
        camera: task.camera,
        noise: settings.noise,
        seed,
    };
    let mut turn = ClosedLoop::new(&mut session, sensor, start);
    let mut seconds = [0.0; 4];
    let mut last = std::time::Instant::now();
    loop {
        let step = turn.step(&mut |part| {
            let k = match part {
                Part::Sense => 0,
                Part::Session(Phase::Detect) => 1,
                Part::Session(Phase::Map) => 2,
                Part::Session(Phase::Score) => 3,
            };
            seconds[k] += last.elapsed().as_secs_f64();
            last = std::time::Instant::now();
        })?;
        let step = step.ok_or("the run has no end")?;
        coverage.observe(&step.observation);
        last = std::time::Instant::now();
        if let Decision::End(end) = step.decision {
            return Ok(Run {
                end,
                views: step.update.n,
                coverage: coverage.share(),
                seconds,
            });
        }
    }
}

fn row(name: &str, runs: &[(&str, &Run)], recognition: bool) -> String {
    let goal = runs.iter().filter(|(_, r)| r.end.outcome == Outcome::Goal).count();
    let right = runs
        .iter()
        .filter(|(object, r)| r.end.class.as_deref() == Some(object))
        .count();
    let (right, wrong) = if recognition {
        (right.to_string(), wrong(runs, true).to_string())
    } else {
        ("–".into(), "–".into())
    };
    let views = || runs.iter().map(|(_, r)| r.views);
    let mean = views().sum::<usize>() as f64 / runs.len() as f64;
    let (least, most) = (views().min().unwrap_or(0), views().max().unwrap_or(0));
    let covered: Vec<f64> = runs.iter().filter_map(|(_, r)| r.coverage).collect();
    let average = covered.iter().sum::<f64>() / covered.len().max(1) as f64 * 100.0;
    let worst = covered.iter().copied().fold(f64::INFINITY, f64::min) * 100.0;
    let n = runs.len();
    format!(
        "| {name} | {n} | {goal} | {right} | {wrong} | {mean:.2} | {least} | {most} | {average:.1} % | {worst:.1} % |"
    )
}

/// Runs that reach the goal with another class than the object's own.
fn wrong(runs: &[(&str, &Run)], recognition: bool) -> usize {
    let is_wrong =
        |(object, r): &&(&str, &Run)| r.end.outcome == Outcome::Goal && r.end.class.as_deref() != Some(*object);
    if recognition {
        runs.iter().filter(is_wrong).count()
    } else {
        0
    }
}
