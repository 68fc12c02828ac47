//! Repairing a program: the fixes of its diagnostics, made where they hold.
//!
//! A fix holds when the diagnostic that offers it is gone afterwards and no error
//! is new. Those of one round are tried together, then by halves, until nothing is
//! left to do. Only the file that was asked for is changed; writing it is for
//! others, as are its imports.

use std::collections::{BTreeMap, BTreeSet};

use super::diagnostics::{edited, touch};
use super::{Code, Compilation, Diagnostic, Edit, Fix, MOST_BYTES, ReadFailure, Severity, Span, World, compile};

/// Most rounds; a fix can uncover another.
const MOST_ROUNDS: usize = 16;
/// Most fixes of a round.
const MOST_OFFERS: usize = 1000;
/// Most compilations, and the bytes that they may read in all beyond the least.
const MOST_COMPILATIONS: usize = 256;
const LEAST_COMPILATIONS: usize = 8;
const MOST_BYTES_IN_ALL: usize = 64 << 20;

/// A fix that was made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Applied {
    /// The code of its diagnostic.
    pub code: Code,
    /// Where the diagnostic stood, in the text as it was then.
    pub line: usize,
    /// In characters, from 1.
    pub column: usize,
    /// What the fix did.
    pub message: String,
}

/// A program after its repair.
#[derive(Debug)]
pub struct Repaired {
    /// Its text; none where it could not be read.
    pub text: Option<String>,
    /// What was done, in order.
    pub applied: Vec<Applied>,
    /// What remains to be said.
    pub compilation: Compilation,
}

/// Makes every fix of the program at `path` that holds.
pub fn repair(path: &str, world: &dyn World) -> Repaired {
    let read = world.read(path);
    let text = read.clone().ok().and_then(|bytes| String::from_utf8(bytes).ok());
    let compilation = compile(path, &Edited { path, read, world });
    let Some(text) = text else {
        return Repaired {
            text: None,
            applied: Vec::new(),
            compilation,
        };
    };
    let most = MOST_BYTES_IN_ALL / text.len().max(1);
    let mut repair = Repair {
        path,
        world,
        left: most.clamp(LEAST_COMPILATIONS, MOST_COMPILATIONS),
    };
    repair.run(State { text, compilation })
}

/// The world with the program as it would be.
struct Edited<'a> {
    path: &'a str,
    read: Result<Vec<u8>, ReadFailure>,
    world: &'a dyn World,
}

impl World for Edited<'_> {
    fn read(&self, path: &str) -> Result<Vec<u8>, ReadFailure> {
        match path == self.path {
            true => self.read.clone(),
            false => self.world.read(path),
        }
    }
}

/// A text of the program and what is said about it.
struct State {
    text: String,
    compilation: Compilation,
}

/// A diagnostic and its likeliest fix.
struct Offer<'a> {
    diagnostic: &'a Diagnostic,
    fix: &'a Fix,
}

struct Repair<'a> {
    path: &'a str,
    world: &'a dyn World,
    /// Compilations that may still be done.
    left: usize,
}

impl Repair<'_> {
    fn run(&mut self, mut state: State) -> Repaired {
        let mut applied = Vec::new();
        for _ in 0..MOST_ROUNDS {
            let offers = offers(&state.compilation);
            let mut accepted = Vec::new();
            let Some(next) = self.accept(&state, &mut accepted, &offers) else {
                break;
            };
            applied.extend(accepted.iter().map(|offer| record(offer, &state.compilation)));
            state = next;
        }
        Repaired {
            text: Some(state.text),
            applied,
            compilation: state.compilation,
        }
    }

    /// Adds to `accepted` what holds with it, and gives the program with all of it;
    /// none where nothing was added.
    fn accept<'o>(
        &mut self,
        from: &State,
        accepted: &mut Vec<&'o Offer<'o>>,
        offers: &'o [Offer<'o>],
    ) -> Option<State> {
        if offers.is_empty() {
            return None;
        }
        let tried: Vec<&Offer<'_>> = accepted.iter().copied().chain(offers).collect();
        if let Some(state) = self.attempt(from, &tried) {
            *accepted = tried;
            return Some(state);
        }
        if offers.len() == 1 {
            return None;
        }
        let (first, second) = offers.split_at(offers.len() / 2);
        let first = self.accept(from, accepted, first);
        self.accept(from, accepted, second).or(first)
    }

    /// The program with some fixes, where they hold together.
    fn attempt(&mut self, from: &State, offers: &[&Offer<'_>]) -> Option<State> {
        let edits: Vec<Edit> = offers.iter().flat_map(|offer| &offer.fix.edits).cloned().collect();
        let text = edited(&from.text, &edits).filter(|text| text.len() <= MOST_BYTES)?;
        self.left = self.left.checked_sub(1)?;
        let read = Ok(text.clone().into_bytes());
        let world = Edited {
            path: self.path,
            read,
            world: self.world,
        };
        let compilation = compile(self.path, &world);
        let fixed = offers.iter().map(|offer| offer.diagnostic);
        holds(&from.compilation, fixed, &edits, &compilation).then_some(State { text, compilation })
    }
}

