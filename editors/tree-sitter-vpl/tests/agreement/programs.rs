//! Every `.vpl` file of the tree with the compiler's tokens, which `examples/tokens.rs`
//! prints; each once more with carriage returns, and with a byte order mark.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use serde_json::Value;

pub struct Program {
    pub path: String,
    pub text: String,
    /// Whether the compiler finds no fault with its syntax.
    pub well_formed: bool,
    pub tokens: Vec<Token>,
}

pub struct Token {
    /// The name of the compiler's class.
    pub class: String,
    pub start: usize,
    pub end: usize,
}

pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .canonicalize()
        .unwrap()
}

pub fn programs() -> &'static [Program] {
    static ALL: OnceLock<Vec<Program>> = OnceLock::new();
    ALL.get_or_init(|| {
        let files = files();
        let others = files.iter().enumerate().flat_map(|(at, file)| variants(at, file));
        read(&others.chain(files.clone()).collect::<Vec<_>>())
    })
}

/// Every `.vpl` file below the root, in order.
fn files() -> Vec<PathBuf> {
    let mut folders = vec![root()];
    let mut found = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_string_lossy();
            if path.is_dir() && !name.starts_with('.') && !["target", "node_modules"].contains(&&*name) {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "vpl") && std::fs::read_to_string(&path).is_ok() {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// The same program as other editors save it.
fn variants(at: usize, file: &Path) -> [PathBuf; 2] {
    let text = std::fs::read_to_string(file).unwrap();
    let name = file.file_stem().unwrap().to_string_lossy();
    let others = [("crlf", text.replace('\n', "\r\n")), ("bom", format!("\u{feff}{text}"))];
    others.map(|(how, text)| {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{at}-{name}-{how}.vpl"));
        std::fs::write(&path, text).unwrap();
        path
    })
}

/// Asks the compiler.
fn read(files: &[PathBuf]) -> Vec<Program> {
    let mut cargo = Command::new(env!("CARGO"));
    cargo
        .args(["run", "--quiet", "--locked", "--example", "tokens"])
        .current_dir(root());
    if !cfg!(debug_assertions) {
        cargo.arg("--release");
    }
    let output = cargo.arg("--").args(files).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap().lines().map(program).collect()
}

fn program(line: &str) -> Program {
    let read: Value = serde_json::from_str(line).unwrap();
    let path = read["file"].as_str().unwrap().to_owned();
    Program {
        text: std::fs::read_to_string(&path).unwrap(),
        path,
        well_formed: read["well_formed"].as_bool().unwrap(),
        tokens: read["tokens"].as_array().unwrap().iter().map(token).collect(),
    }
}

fn token(triple: &Value) -> Token {
    let byte = |at: usize| triple[at].as_u64().unwrap() as usize;
    Token {
        class: triple[0].as_str().unwrap().to_owned(),
        start: byte(1),
        end: byte(2),
    }
}
