//! From the parser's pairs to the tree: studies, their settings and variants.

use pest::iterators::Pair;

use super::Rule;
use super::build::{Builder, parts, start_to};
use super::expressions::{expr, name, quoted};
use super::tree::{Setting, Study, StudyStatement, StudyStatementKind, Variant};
use crate::lang::source::Span;

impl Builder<'_> {
    pub(super) fn study(&mut self, pair: Pair<'_, Rule>) -> Option<Study> {
        let doc = self.doc(&pair);
        let start = self.span(&pair);
        let known = self.bad.len();
        self.slips(&pair);
        let mut parts = parts(pair);
        let title = self.title(&parts.next()?);
        let mut statements = Vec::new();
        for part in parts {
            let span = self.span(&part);
            statements.extend(self.study_statement(part).map(|kind| StudyStatement { kind, span }));
        }
        Some(Study {
            head: start_to(start, title.span),
            name: title,
            statements,
            whole: self.bad.len() == known,
            doc,
        })
    }

    fn study_statement(&mut self, pair: Pair<'_, Rule>) -> Option<StudyStatementKind> {
        use StudyStatementKind as Kind;
        let kind = pair.as_rule();
        match kind {
            Rule::bad_study_statement => {
                self.bad(&pair);
                return None;
            }
            Rule::variant => return self.variant(pair).map(Kind::Variant),
            _ => {}
        }
        if !is_own(kind) {
            return self.setting(pair).map(Kind::Setting);
        }
        self.slips(&pair);
        let mut parts = parts(pair);
        Some(match kind {
            Rule::program_of => Kind::Program(quoted(self, parts.next()?, "a file's path")),
            Rule::task_of => Kind::Task(self.title(&parts.next()?)),
            Rule::objects => Kind::Objects(parts.map(|p| expr(self, p)).collect()),
            Rule::methods => Kind::Methods(parts.map(|p| name(self.file, &p)).collect()),
            Rule::starts => Kind::Starts(expr(self, parts.next()?)),
            Rule::seeds => Kind::Seeds(expr(self, parts.next()?)),
            Rule::noise => Kind::Noise(parts.map(|p| name(self.file, &p)).collect()),
            _ => Kind::Published(quoted(self, parts.next()?, "a file's path")),
        })
    }

    fn variant(&mut self, pair: Pair<'_, Rule>) -> Option<Variant> {
        self.slips(&pair);
        let mut parts = parts(pair);
        let title = self.title(&parts.next()?);
        let settings = parts.filter_map(|part| {
            let span: Span = self.span(&part);
            Some((self.setting(part)?, span))
        });
        Some(Variant {
            settings: settings.collect(),
            name: title,
        })
    }

    fn setting(&mut self, pair: Pair<'_, Rule>) -> Option<Setting> {
        Some(match pair.as_rule() {
            Rule::voxel_of => Setting::Voxel(self.value(pair)?),
            Rule::backdrop => Setting::Backdrop(self.value(pair)?),
            _ => Setting::Task(self.task_statement(pair)?),
        })
    }
}

/// Whether a statement is a study's own, and no setting of its task.
fn is_own(kind: Rule) -> bool {
    matches!(
        kind,
        Rule::program_of
            | Rule::task_of
            | Rule::objects
            | Rule::methods
            | Rule::starts
            | Rule::seeds
            | Rule::noise
            | Rule::published
    )
}
