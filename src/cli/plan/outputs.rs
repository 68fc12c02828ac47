//! Where results go: no file that a run reads or writes is overwritten by another.

use std::fs;
use std::path::{Path, PathBuf};

use super::Plan;
use super::record::is_stdout;
use crate::cli::Failure;
use crate::cli::files::STDIN;

/// Refuses a log or a map that would take the place of the program, of the
/// object's mesh or of one another. A log may replace the log that it resumes.
///
/// # Errors
/// A usage failure that names the option and the file.
pub(super) fn check(options: &Plan) -> Result<(), Failure> {
    let (log, map) = (options.log.as_deref(), options.map.as_deref());
    let program = Some(Path::new(&options.file)).filter(|file| *file != Path::new(STDIN));
    let object = options.object.as_deref().map(Path::new);
    let resumed = options.resume.as_deref();
    for (option, out, other) in [
        ("--log", log, program),
        ("--log", log, object),
        ("--map", map, program),
        ("--map", map, object),
        ("--map", map, resumed),
        ("--map", map, log),
    ] {
        if let (Some(out), Some(other)) = (out, other)
            && same(out, other)
        {
            let (out, other) = (out.display(), other.display());
            return Err(Failure::Usage(format!(
                "`{option} {out}` would overwrite `{other}`; name another file"
            )));
        }
    }
    Ok(())
}

/// Whether the log or the map goes to standard output, where nothing else then may.
pub(super) fn use_stdout(options: &Plan) -> bool {
    [&options.log, &options.map]
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
