//! Where a name was declared, and where else it stands.

use super::{MAIN, Snapshot};
use crate::lang::Span;
use crate::lang::index::{Entity, Occurrence};

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
