//! From a file's bytes to its text, or to what is wrong with it. Nothing is parsed here.

use super::diagnostics::{Code, Diagnostic};
use super::source::{FileId, SourceFile, SourceMap, Span};
use super::world::{MOST_BYTES, ReadFailure, World};

/// Reads the file at `path` as text.
///
/// # Errors
/// What is wrong with it, where it cannot be read, is too large or is no text.
pub fn read(path: &str, world: &dyn World, sources: &mut SourceMap) -> Result<FileId, Box<Diagnostic>> {
    source(path, path, world.read(path), sources, None)
}

/// Adds a file to the sources. What is wrong stands at the `import`, where there is one.
pub(super) fn source(
    display: &str,
    path: &str,
    bytes: Result<Vec<u8>, ReadFailure>,
    sources: &mut SourceMap,
    import: Option<Span>,
) -> Result<FileId, Box<Diagnostic>> {
    let mut add = |text: String| sources.add(SourceFile::new(display.to_owned(), path.to_owned(), text));
    let bytes = match bytes {
        Ok(bytes) => bytes,
        Err(failure) => {
            let at = import.unwrap_or_else(|| Span::new(add(String::new()), 0, 0));
            return Err(Box::new(unreadable(display, &failure, at, import.is_some())));
        }
    };
    let error = match String::from_utf8(bytes) {
        Ok(text) => return Ok(add(text)),
        Err(error) => error,
    };
    let at = error.utf8_error().valid_up_to();
    let id = add(String::from_utf8_lossy(&error.as_bytes()[..at]).into_owned());
    let message = format!("the byte at offset {at} is no UTF-8 text");
    let out = Diagnostic::new(Code::E0107, Span::new(id, at, at), message);
    Err(Box::new(out.help("save the program as UTF-8 text")))
}

fn unreadable(display: &str, failure: &ReadFailure, at: Span, imported: bool) -> Diagnostic {
    let (code, message) = match failure {
        ReadFailure::Missing => (Code::E0105, format!("there is no file `{display}`")),
        ReadFailure::TooLarge => (
            Code::E0106,
            format!("`{display}` is larger than {} MB", MOST_BYTES >> 20),
        ),
        ReadFailure::Failed(why) => (Code::E0105, format!("`{display}` cannot be read: {why}")),
    };
    let help = match failure {
        ReadFailure::TooLarge => Some("split it into modules and import them with `use`".to_owned()),
        _ => imported.then(|| "a path is relative to the file that imports it".to_owned()),
    };
    Diagnostic::new(code, at, message).maybe_help(help)
}
