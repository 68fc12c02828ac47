//! Classes: what features each has, one by one or as a table, and how likely it is.

use super::Checker;
use super::expressions::Due;
use super::scope::Scope;
use super::typed::Class;
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::syntax::tree;
use crate::primitives::Type;
use crate::rules::FeatureId;

impl Checker<'_> {
    pub(super) fn class(&mut self, class: &tree::Class, scope: Scope<'_>, width: usize) -> Class {
        let mut presence = vec![false; width];
        for feature in &class.features {
            for id in self.members_of(feature, scope).unwrap_or_default() {
                if std::mem::replace(&mut presence[id.index()], true) {
                    let message = format!("class `{}` lists `{}` twice", class.name.text, feature.name.text);
                    self.report(Diagnostic::new(Code::E0202, feature.span, message).help("leave one of them out"));
                }
            }
        }
        Class {
            environment: None,
            name: class.name.text.clone(),
            presence,
            prior: class.prior.as_ref().and_then(|p| self.prior(p, scope)),
            span: class.span,
        }
    }

    pub(super) fn table(&mut self, table: &tree::ClassTable, scope: Scope<'_>, width: usize) -> Vec<Class> {
        let columns: Option<Vec<Vec<FeatureId>>> = table.columns.iter().map(|c| self.members_of(c, scope)).collect();
        let columns: Option<Vec<FeatureId>> = columns.map(|c| c.into_iter().flatten().collect());
        if let Some(columns) = &columns {
            self.columns_once(table, columns);
        }
        table
            .rows
            .iter()
            .map(|row| self.row(row, columns.as_deref(), table, scope, width))
            .collect()
    }

    fn columns_once(&mut self, table: &tree::ClassTable, columns: &[FeatureId]) {
        let mut sorted = columns.to_vec();
        sorted.sort_unstable();
        sorted.dedup();
        if let (true, Some(first)) = (sorted.len() < columns.len(), table.columns.first()) {
            let last = table.columns.last().unwrap_or(first);
            let at = first.span.to(last.span);
            self.report(Diagnostic::new(
                Code::E0202,
                at,
                "a feature has two columns in this table",
            ));
        }
    }

    fn row(
        &mut self,
        row: &tree::Row,
        columns: Option<&[FeatureId]>,
        table: &tree::ClassTable,
        scope: Scope<'_>,
        width: usize,
    ) -> Class {
        let mut presence = vec![false; width];
        if let Some(columns) = columns {
            if columns.len() != row.cells.len() {
                self.wrong_width(row, columns.len(), table);
            }
            for (id, cell) in columns.iter().zip(&row.cells) {
                presence[id.index()] = *cell;
            }
        }
        Class {
            environment: None,
            name: row.name.text.clone(),
            presence,
            prior: row.prior.as_ref().and_then(|p| self.prior(p, scope)),
            span: row.span,
        }
    }

    fn wrong_width(&mut self, row: &tree::Row, expected: usize, table: &tree::ClassTable) {
        let found = row.cells.len();
        let mut out = Diagnostic::new(
            Code::E0310,
            row.span,
            format!(
                "expected {expected} cells in the row of `{}`, found {found}",
                row.name.text
            ),
        )
        .help("a row has a 1 or a 0 for each feature of the table, in its order");
        if let (Some(first), Some(last)) = (table.columns.first(), table.columns.last()) {
            let what = format!("{expected} features");
            out = out.related(first.span.to(last.span), what);
        }
        self.report(out);
    }

    fn prior(&mut self, prior: &tree::Expr, scope: Scope<'_>) -> Option<super::typed::Expr> {
        let due = Due {
            ty: Type::Share,
            what: "`prior`",
        };
        self.check(prior, due, scope)
    }

    pub(super) fn all_or_no_priors(&mut self, classes: &[Class]) {
        let with = classes.iter().find(|c| c.prior.is_some());
        let without = classes.iter().find(|c| c.prior.is_none());
        if let (Some(with), Some(without)) = (with, without) {
            self.report(
                Diagnostic::new(
                    Code::E0311,
                    without.span,
                    format!("class `{}` has no prior, and `{}` has one", without.name, with.name),
                )
                .related(with.span, "with a prior")
                .help("give every class a prior, or none (then all are equally likely)"),
            );
        }
    }
}
