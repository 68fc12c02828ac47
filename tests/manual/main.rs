//! The manual says only what is so: every VPL block in README and docs is compiled,
//! and every console block that begins with `$ vpl` is run and compared.
//!
//! - A `vpl` block that begins with `vpl 1` is a whole program, without errors or warnings,
//!   and laid out as `vpl fmt` does.
//! - `vpl,NAME.vpl` appends to a file that the page's console blocks can use.
//! - Any other `vpl` block is a fragment: items, entries of a library, statements of
//!   a rule, a task or a scene. It must fit into one of the frames of `fragment`.
//! - In a console block, `...` at the end of a line or alone on one stands for anything.
//!
//! `UPDATE_MANUAL=1 cargo test --release --test manual` writes the console blocks anew.

mod fragment;
mod page;

use std::path::{Path, PathBuf};
use std::process::Command;

use page::{Block, Kind};
use vpl::lang::{self, Code, Memory, Severity};

fn pages() -> Vec<PathBuf> {
    let mut found = vec![PathBuf::from("README.md")];
    let mut folders = vec![PathBuf::from("docs")];
    while let Some(folder) = folders.pop() {
        // Pages of diagnostics hold programs that fail: tests/check holds them.
        if folder.ends_with("diagnostics") {
            continue;
        }
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            match path.extension().and_then(|e| e.to_str()) {
                _ if path.is_dir() => folders.push(path),
                Some("md") => found.push(path),
                _ => {}
            }
        }
    }
    found.sort();
    found
}

#[test]
fn every_program_of_the_manual_is_right() {
    let mut wrong = Vec::new();
    for path in pages() {
        let blocks = page::blocks(&std::fs::read_to_string(&path).unwrap());
        for block in blocks {
            let said = match &block.kind {
                Kind::Program => whole(&block.text),
                Kind::Fragment => fragment::check(&block.text),
                Kind::Part(_) | Kind::Console => continue,
            };
            wrong.extend(said.map(|said| format!("{}:{}: {said}", path.display(), block.line)));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_program_of_the_manual_is_laid_out() {
    let mut wrong = Vec::new();
    for path in pages() {
        let blocks = page::blocks(&std::fs::read_to_string(&path).unwrap());
        let programs = blocks
            .iter()
            .filter(|b| matches!(b.kind, Kind::Program | Kind::Part(_)));
        for block in programs {
            let laid_out = lang::format(&block.text).text;
            let first = block.text.lines().zip(laid_out.lines()).find(|(a, b)| a != b);
            wrong.extend(first.map(|(is, due)| format!("{}:{}:\n  {is}\n  {due}", path.display(), block.line)));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What is wrong with a whole program.
fn whole(text: &str) -> Option<String> {
    let compiled = lang::compile("main.vpl", &Memory::of("main.vpl", text));
    let said = compiled.diagnostics.iter().find(|d| d.severity != Severity::Note)?;
    Some(format!("{}: {}", said.code, said.message))
}

#[test]
fn every_transcript_of_the_manual_is_what_the_program_says() {
    for path in pages() {
        let text = std::fs::read_to_string(&path).unwrap();
        let blocks = page::blocks(&text);
        if !blocks.iter().any(|b| b.kind == Kind::Console) {
            continue;
        }
        let folder = std::env::temp_dir().join(format!("vpl-manual-{}-{}", std::process::id(), name(&path)));
        std::fs::create_dir_all(&folder).unwrap();
        // Console blocks speak of the repository's files, too.
        for shared in ["examples", "stdlib"] {
            link(&std::env::current_dir().unwrap().join(shared), &folder.join(shared));
        }
        let said = transcripts(&blocks, &folder);
        std::fs::remove_dir_all(&folder).unwrap();
        if std::env::var_os("UPDATE_MANUAL").is_some() {
            std::fs::write(&path, page::with(&text, &said)).unwrap();
            continue;
        }
        for (block, said) in said {
            assert!(
                page::alike(&block.text, &said),
                "{}:{}: the program says\n{said}",
                path.display(),
                block.line
            );
        }
    }
}

fn name(path: &Path) -> String {
    path.file_stem().unwrap().to_str().unwrap().to_owned()
}

#[cfg(unix)]
fn link(from: &Path, to: &Path) {
    let _ = std::fs::remove_file(to);
    std::os::unix::fs::symlink(from, to).unwrap();
}

#[cfg(windows)]
fn link(from: &Path, to: &Path) {
    std::os::windows::fs::symlink_dir(from, to).unwrap();
}

/// Each console block with what its commands say now.
fn transcripts<'a>(blocks: &'a [Block], folder: &Path) -> Vec<(&'a Block, String)> {
    let mut said = Vec::new();
    for block in blocks {
        match &block.kind {
            Kind::Part(name) => append(&folder.join(name), &block.text),
            Kind::Console => said.push((block, console(&block.text, folder))),
            Kind::Program | Kind::Fragment => {}
        }
    }
    said
}

fn append(file: &Path, text: &str) {
    let before = std::fs::read_to_string(file).unwrap_or_default();
    let gap = if before.is_empty() { "" } else { "\n" };
    std::fs::write(file, format!("{before}{gap}{text}")).unwrap();
}

/// The block with the commands' answers: standard output, then standard error.
fn console(text: &str, folder: &Path) -> String {
    let mut out = String::new();
    for line in text.lines().filter(|line| line.starts_with("$ ")) {
        out.push_str(line);
        out.push('\n');
        let words: Vec<&str> = line[2..].split_whitespace().collect();
        assert_eq!(words.first(), Some(&"vpl"), "only `vpl` is run: {line}");
        let run = Command::new(env!("CARGO_BIN_EXE_vpl"))
            .args(&words[1..])
            .current_dir(folder)
            .env("NO_COLOR", "1")
            .output()
            .unwrap();
        for stream in [run.stderr, run.stdout] {
            let text = String::from_utf8(stream).unwrap();
            out.push_str(text.trim_end());
            if !text.trim().is_empty() {
                out.push('\n');
            }
        }
    }
    out
}

/// A test of the tests: what is wrong is found.
#[test]
fn wrong_blocks_are_found() {
    assert!(whole("vpl 1\nlet a = b\n").is_some());
    assert!(fragment::check("feature a : polygone").is_some());
    assert!(fragment::check("near: 10 mm").is_some());
    assert!(page::alike("$ x\na ...\n...\nb", "$ x\na 12\nmore\nb"));
    assert!(!page::alike("$ x\na\nb", "$ x\na\nc"));
    assert!(lang::Code::ALL.contains(&Code::E0101));
}
