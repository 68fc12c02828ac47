//! The call around the cursor: its parameters, and which of them is being written.

use super::complete::{Context, Frame, Reading};
use super::describe::{call, describe};
use super::{MAIN, Snapshot};
use crate::lang::callable;
use crate::lang::index::{Entity, Kind};
use crate::primitives::{self, written};

/// A call's signature.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Help {
    /// As it is declared.
    pub label: String,
    /// Documentation in Markdown.
    pub docs: String,
    /// Its parameters: the bytes of the label and what they mean.
    pub parameters: Vec<(std::ops::Range<usize>, String)>,
    /// The parameter at the cursor.
    pub active: Option<usize>,
}

/// The signature of the innermost call around a byte of the main file.
pub fn signature_help(snapshot: &Snapshot, offset: usize) -> Option<Help> {
    let context = Context::at(snapshot.text(), offset);
    let reading = Reading::of(&context, snapshot);
    let open = reading.frames.iter().rev().find_map(|frame| match frame {
        Frame::Call(callee, finished, named) => Some((*callee, *finished, *named)),
        _ => None,
    });
    let (callee, finished, named) = open?;
    let (label, docs, parameters) = declared(snapshot, callee).or_else(|| of_primitive(callee))?;
    let active = match named {
        Some(name) => parameters.iter().position(|(n, _)| n == name),
        None => (finished < parameters.len()).then_some(finished),
    };
    let mut from = label.find('(').map_or(0, |at| at + 1);
    let placed = parameters.into_iter().map(|(name, docs)| {
        let start = label[from..].find(&format!("{name}: ")).map_or(from, |at| from + at);
        let end = label[start..].find([',', ')']).map_or(label.len(), |at| start + at);
        from = end;
        (start..end, docs)
    });
    let parameters = placed.collect();
    Some(Help {
        label,
        docs,
        parameters,
        active,
    })
}

type Declared = (String, String, Vec<(String, String)>);

fn declared(snapshot: &Snapshot, callee: &str) -> Option<Declared> {
    let (_, at) = snapshot.index().scope(MAIN).find(|(name, _)| *name == callee)?;
    let signature = snapshot.index().signature(at)?;
    let docs = describe(snapshot, Entity::Declared(Kind::Definition, at))?.docs;
    let parameters = signature.parameters.iter().map(|p| (p.name.clone(), String::new()));
    Some((call(callee, signature), docs, parameters.collect()))
}

fn of_primitive(callee: &str) -> Option<Declared> {
    let primitive = callable(callee)?;
    let written_each: Vec<String> = primitive.parameters.iter().map(primitives::signature).collect();
    let label = format!("{callee}({}) -> {}", written_each.join(", "), written(primitive.result));
    let parameters = primitive
        .parameters
        .iter()
        .map(|p| (p.name.to_owned(), p.doc.to_owned()));
    Some((label, primitive.doc.to_owned(), parameters.collect()))
}
