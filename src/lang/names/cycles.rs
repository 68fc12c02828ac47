//! Definitions that need themselves, and libraries that take themselves over: the
//! language is total, so there are none.

use super::{DefinitionId, LibraryId, Program};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::source::Span;
use crate::lang::syntax::tree::{Expr, ExprKind, Name};

/// Longest chain of definitions, or of libraries, that need each other.
const DEEPEST: usize = 200;

/// Marks and reports what is circular, and chains that are too long.
pub(super) fn mark(program: &mut Program) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    let needs = (0..program.definitions.len()).map(|k| definition_needs(program, DefinitionId(k)));
    let (definitions, order) = broken(needs.collect());
    program.order = order.into_iter().map(DefinitionId).collect();
    for (k, closing) in definitions {
        let definition = &mut program.definitions[k];
        definition.circular = true;
        let help = "a definition may use others, never itself: there is no recursion";
        found.push(report("definition", "need", &definition.tree.name, closing).help(help));
    }
    let needs = (0..program.libraries.len()).map(|k| library_needs(program, LibraryId(k)));
    for (k, closing) in broken(needs.collect()).0 {
        program.libraries[k].circular = true;
        let Some((library, _)) = program.library(LibraryId(k)) else {
            continue;
        };
        let help = "a library may take over others, never itself: there is no recursion";
        found.push(report("library", "take", &library.name, closing).help(help));
    }
    found
}

/// Where a circle closes; none for a chain that is too long.
type Closing = Option<Span>;

fn report(kind: &str, verb: &str, name: &Name, closing: Closing) -> Diagnostic {
    let name_text = &name.text;
    let Some(closing) = closing else {
        let message = format!("{kind} `{name_text}` {verb}s too long a chain of others");
        return Diagnostic::new(Code::E0312, name.span, message);
    };
    let over = if verb == "take" { " over" } else { "" };
    Diagnostic::new(
        Code::E0209,
        name.span,
        format!("{kind} `{name_text}` {verb}s itself{over}"),
    )
    .related(closing, "the circle closes here")
}

/// What needs itself or too long a chain, and an order in which all come after what
/// they need.
fn broken(needs: Vec<Needs>) -> (Vec<(usize, Closing)>, Vec<usize>) {
    let mut walk = Walk {
        marks: vec![Mark::New; needs.len()],
        found: Vec::new(),
        order: Vec::new(),
    };
    for k in 0..needs.len() {
        walk.visit(&needs, k, None, 0);
    }
    walk.found.sort_unstable_by_key(|(k, closing)| (*k, closing.is_none()));
    walk.found.dedup_by_key(|(k, _)| *k);
    (walk.found, walk.order)
}

/// What one needs, and where it says so.
type Needs = Vec<(usize, Span)>;

#[derive(Clone, Copy, PartialEq)]
enum Mark {
    New,
    Open,
    /// With the length of the longest chain from here.
    Done(usize),
}

struct Walk {
    marks: Vec<Mark>,
    found: Vec<(usize, Closing)>,
    /// Those that are done.
    order: Vec<usize>,
}

impl Walk {
    /// The length of the longest chain from here; what is broken counts as none.
    fn visit(&mut self, needs: &[Needs], k: usize, from: Closing, depth: usize) -> usize {
        match self.marks[k] {
            Mark::Done(length) => return length,
            Mark::Open => return self.broken(k, from),
            Mark::New if depth > DEEPEST => return self.broken(k, None),
            Mark::New => self.marks[k] = Mark::Open,
        }
        let mut longest = 0;
        for (next, at) in &needs[k] {
            longest = longest.max(self.visit(needs, *next, Some(*at), depth + 1));
        }
        let length = if longest < DEEPEST {
            longest + 1
        } else {
            self.broken(k, None)
        };
        self.marks[k] = Mark::Done(length);
        self.order.push(k);
        length
    }

    fn broken(&mut self, k: usize, closing: Closing) -> usize {
        self.found.push((k, closing));
        0
    }
}

/// The definitions that the body and the defaults of one name.
fn definition_needs(program: &Program, id: DefinitionId) -> Needs {
    let definition = program.definition(id);
    let scope = &program.modules[definition.module].scope;
    let parameters = &definition.tree.parameters;
    let mut out = Vec::new();
    let mut see = |name: &Name| {
        if let Some(Some(id)) = scope.get(&name.text) {
            out.push((id.0, name.span));
        }
    };
    mentioned(&definition.tree.body, &mut |name| {
        if !parameters.iter().any(|p| p.name.text == name.text) {
            see(name);
        }
    });
    for default in parameters.iter().filter_map(|p| p.default.as_ref()) {
        mentioned(default, &mut see);
    }
    out
}

/// The libraries that one takes over.
fn library_needs(program: &Program, id: LibraryId) -> Needs {
    let Some((library, module)) = program.library(id) else {
        return Vec::new();
    };
    let uses = library.uses.iter().map(|u| &u.call.name);
    uses.filter_map(|name| Some(((*module.libraries.get(&name.text)?)?.0, name.span)))
        .collect()
}

/// Calls `see` with every name that an expression calls or refers to.
pub(in crate::lang) fn mentioned(expr: &Expr, see: &mut impl FnMut(&Name)) {
    match &expr.kind {
        ExprKind::Reference(reference) => see(&reference.name),
        ExprKind::Call(call) => {
            see(&call.name);
            call.arguments.iter().for_each(|a| mentioned(&a.value, see));
        }
        ExprKind::List(items) => items.iter().for_each(|e| mentioned(e, see)),
        ExprKind::Group(e) | ExprKind::Negate(e) => mentioned(e, see),
        ExprKind::Binary(_, a, b) | ExprKind::Else(a, b) => {
            mentioned(a, see);
            mentioned(b, see);
        }
        ExprKind::Quantity(_) | ExprKind::Text(_) | ExprKind::Colour(_) | ExprKind::Direction(..) => {}
    }
}
