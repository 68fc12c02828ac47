//! What a study leaves to read: a CSV summary, Markdown tables, plots, one page.

mod csv;
mod page;
mod plots;
mod table;
mod tables;

use super::design::Design;
use super::error::StudyError;
use super::ledger::Ledger;
use super::published::Published;
use super::summary::Summary;

pub use table::Table;
pub use tables::tables;

/// Writes all results of a study to its folder; gives its tables in Markdown.
///
/// # Errors
/// A file cannot be written.
pub fn write(
    design: &Design,
    summary: &Summary,
    published: Option<&Published>,
    ledger: &Ledger,
) -> Result<String, StudyError> {
    let tables = tables(design, summary, published);
    let markdown: Vec<String> = tables.iter().map(Table::markdown).collect();
    let markdown = markdown.join("\n");
    let plots = plots::plots(design, summary)?;
    ledger.write("summary.csv", csv::csv(design, summary).as_bytes())?;
    ledger.write("tables.md", markdown.as_bytes())?;
    for plot in &plots {
        ledger.write(&format!("{}.svg", plot.name), plot.svg.as_bytes())?;
    }
    let page = page::page(design, ledger.rows().len(), &tables, &plots);
    ledger.write("index.html", page.as_bytes())?;
    Ok(markdown)
}
