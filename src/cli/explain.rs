//! `vpl explain`: what a code means, with a program that fails and one that does not.

use std::io;

use clap::Args;

use super::files::coloured;
use super::{Failure, Outcome, print};
use crate::lang::{self, Code};

/// Explain the code of a diagnostic, or list all codes.
#[derive(Args)]
#[command(after_help = "Examples:
  vpl explain E0302
  vpl explain")]
pub(crate) struct Explain {
    /// The code, in capitals or not; all are listed without it.
    code: Option<String>,
}

pub(crate) fn run(options: &Explain) -> Result<Outcome, Failure> {
    let Some(code) = &options.code else {
        print(&lang::list_of_codes())?;
        return Ok(Outcome::Done);
    };
    let code: Code = code.parse().map_err(|_| unknown(code))?;
    print(&lang::explain(code, coloured(&io::stdout())))?;
    Ok(Outcome::Done)
}

fn unknown(code: &str) -> Failure {
    let near: Vec<String> = lang::similar_codes(code).iter().map(|c| format!("`{c}`")).collect();
    let advice = match near.is_empty() {
        true => "`vpl explain` lists all".to_owned(),
        false => format!("near it are {}", near.join(", ")),
    };
    Failure::Usage(format!("there is no code `{code}`; {advice}"))
}
