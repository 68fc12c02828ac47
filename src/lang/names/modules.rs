//! Reading the main file and its imports, each once, depth first.

use std::collections::BTreeMap;

use super::suggest::{did_you_mean, one_of};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::source::{FileId, SourceFile, SourceMap, Span};
use crate::lang::syntax::{self, tree};
use crate::lang::world::{MOST_BYTES, ReadFailure, World};
use crate::lang::{EDITION, stdlib};

/// Most modules of a program; imports nest no deeper.
const MOST_MODULES: usize = 256;

/// A file that was read, and what its imports point to.
pub(super) struct Loaded {
    pub tree: tree::File,
    /// The module behind each import in order; `None` where it failed.
    pub imports: Vec<Option<usize>>,
    /// How the module is called in messages: `std.views` or its path.
    pub title: String,
}

/// Where a module comes from.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Key {
    Standard(String),
    /// Path relative to the main file's folder, without `.` and inner `..`.
    User(String),
}

struct Loader<'a> {
    world: &'a dyn World,
    sources: &'a mut SourceMap,
    /// The main file's folder, with its final `/`.
    folder: String,
    modules: Vec<Option<Loaded>>,
    by_key: BTreeMap<Key, Option<usize>>,
    /// Modules being read, for circles.
    reading: Vec<Key>,
    found: Vec<Diagnostic>,
}

/// The modules of a program, the main file first; none where that cannot be read.
pub(super) fn load(path: &str, world: &dyn World, sources: &mut SourceMap) -> (Vec<Loaded>, Vec<Diagnostic>) {
    let (folder, file) = path.rfind('/').map_or(("", path), |at| path.split_at(at + 1));
    let mut loader = Loader {
        world,
        sources,
        folder: folder.to_owned(),
        modules: Vec::new(),
        by_key: BTreeMap::new(),
        reading: Vec::new(),
        found: Vec::new(),
    };
    loader.read(Key::User(file.to_owned()), None);
    (loader.modules.into_iter().flatten().collect(), loader.found)
}

impl Loader<'_> {
    /// The index of a module, read now if it was not before.
    fn read(&mut self, key: Key, import: Option<Span>) -> Option<usize> {
        if let Some(known) = self.by_key.get(&key) {
            return *known;
        }
        self.by_key.insert(key.clone(), None);
        let file = self.source(&key, import)?;
        let tree = self.parse(file)?;
        let index = self.modules.len();
        self.modules.push(None);
        self.by_key.insert(key.clone(), Some(index));
        self.reading.push(key.clone());
        let imports = tree.items.iter().filter_map(|item| match item {
            tree::Item::Use(import) => Some(import),
            _ => None,
        });
        let imports = imports.map(|import| self.import(&key, import)).collect();
        self.reading.pop();
        self.modules[index] = Some(Loaded {
            tree,
            imports,
            title: title(&key),
        });
        Some(index)
    }

    fn import(&mut self, from: &Key, import: &tree::Use) -> Option<usize> {
        let key = match &import.module {
            tree::Module::Dotted(words) => self.standard(words, import.span)?,
            tree::Module::Path(path) => self.user(from, path)?,
        };
        if self.reading.contains(&key) {
            self.found.push(
                Diagnostic::new(
                    Code::E0112,
                    import.span,
                    format!("`{}` imports itself, directly or through its imports", title(&key)),
                )
                .help("move the definitions that both need to a module of their own"),
            );
            return None;
        }
        if self.modules.len() >= MOST_MODULES {
            let message = format!("a program of more than {MOST_MODULES} modules");
            self.found.push(Diagnostic::new(Code::E0111, import.span, message));
            return None;
        }
        self.read(key, Some(import.span))
    }

    fn standard(&mut self, words: &[tree::Name], span: Span) -> Option<Key> {
        let texts: Vec<&str> = words.iter().map(|w| w.text.as_str()).collect();
        let help = match texts.as_slice() {
            ["std", name] if stdlib::module(name).is_some() => return Some(Key::Standard((*name).to_owned())),
            ["std", name, ..] => did_you_mean(name, stdlib::names())
                .unwrap_or_else(|| format!("the standard library has {}", one_of(stdlib::names()))),
            ["std"] => format!("name a module: {}", one_of(stdlib::names())),
            _ => {
                "the standard library is `std`; a file of yours is imported by its path: `use \"file.vpl\".name`".into()
            }
        };
        let at = words.get(1).or(words.first()).map_or(span, |w| w.span);
        let message = format!("there is no module `{}`", texts.join("."));
        self.found.push(Diagnostic::new(Code::E0204, at, message).help(help));
        None
    }

    fn user(&mut self, from: &Key, path: &tree::Name) -> Option<Key> {
        let base = match from {
            Key::User(base) => base.rfind('/').map_or("", |at| &base[..=at]),
            Key::Standard(_) => "",
        };
        let refuse = |help: &str| {
            Diagnostic::new(Code::E0111, path.span, format!("`{}` is no relative path", path.text)).help(help)
        };
        if path.text.contains('\\') {
            self.found.push(refuse("separate folders with `/`"));
            return None;
        }
        if path.text.is_empty() || path.text.starts_with('/') || path.text.contains(':') {
            self.found.push(refuse(
                "give the path from this file's folder, like \"parts/markers.vpl\"",
            ));
            return None;
        }
        Some(Key::User(normal(&format!("{base}{}", path.text))))
    }

    fn source(&mut self, key: &Key, import: Option<Span>) -> Option<FileId> {
        let (display, path) = match key {
            Key::Standard(name) => (format!("std/{name}.vpl"), format!("std/{name}.vpl")),
            Key::User(path) => (format!("{}{path}", self.folder), path.clone()),
        };
        let bytes = match key {
            Key::Standard(name) => Ok(stdlib::module(name).unwrap_or_default().as_bytes().to_vec()),
            Key::User(_) => self.world.read(&display),
        };
        let bytes = match bytes {
            Ok(bytes) => bytes,
            Err(failure) => {
                self.unreadable(display, path, &failure, import);
                return None;
            }
        };
        let (text, invalid) = match String::from_utf8(bytes) {
            Ok(text) => (text, None),
            Err(error) => {
                let at = error.utf8_error().valid_up_to();
                let valid = String::from_utf8_lossy(&error.as_bytes()[..at]).into_owned();
                (valid, Some(at))
            }
        };
        let file = SourceFile::new(display, path, text);
        let id = self.sources.add(match key {
            Key::Standard(_) => file.shipped(),
            Key::User(_) => file,
        });
        let Some(at) = invalid else {
            return Some(id);
        };
        let message = format!("the byte at offset {at} is no UTF-8 text");
        self.found
            .push(Diagnostic::new(Code::E0107, Span::new(id, at, at), message).help("save the program as UTF-8 text"));
        None
    }

    fn unreadable(&mut self, display: String, path: String, failure: &ReadFailure, import: Option<Span>) {
        let (code, message) = match failure {
            ReadFailure::Missing => (Code::E0105, format!("there is no file `{display}`")),
            ReadFailure::TooLarge => (
                Code::E0106,
                format!("`{display}` is larger than {} MB", MOST_BYTES >> 20),
            ),
            ReadFailure::Failed(why) => (Code::E0105, format!("`{display}` cannot be read: {why}")),
        };
        let at = import.unwrap_or_else(|| {
            let id = self.sources.add(SourceFile::new(display, path, String::new()));
            Span::new(id, 0, 0)
        });
        let help = match failure {
            ReadFailure::TooLarge => Some("split it into modules and import them with `use`".to_owned()),
            _ => import.map(|_| "a path is relative to the file that imports it".to_owned()),
        };
        self.found.push(Diagnostic::new(code, at, message).maybe_help(help));
    }

    /// The tree of a file of this edition.
    fn parse(&mut self, file: FileId) -> Option<tree::File> {
        let text = self.sources.get(file).map(|f| f.text.clone()).unwrap_or_default();
        let start = Span::new(file, 0, 0);
        if text
            .trim_matches(|c: char| c.is_whitespace() || c == '\u{feff}')
            .is_empty()
        {
            self.found
                .push(Diagnostic::new(Code::E0104, start, "this file is empty").help(format!(
                    "begin with the edition line `vpl {EDITION}`, then declare a `library` and a `task`"
                )));
            return None;
        }
        let (tree, found) = syntax::parse(file, &text);
        let unread = tree.items.is_empty() && tree.bad.is_empty() && !found.is_empty();
        let edition = if unread { None } else { edition(&tree, start, &text) };
        if let Some(newer) = edition.as_ref().filter(|d| d.code == Code::E0103) {
            self.found.push(newer.clone());
            return None;
        }
        self.found.extend(edition);
        self.found.extend(found);
        Some(tree)
    }
}

