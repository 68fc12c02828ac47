//! `vpl lsp`: the language server, on standard input and output.

use std::io;

use clap::Args;

use super::files::Disk;
use super::{Failure, Outcome};
use crate::lsp::serve;

/// Serve an editor over the Language Server Protocol, on standard input and output.
#[derive(Args)]
#[command(after_help = "Example, in an editor's settings: command = \"vpl\", args = [\"lsp\"]")]
pub(crate) struct Lsp {
    /// Accepted, for editors that name the transport: there is no other.
    #[arg(long)]
    stdio: bool,
}

pub(crate) fn run(options: &Lsp) -> Result<Outcome, Failure> {
    let Lsp { stdio: _ } = options;
    let agreed = serve(io::stdin(), io::stdout().lock(), Box::new(Disk))
        .map_err(|error| Failure::Write("standard output".into(), error))?;
    Ok(if agreed { Outcome::Done } else { Outcome::WrongInput })
}
