//! The map and the scorer on the inputs of other libraries' harnesses.
//!
//! ```text
//! cargo run --release --example anchor_bench -- JOB FILE RES [--threads N] [--mode MODE] [--frames N]
//! ```
//!
//! `FILE` is one of posed clouds (`.vpc`), depth images (`.vdi`) or a mesh (`.vmesh`);
//! `RES` is a voxel's edge in metres. To `render` a mesh, the file of depth images to
//! hold against it takes the place of `RES`. Prints a JSON line a measurement, with the fields
//! that OctoMap's and OpenVDB's harnesses print. Seconds are the process's on one
//! thread, so that a busy machine distorts them little, and the wall clock's on more.

mod files;
mod insert;
mod meter;
mod render;
mod views;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use clap::builder::PossibleValuesParser;
use serde_json::Value;

/// Measures and gives the lines to print, or what is wrong with the file or the options.
type Run = fn(&Arguments) -> Result<Vec<Value>, String>;

/// Every job, one function in a file of its own.
const JOBS: &[(&str, Run)] = &[
    ("insert", insert::clouds),
    ("insert-depth", insert::depth),
    ("gain", views::gain),
    ("distinct", views::distinct),
    ("first", views::first),
    ("render", render::depth),
];

/// Measures the map on a file of posed clouds, depth images or a mesh.
#[derive(Debug, Parser)]
struct Arguments {
    /// What is measured.
    #[arg(value_parser = PossibleValuesParser::new(JOBS.iter().map(|job| job.0)))]
    job: String,
    file: PathBuf,
    /// Edge of a voxel, metres; to render, the depth images whose views are drawn.
    #[arg(value_name = "RES")]
    against: String,
    /// Edge of a voxel, metres.
    #[arg(skip)]
    res: f64,
    #[arg(long, default_value_t = 1)]
    threads: usize,
    /// How: what there is depends on the job.
    #[arg(long)]
    mode: Option<String>,
    /// The first so many frames; 0 for all.
    #[arg(long, default_value_t = 0)]
    frames: usize,
    #[command(flatten)]
    images: views::Images,
}

impl Arguments {
    /// The name of the data: the file's without its ending.
    fn data(&self) -> String {
        let stem = self.file.file_stem().unwrap_or_default();
        stem.to_string_lossy().into_owned()
    }
}

fn main() -> ExitCode {
    let mut arguments = Arguments::parse();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(arguments.threads);
    let measured = match pool.build_global() {
        Err(error) => Err(error.to_string()),
        Ok(()) => measure(&mut arguments),
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

fn measure(arguments: &mut Arguments) -> Result<Vec<Value>, String> {
    if arguments.job != "render" {
        let edge = arguments
            .against
            .parse()
            .ok()
            .filter(|edge: &f64| edge.is_finite() && *edge > 0.0);
        arguments.res = edge.ok_or_else(|| format!("a voxel's edge must be above 0 m, not {}", arguments.against))?;
    }
    let job = JOBS.iter().find(|job| job.0 == arguments.job);
    job.map_or_else(|| Err("no such job".to_owned()), |job| (job.1)(arguments))
}
