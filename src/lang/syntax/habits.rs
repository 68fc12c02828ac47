//! Habits of other languages, which the grammar reads on purpose: each is answered once
//! a file, however often it occurs, with one fix for all of its places.

use std::collections::BTreeMap;

use crate::lang::diagnostics::{Code, Diagnostic, Edit, Fix};
use crate::lang::source::Span;

/// A habit of another language.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Habit {
    /// `# comment`.
    Hash,
    /// `/* comment */`.
    Block,
    /// `box-a`.
    Hyphen,
    /// `tk1: true, false, 1`.
    Cells,
    /// `(107 mm, 0 mm, 0 mm)`.
    Tuple,
    /// `[107, 0, 0] mm`.
    CommonUnit,
    /// A mark that means nothing here, and what is written instead.
    Mark(String, &'static str),
}

impl Habit {
    /// What is wrong, and what to write.
    fn message(&self) -> (String, String) {
        let (wrong, right) = match self {
            Self::Mark(wrong, "") => {
                return (
                    format!("`{wrong}` has no place here"),
                    format!("leave the `{wrong}` out: a word and its value stand side by side"),
                );
            }
            Self::Mark(wrong, right) => {
                return (format!("`{wrong}` has no place here"), format!("write `{right}`"));
            }
            Self::Hash => ("a comment begins with `//`, not with `#`", "write `//`"),
            Self::Block => ("a comment begins with `//` and ends with its line", "write `//`"),
            Self::Hyphen => (
                "a `-` is no part of a name: it subtracts",
                "join the words of a name with `_`",
            ),
            Self::Cells => (
                "a row is a name and its cells, 0 or 1, with spaces between",
                "write the cells like `1 0 1`",
            ),
            Self::Tuple => (
                "a list stands in square brackets",
                "write a point like `[107 mm, 0 mm, 0 mm]`",
            ),
            Self::CommonUnit => (
                "every number of a list has its own unit",
                "write a point like `[107 mm, 0 mm, 0 mm]`",
            ),
        };
        (wrong.to_owned(), right.to_owned())
    }
}

/// Where habits were met.
#[derive(Default)]
pub(super) struct Habits(BTreeMap<Habit, Vec<Place>>);

struct Place {
    at: Span,
    /// None where nothing can be mended without losing something.
    edits: Vec<Edit>,
}

impl Habits {
    pub fn met(&mut self, habit: Habit, at: Span, edits: Vec<Edit>) {
        self.0.entry(habit).or_default().push(Place { at, edits });
    }

    /// One diagnostic a habit.
    pub fn answers(self) -> impl Iterator<Item = Diagnostic> {
        self.0.into_iter().filter_map(|(habit, places)| answer(&habit, places))
    }
}

/// Most further places that are shown.
const MOST_SHOWN: usize = 3;

fn answer(habit: &Habit, mut places: Vec<Place>) -> Option<Diagnostic> {
    places.sort_by_key(|p| p.at);
    let (message, advice) = habit.message();
    let mut out = Diagnostic::new(Code::E0109, places.first()?.at, message);
    for place in places.iter().skip(1).take(MOST_SHOWN) {
        out = out.related(place.at, "and here");
    }
    let help = match places.len() {
        n if n > 1 + MOST_SHOWN => format!("{advice}, here and at {} other places", n - 1),
        _ => advice.clone(),
    };
    let mendable = places.iter().all(|p| !p.edits.is_empty());
    let edits: Vec<Edit> = places.into_iter().flat_map(|p| p.edits).collect();
    if mendable {
        out.fixes.push(Fix { message: advice, edits });
    }
    Some(out.help(help))
}
