//! From the place of a declaration to its part of the tree.

use crate::lang::Span;
use crate::lang::syntax::tree::{
    Feature, FeatureRef, File, Index, Item, Layout, Let, Library, Name, Object, Parameter, Rule, Scene, Task,
};

/// A declaration with what it stands in.
#[derive(Clone, Copy)]
pub(super) enum Declaration<'t> {
    Let(&'t Let),
    /// A parameter of a definition or a template, and that one's name.
    Parameter(&'t Name, &'t Parameter),
    Library(&'t Library),
    Feature(&'t Library, &'t Feature),
    /// A class, or a row of a table.
    Class,
    Layout(&'t Layout),
    /// A variable of a rule: `for each`, or an index.
    Variable(&'t Library, &'t Rule),
    Task(&'t Task),
    Scene(&'t Scene),
    Object(&'t Object),
}

/// What is declared by the name at a span.
pub(super) fn declaration(file: &File, name: Span) -> Option<Declaration<'_>> {
    file.items.iter().find_map(|item| match item {
        Item::Let(item) => in_let(item, name),
        Item::Library(library) => in_library(library, name),
        Item::Task(task) => (task.name.span == name).then_some(Declaration::Task(task)),
        Item::Scene(scene) if scene.name.span == name => Some(Declaration::Scene(scene)),
        Item::Scene(scene) => {
            let object = scene.objects.iter().find(|o| o.name.span == name);
            object.map(Declaration::Object)
        }
        _ => None,
    })
}

fn in_let(item: &Let, name: Span) -> Option<Declaration<'_>> {
    if item.name.span == name {
        return Some(Declaration::Let(item));
    }
    parameter(&item.name, &item.parameters, name)
}

fn parameter<'t>(owner: &'t Name, parameters: &'t [Parameter], name: Span) -> Option<Declaration<'t>> {
    let found = parameters.iter().find(|p| p.name.span == name)?;
    Some(Declaration::Parameter(owner, found))
}

fn in_library(library: &Library, name: Span) -> Option<Declaration<'_>> {
    if library.name.span == name {
        return Some(Declaration::Library(library));
    }
    let parameters = library.parameters.as_deref().unwrap_or_default();
    let feature = library.features.iter().find(|f| f.name.name.span == name);
    let class = library.classes.iter().find(|c| c.name.span == name);
    let layout = library.layouts.iter().find(|l| l.name.span == name);
    let row = library.tables.iter().flat_map(|t| &t.rows).any(|r| r.name.span == name);
    feature
        .map(|f| Declaration::Feature(library, f))
        .or_else(|| parameter(&library.name, parameters, name))
        .or_else(|| class.map(|_| Declaration::Class))
        .or_else(|| layout.map(Declaration::Layout))
        .or_else(|| row.then_some(Declaration::Class))
        .or_else(|| {
            let rule = library.rules.iter().find(|r| variables(r).any(|at| at == name));
            rule.map(|rule| Declaration::Variable(library, rule))
        })
}

/// Where the variables of a rule are declared.
fn variables(rule: &Rule) -> impl Iterator<Item = Span> {
    let indices = heads(rule).filter_map(|f| match &f.index {
        Some(Index::Variable(name)) => Some(name.span),
        _ => None,
    });
    indices.chain(rule.each.iter().map(|e| e.variable.span))
}

/// The features of a rule's first line.
pub(super) fn heads(rule: &Rule) -> impl Iterator<Item = &FeatureRef> {
    rule.antecedents.iter().chain([&rule.consequent])
}
