//! `vpl plan`: the closed loop, in the built-in simulator or on recorded frames.

mod outputs;
mod record;
mod recorded;
mod resume;
mod source;
mod stage;

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use self::record::Recorder;
use self::source::{Drive, Source};
use super::files::{Disk, human};
use super::output::is_stdout;
use super::recording::RecordingOptions;
use super::{Failure, Outcome, more, print, report};
use crate::lang::{self, Compilation, Diagnostic, render};
use crate::plan::{self, Options, PlanError, Session};
use crate::rules::{RuleSet, Task};
use crate::sense::Noise;
use crate::show::{self, log};

/// Run a task in the simulator or on recorded frames: measure, reason, go to the
/// next best view.
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
    /// Recorded frames, a folder or a log: the views are those that were taken.
    #[arg(long, value_name = "DATASET")]
    frames: Option<PathBuf>,
    #[command(flatten)]
    recording: RecordingOptions,
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
    #[arg(long, value_name = "OUT.bt|OUT.ot")]
    map: Option<PathBuf>,
    /// Write the measured points, one a voxel.
    #[arg(long, value_name = "OUT.ply|OUT.pcd")]
    cloud: Option<PathBuf>,
    /// Write the faces that are predicted at the end.
    #[arg(long, value_name = "OUT.ply|OUT.obj")]
    predicted: Option<PathBuf>,
    /// Write the poses of the measured views, as TUM's trajectory or transforms.json.
    #[arg(long, value_name = "OUT.txt|OUT.json")]
    poses: Option<PathBuf>,
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
    let name = chosen_task(rules, options.task.as_deref())?.name.clone();
    // As the session is given it: with the camera of recorded frames.
    let mut given = rules.clone();
    let task = given.tasks.iter_mut().find(|t| t.name == name);
    let task = task.ok_or_else(|| Failure::Run(format!("task `{name}` is gone")))?;
    let source = match Source::set(options, &compiled, rules, task)? {
        Ok(source) => source,
        Err(outcome) => return Ok(outcome),
    };
    let session = Session::new(
        &given,
        &name,
        Options {
            method: options.method.clone(),
            seed: options.seed,
            limit: options.max_views,
            views: source.views(),
        },
    );
    let mut session = session.map_err(usage_of)?;
    let start = chosen_start(options, &session)?;
    if let Some(diagnostic) = source.views_inside(&session) {
        return refuse(&compiled, diagnostic);
    }
    let head = log::Start::of(
        &session,
        &options.file,
        &source.name(),
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
    outputs::writable(options)?;
    let page = options
        .report
        .is_some()
        .then(|| show::Report::begin(head.clone(), &session));
    let mut recorder = Recorder::begin(options.log.as_deref(), page, head, logged.len())?;
    let drive = Drive {
        noise,
        seed: options.seed,
        logged: &logged,
        recorder: &mut recorder,
    };
    let end = source.drive(&mut session, start, drive)?;
    let mut summary = show::summary(recorder.records(), &source.name());
    summary += &options.log.as_deref().map_or(String::new(), why_line);
    if outputs::use_stdout(options) {
        report(&summary)?;
    } else {
        print(&summary)?;
    }
    outputs::write(options, &session, &recorder)?;
    Ok(if end == plan::Outcome::Goal {
        Outcome::Done
    } else {
        Outcome::GoalMissed
    })
}

/// Where the run can be asked about.
fn why_line(log: &Path) -> String {
    if is_stdout(log) {
        return String::new();
    }
    let log = log.display().to_string();
    let quote = if log.contains(char::is_whitespace) { "'" } else { "" };
    format!("why         vpl why {quote}{log}{quote} SUBJECT: a rule, a feature, a class, or `view N`\n")
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
