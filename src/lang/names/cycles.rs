//! Definitions that need themselves: the language is total, so there are none.

use super::{DefinitionId, Program};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::syntax::tree::{Expr, ExprKind};

/// Longest chain of definitions that need each other.
const DEEPEST: usize = 200;

#[derive(Clone, Copy, PartialEq)]
enum Mark {
    New,
    Open,
    Done,
}

/// Marks and reports circular definitions, and chains that are too long.
pub(super) fn mark(program: &mut Program) -> Vec<Diagnostic> {
    let needs: Vec<Vec<DefinitionId>> = (0..program.definitions.len())
        .map(|k| needs(program, DefinitionId(k)))
        .collect();
    let mut walk = Walk {
        marks: vec![Mark::New; needs.len()],
        circular: Vec::new(),
        too_deep: Vec::new(),
        needs,
    };
    for k in 0..walk.marks.len() {
        walk.visit(k, 0);
    }
    let circular = walk.circular.iter().map(|k| (*k, Code::E0209, "needs itself"));
    let deep = walk
        .too_deep
        .iter()
        .map(|k| (*k, Code::E0312, "needs too long a chain of definitions"));
    let reports: Vec<_> = circular.chain(deep).collect();
    let mut found = Vec::new();
    for (k, code, what) in reports {
        let definition = &mut program.definitions[k];
        definition.circular = true;
        let name = &definition.tree.name;
        found.push(
            Diagnostic::new(code, name.span, format!("definition `{}` {what}", name.text))
                .help("a definition may use others, never itself: there is no recursion"),
        );
    }
    found
}

struct Walk {
    marks: Vec<Mark>,
    needs: Vec<Vec<DefinitionId>>,
    circular: Vec<usize>,
    too_deep: Vec<usize>,
}

impl Walk {
    fn visit(&mut self, k: usize, depth: usize) {
        match self.marks[k] {
            Mark::Done => return,
            Mark::Open => return self.circular.push(k),
            Mark::New if depth > DEEPEST => return self.too_deep.push(k),
            Mark::New => self.marks[k] = Mark::Open,
        }
        for next in self.needs[k].clone() {
            self.visit(next.0, depth + 1);
        }
        self.marks[k] = Mark::Done;
    }
}

/// The definitions that the body of one names.
fn needs(program: &Program, id: DefinitionId) -> Vec<DefinitionId> {
    let definition = program.definition(id);
    let scope = &program.modules[definition.module].scope;
    let parameters = &definition.tree.parameters;
    let mut out = Vec::new();
    names(&definition.tree.body, &mut |name| {
        if !parameters.iter().any(|p| p.name.text == name)
            && let Some(Some(id)) = scope.get(name)
        {
            out.push(*id);
        }
    });
    out
}

/// Calls `see` with every name that an expression calls or refers to.
fn names(expr: &Expr, see: &mut impl FnMut(&str)) {
    match &expr.kind {
        ExprKind::Reference(reference) => see(&reference.name.text),
        ExprKind::Call(call) => {
            see(&call.name.text);
            call.arguments.iter().for_each(|a| names(&a.value, see));
        }
        ExprKind::List(items) => items.iter().for_each(|e| names(e, see)),
        ExprKind::Group(e) | ExprKind::Negate(e) => names(e, see),
        ExprKind::Binary(_, a, b) | ExprKind::Else(a, b) => {
            names(a, see);
            names(b, see);
        }
        ExprKind::Quantity(_) | ExprKind::Text(_) | ExprKind::Colour(_) | ExprKind::Direction(..) => {}
    }
}
