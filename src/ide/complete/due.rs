//! What a statement waits for, after the words that it has.

use super::Word;
use super::context::{Block, Context};
use crate::ide::{MAIN, Snapshot};
use crate::lang::syntax::TokenClass;
use crate::lang::{callable, vocabulary};
use crate::primitives::Type;

/// A bracket that is open, or the statement.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::ide) enum Frame<'t> {
    /// The statement with its last keyword.
    Statement(&'t str),
    /// The arguments of a call: how many were finished, and the name of this one.
    Call(&'t str, usize, Option<&'t str>),
    /// The index of a feature.
    Index(&'t str),
    /// A list, with the type of its elements.
    List(Option<Type>),
    /// Parentheses around a part of an expression.
    Group(Option<Type>),
}

/// A statement as far as it was read.
#[derive(Clone, Debug)]
pub(in crate::ide) struct Reading<'t> {
    /// Open brackets, the statement first.
    pub frames: Vec<Frame<'t>>,
    /// Where the call that is open begins.
    pub callee: Option<Word<'t>>,
    /// The type that is due.
    pub due: Option<Type>,
    pub last: Option<Word<'t>>,
    /// The word before the last.
    pub second: Option<Word<'t>>,
}

/// Words after which another kind of value is due.
const TURNS: &[(&str, Option<Type>)] = &[
    ("detect", Some(Type::Detector)),
    ("measure", Some(Type::Measure)),
    ("predict", Some(Type::Predictor)),
    ("camera", Some(Type::Camera)),
    ("views", Some(Type::Views)),
    ("at", Some(Type::Point)),
    ("facing", Some(Type::Direction)),
    ("voxel", Some(Type::Length)),
    ("turned", Some(Type::Angle)),
    ("prior", Some(Type::Share)),
    ("overlap", Some(Type::Share)),
    ("limit", Some(Type::Count)),
    ("starts", Some(Type::Count)),
    ("seeds", Some(Type::Count)),
    ("objects", None),
    ("methods", None),
    ("noise", None),
    ("program", None),
    ("published", None),
    ("variant", None),
    ("task", None),
    ("gain_floor", Some(Type::Count)),
    ("object", None),
    ("space", None),
    ("backdrop", None),
    ("marked", None),
    ("as", None),
    ("goal", None),
    ("and", None),
    ("method", None),
    ("inspected", None),
    ("visibility", None),
    ("verify", None),
    ("insertion", None),
    ("library", None),
    ("in", None),
    ("for", None),
    ("by", None),
    ("feature", None),
    ("class", None),
    ("classes", None),
    ("layout", None),
    ("rule", None),
    ("use", None),
    ("given", None),
    ("expect", None),
    ("let", None),
    ("thresholds", None),
    ("sensor_model", None),
];

impl<'t> Reading<'t> {
    /// Reads the statement before the cursor.
    pub fn of(context: &Context<'t>, snapshot: &Snapshot) -> Self {
        let mut reading = Self {
            frames: vec![Frame::Statement("")],
            callee: None,
            due: None,
            last: None,
            second: None,
        };
        let mut turned = None;
        for word in &context.statement {
            reading.word(*word, context, snapshot, &mut turned);
        }
        reading.due = reading.due_in(reading.frames.len() - 1, turned, snapshot);
        reading
    }

    fn word(&mut self, word: Word<'t>, context: &Context<'t>, snapshot: &Snapshot, turned: &mut Option<Type>) {
        match word.text {
            "(" => self.open_round(*turned, snapshot),
            "[" => self.open_square(word, *turned, snapshot),
            ")" | "]" if self.frames.len() > 1 => drop(self.frames.pop()),
            "," => self.next_argument(),
            ":" => self.colon(context, turned),
            "=" if matches!(self.frames.last(), Some(Frame::Statement("object"))) => *turned = Some(Type::Shape),
            text => self.turn(text, turned),
        }
        self.second = self.last.replace(word);
    }

    fn open_round(&mut self, turned: Option<Type>, snapshot: &Snapshot) {
        match self.last {
            Some(name) if is_word(name) && !matches!(name.class, TokenClass::Keyword) => {
                self.frames.push(Frame::Call(name.text, 0, None));
                self.callee = Some(name);
            }
            _ => {
                let due = self.due_in(self.frames.len() - 1, turned, snapshot);
                self.frames.push(Frame::Group(due));
            }
        }
    }

