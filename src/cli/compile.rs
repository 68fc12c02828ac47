//! `vpl compile`: the rule set as JSON.

use std::path::{Path, PathBuf};

use clap::Args;

use super::files::{Disk, human};
use super::{Failure, Outcome, more, print, report};
use crate::lang::{self, render};

/// Compile a program to its rule set, written as JSON.
#[derive(Args)]
#[command(after_help = "Example: vpl compile examples/solids/solids.vpl -o solids.json")]
pub(crate) struct Compile {
    /// The program; `-` is standard input.
    file: String,
    /// Where to write; standard output by default, and for `-`.
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
}

pub(crate) fn run(options: &Compile) -> Result<Outcome, Failure> {
    let compiled = lang::compile(&options.file, &Disk).without_notes();
    report(&render(&compiled.diagnostics, &compiled.sources, human()))?;
    report(&more([&compiled], human()))?;
    let Some(rules) = compiled.rules else {
        return Ok(Outcome::WrongInput);
    };
    match options.output.as_deref().filter(|out| *out != Path::new("-")) {
        None => print(&rules.to_json())?,
        Some(out) => std::fs::write(out, rules.to_json())
            .map_err(|error| Failure::Write(format!("`{}`", out.display()), error))?,
    }
    Ok(Outcome::Done)
}
