//! Calls: arguments against parameters, of primitives and of definitions.

use std::collections::BTreeMap;

use super::expressions::{Due, constant, made};
use super::parameters::Slot;
use super::scope::Scope;
use super::typed::{Expr, ExprKind};
use super::{Checker, units};
use crate::lang::diagnostics::{Code, Diagnostic, Edit, Label};
use crate::lang::index::Entity;
use crate::lang::names::suggest::{closest, one_of};
use crate::lang::names::{DefinitionId, standard_home};
use crate::lang::source::Span;
use crate::lang::syntax::tree;
use crate::primitives::{self, Default, Primitive};

impl Checker<'_> {
    pub(super) fn call(&mut self, call: &tree::Call, span: Span, scope: Scope<'_>) -> Option<Expr> {
        let name = &call.name.text;
        match scope.module.scope.get(name) {
            Some(Some(id)) => self.definition_call(*id, call, span, scope),
            Some(None) => self.arguments_alone(call, scope),
            None => match primitives::find(name) {
                Some(primitive) => {
                    self.names.uses(call.name.span, Entity::Primitive(primitive.name));
                    self.primitive_call(primitive, call, span, scope)
                }
                None => {
                    self.unknown_callee(&call.name, scope);
                    self.arguments_alone(call, scope)
                }
            },
        }
    }

    /// Looks at the arguments of a call that means nothing.
    fn arguments_alone(&mut self, call: &tree::Call, scope: Scope<'_>) -> Option<Expr> {
        for argument in &call.arguments {
            self.argument_alone(argument, scope);
        }
        None
    }

    /// Looks at an argument whose meaning is unknown: a word may be anything.
    fn argument_alone(&mut self, argument: &tree::Argument, scope: Scope<'_>) {
        let is_word = matches!(&argument.value.kind, tree::ExprKind::Reference(r) if r.fields.is_empty());
        if !is_word {
            self.infer(&argument.value, scope);
        }
    }

    pub(super) fn primitive_call(
        &mut self,
        primitive: &'static Primitive,
        call: &tree::Call,
        span: Span,
        scope: Scope<'_>,
    ) -> Option<Expr> {
        let wanted: Vec<Slot> = primitive
            .parameters
            .iter()
            .map(|p| Slot {
                name: p.name.to_owned(),
                ty: Some(p.ty),
                optional: !matches!(p.default, Default::Required),
                span,
                entity: Entity::Argument(primitive.name, p.name),
            })
            .collect();
        let given = self.arguments(&wanted, call, scope)?;
        let mut arguments = BTreeMap::new();
        for (parameter, given) in primitive.parameters.iter().zip(given) {
            let value = match (given, parameter.default) {
                (Some(given), _) => given,
                (None, Default::Value(value)) => constant(value(), parameter.ty, span),
                (None, Default::Absent | Default::Required) => continue,
            };
            arguments.insert(parameter.name, value);
        }
        Some(made(ExprKind::Primitive(primitive, arguments), primitive.result, span))
    }

    pub(super) fn definition_call(
        &mut self,
        id: DefinitionId,
        call: &tree::Call,
        span: Span,
        scope: Scope<'_>,
    ) -> Option<Expr> {
        self.names.uses(call.name.span, self.entity(id));
        let ty = self.definition(id);
        let signature = self.signatures[id.0].clone();
        let given = self.arguments(&signature, call, scope)?;
        Some(made(ExprKind::Definition(id, given), ty?, span))
    }

    /// The argument of each parameter in order; `None` for the whole where some is wrong.
    pub(super) fn arguments(
        &mut self,
        wanted: &[Slot],
        call: &tree::Call,
        scope: Scope<'_>,
    ) -> Option<Vec<Option<Expr>>> {
        let callee = &call.name.text;
        let mut given: Vec<Option<Expr>> = wanted.iter().map(|_| None).collect();
        let mut places: Vec<Option<Span>> = vec![None; wanted.len()];
        let (mut right, mut named) = (true, false);
        for (k, argument) in call.arguments.iter().enumerate() {
            let slot = match &argument.name {
                Some(name) => {
                    named = true;
                    self.named_slot(wanted, name, callee, scope)
                }
                None if named => {
                    self.report(
                        Diagnostic::new(
                            Code::E0304,
                            argument.value.span,
                            "an argument without a name stands after one with a name",
                        )
                        .help("name it too, or move it before the named ones"),
                    );
                    None
                }
                None if k > wanted.len() => None,
                None => self.positional_slot(wanted, k, argument.value.span, callee),
            };
            let Some(slot) = slot else {
                right = false;
                continue;
            };
            if let Some(first) = places[slot] {
                let message = format!("`{}` is given twice", wanted[slot].name);
                let out = Diagnostic::new(Code::E0304, argument.value.span, message);
                self.report(out.related(first, "given first here"));
                right = false;
                continue;
            }
            places[slot] = Some(argument.value.span);
            let what = format!("`{}` of `{callee}`", wanted[slot].name);
            given[slot] = match wanted[slot].ty {
                Some(ty) => self.check(&argument.value, Due { ty, what: &what }, scope),
                // What the parameter takes is unknown, and the rest of the argument is not.
                None => {
                    self.argument_alone(argument, scope);
                    None
                }
            };
            right &= given[slot].is_some();
        }
        right &= self.all_given(wanted, &places, call);
        right.then_some(given)
    }

    fn named_slot(&mut self, wanted: &[Slot], name: &tree::Name, callee: &str, scope: Scope<'_>) -> Option<usize> {
        let slot = wanted.iter().position(|w| w.name == name.text);
        if let Some(slot) = slot {
            self.names.uses(name.span, wanted[slot].entity);
        }
        if slot.is_some() || scope.lost(callee) {
            return slot;
        }
        let names = || wanted.iter().map(|w| w.name.as_str());
        let key = (name.span.file, callee.to_owned(), name.text.clone());
        if let Some(first) = self.unknown_arguments.get(&key).copied() {
            self.again(first, name.span);
            return None;
        }
        self.unknown_arguments.insert(key, self.found.len());
        let out = Diagnostic::new(
            Code::E0304,
            name.span,
            format!("`{callee}` has no argument `{}`", name.text),
        );
        let out = match closest(&name.text, names()) {
            Some(near) => out
                .help(format!("did you mean `{near}`?"))
                .fix(format!("write `{near}`"), name.span, near),
            None if wanted.is_empty() => out.help(format!("write `{callee}()`")),
            None => out.help(format!("its arguments are {}", list_names(wanted))),
        };
        self.report(out);
        None
    }

    /// Adds a place to a diagnostic that would be repeated word by word.
    fn again(&mut self, first: usize, span: Span) {
        const MOST_SHOWN: usize = 3;
        let Some(first) = self.found.get_mut(first).filter(|d| d.primary.span != span) else {
            return;
        };
        if first.related.len() < MOST_SHOWN {
            first.related.push(Label {
                span,
                text: "and here".into(),
            });
        }
        for fix in &mut first.fixes {
            let text = fix.edits.first().map(|e| e.text.clone()).unwrap_or_default();
            fix.edits.push(Edit { span, text });
        }
    }

    fn positional_slot(&mut self, wanted: &[Slot], k: usize, span: Span, callee: &str) -> Option<usize> {
        if k < wanted.len() {
            return Some(k);
        }
        let takes = match wanted.len() {
            0 => "no arguments".to_owned(),
            1 => "one argument".to_owned(),
            n => format!("{n} arguments"),
        };
        self.report(Diagnostic::new(Code::E0304, span, format!("`{callee}` takes {takes}")).label("one too many"));
        None
    }

    fn all_given(&mut self, wanted: &[Slot], places: &[Option<Span>], call: &tree::Call) -> bool {
        let missing: Vec<&Slot> = wanted
            .iter()
            .zip(places)
            .filter(|(w, place)| !w.optional && place.is_none())
            .map(|(w, _)| w)
            .collect();
        // An unknown argument is probably the missing one by another name.
        let misnamed = call
            .arguments
            .iter()
            .filter_map(|a| a.name.as_ref())
            .any(|n| wanted.iter().all(|w| w.name != n.text));
        if missing.is_empty() || misnamed {
            return missing.is_empty();
        }
        let described: Vec<String> = missing
            .iter()
            .map(|w| match w.ty {
                Some(ty) => format!("`{}` ({})", w.name, units::describe(ty)),
                None => format!("`{}`", w.name),
            })
            .collect();
        let callee = &call.name.text;
        self.report(
            Diagnostic::new(
                Code::E0303,
                call.name.span,
                format!("`{callee}` lacks {}", described.join(", ")),
            )
            .help(format!("its arguments are {}", list_names(wanted))),
        );
        false
    }

    pub(super) fn unknown_callee(&mut self, name: &tree::Name, scope: Scope<'_>) {
        if scope.lost(&name.text) || !self.first_time("name", name) {
            return;
        }
        if scope.module.libraries.contains_key(&name.text) {
            return self.library_as_value(name);
        }
        let out = Diagnostic::new(
            Code::E0203,
            name.span,
            format!("there is no definition or primitive `{}`", name.text),
        );
        let known = scope.module.scope.keys().map(String::as_str);
        let near = closest(&name.text, known.chain(primitives::all().map(|p| p.name)));
        let out = match (standard_home(&name.text), near) {
            (Some(module), _) => self.with_import(out, module, &name.text, scope),
            (None, Some(near)) => {
                out.help(format!("did you mean `{near}`?"))
                    .fix(format!("write `{near}`"), name.span, near)
            }
            (None, None) => {
                out.help(foreign_call(&name.text).unwrap_or("define it with `let`, or import it with `use`"))
            }
        };
        self.report(out);
    }

    /// Reports a library that stands where a value is due.
    pub(super) fn library_as_value(&mut self, name: &tree::Name) {
        let message = format!("`{}` is a library, and no value", name.text);
        self.report(
            Diagnostic::new(Code::E0203, name.span, message)
                .help(format!("take it over inside of a library, with `use {}`", name.text)),
        );
    }

    /// Offers the import of a name of the standard library.
    pub(super) fn with_import(&self, out: Diagnostic, module: &str, name: &str, scope: Scope<'_>) -> Diagnostic {
        let line = format!("use std.{module}.{name}");
        let out = out.help(format!("it is in the standard library: add `{line}`"));
        match &scope.module.tree.edition {
            Some(edition) if edition.span.file == out.primary.span.file => {
                let at = edition.span.after();
                out.fix(format!("add `{line}`"), at, format!("\n\n{line}"))
            }
            _ => out,
        }
    }
}

/// What is written for a shape or a function that others have.
fn foreign_call(name: &str) -> Option<&'static str> {
    Some(match name.to_ascii_lowercase().as_str() {
        "cube" | "cuboid" | "block" => "a cuboid is a `box(width: …, depth: …, height: …)`",
        "rgb" | "rgba" | "hsv" | "hex" => "a colour is a name like `red`, or `#ff8000`",
        "cylinder" | "disc" | "disk" => "a prism of 12 sides is nearly round: `prism(sides: 12, radius: …, height: …)`",
        "cone" => "a pyramid of 12 sides is nearly round: `pyramid(sides: 12, radius: …, height: …)`",
        "stl" | "obj" | "ply" | "model" | "cad" => {
            "a shape from a file is `mesh(file: \"part.stl\", units: mm, up: z)`"
        }
        "aruco" | "apriltag" | "tag" | "barcode" | "qrcode" => "markers are QR codes: `qr(text: \"…\", size: 100 mm)`",
        _ => return None,
    })
}

fn list_names(wanted: &[Slot]) -> String {
    one_of(wanted.iter().map(|w| w.name.as_str())).replace(" or ", " and ")
}
