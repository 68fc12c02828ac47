//! Parameters of definitions and templates: their types and their defaults.

use super::expressions::Due;
use super::scope::{Parameters, Scope};
use super::typed::Parameter;
use super::{Checker, units};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::index::{Entity, Kind};
use crate::lang::names::suggest::closest;
use crate::lang::names::{self, Module};
use crate::lang::source::Span;
use crate::lang::syntax::tree;
use crate::primitives::Type;

/// What a call of a definition or a template has to give.
#[derive(Clone, Debug)]
pub(super) struct Slot {
    pub name: String,
    /// `None` where its declaration is wrong.
    pub ty: Option<Type>,
    pub optional: bool,
    pub span: Span,
    pub entity: Entity,
}

/// The parameters that the body of a definition or a template sees.
pub(super) fn visible(signature: &[Slot]) -> Parameters {
    let slots = signature.iter();
    slots.map(|s| (s.name.clone(), (s.ty, s.span))).collect()
}

impl Checker<'_> {
    /// The types of some parameters.
    pub(super) fn signature(&mut self, parameters: &[tree::Parameter]) -> Vec<Slot> {
        names::unique("parameter", parameters.iter().map(|p| &p.name), &mut self.found);
        parameters
            .iter()
            .map(|p| Slot {
                name: p.name.text.clone(),
                ty: self.type_name(&p.ty),
                optional: p.default.is_some(),
                span: p.name.span,
                entity: Entity::Declared(Kind::Parameter, p.name.span),
            })
            .collect()
    }

    /// Parameters with their defaults; `None` where one is wrong.
    pub(super) fn defaults(
        &mut self,
        parameters: &[tree::Parameter],
        signature: &[Slot],
        module: &Module,
    ) -> Option<Vec<Parameter>> {
        let checked: Vec<Option<Parameter>> = parameters
            .iter()
            .zip(signature)
            .map(|(parameter, slot)| {
                let default = match (&parameter.default, slot.ty) {
                    (None, _) => None,
                    (Some(_), None) => return None,
                    (Some(default), Some(ty)) => Some(self.default(default, slot, ty, parameters, module)?),
                };
                Some(Parameter {
                    name: slot.name.clone(),
                    default,
                })
            })
            .collect();
        checked.into_iter().collect()
    }

    fn default(
        &mut self,
        default: &tree::Expr,
        slot: &Slot,
        ty: Type,
        parameters: &[tree::Parameter],
        module: &Module,
    ) -> Option<super::typed::Expr> {
        let mut read = None;
        names::mentioned(default, &mut |name| {
            read = read.or_else(|| {
                parameters
                    .iter()
                    .map(|p| &p.name)
                    .find(|p| p.text == name.text)
                    .map(|p| (p.span, name.span))
            });
        });
        if let Some((declared, at)) = read {
            let message = format!("the default of `{}` reads another parameter", slot.name);
            self.report(
                Diagnostic::new(Code::E0213, at, message)
                    .related(declared, "the parameter")
                    .help("write the value out, or make a definition of it with `let`"),
            );
            return None;
        }
        let what = format!("the default of `{}`", slot.name);
        self.check(default, Due { ty, what: &what }, Scope::of(module))
    }

    /// Reports a word that is no type; the type that is surely meant.
    fn no_type(&mut self, word: &tree::Name) -> Option<Type> {
        let known = units::NAMED.iter().map(|(name, _)| *name);
        let message = format!("there is no type `{}`", word.text);
        let out = Diagnostic::new(Code::E0201, word.span, message);
        let (out, meant) = match word.text.as_str() {
            "marker" => (
                out.help("a marker is given by its pose: take a `pose`, and pass `label.pose`")
                    .fix("write `pose`", word.span, "pose"),
                Some(Type::Pose),
            ),
            "shell" | "feature" => (
                out.help("parts of a feature are passed, not the feature: an `edge`, a `polygon`, a `length`"),
                None,
            ),
            other => match closest(other, known.clone()) {
                Some(near) => (out.meant(near), units::named(near).map(|(_, ty)| ty)),
                None => (
                    out.help(format!("types are {}", known.collect::<Vec<_>>().join(", "))),
                    None,
                ),
            },
        };
        self.report(out);
        meant
    }

    fn type_name(&mut self, name: &tree::TypeName) -> Option<Type> {
        let element = &name.element;
        let Some((word, mut ty)) = units::named(&element.text) else {
            return self.no_type(element);
        };
        self.names.uses(element.span, Entity::Type(word));
        for _ in 0..name.depth {
            let Some(list) = units::list_of(ty) else {
                let message = format!("there are no lists of {}", units::describe(ty));
                self.report(Diagnostic::new(Code::E0301, name.span, message));
                return None;
            };
            ty = list;
        }
        Some(ty)
    }
}
