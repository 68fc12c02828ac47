//! From the parser's pairs to the tree: files, items and their members.

use pest::iterators::{Pair, Pairs};

use super::expressions::{expr, integer, name, quoted, reference};
use super::tree::{
    Class, ClassTable, Feature, FeatureRef, Field, File, ForEach, Index, Item, Layout, LayoutPlace, Let, Library,
    Marked, Module, Name, Object, Parameter, Row, Rule as RuleItem, Scene, SpaceStatement, Statement, Task,
    TaskStatement, TaskStatementKind, TypeName, Use,
};
use super::{Rule, recover, span};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::source::{FileId, Span};

/// Bad regions that are explained; a binary file has thousands.
const MOST_EXPLAINED: usize = 200;

/// Reads pairs into a tree; what is wrong collects in `found`.
pub(super) struct Builder<'a> {
    pub(super) file: FileId,
    text: &'a str,
    pub(super) found: Vec<Diagnostic>,
    bad: Vec<Span>,
    comments: Vec<Span>,
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
    };
    let mut edition = None;
    let mut items = Vec::new();
    for pair in pairs.flat_map(children) {
        match pair.as_rule() {
            Rule::header => edition = Some(b.header(pair)),
            Rule::EOI => {}
            _ => items.extend(b.item(pair)),
        }
    }
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
        parts(pair).next().map_or(
            Name {
                text: String::new(),
                span: whole,
            },
            |p| name(self.file, &p),
        )
    }

    /// Remembers a region that could not be read, and says why.
    fn bad(&mut self, pair: &Pair<'_, Rule>) {
        let region = self.span(pair);
        self.bad.push(region);
        if self.bad.len() <= MOST_EXPLAINED {
            self.found.push(recover::explain(region, pair.as_rule(), self.text));
        }
    }

    /// Answers slips that the grammar reads on purpose.
    pub(super) fn slips(&mut self, pair: &Pair<'_, Rule>) {
        for slip in pair.clone().into_inner() {
            let (wrong, right) = match slip.as_rule() {
                Rule::wrong_equals => ("=", ":"),
                Rule::wrong_colon => (":", ""),
                Rule::wrong_arrow => (slip.as_str(), "->"),
                _ => continue,
            };
            let help = match right {
                "" => "leave the `:` out: a word and its value stand side by side".to_owned(),
                _ => format!("write `{right}`"),
            };
            let at = self.span(&slip);
            self.found.push(
                Diagnostic::new(Code::E0109, at, format!("`{wrong}` has no place here"))
                    .help(help.clone())
                    .fix(help, at, right),
            );
        }
    }

    fn item(&mut self, pair: Pair<'_, Rule>) -> Option<Item> {
        Some(match pair.as_rule() {
            Rule::use_item => Item::Use(self.use_item(pair)?),
            Rule::let_item => Item::Let(self.let_item(pair)?),
            Rule::tolerant_library => Item::Library(self.library(pair)?),
            Rule::tolerant_task => Item::Task(self.task(pair)?),
            Rule::tolerant_scene => Item::Scene(self.scene(pair)?),
            _ => {
                self.bad(&pair);
                return None;
            }
        })
    }

    fn use_item(&mut self, pair: Pair<'_, Rule>) -> Option<Use> {
        let whole = self.span(&pair);
        let (mut path, mut words, mut names, mut grouped) = (None, Vec::new(), Vec::new(), false);
        for part in parts(pair) {
            match part.as_rule() {
                Rule::text => path = Some(quoted(self, part)),
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
        let mut parts = parts(pair).peekable();
        let title = name(self.file, &parts.next()?);
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

    fn parameters(&mut self, pair: Pair<'_, Rule>) -> Vec<Parameter> {
        parts(pair)
            .filter_map(|p| {
                let mut parts = parts(p);
                let name = name(self.file, &parts.next()?);
                let ty = self.type_name(parts.next()?)?;
                Some(Parameter { name, ty })
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

    fn library(&mut self, pair: Pair<'_, Rule>) -> Option<Library> {
        let doc = self.doc(&pair);
        let start = self.span(&pair);
        let known = self.bad.len();
        let mut parts = parts(pair);
        let title = name(self.file, &parts.next()?);
        let mut library = Library {
            head: start_to(start, title.span),
            name: title,
            features: Vec::new(),
            classes: Vec::new(),
            tables: Vec::new(),
            rules: Vec::new(),
            layouts: Vec::new(),
            whole: true,
            doc,
        };
        for part in parts {
            match part.as_rule() {
                Rule::feature => library.features.extend(self.feature(part)),
                Rule::class => library.classes.extend(self.class(part)),
                Rule::tolerant_classes => library.tables.extend(self.table(part)),
                Rule::tolerant_rule => library.rules.extend(self.rule(part)),
                Rule::tolerant_layout => library.layouts.extend(self.layout(part)),
                _ => self.bad(&part),
            }
        }
        library.whole = self.bad.len() == known;
        Some(library)
    }

    fn feature(&mut self, pair: Pair<'_, Rule>) -> Option<Feature> {
        let whole = self.span(&pair);
        let many = children(pair.clone()).any(|p| p.as_rule() == Rule::kw_many);
        let mut parts = parts(pair);
        Some(Feature {
            name: self.feature_ref(parts.next()?)?,
            kind: name(self.file, &parts.next()?),
            many,
            span: whole,
        })
    }

    fn feature_ref(&mut self, pair: Pair<'_, Rule>) -> Option<FeatureRef> {
        let whole = self.span(&pair);
        let mut parts = parts(pair);
        let title = name(self.file, &parts.next()?);
        let index = parts.next().and_then(|p| self.index(p));
        Some(FeatureRef {
            name: title,
            index,
            span: whole,
        })
    }

    pub(super) fn index(&mut self, pair: Pair<'_, Rule>) -> Option<Index> {
        let part = parts(pair).next()?;
        let whole = self.span(&part);
        Some(match part.as_rule() {
            Rule::integer => Index::Literal(integer(self, &part), whole),
            Rule::range => {
                let ends: Vec<u64> = parts(part).map(|p| integer(self, &p)).collect();
                Index::Range(*ends.first()?, *ends.get(1)?, whole)
            }
            _ => Index::Variable(name(self.file, &part)),
        })
    }

    fn class(&mut self, pair: Pair<'_, Rule>) -> Option<Class> {
        let whole = self.span(&pair);
        let mut parts = parts(pair);
        let title = name(self.file, &parts.next()?);
        let (mut features, mut prior) = (Vec::new(), None);
        for part in parts {
            match part.as_rule() {
                Rule::prior => prior = self.value(part),
                _ => features.extend(self.feature_ref(part)),
            }
        }
        Some(Class {
            name: title,
            features,
            prior,
            span: whole,
        })
    }

    fn table(&mut self, pair: Pair<'_, Rule>) -> Option<ClassTable> {
        let mut parts_of = parts(pair);
        let head = parts_of.next()?;
        let columns = parts(head).filter_map(|p| self.feature_ref(p)).collect();
        let mut rows = Vec::new();
        for part in parts_of {
            match part.as_rule() {
                Rule::row => rows.extend(self.row(part)),
                _ => self.bad(&part),
            }
        }
        Some(ClassTable { columns, rows })
    }

    fn row(&mut self, pair: Pair<'_, Rule>) -> Option<Row> {
        let whole = self.span(&pair);
        let mut parts = parts(pair);
        let title = name(self.file, &parts.next()?);
        let (mut cells, mut prior) = (Vec::new(), None);
        for part in parts {
            match part.as_rule() {
                Rule::prior => prior = self.value(part),
                _ => cells.push(part.as_str() == "1"),
            }
        }
        Some(Row {
            name: title,
            cells,
            prior,
            span: whole,
        })
    }

    fn rule(&mut self, pair: Pair<'_, Rule>) -> Option<RuleItem> {
        let known = self.bad.len();
        let mut parts_of = parts(pair);
        let head = parts_of.next()?;
        let head_span = self.span(&head);
        self.slips(&head);
        let mut features: Vec<FeatureRef> = parts(head).filter_map(|p| self.feature_ref(p)).collect();
        let consequent = features.pop()?;
        let mut rule = RuleItem {
            antecedents: features,
            consequent,
            each: Vec::new(),
            detect: Vec::new(),
            measure: Vec::new(),
            predict: Vec::new(),
            head: head_span,
            whole: true,
        };
        for part in parts_of {
            match part.as_rule() {
                Rule::for_each => rule.each.extend(self.for_each(part)),
                Rule::detect => rule.detect.extend(self.statement(part)),
                Rule::measure => rule.measure.extend(self.statement(part)),
                Rule::predict => rule.predict.extend(self.statement(part)),
                _ => self.bad(&part),
            }
        }
        rule.whole = self.bad.len() == known;
        Some(rule)
    }

    fn for_each(&mut self, pair: Pair<'_, Rule>) -> Option<ForEach> {
        let whole = self.span(&pair);
        let mut parts = parts(pair);
        Some(ForEach {
            variable: name(self.file, &parts.next()?),
            over: reference(self, parts.next()?)?,
            span: whole,
        })
    }

    fn statement(&mut self, pair: Pair<'_, Rule>) -> Option<Statement> {
        let whole = self.span(&pair);
        Some(Statement {
            value: self.value(pair)?,
            span: whole,
        })
    }

    /// The expression of a word that is followed by one.
    fn value(&mut self, pair: Pair<'_, Rule>) -> Option<super::tree::Expr> {
        self.slips(&pair);
        let part = parts(pair).next()?;
        Some(expr(self, part))
    }

    fn layout(&mut self, pair: Pair<'_, Rule>) -> Option<Layout> {
        let known = self.bad.len();
        let mut parts_of = parts(pair);
        let head = parts_of.next()?;
        let head_span = self.span(&head);
        let title = name(self.file, &parts(head).next()?);
        let mut places = Vec::new();
        for part in parts_of {
            match part.as_rule() {
                Rule::place => places.extend(self.place(part)),
                _ => self.bad(&part),
            }
        }
        Some(Layout {
            name: title,
            places,
            head: head_span,
            whole: self.bad.len() == known,
        })
    }

    fn place(&mut self, pair: Pair<'_, Rule>) -> Option<LayoutPlace> {
        let whole = self.span(&pair);
        let mut parts = parts(pair);
        Some(LayoutPlace {
            feature: self.feature_ref(parts.next()?)?,
            at: expr(self, parts.next()?),
            facing: expr(self, parts.next()?),
            span: whole,
        })
    }

    fn task(&mut self, pair: Pair<'_, Rule>) -> Option<Task> {
        let doc = self.doc(&pair);
        let start = self.span(&pair);
        let known = self.bad.len();
        let mut parts = parts(pair);
        let title = name(self.file, &parts.next()?);
        let mut statements = Vec::new();
        for part in parts {
            let whole = self.span(&part);
            match self.task_statement(part) {
                Some(kind) => statements.push(TaskStatement { kind, span: whole }),
                None => continue,
            }
        }
        Some(Task {
            head: start_to(start, title.span),
            name: title,
            statements,
            whole: self.bad.len() == known,
            doc,
        })
    }

    fn task_statement(&mut self, pair: Pair<'_, Rule>) -> Option<TaskStatementKind> {
        use TaskStatementKind as Kind;
        self.slips(&pair);
        let kind = pair.as_rule();
        if kind == Rule::bad_task_statement {
            self.bad(&pair);
            return None;
        }
        let mut parts = parts(pair);
        Some(match kind {
            Rule::library_of => Kind::Library(name(self.file, &parts.next()?)),
            Rule::goal => Kind::Goal(parts.map(|p| name(self.file, &p)).collect()),
            Rule::camera => Kind::Camera(expr(self, parts.next()?)),
            Rule::space => Kind::Space(Box::new(SpaceStatement {
                shape: expr(self, parts.next()?),
                at: expr(self, parts.next()?),
                voxel: expr(self, parts.next()?),
            })),
            Rule::views => Kind::Views(expr(self, parts.next()?)),
            Rule::thresholds => Kind::Thresholds(self.fields(parts.next()?)),
            Rule::limit => Kind::Limit(expr(self, parts.next()?)),
            Rule::overlap => Kind::Overlap(expr(self, parts.next()?)),
            Rule::method => Kind::Method(name(self.file, &parts.next()?)),
            Rule::gain_floor => Kind::GainFloor(expr(self, parts.next()?)),
            Rule::inspected => Kind::Inspected(name(self.file, &parts.next()?)),
            Rule::verify => Kind::Verify(name(self.file, &parts.next()?)),
            _ => Kind::SensorModel(self.fields(parts.next()?)),
        })
    }

    fn fields(&mut self, pair: Pair<'_, Rule>) -> Vec<Field> {
        parts(pair)
            .filter_map(|p| {
                self.slips(&p);
                let mut parts = parts(p);
                Some(Field {
                    name: name(self.file, &parts.next()?),
                    value: expr(self, parts.next()?),
                })
            })
            .collect()
    }

    fn scene(&mut self, pair: Pair<'_, Rule>) -> Option<Scene> {
        let start = self.span(&pair);
        let mut parts = parts(pair);
        let title = name(self.file, &parts.next()?);
        let (mut backdrops, mut objects) = (Vec::new(), Vec::new());
        for part in parts {
            match part.as_rule() {
                Rule::backdrop => backdrops.extend(self.statement(part)),
                Rule::object => objects.extend(self.object(part)),
                _ => self.bad(&part),
            }
        }
        Some(Scene {
            head: start_to(start, title.span),
            name: title,
            backdrops,
            objects,
        })
    }

    fn object(&mut self, pair: Pair<'_, Rule>) -> Option<Object> {
        let whole = self.span(&pair);
        let mut parts_of = parts(pair);
        let title = name(self.file, &parts_of.next()?);
        let shape = expr(self, parts_of.next()?);
        let at = expr(self, parts_of.next()?);
        let (mut turned, mut marked) = (None, None);
        for part in parts_of {
            match part.as_rule() {
                Rule::turned => turned = self.value(part),
                _ => {
                    let mut names = parts(part).map(|p| name(self.file, &p));
                    marked = Some(Marked {
                        library: names.next()?,
                        layout: names.next()?,
                        class: names.next()?,
                    });
                }
            }
        }
        Some(Object {
            name: title,
            shape,
            at,
            turned,
            marked,
            span: whole,
        })
    }

    /// The `///` lines that end right before a declaration.
    fn doc(&self, pair: &Pair<'_, Rule>) -> String {
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

fn start_to(start: Span, end: Span) -> Span {
    Span { end: end.end, ..start }
}
