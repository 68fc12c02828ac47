//! The declarations of a file as a tree.

use super::braces::{Block, blocks, end_of_block};
use super::{MAIN, Snapshot};
use crate::lang::Span;
use crate::lang::syntax::tree::{self, Item, Name};

/// A declaration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// Its name.
    pub name: String,
    /// A few words on it.
    pub detail: String,
    /// What it is.
    pub kind: SymbolKind,
    /// All of it.
    pub span: Span,
    /// Its name.
    pub at: Span,
    /// What it holds.
    pub children: Vec<Symbol>,
}

/// What a symbol is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SymbolKind {
    /// A definition with parameters.
    Function,
    /// A definition without.
    Constant,
    /// A library.
    Library,
    /// A feature.
    Feature,
    /// A class.
    Class,
    /// A rule.
    Rule,
    /// A layout.
    Layout,
    /// A task.
    Task,
    /// A scene.
    Scene,
    /// An object.
    Object,
    /// A test.
    Test,
    /// A study.
    Study,
}

/// The declarations of the main file, in the order of the text.
pub fn outline(snapshot: &Snapshot) -> Vec<Symbol> {
    let reading = Reading {
        text: snapshot.text(),
        blocks: blocks(snapshot.text()),
    };
    let items = snapshot.tree(MAIN).into_iter().flat_map(|tree| &tree.items);
    items.filter_map(|item| reading.item(item)).collect()
}

struct Reading<'t> {
    text: &'t str,
    blocks: Vec<Block>,
}

impl Reading<'_> {
    fn item(&self, item: &Item) -> Option<Symbol> {
        Some(match item {
            Item::Let(item) if item.parameters.is_empty() => self.definition(item, SymbolKind::Constant),
            Item::Let(item) => self.definition(item, SymbolKind::Function),
            Item::Library(library) => self.library(library),
            Item::Task(task) => self.block(&task.name, SymbolKind::Task, task.head),
            Item::Scene(scene) => {
                let objects = scene.objects.iter();
                let objects = objects.map(|o| leaf(&o.name, SymbolKind::Object, o.span)).collect();
                Symbol {
                    children: objects,
                    ..self.block(&scene.name, SymbolKind::Scene, scene.head)
                }
            }
            Item::Test(test) => self.block(&test.name, SymbolKind::Test, test.head),
            Item::Study(study) => self.block(&study.name, SymbolKind::Study, study.head),
            Item::Use(_) => return None,
        })
    }

    fn definition(&self, item: &tree::Let, kind: SymbolKind) -> Symbol {
        leaf(&item.name, kind, item.name.span.to(item.body.span))
    }

    fn library(&self, library: &tree::Library) -> Symbol {
        let mut children: Vec<Symbol> = Vec::new();
        for feature in &library.features {
            let detail = self.text.get(feature.name.span.end..feature.span.end).unwrap_or("");
            children.push(Symbol {
                detail: detail.trim_start_matches([' ', ':']).to_owned(),
                ..leaf(&feature.name.name, SymbolKind::Feature, feature.span)
            });
        }
        let classes = library.classes.iter().map(|c| (&c.name, c.span));
        let rows = library
            .tables
            .iter()
            .flat_map(|t| t.rows.iter().map(|r| (&r.name, r.span)));
        children.extend(
            classes
                .chain(rows)
                .map(|(name, span)| leaf(name, SymbolKind::Class, span)),
        );
        children.extend(library.rules.iter().map(|rule| self.rule(rule)));
        let layouts = library.layouts.iter();
        children.extend(layouts.map(|l| self.block(&l.name, SymbolKind::Layout, l.head)));
        children.sort_by_key(|child| child.span);
        Symbol {
            children,
            ..self.block(&library.name, SymbolKind::Library, library.head)
        }
    }

    fn rule(&self, rule: &tree::Rule) -> Symbol {
        let written = self.text.get(rule.head.start..rule.head.end).unwrap_or("");
        let name = Name {
            text: written.strip_prefix("rule").unwrap_or(written).trim().to_owned(),
            span: rule.head,
        };
        self.block(&name, SymbolKind::Rule, rule.head)
    }

    /// A symbol that goes on to the end of its braces.
    fn block(&self, name: &Name, kind: SymbolKind, head: Span) -> Symbol {
        let end = end_of_block(&self.blocks, head.end, self.text).unwrap_or(head.end);
        leaf(name, kind, Span { end, ..head })
    }
}

fn leaf(name: &Name, kind: SymbolKind, span: Span) -> Symbol {
    Symbol {
        name: name.text.clone(),
        detail: String::new(),
        kind,
        span,
        at: name.span,
        children: Vec::new(),
    }
}