    fn open_square(&mut self, word: Word<'t>, turned: Option<Type>, snapshot: &Snapshot) {
        match self.last {
            Some(name) if word.glued && is_word(name) => self.frames.push(Frame::Index(name.text)),
            _ => {
                let due = self.due_in(self.frames.len() - 1, turned, snapshot);
                self.frames.push(Frame::List(due.and_then(element)));
            }
        }
    }

    fn next_argument(&mut self) {
        if let Some(Frame::Call(_, finished, named)) = self.frames.last_mut() {
            (*finished, *named) = (*finished + 1, None);
        }
    }

    fn colon(&mut self, context: &Context<'t>, turned: &mut Option<Type>) {
        match (self.frames.last_mut(), self.last, context.block) {
            (Some(Frame::Call(_, _, named)), Some(name), _) => *named = Some(name.text),
            (Some(Frame::Statement(_)), Some(name), Block::Fields(statement)) => {
                let fields = vocabulary::fields(statement).iter();
                *turned = fields
                    .filter(|(field, _)| *field == name.text)
                    .map(|(_, ty)| *ty)
                    .next();
            }
            _ => {}
        }
    }

    /// A keyword of the statement; the first word of a block's statement is one, too.
    fn turn(&mut self, text: &'t str, turned: &mut Option<Type>) {
        let first = self.last.is_none() || self.last.is_some_and(|w| matches!(w.text, "{" | "}"));
        let depth = self.frames.len();
        let Some(Frame::Statement(word)) = self.frames.last_mut() else {
            return;
        };
        if depth > 1 {
            return;
        }
        if let Some((known, ty)) = TURNS.iter().find(|(w, _)| *w == text)
            && (first || !matches!(*word, "let" | "use"))
            && (first || CONTINUING.contains(known))
        {
            *word = known;
            *turned = *ty;
        }
    }

    /// The type that is due in a frame.
    fn due_in(&self, frame: usize, turned: Option<Type>, snapshot: &Snapshot) -> Option<Type> {
        match self.frames.get(frame)? {
            Frame::Statement(_) => turned,
            Frame::Call(callee, finished, named) => parameter(snapshot, callee, *finished, *named),
            Frame::Index(_) => None,
            Frame::List(due) | Frame::Group(due) => *due,
        }
    }

    /// The last keyword of the statement.
    pub fn keyword(&self) -> &'t str {
        match self.frames.first() {
            Some(Frame::Statement(word)) => word,
            _ => "",
        }
    }

    /// Whether a value was just finished.
    pub fn after_value(&self) -> bool {
        self.last.is_some_and(|w| {
            matches!(w.text, ")" | "]") || w.class == TokenClass::Unit || (is_word(w) && w.text != self.keyword())
        })
    }
}

/// Keywords that can stand inside a statement.
const CONTINUING: &[&str] = &[
    "at", "facing", "voxel", "turned", "marked", "as", "prior", "and", "in", "by", "class", "classes",
];

/// Whether a token is a word rather than a mark or a number.
pub(in crate::ide) fn is_word(word: Word<'_>) -> bool {
    word.text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
}

/// The parameters of something that can be called, with their types: of the file's
/// scope or the registry.
pub(in crate::ide) fn parameters(snapshot: &Snapshot, callee: &str) -> Option<Vec<(String, Option<Type>)>> {
    let index = snapshot.index();
    let declared = index
        .scope(MAIN)
        .chain(index.libraries(MAIN))
        .find(|(name, _)| *name == callee);
    if let Some((_, at)) = declared {
        let parameters = index.signature(at)?.parameters.iter();
        return Some(parameters.map(|p| (p.name.clone(), p.ty)).collect());
    }
    let parameters = callable(callee)?.parameters.iter();
    Some(parameters.map(|p| (p.name.to_owned(), Some(p.ty))).collect())
}

/// The type of an argument, by its name or its place.
fn parameter(snapshot: &Snapshot, callee: &str, place: usize, named: Option<&str>) -> Option<Type> {
    let mut parameters = parameters(snapshot, callee)?.into_iter();
    match named {
        Some(wanted) => parameters.find(|(name, _)| name == wanted)?.1,
        None => parameters.nth(place)?.1,
    }
}

fn element(ty: Type) -> Option<Type> {
    match ty {
        Type::Point => Some(Type::Length),
        Type::Direction => Some(Type::Number),
        Type::List(element) => Some(*element),
        _ => None,
    }
}
