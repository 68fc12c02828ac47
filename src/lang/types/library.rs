//! Libraries: classes, presence tables and layouts.

use std::collections::BTreeMap;

use super::Checker;
use super::expressions::Due;
use super::scope::Scope;
use super::typed::{Class, Families, Layout, LayoutPlace, Library, Rule};
use crate::lang::diagnostics::{Code, Diagnostic, Severity};
use crate::lang::names;
use crate::lang::source::Span;
use crate::lang::syntax::tree;
use crate::primitives::Type;
use crate::rules::{FeatureId, FeatureKind};

impl<'a> Checker<'a> {
    pub(super) fn library(&mut self, library: &'a tree::Library) -> Library {
        let before = self.errors();
        let (families, features) = self.families(library);
        let rows = library.tables.iter().flat_map(|t| t.rows.iter().map(|r| &r.name));
        let class_names = library.classes.iter().map(|c| &c.name).chain(rows);
        names::unique("class", class_names, &mut self.found);
        names::unique("layout", library.layouts.iter().map(|l| &l.name), &mut self.found);
        let mut classes: Vec<Class> = Vec::new();
        for class in &library.classes {
            classes.push(self.class(class, &families, features.len()));
        }
        for table in &library.tables {
            classes.extend(self.table(table, &families, features.len()));
        }
        // Classes stand in the order of the text, whichever way they are written.
        classes.sort_by_key(|class| class.span);
        self.all_or_no_priors(&classes);
        let rules: Vec<Rule> = library.rules.iter().filter_map(|r| self.rule(r, &families)).collect();
        let layouts = library.layouts.iter().map(|l| self.layout(l, &families)).collect();
        if library.whole {
            self.not_empty(library, &classes);
        }
        Library {
            name: library.name.text.clone(),
            whole: library.whole && self.errors() == before && rules.len() == library.rules.len(),
            span: library.head,
            families,
            features,
            classes,
            rules,
            layouts,
        }
    }

    /// How many errors there are so far.
    pub(super) fn errors(&self) -> usize {
        self.found.iter().filter(|d| d.severity == Severity::Error).count()
    }

    fn not_empty(&mut self, library: &tree::Library, classes: &[Class]) {
        let name = &library.name;
        let lacks = if library.features.is_empty() {
            "features: `feature name : polygon`"
        } else if classes.is_empty() && library.tables.is_empty() {
            "classes: `class name { feature, … }`"
        } else {
            return;
        };
        let message = format!(
            "library `{}` has no {}",
            name.text,
            lacks.split(':').next().unwrap_or_default()
        );
        self.report(Diagnostic::new(Code::E0308, name.span, message).help(format!("declare some {lacks}")));
    }

    fn class(&mut self, class: &tree::Class, families: &Families, width: usize) -> Class {
        let mut presence = vec![false; width];
        for feature in &class.features {
            for id in self.members_of(feature, families).unwrap_or_default() {
                if std::mem::replace(&mut presence[id.index()], true) {
                    let message = format!("class `{}` lists `{}` twice", class.name.text, feature.name.text);
                    self.report(Diagnostic::new(Code::E0202, feature.span, message).help("leave one of them out"));
                }
            }
        }
        Class {
            name: class.name.text.clone(),
            presence,
            prior: class.prior.as_ref().and_then(|p| self.prior(p)),
            span: class.span,
        }
    }

    fn table(&mut self, table: &tree::ClassTable, families: &Families, width: usize) -> Vec<Class> {
        let columns: Option<Vec<Vec<FeatureId>>> = table.columns.iter().map(|c| self.members_of(c, families)).collect();
        let columns: Option<Vec<FeatureId>> = columns.map(|c| c.into_iter().flatten().collect());
        if let Some(columns) = &columns {
            self.columns_once(table, columns);
        }
        table
            .rows
            .iter()
            .map(|row| self.row(row, columns.as_deref(), table, width))
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

    fn row(&mut self, row: &tree::Row, columns: Option<&[FeatureId]>, table: &tree::ClassTable, width: usize) -> Class {
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
            name: row.name.text.clone(),
            presence,
            prior: row.prior.as_ref().and_then(|p| self.prior(p)),
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

    fn prior(&mut self, prior: &tree::Expr) -> Option<super::typed::Expr> {
        let due = Due {
            ty: Type::Share,
            what: "`prior`",
        };
        self.check(prior, due, Scope::of(self.program.main()))
    }

    fn all_or_no_priors(&mut self, classes: &[Class]) {
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

    fn layout(&mut self, layout: &'a tree::Layout, families: &Families) -> Layout {
        let mut seen: BTreeMap<FeatureId, Span> = BTreeMap::new();
        let mut places = Vec::new();
        for place in &layout.places {
            let Some(checked) = self.layout_place(place, families) else {
                continue;
            };
            if let Some(first) = seen.insert(checked.feature, place.span) {
                let message = format!("`{}` has two places in this layout", place.feature.name.text);
                let out = Diagnostic::new(Code::E0202, place.feature.span, message);
                self.report(out.related(first, "first placed here"));
                continue;
            }
            places.push(checked);
        }
        if layout.whole && layout.places.is_empty() {
            let message = format!("layout `{}` has no places", layout.name.text);
            let help = "give each feature a place: `code[1] at [450 mm, 0 mm, 250 mm] facing +x`";
            self.report(Diagnostic::new(Code::E0308, layout.name.span, message).help(help));
        }
        Layout {
            name: layout.name.text.clone(),
            places,
            span: layout.head,
        }
    }

    fn layout_place(&mut self, place: &tree::LayoutPlace, families: &Families) -> Option<LayoutPlace> {
        let feature = self.one_feature(&place.feature, families);
        let scope = Scope::of(self.program.main());
        let at = Due {
            ty: Type::Point,
            what: "a place",
        };
        let facing = Due {
            ty: Type::Direction,
            what: "`facing`",
        };
        let (at, facing) = (
            self.check(&place.at, at, scope),
            self.check(&place.facing, facing, scope),
        );
        Some(LayoutPlace {
            feature: feature?,
            at: at?,
            facing: facing?,
            span: place.span,
        })
    }

    /// A single marker; layouts place markers.
    fn one_feature(&mut self, feature: &tree::FeatureRef, families: &Families) -> Option<FeatureId> {
        let used = super::features::feature_use(
            self,
            &feature.name,
            feature.index.as_ref(),
            feature.span,
            families,
            None,
        )?;
        let family = families.0.get(&feature.name.text)?;
        if family.kind != FeatureKind::Marker {
            let message = format!(
                "`{}` is a {}, and a layout places markers",
                feature.name.text, family.kind
            );
            let out = Diagnostic::new(Code::E0307, feature.span, message);
            self.report(out.related(family.span, "declared here"));
            return None;
        }
        families.resolve(&used, &BTreeMap::new())
    }
}
