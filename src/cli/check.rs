//! `vpl check`: everything that is known about a program before it runs, and the
//! repair of what can be repaired.

use clap::{Args, ValueEnum};

use super::files::{self, Disk, STDIN, human};
use super::{Failure, Outcome, more, print, report};
use crate::lang::{self, Applied, Compilation, Diagnostic, Format, Severity, SourceMap, render};

/// Check programs: syntax, names, types, units, and what is known about their tasks.
#[derive(Args)]
#[command(after_help = "Examples:
  vpl check examples/solids/solids.vpl
  vpl check --fix --deny warnings *.vpl
  vpl check --format sarif tasks/*.vpl > vpl.sarif")]
pub(crate) struct Check {
    /// The programs; `-` is standard input.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<String>,
    /// How to write diagnostics.
    #[arg(long, value_enum, default_value_t = Form::Human)]
    format: Form,
    /// Make the fixes that are offered, where each removes its cause and adds no
    /// error; of standard input the fixed text goes to standard output.
    #[arg(long)]
    fix: bool,
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
    /// One SARIF 2.1.0 log, on standard output.
    Sarif,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Deny {
    /// Warnings fail the check.
    Warnings,
}

pub(crate) fn run(options: &Check) -> Result<Outcome, Failure> {
    let checked = if options.fix {
        fixed(options)?
    } else {
        options.files.iter().map(|file| lang::compile(file, &Disk)).collect()
    };
    match format(options.format) {
        form @ (Format::Json | Format::Sarif) => print(&together(&checked, form))?,
        form => {
            for one in &checked {
                report(&render(&one.diagnostics, &one.sources, form))?;
            }
            report(&summary(&checked))?;
            report(&more(&checked, form))?;
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
        Form::Sarif => Format::Sarif,
    }
}

/// Repairs every program, then checks them: one can be the module of another.
fn fixed(options: &Check) -> Result<Vec<Compilation>, Failure> {
    let on_stdout = matches!(options.format, Form::Json | Form::Sarif);
    if on_stdout && options.files.iter().any(|file| file == STDIN) {
        let both =
            "`--fix -` writes the program to standard output, where the diagnostics go too: choose another format";
        return Err(Failure::Usage(both.into()));
    }
    let mut piped = None;
    for file in &options.files {
        let repaired = lang::repair(file, &Disk);
        let Some(text) = &repaired.text else {
            continue;
        };
        if file == STDIN {
            print(text)?;
        } else if !repaired.applied.is_empty() {
            files::replace(file, text)?;
        }
        if !on_stdout {
            report(&made(file, &repaired.applied))?;
        }
        if file == STDIN {
            piped = Some(repaired.compilation);
        }
    }
    let again = |file: &String| match piped.take_if(|_| file == STDIN) {
        Some(compilation) => compilation,
        None => lang::compile(file, &Disk),
    };
    Ok(options.files.iter().map(again).collect())
}

/// What was done to a file, one line a fix, then how many there were.
fn made(file: &str, applied: &[Applied]) -> String {
    let mut out = String::new();
    for fix in applied {
        out.push_str(&format!(
            "{file}:{}:{}: fixed[{}]: {}\n",
            fix.line, fix.column, fix.code, fix.message
        ));
    }
    if !applied.is_empty() {
        out.push_str(&format!("fixed {} in {file}\n", applied.len()));
    }
    out
}

/// All files as one report.
fn together(checked: &[Compilation], format: Format) -> String {
    let mut sources = SourceMap::default();
    let mut all: Vec<Diagnostic> = Vec::new();
    for one in checked {
        let first = sources.append(&one.sources);
        all.extend(one.diagnostics.iter().cloned().map(|d| d.moved(first)));
    }
    render(&all, &sources, format)
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
