//! From the parser's pairs to the tree: files, imports and definitions, and what all
//! members share.

use pest::iterators::{Pair, Pairs};

use super::expressions::{expr, name, quoted};
use super::habits::{Habit, Habits};
use super::tree::{File, Item, Let, Module, Name, Parameter, Statement, TypeName, Use};
use super::{Rule, recover, span};
use crate::lang::diagnostics::{Code, Diagnostic, Edit};
use crate::lang::source::{FileId, Span};

/// Bad regions that are explained; a binary file has thousands.
const MOST_EXPLAINED: usize = 200;
/// The fields of `thresholds` and `sensor_model`.
const FIELDS: [&str; 8] = [
    "near",
    "absent",
    "confidence",
    "hit",
    "miss",
    "clamp_min",
    "clamp_max",
    "occupied",
];

/// Reads pairs into a tree; what is wrong collects in `found`.
pub(super) struct Builder<'a> {
    pub(super) file: FileId,
    text: &'a str,
    pub(super) found: Vec<Diagnostic>,
    pub(super) bad: Vec<Span>,
    comments: Vec<Span>,
    /// Imports that stand inside a library.
    pub(super) misplaced: Vec<Item>,
    pub(super) habits: Habits,
    /// Whether the last bad region is a statement without the braces of its fields.
    in_fields: bool,
}

pub(super) fn file(id: FileId, text: &str, pairs: Pairs<'_, Rule>) -> (File, Vec<Diagnostic>) {
    let comments = pairs
        .clone()
        .flatten()
        .filter(|p| p.as_rule() == Rule::COMMENT)
        .map(|p| span(id, &p))
        .collect();
    let mut b = Builder {
        file: id,
        text,
        found: Vec::new(),
        bad: Vec::new(),
        comments,
        misplaced: Vec::new(),
        habits: Habits::default(),
        in_fields: false,
    };
    b.comments_of_others();
    let mut edition = None;
    let mut items = Vec::new();
    for pair in pairs.flat_map(children) {
        match pair.as_rule() {
            Rule::header => edition = Some(b.header(pair)),
            Rule::EOI => {}
            _ => items.extend(b.item(pair)),
        }
    }
    items.append(&mut b.misplaced);
    b.found.extend(std::mem::take(&mut b.habits).answers());
    let tree = File {
        edition,
        items,
        comments: b.comments,
        bad: b.bad,
    };
    (tree, b.found)
}

/// The parts of a pair that say something.
pub(super) fn children(pair: Pair<'_, Rule>) -> impl Iterator<Item = Pair<'_, Rule>> {
    pair.into_inner()
        .filter(|p| !matches!(p.as_rule(), Rule::COMMENT | Rule::line_end))
}

/// The parts that are no keyword and no punctuation.
pub(super) fn parts<'i>(pair: Pair<'i, Rule>) -> impl Iterator<Item = Pair<'i, Rule>> {
    children(pair).filter(|p| !is_token(p.as_rule()))
}

/// The grammar lists keywords, then punctuation, without a break.
fn is_token(kind: Rule) -> bool {
    (Rule::kw_vpl..=Rule::wrong_arrow).contains(&kind)
}

