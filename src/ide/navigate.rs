//! Where a name was declared, and where else it stands: in one program or in several.

use super::{MAIN, Snapshot};
use crate::lang::index::{Entity, Occurrence};
use crate::lang::{FileId, SourceFile, Span, normal};

/// A declaration as every program of a workspace knows it: the file and the byte.
pub(super) type Target = (String, usize);

/// Where the name at a byte of the main file was declared. A module is its beginning.
pub fn definition(snapshot: &Snapshot, offset: usize) -> Option<(Span, Span)> {
    let name = snapshot.index().at(MAIN, offset)?;
    let target = match name.entity {
        Entity::Declared(_, at) => at,
        Entity::Module(file) => Span::new(file, 0, 0),
        _ => return None,
    };
    Some((name.span, target))
}

/// Every occurrence of the name at a byte of the main file, in all files of the program.
pub fn occurrences(snapshot: &Snapshot, offset: usize) -> Vec<Occurrence> {
    let name = snapshot.index().at(MAIN, offset);
    name.into_iter()
        .flat_map(|name| snapshot.index().all(name.entity))
        .collect()
}

/// Every place in some programs that names what stands at a byte of the first: which
/// program, and where in it. Programs that share a file say the same place twice.
pub fn references(programs: &[&Snapshot], offset: usize, declaration: bool) -> Vec<(usize, Span)> {
    let Some(first) = programs.first() else {
        return Vec::new();
    };
    let Some(name) = first.index().at(MAIN, offset) else {
        return Vec::new();
    };
    let target = target(first, name.entity);
    let mut found = Vec::new();
    for (k, program) in programs.iter().enumerate() {
        let entity = match &target {
            Some(target) => entity(program, target),
            None => (k == 0).then_some(name.entity),
        };
        let all = entity.into_iter().flat_map(|entity| program.index().all(entity));
        found.extend(all.filter(|o| declaration || !o.declares).map(|o| (k, o.span)));
    }
    found
}

/// What an entity is to all programs, where it was declared in one.
pub(super) fn target(program: &Snapshot, entity: Entity) -> Option<Target> {
    match entity {
        Entity::Declared(_, at) => Some((path(program.sources().get(at.file)?), at.start)),
        _ => None,
    }
}

/// What a target is to a program.
fn entity(program: &Snapshot, target: &Target) -> Option<Entity> {
    let (file, _) = file(program, target)?;
    let names = program.index().of(file).iter();
    let declared = names.filter(|o| o.declares && o.span.start == target.1);
    declared.map(|o| o.entity).next()
}

/// The file that declares a target.
pub(super) fn file<'p>(program: &'p Snapshot, target: &Target) -> Option<(FileId, &'p SourceFile)> {
    program.sources().files().find(|(_, file)| path(file) == target.0)
}

/// Paths are compared without detours.
pub(super) fn path(file: &SourceFile) -> String {
    normal(&file.display)
}

/// Where a program names a target: path and bytes.
pub(super) fn uses(program: &Snapshot, target: &Target) -> Vec<(String, std::ops::Range<usize>)> {
    let all = entity(program, target)
        .into_iter()
        .flat_map(|entity| program.index().all(entity));
    all.filter_map(|o| Some((path(program.sources().get(o.span.file)?), o.span.start..o.span.end)))
        .collect()
}