/// The fixes that can be made together, in the order of the text.
fn offers(compilation: &Compilation) -> Vec<Offer<'_>> {
    let mut offers: Vec<Offer<'_>> = Vec::new();
    for diagnostic in &compilation.diagnostics {
        if offers.len() == MOST_OFFERS {
            break;
        }
        let Some(fix) = diagnostic.fixes.first().filter(|fix| !fix.edits.is_empty()) else {
            continue;
        };
        let here = fix.edits.iter().all(|edit| edit.span.file == Span::default().file);
        let mut chosen = offers.iter().flat_map(|offer| &offer.fix.edits);
        if here && chosen.all(|a| fix.edits.iter().all(|b| !touch(a, b))) {
            offers.push(Offer { diagnostic, fix });
        }
    }
    offers
}

fn record(offer: &Offer<'_>, compilation: &Compilation) -> Applied {
    let span = offer.diagnostic.primary.span;
    let file = compilation.sources.get(span.file);
    let (line, column) = file.map_or((1, 1), |file| file.line_column(span.start));
    Applied {
        code: offer.diagnostic.code,
        line,
        column,
        message: offer.fix.message.clone(),
    }
}

/// Whether some diagnostics are gone after edits of the main file, and no error is
/// new: each that is left was there before. A mistake that is reported once and was
/// made several times may move on to its next place.
fn holds<'a>(
    before: &'a Compilation,
    fixed: impl Iterator<Item = &'a Diagnostic>,
    edits: &[Edit],
    after: &'a Compilation,
) -> bool {
    let mut left = Counts::default();
    for d in &before.diagnostics {
        left.add(place(d, before, |at| moved(at, edits)));
    }
    let mut elsewhere = Counts::default();
    let mut gone = BTreeSet::new();
    for d in fixed {
        let place = place(d, before, |at| moved(at, edits));
        left.take(&place);
        gone.insert(place);
        elsewhere.add((d.code, d.message.as_str()));
    }
    after.diagnostics.iter().all(|d| {
        let place = place(d, after, |at| at);
        let is_gone = gone.contains(&place);
        let matters = d.severity == Severity::Error || is_gone;
        !matters || left.take(&place) || (!is_gone && elsewhere.take(&(d.code, d.message.as_str())))
    })
}

/// How often something is there.
struct Counts<K>(BTreeMap<K, usize>);

impl<K> Default for Counts<K> {
    fn default() -> Self {
        Self(BTreeMap::new())
    }
}

impl<K: Ord> Counts<K> {
    fn add(&mut self, key: K) {
        *self.0.entry(key).or_default() += 1;
    }

    /// Takes one away; whether there was one.
    fn take(&mut self, key: &K) -> bool {
        let left = self.0.get_mut(key).filter(|n| **n > 0);
        left.map(|n| *n -= 1).is_some()
    }
}

/// The code of a diagnostic, its file, and where it begins.
fn place<'a>(d: &Diagnostic, of: &'a Compilation, moved: impl Fn(usize) -> usize) -> (Code, &'a str, usize) {
    let span = d.primary.span;
    let path = of.sources.get(span.file).map_or("", |file| file.display.as_str());
    let main = span.file == Span::default().file;
    (d.code, path, if main { moved(span.start) } else { span.start })
}

/// Where a byte of the text stands after edits.
fn moved(at: usize, edits: &[Edit]) -> usize {
    edits
        .iter()
        .filter(|edit| edit.span.start < at || edit.span.end <= at)
        .fold(at, |to, edit| {
            let removed = edit.span.end.min(at) - edit.span.start;
            (to + edit.text.len()) - removed
        })
}
