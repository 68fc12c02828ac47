//! Files of a recording: bounded reads and sorted listings.

use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

use super::error::FrameError;

/// Largest text or picture, bytes.
const MOST_BYTES: u64 = 256 << 20;

/// The bytes of a file of bounded size.
pub(super) fn bytes(path: &Path) -> Result<Vec<u8>, FrameError> {
    bytes_up_to(path, MOST_BYTES)
}

/// The bytes of a file of at most `most`.
pub(super) fn bytes_up_to(path: &Path, most: u64) -> Result<Vec<u8>, FrameError> {
    let failed = |error: std::io::Error| FrameError::unreadable(path, &error);
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(failed)?;
    file.take(most + 1).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() as u64 > most {
        return Err(FrameError::TooLarge {
            path: path.to_owned(),
            what: format!("more than {} MiB", most >> 20),
        });
    }
    Ok(bytes)
}

/// The text of a file; a byte-order mark is dropped.
pub(super) fn text(path: &Path) -> Result<String, FrameError> {
    let text = String::from_utf8(bytes(path)?);
    let text = text.map_err(|e| {
        let at = e.utf8_error().valid_up_to();
        FrameError::malformed(path, format!("it is no UTF-8 text (byte {at})"))
    })?;
    Ok(text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text))
}

/// The files of a folder whose names end in one of `endings`, in natural order:
/// `2.png` before `10.png`.
pub(super) fn listed(folder: &Path, endings: &[&str]) -> Result<Vec<PathBuf>, FrameError> {
    let failed = |error: std::io::Error| FrameError::unreadable(folder, &error);
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        let name = path.file_name().map(|n| n.to_string_lossy().to_lowercase());
        if name.is_some_and(|n| endings.iter().any(|end| n.ends_with(end))) {
            files.push(path);
        }
    }
    files.sort_by_cached_key(|path| natural(path));
    Ok(files)
}

/// The first of some folders inside `root` that exists.
pub(super) fn folder(root: &Path, names: &[&str]) -> Option<PathBuf> {
    names.iter().map(|name| root.join(name)).find(|path| path.is_dir())
}

/// The file of a stem in a folder, with any of some endings.
pub(super) fn with_ending(folder: &Path, stem: &str, endings: &[&str]) -> Option<PathBuf> {
    let path = |end: &&str| folder.join(format!("{stem}{end}"));
    endings.iter().map(path).find(|path| path.is_file())
}

/// A file's name without its last ending.
pub(super) fn stem(path: &Path) -> String {
    path.file_stem()
        .map(|s| s.to_string_lossy().into_owned())
        .unwrap_or_default()
}

/// The last whole number in a file's name before its ending.
pub(super) fn number(path: &Path) -> Option<u64> {
    let stem = stem(path);
    let digits: String = stem
        .chars()
        .rev()
        .skip_while(|c| !c.is_ascii_digit())
        .take_while(char::is_ascii_digit)
        .collect();
    digits.chars().rev().collect::<String>().parse().ok()
}

/// Text and numbers of a name, so that numbers compare as numbers.
fn natural(path: &Path) -> Vec<(String, u64)> {
    let name = path
        .file_name()
        .map(|n| n.to_string_lossy().into_owned())
        .unwrap_or_default();
    let mut parts = vec![(String::new(), 0_u64)];
    let mut in_digits = false;
    for c in name.chars() {
        match (c.to_digit(10), parts.last_mut()) {
            (Some(digit), Some(last)) => {
                last.1 = last.1.saturating_mul(10).saturating_add(digit.into());
                in_digits = true;
            }
            (None, Some(last)) if !in_digits => last.0.push(c),
            _ => {
                parts.push((c.to_string(), 0));
                in_digits = false;
            }
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_names_count_as_numbers() {
        let mut names = ["10.png", "9.png", "a-2.depth.png", "a-10.depth.png", "1.png"].map(PathBuf::from);
        names.sort_by_cached_key(|p| natural(p));
        assert_eq!(
            names,
            ["1.png", "9.png", "10.png", "a-2.depth.png", "a-10.depth.png"].map(PathBuf::from)
        );
        assert_eq!(number(Path::new("Depth_0036.bin")), Some(36));
        assert_eq!(number(Path::new("frame-000010.depth.png")), Some(10));
        assert_eq!(number(Path::new("x.png")), None);
    }
}
