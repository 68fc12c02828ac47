//! From the parser's pairs to the tree: tasks, scenes and their statements.

use pest::iterators::Pair;

use super::Rule;
use super::build::{Builder, parts, start_to};
use super::expressions::{expr, name};
use super::tree::{Field, Marked, Name, Object, Scene, SpaceStatement, Task, TaskStatement, TaskStatementKind};
use crate::lang::source::Span;

impl Builder<'_> {
    pub(super) fn task(&mut self, pair: Pair<'_, Rule>) -> Option<Task> {
        let doc = self.doc(&pair);
        let start = self.span(&pair);
        let known = self.bad.len();
        self.slips(&pair);
        let mut parts = parts(pair);
        let title = self.title(&parts.next()?);
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

    pub(super) fn task_statement(&mut self, pair: Pair<'_, Rule>) -> Option<TaskStatementKind> {
        use TaskStatementKind as Kind;
        self.slips(&pair);
        let kind = pair.as_rule();
        if kind == Rule::bad_task_statement {
            self.bad(&pair);
            return None;
        }
        let mut parts = parts(pair);
        Some(match kind {
            Rule::library_of => Kind::Library(self.title(&parts.next()?)),
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
            Rule::visibility => Kind::Visibility(name(self.file, &parts.next()?)),
            Rule::verify => Kind::Verify(name(self.file, &parts.next()?)),
            Rule::insertion => Kind::Insertion(name(self.file, &parts.next()?)),
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

    pub(super) fn scene(&mut self, pair: Pair<'_, Rule>) -> Option<Scene> {
        let start = self.span(&pair);
        self.slips(&pair);
        let mut parts = parts(pair);
        let title = self.title(&parts.next()?);
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
        self.slips(&pair);
        let mut parts_of = parts(pair);
        let title = self.title(&parts_of.next()?);
        let shape = expr(self, parts_of.next()?);
        let at = expr(self, parts_of.next()?);
        let (mut turned, mut marked) = (None, None);
        for part in parts_of {
            match part.as_rule() {
                Rule::turned => turned = self.value(part),
                _ => marked = self.marked(part),
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

    fn marked(&mut self, pair: Pair<'_, Rule>) -> Option<Marked> {
        let whole = self.span(&pair);
        let mut parts_of = parts(pair);
        let first = self.title(&parts_of.next()?);
        let (mut layout, mut class) = (None, None);
        for part in parts_of {
            let dotted = part.as_rule() == Rule::marked_layout;
            let title = parts(part).next().map(|p| self.title(&p));
            *(if dotted { &mut layout } else { &mut class }) = title;
        }
        let unwritten = |span: Span| Name {
            text: String::new(),
            span,
        };
        let start = Span {
            end: first.span.start,
            ..first.span
        };
        Some(match layout {
            Some(layout) => Marked {
                library: first,
                layout,
                class: class.unwrap_or_else(|| unwritten(whole.after())),
            },
            None => Marked {
                library: unwritten(start),
                layout: first,
                class: class.unwrap_or_else(|| unwritten(whole.after())),
            },
        })
    }
}
