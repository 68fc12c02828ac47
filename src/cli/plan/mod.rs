//! `vpl plan`: the closed loop in the built-in simulator.

mod outputs;
mod record;
mod resume;
mod stage;

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use self::record::Recorder;
use self::stage::Stage;
use super::files::{Disk, human};
use super::{Failure, Outcome, more, print, report};
use crate::lang::{self, Compilation, Diagnostic, render};
use crate::plan::{self, ClosedLoop, Decision, Options, Part, PlanError, Session};
use crate::rules::{RuleSet, Task};
use crate::sense::{Coverage, Noise};
use crate::show::{self, log};

/// Run a task in the simulator: measure, reason, go to the next best view.
#[derive(Args)]
#[command(after_help = "Example: vpl plan examples/tanks/tanks.vpl --object tk4 --log run.jsonl")]
pub(crate) struct Plan {
    /// The program; `-` is standard input.
    file: String,
    /// Which task; the first of the file where left out.
    #[arg(long, value_name = "NAME")]
    task: Option<String>,
    /// An object of the scene, or a mesh file; the first object where left out.
    #[arg(long, value_name = "NAME|MESH")]
    object: Option<String>,
    /// What one unit of the mesh file is.
    #[arg(long, value_enum)]
    units: Option<UnitsOption>,
    /// Which axis of the mesh file points up.
    #[arg(long, value_enum)]
    up: Option<AxisOption>,
    /// How views are chosen; the task's method where left out.
    #[arg(long, value_name = "NAME")]
    method: Option<String>,
    /// Seed of the first view and of the noise.
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// First view, from 0; drawn from the seed where left out.
    #[arg(long, value_name = "VIEW")]
    start: Option<usize>,
    /// Most measurements, the first included; the task's limit where left out.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    max_views: Option<u32>,
    /// Threads; the result is the same for any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// What the depth camera does to depth: none, structured_light.
    #[arg(long, value_name = "NAME", default_value = "none")]
    noise: String,
    /// Print what would be run, and stop.
    #[arg(long)]
    dry_run: bool,
    /// Write the run log (JSON Lines); `-` is standard output.
    #[arg(long, value_name = "RUN.jsonl")]
    log: Option<PathBuf>,
    /// Write a page that shows the run (HTML, opens offline); `-` is standard output.
    #[arg(long, value_name = "RUN.html")]
    report: Option<PathBuf>,
    /// Write the map as an OctoMap file; `-` is standard output.
    #[arg(long, value_name = "OUT.bt")]
    map: Option<PathBuf>,
    /// Repeat the views of a run log, then go on.
    #[arg(long, value_name = "RUN.jsonl")]
    resume: Option<PathBuf>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum UnitsOption {
    /// Millimetres.
    Mm,
    /// Centimetres.
    Cm,
    /// Metres.
    M,
    /// Inches.
    In,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum AxisOption {
    /// x points up.
    X,
    /// y points up, as in glTF.
    Y,
    /// z points up.
    Z,
}

pub(crate) fn run(options: &Plan) -> Result<Outcome, Failure> {
    if let Some(threads) = options.threads {
        // It fails only where a pool exists already, which then serves as well.
        let _ = rayon::ThreadPoolBuilder::new()
            .num_threads(threads.into())
            .build_global();
    }
    let noise: Noise = options
        .noise
        .parse()
        .map_err(|error| Failure::Usage(format!("{error}")))?;
    outputs::check(options)?;
    let compiled = lang::compile(&options.file, &Disk).without_notes();
    report(&render(&compiled.diagnostics, &compiled.sources, human()))?;
    report(&more([&compiled], human()))?;
    let Some(rules) = &compiled.rules else {
        return Ok(Outcome::WrongInput);
    };
    let task = chosen_task(rules, options.task.as_deref())?;
    let stage = match stage::set(options, &compiled, rules, task)? {
        Ok(stage) => stage,
        Err(diagnostic) => return refuse(&compiled, diagnostic),
    };
    let session = Session::new(
        rules,
        &task.name,
        Options {
            method: options.method.clone(),
            seed: options.seed,
            limit: options.max_views,
        },
    );
    let mut session = session.map_err(usage_of)?;
    let start = chosen_start(options, &session)?;
    if let Some(diagnostic) = stage::views_inside(&stage, &session) {
        return refuse(&compiled, diagnostic);
    }
    let head = log::Start::of(
        &session,
        &options.file,
        &stage.name,
        noise.name(),
        options.seed,
        rules.digest(),
    );
    if options.dry_run {
        print(&show::configuration(&head, &session, start))?;
        return Ok(Outcome::Done);
    }
    let logged = match &options.resume {
        Some(path) => resume::views(path, &head, start)?,
        None => Vec::new(),
    };
    // Before the first view: a run is not lost to a wrong path.
    for path in [&options.map, &options.report].into_iter().flatten() {
        record::writable(path)?;
    }
    let report_page = options
        .report
        .is_some()
        .then(|| show::Report::begin(head.clone(), &session));
    let mut recorder = Recorder::begin(options.log.as_deref(), report_page, head, logged.len())?;
    let end = drive(&mut session, &stage, noise, options.seed, start, &logged, &mut recorder)?;
    let mut summary = show::summary(recorder.records(), &stage.name);
    summary += &options.log.as_deref().map_or(String::new(), why_line);
    if outputs::use_stdout(options) {
        report(&summary)?;
    } else {
        print(&summary)?;
    }
    if let Some(path) = &options.map {
        record::write_map(path, session.map())?;
    }
    if let Some(path) = &options.report {
        recorder.write_report(path)?;
    }
    Ok(if end == plan::Outcome::Goal {
        Outcome::Done
    } else {
        Outcome::GoalMissed
    })
}

/// Where the run can be asked about.
fn why_line(log: &Path) -> String {
    if record::is_stdout(log) {
        return String::new();
    }
    let log = log.display().to_string();
    let quote = if log.contains(char::is_whitespace) { "'" } else { "" };
    format!("why         vpl why {quote}{log}{quote} SUBJECT: a rule, a feature, a class, or `view N`\n")
}

/// Runs the loop to its end, a record and a line a view.
fn drive(
    session: &mut Session,
    stage: &Stage,
    noise: Noise,
    seed: u64,
    start: usize,
    logged: &[usize],
    recorder: &mut Recorder,
) -> Result<plan::Outcome, Failure> {
    let task = session.task().clone();
    recorder.preparing(&format!("working out what can be seen of {}", stage.name));
    let mut coverage = Coverage::new(&stage.simulator, &task.camera, session.views(), task.thresholds.near);
    let sensor = stage.sensor(task.camera, noise, seed);
    let mut turn = ClosedLoop::new(session, sensor, start);
    loop {
        recorder.begin_view();
        let step = turn
            .step(&mut |part: Part| recorder.lap(part))
            .map_err(|e| Failure::Run(e.to_string()))?;
        let Some(step) = step else {
            return Err(Failure::Run("the run has no end".into()));
        };
        coverage.observe(&step.observation);
        recorder.view(turn.session(), &step)?;
        resume::agrees(logged, &step)?;
        if let Decision::End(end) = &step.decision {
            recorder.end(end, coverage.share())?;
            return Ok(end.outcome);
        }
    }
}

fn chosen_task<'a>(rules: &'a RuleSet, name: Option<&str>) -> Result<&'a Task, Failure> {
    let task = match name {
        Some(name) => rules.tasks.iter().find(|t| t.name == name),
        None => rules.tasks.first(),
    };
    task.ok_or_else(|| {
        let known: Vec<String> = rules.tasks.iter().map(|t| format!("`{}`", t.name)).collect();
        Failure::Usage(match name {
            Some(name) => format!("there is no task `{name}`; the file has {}", listed(&known)),
            None => "the file has no task; add `task NAME { … }`".to_owned(),
        })
    })
}

fn chosen_start(options: &Plan, session: &Session) -> Result<usize, Failure> {
    let (start, count) = (options.start.unwrap_or_else(|| session.start()), session.views().len());
    if start < count {
        return Ok(start);
    }
    let last = count - 1;
    Err(Failure::Usage(format!(
        "there is no view {start}; the task's {count} views are numbered from 0 to {last}"
    )))
}

fn usage_of(error: PlanError) -> Failure {
    match error {
        PlanError::UnknownMethod { .. } => Failure::Usage(error.to_string()),
        other => Failure::Run(other.to_string()),
    }
}

fn refuse(compiled: &Compilation, diagnostic: Diagnostic) -> Result<Outcome, Failure> {
    report(&render(&[diagnostic], &compiled.sources, human()))?;
    Ok(Outcome::WrongInput)
}

/// `a, b and c`; `none` where there is none.
fn listed(names: &[String]) -> String {
    match names {
        [] => "none".to_owned(),
        [one] => one.clone(),
        [most @ .., last] => format!("{} and {last}", most.join(", ")),
    }
}
