//! Words that are values where their type is due: colours and named alternatives.

use super::expressions::{Due, constant};
use super::scope::Scope;
use super::typed::Expr;
use super::{Checker, colours};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::index::Entity;
use crate::lang::names::suggest::{closest, one_of};
use crate::lang::syntax::tree;
use crate::primitives::Type;
use crate::rules::Value;

impl Checker<'_> {
    /// Whether a reference is a colour or one of some words rather than a name.
    pub(super) fn is_word(&self, r: &tree::Reference, due: Type, scope: Scope<'_>) -> bool {
        let name = &r.name.text;
        let plain = r.index.is_none() && r.fields.is_empty();
        let named = scope.parameter(name).is_some()
            || scope.variable(name).is_some()
            || (scope.module.scope.contains_key(name) && colours::named(name).is_none());
        plain && !named && matches!(due, Type::Colour | Type::Choice(_))
    }

    pub(super) fn word(&mut self, r: &tree::Reference, due: Due<'_>) -> Option<Expr> {
        let name = &r.name;
        let words: Vec<&str> = match due.ty {
            Type::Choice(words) => words.to_vec(),
            _ => colours::names().collect(),
        };
        let value = match due.ty {
            Type::Choice(words) => words
                .iter()
                .find(|word| **word == name.text)
                .map(|word| (Entity::Word(word), Value::Choice(name.text.clone()))),
            _ => colours::all()
                .find(|(word, _)| *word == name.text)
                .map(|(word, colour)| (Entity::Colour(word), Value::Colour(colour))),
        };
        match value {
            Some((entity, value)) => {
                self.names.uses(name.span, entity);
                Some(constant(value, due.ty, r.span))
            }
            None => {
                self.unknown_word(name, due.what, &words);
                None
            }
        }
    }

    /// Reports a word that is none of those that are due.
    pub(super) fn unknown_word(&mut self, name: &tree::Name, what: &str, words: &[&str]) {
        let out = Diagnostic::new(Code::E0306, name.span, format!("{what} cannot be `{}`", name.text));
        let out = match closest(&name.text, words.iter().copied()) {
            Some(near) => out.meant(near),
            None => out.help(format!("it is {}", one_of(words.iter().copied()))),
        };
        self.report(out);
    }
}
