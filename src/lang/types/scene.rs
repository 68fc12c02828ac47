//! Scenes: the backdrop and the objects.

use super::Checker;
use super::expressions::Due;
use super::forms::BACKDROPS;
use super::scope::Scope;
use super::typed::{Expr, Library, Marked, Object, Scene};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::index::Kind;
use crate::lang::syntax::tree;
use crate::primitives::Type;

impl<'a> Checker<'a> {
    pub(super) fn scene(&mut self, scene: &'a tree::Scene, libraries: &[Library]) -> Scene {
        let first = scene.backdrops.first();
        for again in scene.backdrops.iter().skip(1) {
            self.surplus(again.span, first.map_or(again.span, |f| f.span), "backdrop");
        }
        Scene {
            name: scene.name.text.clone(),
            backdrop: self.backdrop(first.map(|s| &s.value), scene.head),
            backdrop_span: first.map_or(scene.head, |s| s.span),
            objects: scene.objects.iter().filter_map(|o| self.object(o, libraries)).collect(),
            span: scene.head,
        }
    }

    /// `None` is empty air; no statement is the usual sphere.
    pub(super) fn backdrop(&mut self, described: Option<&tree::Expr>, head: crate::lang::source::Span) -> Option<Expr> {
        let scope = Scope::of(self.program.main());
        let Some(described) = described else {
            let usual = tree::Call {
                name: tree::Name {
                    text: BACKDROPS[0].name.to_owned(),
                    span: head,
                },
                arguments: Vec::new(),
            };
            return self.primitive_call(&BACKDROPS[0], &usual, head, scope);
        };
        match &described.kind {
            tree::ExprKind::Reference(r) if r.name.text == "none" && r.fields.is_empty() => None,
            _ => self.form(described, BACKDROPS, "`backdrop`", scope),
        }
    }

    fn object(&mut self, object: &tree::Object, libraries: &[Library]) -> Option<Object> {
        let scope = Scope::of(self.program.main());
        let due = |ty, what| Due { ty, what };
        let shape = self.check(&object.shape, due(Type::Shape, "an object"), scope);
        let at = self.check(&object.at, due(Type::Point, "the place of an object"), scope);
        let turned = object
            .turned
            .as_ref()
            .map(|t| self.check(t, due(Type::Angle, "`turned`"), scope));
        let marked = object.marked.as_ref().map(|m| self.marked(m, libraries));
        Some(Object {
            name: object.name.text.clone(),
            shape: shape?,
            at: at?,
            turned: all(turned)?,
            marked: all(marked)?,
            span: object.span,
        })
    }

    /// `marked hull`: says which library has that layout.
    fn incomplete_mark(&mut self, marked: &tree::Marked, libraries: &[Library]) {
        let at = marked.library.span.to(marked.class.span);
        let layout = &marked.layout.text;
        let homes: Vec<&Library> = (libraries.iter())
            .filter(|l| l.layouts.iter().any(|known| known.name == *layout))
            .collect();
        let named = libraries.iter().find(|l| l.name == marked.library.text);
        let whole = |class: &str| match (homes.as_slice(), named.or(homes.first().copied())) {
            ([_, _, ..], None) | (_, None) => format!("marked LIBRARY.{layout} as {class}"),
            (_, Some(library)) => format!("marked {}.{layout} as {class}", library.name),
        };
        if marked.library.text.is_empty() {
            let message = format!("`{layout}` is the layout of some library: say of which");
            let out = Diagnostic::new(Code::E0208, at, message);
            let class = if marked.class.text.is_empty() {
                "CLASS"
            } else {
                &marked.class.text
            };
            let out = out.help(format!("write `{}`", whole(class)));
            self.report(match homes.as_slice() {
                [library] if !marked.class.text.is_empty() => {
                    let insert = format!("{}.", library.name);
                    out.fix(format!("write `{}`", whole(class)), marked.library.span, insert)
                }
                _ => out,
            });
            return;
        }
        let message = "this says where the markers are, not which of them the object has";
        let out = Diagnostic::new(Code::E0208, at, message);
        self.report(out.help(format!("add the class: `{}`", whole("CLASS"))));
    }

    fn marked(&mut self, marked: &tree::Marked, libraries: &[Library]) -> Option<Marked> {
        if marked.library.text.is_empty() || marked.class.text.is_empty() {
            self.incomplete_mark(marked, libraries);
            return None;
        }
        let Some(library) = libraries.iter().position(|l| l.name == marked.library.text) else {
            self.no_library(&marked.library, libraries);
            return None;
        };
        let here = &libraries[library];
        self.uses_listed(&marked.library);
        let main = self.program.main();
        let layout = here.layouts.iter().position(|l| l.name == marked.layout.text);
        if layout.is_none() {
            self.unknown_item(
                "layout",
                &marked.layout,
                here.layouts.iter().map(|l| l.name.as_str()),
                main,
            );
        }
        if let Some(layout) = layout {
            self.names
                .member(Kind::Layout, here.layouts[layout].span, &marked.layout);
        }
        let class = here.classes.iter().position(|c| c.name == marked.class.text);
        if class.is_none() {
            self.unknown_item(
                "class",
                &marked.class,
                here.classes.iter().map(|c| c.name.as_str()),
                main,
            );
        }
        if let Some(class) = class {
            self.names.member(Kind::Class, here.classes[class].span, &marked.class);
        }
        Some(Marked {
            library,
            layout: layout?,
            class: class?,
            span: marked.library.span.to(marked.class.span),
        })
    }
}

/// What is given must be right; what is not given is.
fn all<T>(given: Option<Option<T>>) -> Option<Option<T>> {
    given.map_or(Some(None), |value| value.map(Some))
}
