//! Reading the main file and its imports, each once, depth first.

use std::collections::BTreeMap;

use super::suggest::{closest, one_of};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::source::{FileId, SourceFile, SourceMap, Span};
use crate::lang::syntax::{self, tree};
use crate::lang::world::{World, normal};
use crate::lang::{EDITION, reading, stdlib};

/// Most modules of a program; imports nest no deeper.
const MOST_MODULES: usize = 256;

/// A file that was read, and what its imports point to.
pub(super) struct Loaded {
    pub file: FileId,
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
            file,
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
        if let ["std", name] = texts.as_slice()
            && stdlib::module(name).is_some()
        {
            return Some(Key::Standard((*name).to_owned()));
        }
        let at = words.get(1).or(words.first()).map_or(span, |w| w.span);
        let message = format!("there is no module `{}`", texts.join("."));
        let out = Diagnostic::new(Code::E0204, at, message);
        self.found.push(match texts.as_slice() {
            ["std", name, ..] => match closest(name, stdlib::names()) {
                Some(near) => out.meant(near),
                None => out.help(format!("the standard library has {}", one_of(stdlib::names()))),
            },
            ["std"] => out.help(format!("name a module: {}", one_of(stdlib::names()))),
            _ => out.help(
                "the standard library is `std`; a file of yours is imported by its path: `use \"file.vpl\".name`",
            ),
        });
        None
    }

    fn user(&mut self, from: &Key, path: &tree::Name) -> Option<Key> {
        let base = match from {
            Key::User(base) => base.rfind('/').map_or("", |at| &base[..=at]),
            Key::Standard(_) => "",
        };
        if let Some(refused) = refused_path(path) {
            self.found.push(refused);
            return None;
        }
        let key = normal(&format!("{base}{}", path.text));
        if let Some(name) = path.text.strip_prefix("std/")
            && self.world.read(&format!("{}{key}", self.folder)).is_err()
        {
            let name = name.trim_end_matches(".vpl");
            let message = format!("there is no file `{}`", path.text);
            let out = Diagnostic::new(Code::E0105, path.span, message);
            let help = format!("the standard library has no quotes: `use std.{name}.…`");
            self.found.push(out.help(help));
            return None;
        }
        if let Some(whole) = self.without_ending(&key) {
            let (message, written) = (
                format!("there is no file `{}`", path.text),
                format!("{}.vpl", path.text),
            );
            let out = Diagnostic::new(Code::E0105, path.span, message);
            self.found.push(out.help(format!("did you mean `{written}`?")).fix(
                format!("write `{written}`"),
                path.span,
                format!("\"{written}\""),
            ));
            return Some(Key::User(whole));
        }
        Some(Key::User(key))
    }

    /// The file that a path means whose `.vpl` was left out.
    fn without_ending(&self, path: &str) -> Option<String> {
        let whole = format!("{path}.vpl");
        let read = |path: &str| self.world.read(&format!("{}{path}", self.folder));
        let is_it = !path.ends_with(".vpl") && read(path).is_err() && read(&whole).is_ok();
        is_it.then_some(whole)
    }

    fn source(&mut self, key: &Key, import: Option<Span>) -> Option<FileId> {
        match key {
            Key::Standard(name) => {
                let path = format!("std/{name}.vpl");
                let text = stdlib::module(name).unwrap_or_default().to_owned();
                Some(self.sources.add(SourceFile::new(path.clone(), path, text).shipped()))
            }
            Key::User(path) => {
                let display = format!("{}{path}", self.folder);
                let bytes = self.world.read(&display);
                let read = reading::source(&display, path, bytes, self.sources, import);
                read.map_err(|found| self.found.push(*found)).ok()
            }
        }
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
        // What is no program at all has one thing to be said about it.
        let is_a_program = edition.is_none() || !tree.items.is_empty();
        self.found.extend(edition);
        self.found.extend(found.into_iter().filter(|_| is_a_program));
        Some(tree)
    }
}

/// What is wrong with a path that should be relative to the file that names it.
pub(in crate::lang) fn refused_path(path: &tree::Name) -> Option<Diagnostic> {
    let refuse =
        |help: &str| Diagnostic::new(Code::E0111, path.span, format!("`{}` is no relative path", path.text)).help(help);
    if path.text.contains('\\') {
        return Some(refuse("separate folders with `/`"));
    }
    let absolute = path.text.is_empty() || path.text.starts_with('/') || path.text.contains(':');
    absolute.then(|| refuse("give the path from this file's folder, like \"parts/markers.vpl\""))
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
