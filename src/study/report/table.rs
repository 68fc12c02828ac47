//! A table that is Markdown and HTML.

/// A title, what its numbers are, and cells. The first column holds names.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// What it shows.
    pub title: String,
    /// How to read it; may be empty.
    pub note: String,
    /// Names of the columns.
    pub head: Vec<String>,
    /// Cells by row.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// The table in Markdown, its title as a heading.
    pub fn markdown(&self) -> String {
        let line = |cells: &[String]| {
            let cells: Vec<String> = cells.iter().map(|c| c.replace('|', "\\|")).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let mut out = format!("## {}\n\n", self.title);
        if !self.note.is_empty() {
            out += &format!("{}\n\n", self.note);
        }
        out += &line(&self.head);
        out += &format!("|---|{}\n", "--:|".repeat(self.head.len().saturating_sub(1)));
        self.rows.iter().for_each(|row| out += &line(row));
        out
    }

    /// The table in HTML, its title as a heading.
    pub fn html(&self) -> String {
        let cells = |row: &[String], tag: &str| {
            let cells = row.iter().enumerate().map(|(k, cell)| {
                let tag = if k == 0 { "th" } else { tag };
                format!("<{tag}>{}</{tag}>", escaped(cell))
            });
            format!("<tr>{}</tr>\n", cells.collect::<String>())
        };
        let rows: String = self.rows.iter().map(|row| cells(row, "td")).collect();
        let note = match self.note.as_str() {
            "" => String::new(),
            note => format!("<p>{}</p>\n", with_code(note)),
        };
        format!(
            "<section>\n<h2>{}</h2>\n{note}<div class=\"wide\"><table>\n<thead>{}</thead>\n<tbody>\n{rows}</tbody>\n</table></div>\n</section>\n",
            escaped(&self.title),
            cells(&self.head, "th"),
        )
    }
}

/// Text whose parts between backticks are code.
fn with_code(text: &str) -> String {
    let parts = text.split('`').enumerate();
    let part = |(k, part): (usize, &str)| match k % 2 {
        0 => escaped(part),
        _ => format!("<code>{}</code>", escaped(part)),
    };
    parts.map(part).collect()
}

/// Text as HTML shows it.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}
