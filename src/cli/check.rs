//! `vpl check`: everything that is known about a program before it runs.

use clap::{Args, ValueEnum};

use super::files::{Disk, human};
use super::{Failure, Outcome, print, report};
use crate::lang::{self, Compilation, Diagnostic, Format, Severity, SourceMap, render};

/// Check programs: syntax, names, types, units, and what is known about their tasks.
#[derive(Args)]
#[command(after_help = "Example: vpl check examples/solids/solids.vpl")]
pub(crate) struct Check {
    /// The programs; `-` is standard input.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<String>,
    /// How to write diagnostics.
    #[arg(long, value_enum, default_value_t = Form::Human)]
    format: Form,
    /// What to treat as errors.
    #[arg(long, value_enum, value_name = "KIND")]
    deny: Option<Deny>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Form {
    /// With the source around.
    Human,
    /// Without drawing or colour.
    Plain,
    /// One line each.
    Short,
    /// One array, on standard output.
    Json,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Deny {
    /// Warnings fail the check.
    Warnings,
}

pub(crate) fn run(options: &Check) -> Result<Outcome, Failure> {
    let checked: Vec<Compilation> = options.files.iter().map(|file| lang::compile(file, &Disk)).collect();
    match options.format {
        Form::Json => print(&json(&checked))?,
        form => {
            for one in &checked {
                report(&render(&one.diagnostics, &one.sources, format(form)))?;
            }
            report(&summary(&checked))?;
        }
    }
    let worst = if options.deny.is_some() {
        Severity::Warning
    } else {
        Severity::Error
    };
    let failed = checked.iter().flat_map(|c| &c.diagnostics).any(|d| d.severity <= worst);
    Ok(if failed { Outcome::WrongInput } else { Outcome::Done })
}

fn format(form: Form) -> Format {
    match form {
        Form::Human => human(),
        Form::Plain => Format::Plain,
        Form::Short => Format::Short,
        Form::Json => Format::Json,
    }
}

/// One array over all files.
fn json(checked: &[Compilation]) -> String {
    let mut sources = SourceMap::default();
    let mut all: Vec<Diagnostic> = Vec::new();
    for one in checked {
        let first = sources.append(&one.sources);
        all.extend(one.diagnostics.iter().cloned().map(|d| d.moved(first)));
    }
    render(&all, &sources, Format::Json)
}

/// `2 errors, 1 warning in 1 file`.
fn summary(checked: &[Compilation]) -> String {
    let count = |severity| {
        let all = checked.iter().flat_map(|c| &c.diagnostics);
        all.filter(|d| d.severity == severity).count()
    };
    let files = plural(checked.len(), "file");
    let (errors, warnings) = (count(Severity::Error), count(Severity::Warning));
    match (errors, warnings) {
        (0, 0) => format!("no errors in {files}\n"),
        (0, w) => format!("{} in {files}\n", plural(w, "warning")),
        (e, 0) => format!("{} in {files}\n", plural(e, "error")),
        (e, w) => format!("{}, {} in {files}\n", plural(e, "error"), plural(w, "warning")),
    }
}

fn plural(n: usize, noun: &str) -> String {
    format!("{n} {noun}{}", if n == 1 { "" } else { "s" })
}
