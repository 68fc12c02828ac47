//! Names that hide others: reported, so that a word means one thing in one place.

use super::scope::Scope;
use super::{Checker, colours};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::syntax::tree;

impl Checker<'_> {
    /// Reports a parameter or variable that hides a feature, a parameter, a definition
    /// or a colour.
    pub(super) fn hides_something(&mut self, kind: &str, name: &tree::Name, scope: Scope<'_>) {
        if self.hides_a_parameter(kind, name, scope) {
            return;
        }
        let out = if let Some(family) = scope.family(&name.text) {
            hides(kind, name, "feature").related(family.span, "declared here")
        } else if let Some(Some(id)) = scope.module.scope.get(&name.text) {
            let at = self.program.definition(*id).tree.name.span;
            hides(kind, name, "definition").related(at, "defined here")
        } else if colours::named(&name.text).is_some() {
            hides(kind, name, "colour")
        } else {
            return;
        };
        self.report(out);
    }

    /// Reports a name that hides a parameter of the library around it.
    pub(super) fn hides_a_parameter(&mut self, kind: &str, name: &tree::Name, scope: Scope<'_>) -> bool {
        let Some((_, at)) = scope.parameters.and_then(|p| p.get(&name.text)) else {
            return false;
        };
        let out = hides(kind, name, "parameter").related(*at, "declared here");
        self.report(out);
        true
    }
}

/// A name that hides something else.
pub(super) fn hides(kind: &str, name: &tree::Name, what: &str) -> Diagnostic {
    let message = format!("{kind} `{0}` hides the {what} `{0}`", name.text);
    Diagnostic::new(Code::E0211, name.span, message).help(format!("give the {kind} another name"))
}
