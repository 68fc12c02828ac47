//! From the parser's pairs to the tree: libraries and their members.

use pest::iterators::Pair;

use super::build::{Builder, children, parts, replace, start_to};
use super::expressions::{call, expr, integer, name, reference};
use super::habits::Habit;
use super::tree::{
    Call, Class, ClassTable, Feature, FeatureRef, ForEach, Inclusion, Index, Item, Layout, LayoutPlace, Library, Row,
    Rule as RuleItem,
};
use super::{Rule, syntax_error};
use crate::lang::source::Span;

impl Builder<'_> {
    pub(super) fn library(&mut self, pair: Pair<'_, Rule>) -> Option<Library> {
        let doc = self.doc(&pair);
        let start = self.span(&pair);
        let known = self.bad.len();
        self.slips(&pair);
        let mut parts = parts(pair).peekable();
        let title = self.title(&parts.next()?);
        let parameters = parts.next_if(|p| p.as_rule() == Rule::parameters);
        let mut library = Library {
            head: start_to(start, title.span),
            name: title,
            parameters: parameters.map(|list| self.parameters(list)),
            uses: Vec::new(),
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
                Rule::inclusion => library.uses.extend(self.inclusion(part)),
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

    fn inclusion(&mut self, pair: Pair<'_, Rule>) -> Option<Inclusion> {
        let whole = self.span(&pair);
        let part = parts(pair).next()?;
        let call = match part.as_rule() {
            Rule::call => call(self, part),
            Rule::wrong_import => return self.misplaced_import(part),
            _ => Call {
                name: name(self.file, &part),
                arguments: Vec::new(),
            },
        };
        Some(Inclusion { call, span: whole })
    }

    /// It is reported, and read as if it stood where it should.
    fn misplaced_import(&mut self, pair: Pair<'_, Rule>) -> Option<Inclusion> {
        let at = self.span(&pair);
        self.found.push(
            syntax_error(at, "an import stands at the top of the file, not in a library")
                .help("move it above the `library`; inside, `use NAME(…)` takes over a library that is in scope"),
        );
        let import = self.use_item(pair)?;
        self.misplaced.push(Item::Use(import));
        None
    }

    fn feature(&mut self, pair: Pair<'_, Rule>) -> Option<Feature> {
        let whole = self.span(&pair);
        let many = children(pair.clone()).any(|p| p.as_rule() == Rule::kw_many);
        self.slips(&pair);
        let mut parts = parts(pair);
        Some(Feature {
            name: self.feature_ref(parts.next()?)?,
            kind: name(self.file, &parts.next()?),
            many,
            span: whole,
        })
    }

    pub(super) fn feature_ref(&mut self, pair: Pair<'_, Rule>) -> Option<FeatureRef> {
        let whole = self.span(&pair);
        let mut parts = parts(pair);
        let title = self.title(&parts.next()?);
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
        self.slips(&pair);
        let mut parts = parts(pair);
        let title = self.title(&parts.next()?);
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
        self.cells(&pair, whole);
        let mut parts = parts(pair);
        let title = self.title(&parts.next()?);
        let (mut cells, mut prior) = (Vec::new(), None);
        for part in parts {
            match part.as_rule() {
                Rule::prior => prior = self.value(part),
                _ => cells.push(matches!(part.as_str(), "1" | "true" | "yes")),
            }
        }
        Some(Row {
            name: title,
            cells,
            prior,
            span: whole,
        })
    }

    /// Answers cells in the manner of other languages.
    fn cells(&mut self, pair: &Pair<'_, Rule>, row: Span) {
        let mut edits = Vec::new();
        for part in pair.clone().into_inner() {
            let right = match (part.as_rule(), part.as_str()) {
                (Rule::wrong_colon, _) => "",
                (Rule::wrong_comma, _) => " ",
                (Rule::wrong_cell, "true" | "yes") => "1",
                (Rule::wrong_cell, _) => "0",
                _ => continue,
            };
            edits.push(replace(self.span(&part), right));
        }
        if !edits.is_empty() {
            self.habits.met(Habit::Cells, row, edits);
        }
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

    fn layout(&mut self, pair: Pair<'_, Rule>) -> Option<Layout> {
        let known = self.bad.len();
        let mut parts_of = parts(pair);
        let head = parts_of.next()?;
        let head_span = self.span(&head);
        self.slips(&head);
        let title = self.title(&parts(head).next()?);
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
}
