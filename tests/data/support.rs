//! Folders, runs of the binary, and the data of others.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// An empty folder of a test's own.
pub fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("data").join(test);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// How a run of the binary went.
pub struct Ran {
    pub status: Option<i32>,
    pub out: String,
    pub err: String,
}

impl Ran {
    #[track_caller]
    pub fn expect(self, status: i32, words: &[&str]) -> Self {
        let said = format!("{}\n{}", self.out, self.err);
        assert_eq!(self.status, Some(status), "{said}");
        for word in words {
            assert!(said.contains(word), "no `{word}` in: {said}");
        }
        self
    }
}

pub fn vpl(arguments: &[&str]) -> Ran {
    let output = Command::new(env!("CARGO_BIN_EXE_vpl"))
        .args(arguments)
        .output()
        .unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let ran = Ran {
        status: output.status.code(),
        out: text(&output.stdout),
        err: text(&output.stderr),
    };
    assert!(!ran.err.contains("panicked"), "{}", ran.err);
    ran
}

pub fn inspect(path: &Path, options: &[&str]) -> Ran {
    vpl(&[&["inspect", path.to_str().unwrap()], options].concat())
}

/// A file or folder of the shared data; says so where it is absent.
pub fn shared(name: &str) -> Option<PathBuf> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data").into();
    let path = std::env::var_os("VPL_DATA").map_or(beside, PathBuf::from).join(name);
    if !path.exists() {
        eprintln!(
            "skipped: there is no {}; VPL_DATA names the folder of shared data",
            path.display()
        );
        return None;
    }
    Some(path)
}

/// Whether a program is installed; says so where it is not.
pub fn installed(program: &str) -> bool {
    let there = Command::new(program).output().is_ok();
    if !there {
        eprintln!("skipped: {program} is not installed (Debian's octomap-tools)");
    }
    there
}
