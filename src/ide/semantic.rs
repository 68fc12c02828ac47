//! The words of a file and what each of them is, for colouring.

use super::{MAIN, Snapshot};
use crate::lang::index::{Entity, Kind, Occurrence};
use crate::lang::syntax::{Token, TokenClass};
use crate::lang::{FileId, vocabulary};

/// What a piece of text is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Meaning {
    /// A word of the language.
    Keyword,
    /// A type, or a kind of feature.
    Type,
    /// A module, or a library.
    Namespace,
    /// A feature, or an attribute of one.
    Property,
    /// A class.
    Class,
    /// A layout, a task or a scene.
    Struct,
    /// Something that is called.
    Function,
    /// A parameter or the name of an argument.
    Parameter,
    /// A variable, or a definition without parameters.
    Variable,
    /// One of a few words.
    EnumMember,
    /// A unit.
    Unit,
    /// A number.
    Number,
    /// A text.
    String,
    /// A comment.
    Comment,
    /// A mark between values.
    Operator,
}

/// A piece of the main file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Piece {
    /// First byte.
    pub start: usize,
    /// One past the last byte, on the same line.
    pub end: usize,
    /// What it is.
    pub meaning: Meaning,
    /// Whether it is declared here.
    pub declares: bool,
    /// Whether it belongs to the language or its library.
    pub standard: bool,
    /// Whether it documents.
    pub documents: bool,
}

/// The pieces of the main file, in order. Words that could not be resolved are left out.
pub fn semantic(snapshot: &Snapshot) -> Vec<Piece> {
    let names = snapshot.index().of(MAIN);
    let tokens = snapshot.tokens().iter();
    tokens.filter_map(|token| piece(snapshot, names, token)).collect()
}

fn piece(snapshot: &Snapshot, names: &[Occurrence], token: &Token) -> Option<Piece> {
    let plain = |meaning| Piece {
        start: token.start,
        end: token.end,
        meaning,
        declares: false,
        standard: false,
        documents: token.class == TokenClass::Doc,
    };
    Some(match token.class {
        TokenClass::Keyword => plain(Meaning::Keyword),
        TokenClass::Number => plain(Meaning::Number),
        TokenClass::Unit => plain(Meaning::Unit),
        TokenClass::Text => plain(Meaning::String),
        TokenClass::Colour | TokenClass::Direction => plain(Meaning::EnumMember),
        TokenClass::Comment | TokenClass::Doc => plain(Meaning::Comment),
        TokenClass::Operator => plain(Meaning::Operator),
        TokenClass::Type | TokenClass::Callee | TokenClass::Name | TokenClass::Hole => {
            let name = name_in(names, token)?;
            Piece {
                declares: name.declares,
                standard: is_standard(snapshot, name.entity),
                ..plain(meaning(snapshot, name.entity))
            }
        }
        TokenClass::Punctuation | TokenClass::Newline | TokenClass::Bad => return None,
    })
}

fn name_in<'n>(names: &'n [Occurrence], token: &Token) -> Option<&'n Occurrence> {
    let at = names.partition_point(|o| o.span.end <= token.start);
    names.get(at).filter(|o| o.span.start < token.end)
}

fn meaning(snapshot: &Snapshot, entity: Entity) -> Meaning {
    match entity {
        Entity::Declared(kind, at) => match kind {
            Kind::Library => Meaning::Namespace,
            Kind::Feature => Meaning::Property,
            Kind::Class => Meaning::Class,
            Kind::Layout | Kind::Task | Kind::Scene => Meaning::Struct,
            Kind::Object | Kind::Variable | Kind::Index => Meaning::Variable,
            Kind::Parameter => Meaning::Parameter,
            Kind::Definition => match snapshot.index().signature(at) {
                Some(signature) if signature.parameters.is_empty() => Meaning::Variable,
                _ => Meaning::Function,
            },
        },
        Entity::Module(_) => Meaning::Namespace,
        Entity::Primitive(_) => Meaning::Function,
        Entity::Argument(..) | Entity::Field(..) => Meaning::Parameter,
        Entity::Attribute(..) => Meaning::Property,
        Entity::Type(_) => Meaning::Type,
        Entity::Unit(_) => Meaning::Unit,
        Entity::Colour(_) | Entity::Word(_) => Meaning::EnumMember,
    }
}

/// Whether an entity is of the language or of a module of its library.
pub(super) fn is_standard(snapshot: &Snapshot, entity: Entity) -> bool {
    match entity {
        Entity::Declared(_, at) => standard_module(snapshot, at.file).is_some(),
        Entity::Module(file) => standard_module(snapshot, file).is_some(),
        _ => true,
    }
}

/// The module of the standard library that a file is.
pub fn standard_module(snapshot: &Snapshot, file: FileId) -> Option<&'static str> {
    let path = &snapshot.sources().get(file)?.display;
    let name = path.strip_prefix("std/")?.strip_suffix(".vpl")?;
    let known = vocabulary::modules()
        .map(|(module, _)| module)
        .find(|module| *module == name);
    known.filter(|_| file != MAIN)
}
