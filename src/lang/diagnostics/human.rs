//! The terminal form, drawn by miette's graphical handler.

use std::fmt;

use miette::{GraphicalReportHandler, GraphicalTheme, LabeledSpan, NamedSource, SourceCode};

use super::{Diagnostic, Label, Severity};
use crate::lang::source::{FileId, SourceMap, Span};

/// Draws a diagnostic with the source around it.
pub(super) fn one(d: &Diagnostic, sources: &SourceMap, colour: bool, width: usize) -> String {
    let theme = if colour {
        GraphicalTheme::unicode()
    } else {
        GraphicalTheme::unicode_nocolor()
    };
    let handler = GraphicalReportHandler::new_themed(theme)
        .with_width(width.max(40))
        .with_links(false);
    let mut out = String::new();
    if handler.render_report(&mut out, &Drawn::new(d, sources)).is_err() {
        return super::plain::one(d, sources);
    }
    out.push('\n');
    out
}

/// A diagnostic in miette's terms: labels of one file here, those of others as related reports.
struct Drawn {
    code: String,
    message: String,
    severity: miette::Severity,
    help: Option<String>,
    source: NamedSource<String>,
    labels: Vec<LabeledSpan>,
    elsewhere: Vec<Drawn>,
}

impl Drawn {
    fn new(d: &Diagnostic, sources: &SourceMap) -> Self {
        let home = d.primary.span.file;
        let (here, there): (Vec<_>, Vec<_>) = d.related.iter().partition(|l| l.span.file == home);
        let mut labels = vec![label(&d.primary, true)];
        labels.extend(here.into_iter().map(|l| label(l, false)));
        Self {
            code: d.code.as_str(),
            message: d.message.clone(),
            severity: severity(d.severity),
            help: d.help.clone(),
            source: source(home, sources),
            labels,
            elsewhere: there.into_iter().map(|l| Self::elsewhere(l, sources)).collect(),
        }
    }

    fn elsewhere(l: &Label, sources: &SourceMap) -> Self {
        Self {
            code: String::new(),
            message: l.text.clone(),
            severity: miette::Severity::Advice,
            help: None,
            source: source(l.span.file, sources),
            labels: vec![label(l, true)],
            elsewhere: Vec::new(),
        }
    }
}

fn label(l: &Label, primary: bool) -> LabeledSpan {
    let Span { start, end, .. } = l.span;
    let text = (!l.text.is_empty()).then(|| l.text.clone());
    if primary {
        LabeledSpan::new_primary_with_span(text, (start, end - start))
    } else {
        LabeledSpan::new_with_span(text, (start, end - start))
    }
}

fn source(id: FileId, sources: &SourceMap) -> NamedSource<String> {
    let (name, text) = sources
        .get(id)
        .map_or(("?", ""), |f| (f.display.as_str(), f.text.as_str()));
    NamedSource::new(name, text.to_owned())
}

fn severity(severity: Severity) -> miette::Severity {
    match severity {
        Severity::Error => miette::Severity::Error,
        Severity::Warning => miette::Severity::Warning,
        Severity::Note => miette::Severity::Advice,
    }
}

impl fmt::Debug for Drawn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl fmt::Display for Drawn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Drawn {}

impl miette::Diagnostic for Drawn {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        (!self.code.is_empty()).then(|| Box::new(&self.code) as Box<dyn fmt::Display>)
    }

    fn severity(&self) -> Option<miette::Severity> {
        Some(self.severity)
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|h| Box::new(h) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(&self.source)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        Some(Box::new(self.labels.iter().cloned()))
    }

    fn related<'a>(&'a self) -> Option<Box<dyn Iterator<Item = &'a dyn miette::Diagnostic> + 'a>> {
        if self.elsewhere.is_empty() {
            return None;
        }
        Some(Box::new(self.elsewhere.iter().map(|d| d as &dyn miette::Diagnostic)))
    }
}
