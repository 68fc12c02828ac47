//! Scenes: the backdrop and the objects.

use super::Checker;
use super::expressions::Due;
use super::forms::BACKDROPS;
use super::scope::Scope;
use super::typed::{Expr, Library, Marked, Object, Scene};
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
    fn backdrop(&mut self, described: Option<&tree::Expr>, head: crate::lang::source::Span) -> Option<Expr> {
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

    fn marked(&mut self, marked: &tree::Marked, libraries: &[Library]) -> Option<Marked> {
        let Some(library) = libraries.iter().position(|l| l.name == marked.library.text) else {
            self.no_library(&marked.library, libraries);
            return None;
        };
        let here = &libraries[library];
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
        let class = here.classes.iter().position(|c| c.name == marked.class.text);
        if class.is_none() {
            self.unknown_item(
                "class",
                &marked.class,
                here.classes.iter().map(|c| c.name.as_str()),
                main,
            );
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
