//! The definitions of the standard library, for offers that bring their import along.

use std::sync::OnceLock;

use crate::ide::docs;
use crate::lang::index::Signature;
use crate::lang::{FileId, Memory, analyse, vocabulary};

/// A definition of the standard library.
#[derive(Debug)]
pub(super) struct Standard {
    pub module: &'static str,
    pub name: String,
    pub signature: Signature,
    pub docs: String,
}

/// All of them, by module. They are part of the program, so they are read once.
pub(super) fn all() -> &'static [Standard] {
    static ALL: OnceLock<Vec<Standard>> = OnceLock::new();
    ALL.get_or_init(|| {
        vocabulary::modules()
            .flat_map(|(name, text)| read(name, text))
            .collect()
    })
}

fn read(module: &'static str, text: &str) -> Vec<Standard> {
    let path = format!("{module}.vpl");
    let analysis = analyse(&path, &Memory::of(&path, text));
    let definitions = analysis.index().scope(FileId(0)).filter_map(|(name, at)| {
        Some(Standard {
            module,
            name: name.to_owned(),
            signature: analysis.index().signature(at)?.clone(),
            docs: docs::above(text, at.start),
        })
    });
    definitions.collect()
}
