//! `vpl completions`: what a shell needs to complete commands.

use clap::{Args, CommandFactory};
use clap_complete::Shell;

use super::{Cli, Failure, Outcome, print};

/// Write the completions of a shell.
#[derive(Args)]
#[command(after_help = "Examples:
  vpl completions bash > ~/.local/share/bash-completion/completions/vpl
  vpl completions fish > ~/.config/fish/completions/vpl.fish")]
pub(crate) struct Completions {
    /// The shell.
    #[arg(value_enum)]
    shell: Shell,
}

pub(crate) fn run(options: &Completions) -> Result<Outcome, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(options.shell, &mut Cli::command(), "vpl", &mut script);
    print(&String::from_utf8_lossy(&script))?;
    Ok(Outcome::Done)
}
