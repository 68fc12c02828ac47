//! The command line: one file a verb.

mod check;
mod compile;
mod completions;
mod explain;
mod files;
mod fmt;
mod inspect;
mod lsp;
mod new;
mod output;
mod plan;
mod recording;
mod study;
mod test;
mod why;

pub use files::Disk;

use std::ffi::OsString;
use std::io::{self, Write};
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::lang::{Code, Compilation, Format, Severity};

/// View Planning Language: say what to perceive, get the next best view.
#[derive(Parser)]
#[command(name = "vpl", version, about, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    New(new::New),
    Check(check::Check),
    Explain(explain::Explain),
    Compile(compile::Compile),
    Fmt(fmt::Fmt),
    Lsp(lsp::Lsp),
    Plan(Box<plan::Plan>),
    Inspect(inspect::Inspect),
    Study(study::Study),
    Test(test::Test),
    Why(why::Why),
    Completions(completions::Completions),
}

/// How a command ended; the numbers are its exit status.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// Done.
    Done = 0,
    /// The input is wrong, and diagnostics said where.
    WrongInput = 1,
    /// A run ended without its goal.
    GoalMissed = 3,
}

/// Why a command could not do its work.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// A result could not be written.
    #[error("error[{code}]: {0} cannot be written: {1}", code = Code::E0601)]
    Write(String, io::Error),
    /// A run log is not of the run that would be continued.
    #[error("error[{code}]: {0} cannot be resumed: {1}", code = Code::E0602)]
    Resume(String, String),
    /// A run could not be made or continued.
    #[error("error[{code}]: {0}", code = Code::E0603)]
    Run(String),
    /// A layout would not have been the same program.
    #[error("error[{code}]: {0} is left as it is: laid out it would be another program", code = Code::E0604)]
    Layout(String),
    /// Recorded frames cannot be used.
    #[error("error[{code}]: {0}", code = Code::E0611)]
    Recording(String),
    /// A file is no OctoMap tree.
    #[error("error[{code}]: {0} cannot be read as an OctoMap file: {1}", code = Code::E0612)]
    OctoMap(String, String),
    /// A folder holds something else than the study's rows.
    #[error("error[{code}]: {0}", code = Code::E0605)]
    Folder(String),
    /// A run log cannot be read.
    #[error("error[{code}]: {0} cannot be read: {1}", code = Code::E0711)]
    Log(String, String),
    /// A file is no run log.
    #[error("error[{code}]: {0} is no run log: {1}", code = Code::E0712)]
    NoLog(String, String),
    /// A question about something that a run does not know.
    #[error("error[{code}]: {0}", code = Code::E0713)]
    Subject(String),
    /// A question about a view that a run does not have.
    #[error("error[{code}]: {0}", code = Code::E0714)]
    Moment(String),
    /// The command was called wrongly.
    #[error("error: {0}")]
    Usage(String),
}

impl Failure {
    /// The exit status: 2 where the command was called wrongly.
    fn status(&self) -> u8 {
        match self {
            Self::Usage(_) | Self::Subject(_) | Self::Moment(_) => 2,
            _ => 1,
        }
    }
}

/// Runs the program with its arguments, the program's name first.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(error) => return usage(&error),
    };
    let outcome = match cli.verb {
        Verb::New(new) => new::run(&new),
        Verb::Check(check) => check::run(&check),
        Verb::Explain(explain) => explain::run(&explain),
        Verb::Compile(compile) => compile::run(&compile),
        Verb::Fmt(fmt) => fmt::run(&fmt),
        Verb::Lsp(lsp) => lsp::run(&lsp),
        Verb::Plan(plan) => plan::run(&plan),
        Verb::Inspect(inspect) => inspect::run(&inspect),
        Verb::Study(study) => study::run(&study),
        Verb::Test(test) => test::run(&test),
        Verb::Why(why) => why::run(&why),
        Verb::Completions(completions) => completions::run(&completions),
    };
    match outcome {
        Ok(outcome) => ExitCode::from(outcome as u8),
        // Whoever read the output has seen enough.
        Err(Failure::Write(_, error)) if error.kind() == io::ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(failure) => {
            let _ = writeln!(io::stderr(), "{failure}");
            ExitCode::from(failure.status())
        }
    }
}

fn usage(error: &clap::Error) -> ExitCode {
    let _ = error.print();
    ExitCode::from(if error.use_stderr() { 2 } else { 0 })
}

/// Writes a result to standard output.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())
        .and_then(|()| out.flush())
        .map_err(|error| Failure::Write("standard output".into(), error))
}

/// Writes diagnostics or progress to standard error. Where nobody reads it any
/// more, the work goes on all the same.
pub(crate) fn report(text: &str) -> Result<(), Failure> {
    match io::stderr().lock().write_all(text.as_bytes()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::Write("standard error".into(), error)),
        _ => Ok(()),
    }
}

/// Where a report for people says how to learn more: of the first error.
pub(crate) fn more<'a>(checked: impl IntoIterator<Item = &'a Compilation>, format: Format) -> String {
    let mut all = checked.into_iter().flat_map(|c| &c.diagnostics);
    match (format, all.find(|d| d.severity == Severity::Error)) {
        (Format::Human { .. }, Some(first)) => format!("for more, run `vpl explain {}`\n", first.code),
        _ => String::new(),
    }
}
