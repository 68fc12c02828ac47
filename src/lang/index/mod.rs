//! The index of names: what each name in a program denotes, and where that was declared.
//!
//! Nothing is resolved here a second time. The checker says what it resolved
//! ([`Recorder`]), and declarations are read from the trees; a file with mistakes
//! has an index of what could be resolved. `crate::ide` reads it.

mod declared;
mod recorder;

use std::collections::BTreeMap;

pub(super) use recorder::Recorder;

use super::source::{FileId, Span};
use crate::primitives::Type;
use crate::rules::FeatureKind;

/// What kind of thing a program declares.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// `library`.
    Library,
    /// `feature`, single or a family.
    Feature,
    /// `class`, or a row of a table.
    Class,
    /// `layout`.
    Layout,
    /// `task`.
    Task,
    /// `scene`.
    Scene,
    /// `object` of a scene.
    Object,
    /// `let`.
    Definition,
    /// A parameter of a `let` or of a template.
    Parameter,
    /// The variable of a `for each`.
    Variable,
    /// The `i` of `rule -> code[i]`.
    Index,
}

/// What a name denotes. Two names denote the same thing exactly when these are equal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Entity {
    /// Something that a program declares, and the name that declares it.
    Declared(Kind, Span),
    /// A file that is imported.
    Module(FileId),
    /// A primitive or a form, by name ([`super::callable`]).
    Primitive(&'static str),
    /// A parameter of a primitive or a form.
    Argument(&'static str, &'static str),
    /// An attribute of a kind of feature.
    Attribute(Attributed, &'static str),
    /// A kind of feature, or a type of a parameter.
    Type(&'static str),
    /// A unit.
    Unit(&'static str),
    /// A named colour.
    Colour(&'static str),
    /// A field of `thresholds` or `sensor_model`.
    Field(&'static str, &'static str),
    /// One of a few words, like a goal or a method.
    Word(&'static str),
}

/// A kind of feature, ordered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Attributed {
    /// See [`FeatureKind::Polygon`].
    Polygon,
    /// See [`FeatureKind::Marker`].
    Marker,
    /// See [`FeatureKind::Shell`].
    Shell,
}

impl From<FeatureKind> for Attributed {
    fn from(kind: FeatureKind) -> Self {
        match kind {
            FeatureKind::Polygon => Self::Polygon,
            FeatureKind::Marker => Self::Marker,
            FeatureKind::Shell => Self::Shell,
        }
    }
}

impl From<Attributed> for FeatureKind {
    fn from(kind: Attributed) -> Self {
        match kind {
            Attributed::Polygon => Self::Polygon,
            Attributed::Marker => Self::Marker,
            Attributed::Shell => Self::Shell,
        }
    }
}

/// A name in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Occurrence {
    /// Where.
    pub span: Span,
    /// Whether this is where it is declared.
    pub declares: bool,
    /// What it denotes.
    pub entity: Entity,
}

/// How a definition or a template is called.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Signature {
    /// Its parameters in order.
    pub parameters: Vec<Parameter>,
    /// What a definition gives; `None` where it is wrong.
    pub result: Option<Type>,
    /// The kinds of feature that it detects, measures or predicts.
    pub features: &'static [FeatureKind],
}

/// A parameter of a definition or a template.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its type; `None` where that is unknown.
    pub ty: Option<Type>,
    /// Whether it may be left out.
    pub optional: bool,
    /// Where it is declared.
    pub at: Span,
}

/// What every name in a program denotes.
#[derive(Debug, Default)]
pub struct Index {
    /// In the order of the text, none overlapping.
    occurrences: Vec<Occurrence>,
    /// By the span of the definition's or the library's name.
    signatures: BTreeMap<Span, Signature>,
    /// Of parameters and variables, by the span of their declaration.
    types: BTreeMap<Span, Type>,
    /// The definitions that each file can name.
    scopes: BTreeMap<FileId, BTreeMap<String, Span>>,
    /// The libraries that each file can name.
    libraries: BTreeMap<FileId, BTreeMap<String, Span>>,
}

impl Index {
    /// Every name of a file, in order.
    pub fn of(&self, file: FileId) -> &[Occurrence] {
        let start = self.occurrences.partition_point(|o| o.span.file < file);
        let end = self.occurrences.partition_point(|o| o.span.file <= file);
        &self.occurrences[start..end]
    }

    /// The name at a byte of a file, or right before it.
    pub fn at(&self, file: FileId, offset: usize) -> Option<Occurrence> {
        let names = self.of(file);
        let after = names.partition_point(|o| o.span.start <= offset);
        let last = names[..after].last()?;
        (offset <= last.span.end).then_some(*last)
    }

    /// Every name that denotes a thing, its declaration included.
    pub fn all(&self, entity: Entity) -> impl Iterator<Item = Occurrence> {
        self.occurrences.iter().filter(move |o| o.entity == entity).copied()
    }

    /// How a definition or a template is called, by the span of its name.
    pub fn signature(&self, definition: Span) -> Option<&Signature> {
        self.signatures.get(&definition)
    }

    /// The type of a parameter or a variable, by the span of its declaration.
    pub fn type_of(&self, declaration: Span) -> Option<Type> {
        self.types.get(&declaration).copied()
    }

    /// The definitions that a file can name, with the spans of their names.
    pub fn scope(&self, file: FileId) -> impl Iterator<Item = (&str, Span)> {
        let names = self.scopes.get(&file).into_iter().flatten();
        names.map(|(name, span)| (name.as_str(), *span))
    }

    /// The libraries that a file can name, likewise.
    pub fn libraries(&self, file: FileId) -> impl Iterator<Item = (&str, Span)> {
        let names = self.libraries.get(&file).into_iter().flatten();
        names.map(|(name, span)| (name.as_str(), *span))
    }
}
