//! The programs that studies are about, read and compiled beside the suite.

use super::analysis::{Compilation, analyse_alone};
use super::diagnostics::{Code, Diagnostic};
use super::names::refused_path;
use super::syntax::tree::Name;
use super::types::studies::Study;
use super::world::{ReadFailure, World, normal};

/// A program that a study names.
#[derive(Debug)]
pub(super) struct Studied {
    pub compiled: Compilation,
    /// The folder of its file; empty, or with a `/` at its end.
    pub folder: String,
}

/// The programs of some studies, as far as they can be read: `None` where a study names
/// none, or it is wrong.
pub(super) fn programs(
    studies: &[Study],
    main: &str,
    world: &dyn World,
    found: &mut Vec<Diagnostic>,
) -> Vec<Option<Studied>> {
    let one = |study: &Study| {
        study
            .program
            .as_ref()
            .and_then(|path| program(path, main, world, found))
    };
    studies.iter().map(one).collect()
}

fn program(path: &Name, main: &str, world: &dyn World, found: &mut Vec<Diagnostic>) -> Option<Studied> {
    if let Some(refused) = refused_path(path) {
        found.push(refused);
        return None;
    }
    let file = normal(&format!("{}{}", folder(main), path.text));
    if let Err(ReadFailure::Missing) = world.read(&file) {
        let out = Diagnostic::new(Code::E0105, path.span, format!("there is no file `{file}`"));
        found.push(out.help("the path is relative to this file"));
        return None;
    }
    // Its own studies are not followed, so that this ends.
    let compiled = analyse_alone(&file, world).compile();
    if compiled.rules.is_none() {
        let message = format!("`{}` has errors, so that it cannot be studied", path.text);
        let out = Diagnostic::new(Code::E0506, path.span, message);
        found.push(out.help(format!("see `vpl check {file}`")));
        return None;
    }
    Some(Studied {
        folder: folder(&file).to_owned(),
        compiled,
    })
}

/// The folder of a file, with its `/`; empty where it has none.
pub(super) fn folder(file: &str) -> &str {
    file.rfind('/').map_or("", |at| &file[..=at])
}