impl Builder<'_> {
    pub(super) fn span(&self, pair: &Pair<'_, Rule>) -> Span {
        let at = span(self.file, pair);
        let written = self.text[at.start..at.end].trim_end().len();
        Span::new(self.file, at.start, at.start + written)
    }

    fn header(&mut self, pair: Pair<'_, Rule>) -> Name {
        let whole = self.span(&pair);
        let edition = parts(pair).next().map_or(
            Name {
                text: String::new(),
                span: whole,
            },
            |p| name(self.file, &p),
        );
        let written = &self.text[whole.start..whole.end];
        let usual = written.starts_with("vpl") && !written.contains(':') && whole.start + 3 < edition.span.start;
        if !usual && !edition.text.is_empty() {
            let line = format!("vpl {}", edition.text);
            self.found.push(
                Diagnostic::new(
                    Code::E0102,
                    whole,
                    "the edition line is a small `vpl`, a space and the edition",
                )
                .help(format!("write `{line}`"))
                .fix(format!("write `{line}`"), whole, line),
            );
        }
        edition
    }

    /// The name of a declaration; a hyphen in it is reported.
    pub(super) fn title(&mut self, pair: &Pair<'_, Rule>) -> Name {
        let mut title = name(self.file, pair);
        if pair.as_rule() == Rule::wrong_name {
            title.text = title.text.replace('-', "_");
            self.habits
                .met(Habit::Hyphen, title.span, vec![replace(title.span, &title.text)]);
        }
        title
    }

    fn comments_of_others(&mut self) {
        for at in &self.comments {
            let written = &self.text[at.start..at.end];
            let begin = |n: usize| replace(Span::new(at.file, at.start, at.start + n), "//");
            if written.starts_with('#') {
                self.habits.met(Habit::Hash, *at, vec![begin(1)]);
            } else if written.starts_with("/*") {
                let rest = self.text[at.end..].split('\n').next().unwrap_or("");
                let edits = match rest.trim().is_empty() {
                    true => vec![begin(2), replace(Span::new(at.file, at.end - 2, at.end), "")],
                    false => Vec::new(),
                };
                self.habits.met(Habit::Block, *at, edits);
            }
        }
    }

    /// Remembers a region that could not be read, and says why.
    pub(super) fn bad(&mut self, pair: &Pair<'_, Rule>) {
        let region = self.span(pair);
        self.bad.push(region);
        if self.bad.len() <= MOST_EXPLAINED && !self.is_a_lost_field(region) {
            self.found.push(recover::explain(region, pair.as_rule(), self.text));
        }
    }

    /// Whether a region is a field of a statement without braces, as in YAML: one
    /// report for the statement is enough.
    fn is_a_lost_field(&mut self, region: Span) -> bool {
        let text = &self.text[region.start..region.end];
        let first = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').next();
        let first = first.unwrap_or("");
        let lost = self.in_fields && FIELDS.contains(&first);
        self.in_fields = lost || (matches!(first, "thresholds" | "sensor_model") && !text.contains('{'));
        lost
    }

    /// Answers slips that the grammar reads on purpose.
    pub(super) fn slips(&mut self, pair: &Pair<'_, Rule>) {
        for slip in pair.clone().into_inner() {
            let (wrong, right) = match slip.as_rule() {
                Rule::wrong_equals => ("=", ":"),
                Rule::wrong_is => (":", "="),
                Rule::wrong_colon => (slip.as_str(), ""),
                Rule::wrong_arrow => (slip.as_str(), "->"),
                _ => continue,
            };
            let at = self.span(&slip);
            self.habits
                .met(Habit::Mark(wrong.to_owned(), right), at, vec![replace(at, right)]);
        }
    }

    fn item(&mut self, pair: Pair<'_, Rule>) -> Option<Item> {
        Some(match pair.as_rule() {
            Rule::use_item => Item::Use(self.use_item(pair)?),
            Rule::let_item => Item::Let(self.let_item(pair)?),
            Rule::tolerant_library => Item::Library(self.library(pair)?),
            Rule::tolerant_task => Item::Task(self.task(pair)?),
            Rule::tolerant_scene => Item::Scene(self.scene(pair)?),
            Rule::tolerant_test => Item::Test(self.test(pair)?),
            Rule::tolerant_study => Item::Study(self.study(pair)?),
            _ => {
                self.bad(&pair);
                return None;
            }
        })
    }

    pub(super) fn use_item(&mut self, pair: Pair<'_, Rule>) -> Option<Use> {
        let whole = self.span(&pair);
        let (mut path, mut words, mut names, mut grouped) = (None, Vec::new(), Vec::new(), false);
        for part in parts(pair) {
            match part.as_rule() {
                Rule::text => path = Some(quoted(self, part, "a file's path")),
                Rule::use_group => {
                    grouped = true;
                    names.extend(parts(part).map(|p| name(self.file, &p)));
                }
                _ => words.push(name(self.file, &part)),
            }
        }
        if !grouped && (path.is_some() || words.len() > 2) {
            names.extend(words.pop());
        }
        let module = match path {
            Some(path) if words.is_empty() => Module::Path(path),
            Some(path) => {
                self.found.push(
                    Diagnostic::new(
                        Code::E0111,
                        whole,
                        format!("`\"{}\"` is a file and has no parts", path.text),
                    )
                    .help("name the definitions after the path: `use \"file.vpl\".{a, b}`"),
                );
                return None;
            }
            None => Module::Dotted(words),
        };
        Some(Use {
            module,
            names,
            span: whole,
        })
    }

    fn let_item(&mut self, pair: Pair<'_, Rule>) -> Option<Let> {
        let doc = self.doc(&pair);
        self.slips(&pair);
        let mut parts = parts(pair).peekable();
        let title = self.title(&parts.next()?);
        let parameters = match parts.next_if(|p| p.as_rule() == Rule::parameters) {
            Some(list) => self.parameters(list),
            None => Vec::new(),
        };
        Some(Let {
            name: title,
            parameters,
            body: expr(self, parts.next()?),
            doc,
        })
    }

    pub(super) fn parameters(&mut self, pair: Pair<'_, Rule>) -> Vec<Parameter> {
        parts(pair)
            .filter_map(|p| {
                let mut parts = parts(p);
                let name = name(self.file, &parts.next()?);
                let ty = self.type_name(parts.next()?)?;
                let default = parts.next().map(|p| expr(self, p));
                Some(Parameter { name, ty, default })
            })
            .collect()
    }

    fn type_name(&self, pair: Pair<'_, Rule>) -> Option<TypeName> {
        let whole = self.span(&pair);
        let mut depth = 0;
        let mut inner = parts(pair).next()?;
        while inner.as_rule() == Rule::type_name {
            depth += 1;
            inner = parts(inner).next()?;
        }
        Some(TypeName {
            element: name(self.file, &inner),
            depth,
            span: whole,
        })
    }

    pub(super) fn statement(&mut self, pair: Pair<'_, Rule>) -> Option<Statement> {
        let whole = self.span(&pair);
        Some(Statement {
            value: self.value(pair)?,
            span: whole,
        })
    }

    /// The expression of a word that is followed by one.
    pub(super) fn value(&mut self, pair: Pair<'_, Rule>) -> Option<super::tree::Expr> {
        self.slips(&pair);
        let part = parts(pair).next()?;
        Some(expr(self, part))
    }

    /// The `///` lines that end right before a declaration.
    pub(super) fn doc(&self, pair: &Pair<'_, Rule>) -> String {
        let mut end = pair.as_span().start();
        let mut lines = Vec::new();
        let before = self.comments.partition_point(|c| c.start < end);
        for comment in self.comments[..before].iter().rev() {
            let text = &self.text[comment.start..comment.end];
            let between = &self.text[comment.end..end];
            let adjacent = between.trim().is_empty() && between.matches('\n').count() == 1;
            let Some(line) = text.strip_prefix("///").filter(|_| adjacent) else {
                break;
            };
            lines.push(line.strip_prefix(' ').unwrap_or(line).trim_end());
            end = comment.start;
        }
        lines.reverse();
        lines.join("\n")
    }
}

/// A change of some bytes.
pub(super) fn replace(span: Span, text: &str) -> Edit {
    Edit {
        span,
        text: text.to_owned(),
    }
}

pub(super) fn start_to(start: Span, end: Span) -> Span {
    Span { end: end.end, ..start }
}
