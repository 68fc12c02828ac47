//! Where results go: no file that a run reads or writes is overwritten by another.

use std::fs;
use std::path::{Path, PathBuf};

use super::Plan;
use super::record::is_stdout;
use crate::cli::Failure;
use crate::cli::files::STDIN;

/// Refuses a result that would take the place of the program, of the object's
/// mesh or of another result. A log may replace the log that it resumes.
///
/// # Errors
/// A usage failure that names the option and the file.
pub(super) fn check(options: &Plan) -> Result<(), Failure> {
    let program = Some(Path::new(&options.file)).filter(|file| *file != Path::new(STDIN));
    let object = options.object.as_deref().map(Path::new);
    let outs = [
        ("--log", options.log.as_deref()),
        ("--map", options.map.as_deref()),
        ("--report", options.report.as_deref()),
    ];
    for (k, (option, out)) in outs.iter().enumerate() {
        let resumed = options.resume.as_deref().filter(|_| *option != "--log");
        let before = outs[..k].iter().map(|(_, other)| *other);
        for other in [program, object, resumed].into_iter().chain(before) {
            refuse_same(option, *out, other)?;
        }
    }
    Ok(())
}

fn refuse_same(option: &str, out: Option<&Path>, other: Option<&Path>) -> Result<(), Failure> {
    match (out, other) {
        (Some(out), Some(other)) if same(out, other) => Err(Failure::Usage(format!(
            "`{option} {}` would overwrite `{}`; name another file",
            out.display(),
            other.display()
        ))),
        _ => Ok(()),
    }
}

/// Whether a result goes to standard output, where nothing else then may.
pub(super) fn use_stdout(options: &Plan) -> bool {
    [&options.log, &options.map, &options.report]
        .into_iter()
        .any(|out| out.as_deref().is_some_and(is_stdout))
}

/// Whether two paths name one file that writing could spoil; devices are none.
fn same(a: &Path, b: &Path) -> bool {
    if is_stdout(a) || is_stdout(b) {
        return is_stdout(a) && is_stdout(b);
    }
    let device = |path: &Path| fs::metadata(path).is_ok_and(|m| !m.is_file());
    !device(a) && settled(a) == settled(b)
}

/// A path without links and `..`, whether the file exists or not.
fn settled(path: &Path) -> PathBuf {
    let beside = || {
        let folder = path.parent().filter(|f| !f.as_os_str().is_empty());
        let folder = fs::canonicalize(folder.unwrap_or(Path::new("."))).ok()?;
        Some(folder.join(path.file_name()?))
    };
    fs::canonicalize(path)
        .ok()
        .or_else(beside)
        .unwrap_or_else(|| path.to_owned())
}
