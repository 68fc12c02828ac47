//! Writes `src/` from `grammar.js`: `cargo run --features generate --bin generate`.
//!
//! With `--check` it writes nothing, and fails where `src/` is not what the grammar
//! gives. It needs `node`, which runs the grammar.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use tree_sitter_generate::{OptLevel, generate_parser_in_directory};

/// The newest that Neovim 0.9 reads.
const ABI: usize = 14;
/// What generation writes, below `src/`.
const FILES: [&str; 6] = [
    "grammar.json",
    "node-types.json",
    "parser.c",
    "tree_sitter/alloc.h",
    "tree_sitter/array.h",
    "tree_sitter/parser.h",
];

fn main() -> ExitCode {
    let committed = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let result = match std::env::args().nth(1).as_deref() {
        None => generate(&committed),
        Some("--check") => check(&committed),
        Some(other) => Err(format!("unknown argument `{other}`")),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("error: {problem}");
            ExitCode::FAILURE
        }
    }
}

fn generate(into: &Path) -> Result<(), String> {
    let here = env!("CARGO_MANIFEST_DIR");
    let grammar = None::<PathBuf>;
    let mut remarks = Vec::new();
    generate_parser_in_directory(
        here,
        Some(into),
        grammar,
        ABI,
        None,
        None,
        true,
        OptLevel::default(),
        &mut remarks,
    )
    .map_err(|problem| problem.to_string())?;
    match remarks.first() {
        None => Ok(()),
        Some(remark) => Err(remark.to_string()),
    }
}

fn check(committed: &Path) -> Result<(), String> {
    let fresh = std::env::temp_dir().join(format!("tree-sitter-vpl-{}", std::process::id()));
    generate(&fresh)?;
    let read = |below: &Path, file: &str| std::fs::read(below.join(file)).ok();
    let stale = FILES
        .into_iter()
        .find(|file| read(committed, file) != read(&fresh, file));
    let _ = std::fs::remove_dir_all(&fresh);
    match stale {
        None => Ok(()),
        Some(file) => Err(format!("src/{file} is not what grammar.js gives: run without --check")),
    }
}
