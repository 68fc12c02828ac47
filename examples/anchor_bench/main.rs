//! The map and the scorer on the inputs of other libraries' harnesses.
//!
//! ```text
//! cargo run --release --example anchor_bench -- JOB FILE RES [--threads N] [--mode MODE] [--frames N]
//! ```
//!
//! `FILE` is one of posed clouds (`.vpc`), depth images (`.vdi`) or a mesh (`.vmesh`);
//! `RES` is a voxel's edge in metres. Prints a JSON line a measurement, with the fields
//! that OctoMap's and OpenVDB's harnesses print. Seconds are the process's on one
//! thread, so that a busy machine distorts them little, and the wall clock's on more.

mod files;
mod insert;
mod meter;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, ValueEnum};

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Job {
    /// Insertion of posed clouds.
    Insert,
    /// Insertion of depth images.
    InsertDepth,
}

/// Measures the map on a file of posed clouds, depth images or a mesh.
#[derive(Debug, Parser)]
struct Arguments {
    job: Job,
    file: PathBuf,
    /// Edge of a voxel, metres.
    res: f64,
    #[arg(long, default_value_t = 1)]
    threads: usize,
    /// How: what there is depends on the job.
    #[arg(long)]
    mode: Option<String>,
    /// The first so many frames; 0 for all.
    #[arg(long, default_value_t = 0)]
    frames: usize,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(arguments.threads);
    let measured = match pool.build_global() {
        Err(error) => Err(error.to_string()),
        Ok(()) => measure(&arguments),
    };
    match measured {
        Ok(lines) => {
            lines.iter().for_each(|line| println!("{line}"));
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("{}: {message}", arguments.file.display());
            ExitCode::from(2)
        }
    }
}

fn measure(arguments: &Arguments) -> Result<Vec<serde_json::Value>, String> {
    match arguments.job {
        Job::Insert => Err("no clouds yet".to_owned()),
        Job::InsertDepth => insert::depth(arguments),
    }
}
