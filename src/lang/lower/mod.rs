//! From the checked program to the rule set: families, layouts and definitions
//! expanded, constants folded, everything in SI units.
//!
//! What is only known now is checked here: ranges of values, and which primitive a
//! definition comes down to.

mod constants;
mod environments;
mod expand;
mod faces;
mod facts;
mod layout;
mod library;
mod ranges;
mod scene;
mod studies;
mod task;

pub(super) use layout::Placed;
pub(super) use task::TaskSpans;

use super::diagnostics::Diagnostic;
use super::names::Program;
use super::source::{SourceMap, Span};
use super::studies::Studied;
use super::types::typed;
use crate::rules::{FORMAT, Fact, Library, Place, RuleSet, Study};

/// The rule set as far as the program is right, with spans for the task checks.
pub(super) struct Lowered {
    pub rules: RuleSet,
    /// By library: whether all of it was lowered.
    pub whole: Vec<bool>,
    /// By library: its layouts; `None` where a place is wrong.
    pub layouts: Vec<Vec<Option<Placed>>>,
    /// By task.
    pub task_spans: Vec<TaskSpans>,
    /// By scene: its backdrop.
    pub backdrop_spans: Vec<Span>,
    /// By scene: what its objects are marked as.
    pub marks: Vec<Vec<Mark>>,
    /// The tests of the main file.
    pub facts: Vec<Fact>,
    /// The studies of the main file.
    pub studies: Vec<Study>,
}

/// `marked LIBRARY.LAYOUT as CLASS`.
pub(super) struct Mark {
    /// Which of the scene's objects.
    pub object: usize,
    /// Which library.
    pub library: usize,
    /// Which of its layouts.
    pub layout: usize,
    /// Which of its classes.
    pub class: usize,
    /// Where it stands.
    pub span: Span,
}

/// Expands a checked program.
///
/// `programs` are those that the studies name, in their order.
pub(super) fn lower(
    program: &Program,
    typed: &typed::Program,
    sources: &SourceMap,
    programs: &[Option<Studied>],
) -> (Lowered, Vec<Diagnostic>) {
    let language = program.main().tree.edition.as_ref().and_then(|e| e.text.parse().ok());
    let mut lowering = Lowering {
        typed,
        sources,
        steps: 0,
        depth: 0,
        found: Vec::new(),
    };
    let mut out = Lowered {
        rules: RuleSet {
            format: FORMAT,
            language: language.unwrap_or(super::EDITION),
            sources: sources.listed(),
            libraries: Vec::new(),
            tasks: Vec::new(),
            scenes: Vec::new(),
        },
        whole: Vec::new(),
        layouts: Vec::new(),
        task_spans: Vec::new(),
        backdrop_spans: Vec::new(),
        marks: Vec::new(),
        facts: Vec::new(),
        studies: Vec::new(),
    };
    let mut libraries = Vec::new();
    for library in &typed.libraries {
        let before = lowering.found.len();
        let (lowered, layouts) = lowering.library(library);
        libraries.push(LoweredLibrary {
            library: lowered,
            layouts,
            whole: library.whole && lowering.found.len() == before,
        });
    }
    for task in &typed.tasks {
        if let Some((task, spans)) = lowering.task(task) {
            out.rules.tasks.push(task);
            out.task_spans.push(spans);
        }
    }
    for scene in &typed.scenes {
        let (lowered, marks) = lowering.scene(scene, &libraries);
        out.rules.scenes.push(lowered);
        out.marks.push(marks);
        out.backdrop_spans.push(scene.backdrop_span);
    }
    out.facts = lowering.facts(&typed.facts, &libraries);
    for library in libraries {
        out.rules.libraries.push(library.library);
        out.layouts.push(library.layouts);
        out.whole.push(library.whole);
    }
    out.studies = lowering.studies(&out, programs);
    (out, lowering.found)
}

/// A library with what scenes need of it.
struct LoweredLibrary {
    library: Library,
    /// By layout; `None` where a place is wrong.
    layouts: Vec<Option<Placed>>,
    /// Whether all of it was lowered.
    whole: bool,
}

struct Lowering<'a> {
    typed: &'a typed::Program,
    sources: &'a SourceMap,
    /// Expressions expanded so far.
    steps: usize,
    /// How deep the expression that is being expanded nests.
    depth: usize,
    found: Vec<Diagnostic>,
}

impl Lowering<'_> {
    fn report(&mut self, diagnostic: Diagnostic) {
        self.found.push(diagnostic);
    }

    fn place(&self, span: Span) -> Place {
        self.sources.place(span)
    }
}
