use std::process::ExitCode;

fn main() -> ExitCode {
    vpl::cli::run(std::env::args_os())
}