/// What is wrong with the edition line.
fn edition(tree: &tree::File, start: Span, text: &str) -> Option<Diagnostic> {
    let Some(edition) = &tree.edition else {
        let at = if text.starts_with('\u{feff}') { 3 } else { 0 };
        let at = Span::new(start.file, at, at);
        return Some(
            Diagnostic::new(Code::E0102, at, format!("the edition line `vpl {EDITION}` is missing"))
                .help(format!("begin the file with `vpl {EDITION}`"))
                .fix(format!("insert `vpl {EDITION}`"), at, format!("vpl {EDITION}\n\n")),
        );
    };
    match edition.text.parse::<u64>() {
        Ok(n) if n == u64::from(EDITION) => None,
        Ok(n) if n > u64::from(EDITION) => Some(
            Diagnostic::new(
                Code::E0103,
                edition.span,
                format!("this program is of edition {n}, and this vpl reads up to edition {EDITION}"),
            )
            .help("update vpl"),
        ),
        _ => Some(
            Diagnostic::new(Code::E0102, edition.span, "the edition line names no edition")
                .help(format!("write `vpl {EDITION}`"))
                .fix(format!("write `{EDITION}`"), edition.span, EDITION.to_string()),
        ),
    }
}

fn title(key: &Key) -> String {
    match key {
        Key::Standard(name) => format!("std.{name}"),
        Key::User(path) => path.clone(),
    }
}

/// A path without `.` and without `..` behind a folder.
fn normal(path: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split('/') {
        match part {
            "" | "." => {}
            ".." if parts.last().is_some_and(|p| *p != "..") => drop(parts.pop()),
            _ => parts.push(part),
        }
    }
    parts.join("/")
}

#[cfg(test)]
mod tests {
    use super::normal;

    #[test]
    fn paths_are_compared_without_detours() {
        assert_eq!(normal("a/./b/../c.vpl"), "a/c.vpl");
        assert_eq!(normal("../../x.vpl"), "../../x.vpl");
        assert_eq!(normal("a/../../x.vpl"), "../x.vpl");
    }
}
