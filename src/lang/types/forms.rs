//! Forms of single statements that look like calls: the space and the backdrop.

use super::Checker;
use super::scope::Scope;
use super::typed::Expr;
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::index::Entity;
use crate::lang::names::suggest::{closest, one_of};
use crate::lang::syntax::tree;
use crate::primitives::{Default, Parameter, Primitive, Type};
use crate::rules::{Colour, Value};

/// `space cube(600 mm)` and `space box(1 m, 1 m, 2 m)`.
pub(in crate::lang) const SPACES: &[Primitive] = &[
    length_form("cube", &[required("edge", "Edge of the cube.")]),
    length_form(
        "box",
        &[
            required("x", "Extent along x."),
            required("y", "Extent along y."),
            required("z", "Extent along z."),
        ],
    ),
];

/// `backdrop sphere(radius: 2 m, colour: grey)`.
pub(in crate::lang) const BACKDROPS: &[Primitive] = &[length_form(
    "sphere",
    &[
        Parameter {
            name: "radius",
            ty: Type::Length,
            default: Default::Value(|| Value::Length(BACKDROP_RADIUS)),
            doc: "Radius.",
        },
        Parameter {
            name: "colour",
            ty: Type::Colour,
            default: Default::Value(|| Value::Colour(BACKDROP_COLOUR)),
            doc: "Colour.",
        },
    ],
)];

/// Radius of a backdrop that is not described, metres.
pub(in crate::lang) const BACKDROP_RADIUS: f64 = 2.0;
/// Colour of a backdrop that is not described.
pub(in crate::lang) const BACKDROP_COLOUR: Colour = Colour([128, 128, 128]);

/// The backdrop where none is described.
pub(in crate::lang) fn usual_backdrop() -> crate::rules::Backdrop {
    crate::rules::Backdrop {
        radius: BACKDROP_RADIUS,
        colour: BACKDROP_COLOUR,
    }
}

const fn length_form(name: &'static str, parameters: &'static [Parameter]) -> Primitive {
    Primitive {
        name,
        result: Type::Shape,
        features: &[],
        parameters,
        doc: "",
    }
}

const fn required(name: &'static str, doc: &'static str) -> Parameter {
    Parameter {
        name,
        ty: Type::Length,
        default: Default::Required,
        doc,
    }
}

/// The form of a name.
pub(in crate::lang) fn form(name: &str) -> Option<&'static Primitive> {
    SPACES.iter().chain(BACKDROPS).find(|form| form.name == name)
}

impl Checker<'_> {
    /// Checks a call of one of some forms; `what` names the statement.
    pub(super) fn form(
        &mut self,
        e: &tree::Expr,
        forms: &'static [Primitive],
        what: &str,
        scope: Scope<'_>,
    ) -> Option<Expr> {
        let names = || forms.iter().map(|f| f.name);
        let call = match &e.kind {
            tree::ExprKind::Call(call) => call,
            _ => {
                let message = format!("{what} is described by {}", one_of(names()));
                self.report(
                    Diagnostic::new(Code::E0301, e.span, message).help(format!("write `{}`", usage(&forms[0]))),
                );
                return None;
            }
        };
        let Some(form) = forms.iter().find(|f| f.name == call.name.text) else {
            let message = format!("{what} cannot be `{}`", call.name.text);
            let out = Diagnostic::new(Code::E0306, call.name.span, message);
            self.report(match closest(&call.name.text, names()) {
                Some(near) => out.meant(near),
                None => out.help(format!("write `{}`", usage(&forms[0]))),
            });
            return None;
        };
        self.names.uses(call.name.span, Entity::Primitive(form.name));
        self.primitive_call(form, call, e.span, scope)
    }
}

fn usage(form: &Primitive) -> String {
    let example = |p: &Parameter| match p.ty {
        Type::Colour => "grey".to_owned(),
        _ => "600 mm".to_owned(),
    };
    let arguments: Vec<String> = form.parameters.iter().map(example).collect();
    format!("{}({})", form.name, arguments.join(", "))
}
