//! What is known about a program: as names and types say, and as it expands.
//!
//! An editor asks after every keystroke what a name denotes, and only when there is
//! time what the planner would make of the program. So there are two steps; a
//! compiler takes both.

use super::diagnostics::{self, Diagnostic, Severity};
use super::index::Index;
use super::names::{self, Program};
use super::source::{FileId, SourceMap};
use super::studies::{self, Studied};
use super::syntax::tree;
use super::types::{self, typed};
use super::world::World;
use super::{checks, lower};
use crate::rules::{Fact, RuleSet, Study};

/// A program whose names and types are checked.
#[derive(Debug)]
pub struct Analysis {
    program: Option<Program>,
    typed: typed::Program,
    index: Index,
    sources: SourceMap,
    /// The programs of its studies; `None` where they are not followed.
    programs: Vec<Option<Studied>>,
    found: Vec<Diagnostic>,
}

/// A program as it expands.
#[derive(Debug, Default)]
pub struct Expansion {
    /// The rule set as far as the program is right; `None` where it could not be read.
    pub rules: Option<RuleSet>,
    /// The tests of the main file, as far as they are right.
    pub facts: Vec<Fact>,
    /// The studies of the main file, as far as they are right.
    pub studies: Vec<Study>,
    /// Everything there is to say about the program, in the order of the text.
    pub diagnostics: Vec<Diagnostic>,
}

/// What compiling a program gave.
#[derive(Debug)]
pub struct Compilation {
    /// The compiled program; `Some` exactly when no diagnostic is an error.
    pub rules: Option<RuleSet>,
    /// The tests of the main file; none where some diagnostic is an error.
    pub facts: Vec<Fact>,
    /// The studies of the main file; none where some diagnostic is an error.
    pub studies: Vec<Study>,
    /// Everything there is to say about it, in the order of the text.
    pub diagnostics: Vec<Diagnostic>,
    /// The files that were read. [`crate::rules::Place::file`] is a [`FileId`] here.
    pub sources: SourceMap,
}

/// Reads, resolves and types the program at `path`. Never panics, whatever the input.
pub fn analyse(path: &str, world: &dyn World) -> Analysis {
    let mut analysis = analyse_alone(path, world);
    let studies = &analysis.typed.studies;
    analysis.programs = studies::programs(studies, path, world, &mut analysis.found);
    analysis
}

/// As [`analyse`], without the programs that its studies name.
pub(super) fn analyse_alone(path: &str, world: &dyn World) -> Analysis {
    let mut sources = SourceMap::default();
    let (program, mut found) = names::load(path, world, &mut sources);
    let (typed, index, more) = program.as_ref().map(types::check).unwrap_or_default();
    found.extend(more);
    Analysis {
        program,
        typed,
        index,
        sources,
        programs: Vec::new(),
        found,
    }
}

impl Analysis {
    /// What every name denotes.
    pub fn index(&self) -> &Index {
        &self.index
    }

    /// The files that were read; the main file is the first.
    pub fn sources(&self) -> &SourceMap {
        &self.sources
    }

    /// The tree of a file, where it could be read.
    pub fn tree(&self, file: FileId) -> Option<&tree::File> {
        let modules = self.program.iter().flat_map(|p| &p.modules);
        modules.filter(|m| m.file == file).map(|m| &m.tree).next()
    }

    /// What is wrong with its names and types.
    pub fn found(&self) -> &[Diagnostic] {
        &self.found
    }

    /// Expands the program, and analyses its tasks.
    pub fn expand(&self) -> Expansion {
        let mut diagnostics = self.found.clone();
        let lowered = self.program.as_ref().map(|program| {
            let (lowered, found) = lower::lower(program, &self.typed, &self.sources, &self.programs);
            diagnostics.extend(found);
            diagnostics.extend(checks::check(&lowered));
            (lowered.rules, (lowered.facts, lowered.studies))
        });
        diagnostics::in_order(&mut diagnostics);
        if diagnostics.iter().any(|d| d.severity == Severity::Error) {
            // What a task costs is of interest once it is one.
            diagnostics.retain(|d| d.severity != Severity::Note);
        }
        let (rules, rest) = lowered.unzip();
        let (facts, studies) = rest.unwrap_or_default();
        Expansion {
            rules,
            facts,
            studies,
            diagnostics,
        }
    }

    /// Compiles the program.
    pub fn compile(self) -> Compilation {
        let Expansion {
            rules,
            facts,
            studies,
            diagnostics,
        } = self.expand();
        let failed = diagnostics.iter().any(|d| d.severity == Severity::Error);
        Compilation {
            rules: rules.filter(|_| !failed),
            facts: if failed { Vec::new() } else { facts },
            studies: if failed { Vec::new() } else { studies },
            diagnostics,
            sources: self.sources,
        }
    }
}

impl Compilation {
    /// The same without notes: what a verb that goes on with the program has to say.
    pub fn without_notes(mut self) -> Self {
        self.diagnostics.retain(|d| d.severity != Severity::Note);
        self
    }

    /// Whether some diagnostic is an error.
    pub fn has_errors(&self) -> bool {
        self.diagnostics.iter().any(|d| d.severity == Severity::Error)
    }
}
