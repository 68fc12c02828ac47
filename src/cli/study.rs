//! `vpl study`: many objects × methods × starts, and what they say.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};

use super::files::{Disk, human};
use super::{Failure, Outcome, more, print, report};
use crate::lang::{self, render};
use crate::rules::Study as Suite;
use crate::study::published::Published;
use crate::study::{self, Design, Ledger, Manifest, Shard, StudyError, execute, summary};

/// Run a suite of experiments: objects × methods × starts, with bounds and intervals.
///
/// Rows are kept as they come: what was stopped goes on where it stopped.
#[derive(Args)]
#[command(after_help = "Example: vpl study examples/studies/recognition.vpl --out results")]
pub(crate) struct Study {
    /// The suite: a program with a `study`; `-` is standard input.
    suite: String,
    /// Where rows, tables, plots and index.html go; `study-NAME` where left out.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Which study; the first of the file where left out.
    #[arg(long, value_name = "NAME")]
    study: Option<String>,
    /// Only every N-th run, from the I-th on; I counts from 1.
    #[arg(long, value_name = "I/N")]
    shard: Option<String>,
    /// Take in the rows of other folders first, and make no run.
    #[arg(long, value_name = "DIR", num_args = 1.., conflicts_with = "shard")]
    merge: Vec<PathBuf>,
    /// Threads; the result is the same for any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Print what would be run, and stop.
    #[arg(long)]
    dry_run: bool,
}

pub(crate) fn run(options: &Study) -> Result<Outcome, Failure> {
    if let Some(threads) = options.threads {
        // It fails only where a pool exists already, which then serves as well.
        let _ = rayon::ThreadPoolBuilder::new()
            .num_threads(threads.into())
            .build_global();
    }
    let shard = options.shard.as_deref().map_or(Ok(Shard::WHOLE), part)?;
    let compiled = lang::compile(&options.suite, &Disk).without_notes();
    report(&render(&compiled.diagnostics, &compiled.sources, human()))?;
    report(&more([&compiled], human()))?;
    if compiled.has_errors() {
        return Ok(Outcome::WrongInput);
    }
    let suite = chosen(compiled.studies, options.study.as_deref())?;
    let published = suite.published.as_deref().map(Published::read).transpose()?;
    let design = Design::new(suite)?;
    let due = design.jobs.iter().filter(|job| shard.has(job)).count();
    if options.dry_run {
        print(&planned(&design, due))?;
        return Ok(Outcome::Done);
    }
    let usual = || PathBuf::from(format!("study-{}", design.study.name));
    let folder = options.out.clone().unwrap_or_else(usual);
    let waiting = |file: &Path| {
        let _ = report(&format!(
            "waiting for another vpl that writes to `{}`\n",
            file.display()
        ));
    };
    let mut ledger = Ledger::open(&folder, Manifest::of(&design), shard, waiting)?;
    for other in &options.merge {
        ledger.take_in(other)?;
    }
    if options.merge.is_empty() {
        make(&design, shard, due, &mut ledger)?;
    }
    if !ledger.is_whole() {
        report(&left(&ledger, &design, shard))?;
        if shard != Shard::WHOLE {
            return Ok(Outcome::Done);
        }
    }
    ledger.sort()?;
    let summed = summary::summarise(&design, ledger.rows());
    let tables = study::report::write(&design, &summed, published.as_ref(), &ledger)?;
    print(&tables)?;
    report(&format!("see {}\n", folder.join("index.html").display()))?;
    Ok(Outcome::Done)
}

/// Makes the runs of a shard that have no row yet.
fn make(design: &Design, shard: Shard, due: usize, ledger: &mut Ledger) -> Result<(), Failure> {
    let known: std::collections::BTreeSet<u64> = ledger.rows().keys().copied().collect();
    let done = design
        .jobs
        .iter()
        .filter(|job| shard.has(job) && known.contains(&job.index))
        .count();
    report(&format!("{due} runs, {done} of them made before\n"))?;
    // Hidden by itself where standard error is no terminal.
    let bar = ProgressBar::new(due as u64).with_style(style());
    bar.set_position(done as u64);
    bar.reset_eta();
    let missing = |job: &study::Job| shard.has(job) && !known.contains(&job.index);
    let made = execute(design, missing, |row| {
        bar.set_message(format!("{} {}", row.object, row.method));
        ledger.add(row)?;
        bar.inc(1);
        Ok(())
    });
    bar.finish_and_clear();
    Ok(made?)
}

fn style() -> ProgressStyle {
    let style = ProgressStyle::with_template("{wide_bar} {pos}/{len} runs, {eta} left  {msg}");
    style.unwrap_or_else(|_| ProgressStyle::default_bar())
}

fn left(ledger: &Ledger, design: &Design, shard: Shard) -> String {
    let (done, all) = (ledger.rows().len(), design.jobs.len());
    match shard {
        Shard::WHOLE => format!("{done} of {all} runs: run it without `--merge` to make the others\n"),
        Shard { number, of } => format!(
            "shard {number}/{of} is done, {done} of {all} runs are here; run it without `--shard` once all shards are\n"
        ),
    }
}

fn chosen(studies: Vec<Suite>, name: Option<&str>) -> Result<Suite, Failure> {
    let known: Vec<String> = studies.iter().map(|s| format!("`{}`", s.name)).collect();
    let mut studies = studies.into_iter();
    let found = match name {
        Some(name) => studies.find(|s| s.name == name),
        None => studies.next(),
    };
    found.ok_or_else(|| {
        Failure::Usage(match name {
            Some(name) if !known.is_empty() => format!("there is no study `{name}`; the file has {}", known.join(", ")),
            _ => "the file has no study; add `study NAME { … }`".to_owned(),
        })
    })
}

fn planned(design: &Design, due: usize) -> String {
    let arms: Vec<&str> = design.arms.iter().map(|arm| arm.label.as_str()).collect();
    format!(
        "study       {}\ntask        {}\nobjects     {}\nstarts      {}\nmethods     {}\nruns        {due} of {}\n",
        design.study.name,
        design.study.task,
        design.study.objects.len(),
        design.study.starts,
        arms.join(", "),
        design.jobs.len(),
    )
}

/// `2/8`.
fn part(text: &str) -> Result<Shard, Failure> {
    let parts = text
        .split_once('/')
        .and_then(|(i, n)| Some((u64::from_str(i).ok()?, u64::from_str(n).ok()?)));
    match parts {
        Some((number, of)) if 1 <= number && number <= of => Ok(Shard { number, of }),
        _ => Err(Failure::Usage(format!(
            "`--shard {text}` is no part: write `I/N` with I from 1 to N, like `2/8`"
        ))),
    }
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::Write(what, error) => Self::Write(format!("`{what}`"), error),
            StudyError::Folder { .. } => Self::Folder(error.to_string()),
            other => Self::Run(other.to_string()),
        }
    }
}
