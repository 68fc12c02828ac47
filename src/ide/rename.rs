//! Renaming: all occurrences at once, and only where every name keeps its meaning.
//!
//! The renamed texts are analysed again before they are handed out. Where a name would
//! then denote something else, or a mistake would appear, the renaming is refused.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::navigate::{Target, file, path, target, uses};
use super::semantic::is_standard;
use super::{MAIN, Snapshot};
use crate::lang::index::{Entity, Occurrence};
use crate::lang::{ReadFailure, World, normal, vocabulary};
use crate::primitives;

/// Why something is not renamed, in a sentence.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Refusal(String);

/// The places to change, by path, in the order of each text.
pub type Renamed = BTreeMap<String, Vec<Range<usize>>>;

/// Whether the name at a byte of the main file can be renamed, and where it stands.
///
/// # Errors
/// It is the language's own, or of its library, or no name at all.
pub fn renameable(snapshot: &Snapshot, offset: usize) -> Result<Occurrence, Refusal> {
    let refuse = |why: String| Err(Refusal(why));
    let Some(name) = snapshot.index().at(MAIN, offset) else {
        return refuse("there is no name here that could be renamed".into());
    };
    let written = snapshot.sources().text(name.span);
    match name.entity {
        Entity::Declared(..) if is_standard(snapshot, name.entity) => {
            refuse(format!("`{written}` is part of the standard library"))
        }
        Entity::Declared(..) => Ok(name),
        Entity::Module(_) => refuse("a module is renamed with its file".into()),
        Entity::Primitive(_) | Entity::Argument(..) => refuse(format!("`{written}` is a primitive's name")),
        _ => refuse(format!("`{written}` is a word of the language")),
    }
}

/// Renames the name at a byte of the first program in all programs given.
///
/// # Errors
/// It cannot be renamed, the new name is none, or it means something already.
pub fn rename(programs: &[&Snapshot], world: &dyn World, offset: usize, new: &str) -> Result<Renamed, Refusal> {
    let Some(first) = programs.first() else {
        return Err(Refusal("there is nothing to rename".into()));
    };
    let name = renameable(first, offset)?;
    valid(new)?;
    let Some(target) = target(first, name.entity) else {
        return Err(Refusal("there is no name here that could be renamed".into()));
    };
    let mut places: BTreeMap<String, BTreeSet<(usize, usize)>> = BTreeMap::new();
    for program in programs {
        for (path, range) in uses(program, &target) {
            places.entry(path).or_default().insert((range.start, range.end));
        }
    }
    let places: Renamed = places
        .into_iter()
        .map(|(path, ranges)| (path, ranges.into_iter().map(|(start, end)| start..end).collect()))
        .collect();
    let changed = Changed {
        world,
        texts: programs.iter().flat_map(|p| texts(p, &places, new)).collect(),
    };
    for program in programs.iter().filter(|p| !uses(p, &target).is_empty()) {
        keeps_its_meaning(program, &target, &places, &changed, new)?;
    }
    Ok(places)
}

fn valid(new: &str) -> Result<(), Refusal> {
    let letters = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if new.is_empty() || !new.chars().all(letters) || new.starts_with(|c: char| c.is_ascii_digit()) {
        return Err(Refusal(format!(
            "`{new}` is no name: letters, digits and `_`, a digit not first"
        )));
    }
    if vocabulary::is_reserved(new) {
        return Err(Refusal(format!("`{new}` is reserved: it begins a declaration")));
    }
    if primitives::find(new).is_some() {
        return Err(Refusal(format!("`{new}` is a primitive")));
    }
    Ok(())
}

/// The texts of a program that change, as they will be.
fn texts(program: &Snapshot, places: &Renamed, new: &str) -> Vec<(String, String)> {
    let changed = program.sources().files().filter_map(|(_, file)| {
        let ranges = places.get(&path(file))?;
        let mut text = file.text.clone();
        for range in ranges.iter().rev() {
            text.replace_range(range.clone(), new);
        }
        Some((path(file), text))
    });
    changed.collect()
}

struct Changed<'a> {
    world: &'a dyn World,
    texts: BTreeMap<String, String>,
}

impl World for Changed<'_> {
    fn read(&self, path: &str) -> Result<Vec<u8>, ReadFailure> {
        match self.texts.get(&normal(path)) {
            Some(text) => Ok(text.as_bytes().to_vec()),
            None => self.world.read(path),
        }
    }
}

/// Whether the renamed program names the target exactly where the old one did.
fn keeps_its_meaning(
    program: &Snapshot,
    target: &Target,
    places: &Renamed,
    changed: &Changed<'_>,
    new: &str,
) -> Result<(), Refusal> {
    let moved = |path: &str, at: usize| {
        let before = places.get(path).into_iter().flatten().filter(|r| r.start < at);
        before.fold(at, |at, r| at + new.len() - r.len())
    };
    let after = Snapshot::new(program.path(), changed);
    let target_after = (target.0.clone(), moved(&target.0, target.1));
    let expected: BTreeSet<(String, usize)> = uses(program, target)
        .into_iter()
        .map(|(path, range)| (path.clone(), moved(&path, range.start)))
        .collect();
    let found: BTreeSet<(String, usize)> = uses(&after, &target_after)
        .into_iter()
        .map(|(path, range)| (path, range.start))
        .collect();
    if found != expected || after.mistakes() > program.mistakes() {
        return Err(Refusal(format!(
            "`{new}` already means something where `{}` is used",
            written(program, target)
        )));
    }
    Ok(())
}

/// The name as it was.
fn written(program: &Snapshot, target: &Target) -> String {
    let uses = uses(program, target);
    let here = uses
        .iter()
        .find(|(path, range)| (path, range.start) == (&target.0, target.1));
    let text = here
        .zip(file(program, target))
        .and_then(|((_, range), (_, file))| file.text.get(range.clone()));
    text.unwrap_or_default().to_owned()
}
