//! The pages of the codes as they are read: for a terminal, and the index of all.
//!
//! The pages are Markdown of a narrow kind: a title, paragraphs, headings of the
//! second level, fenced blocks. `vpl explain` and the documentation read them.

use std::borrow::Cow;
use std::fmt::Write as _;

use super::codes::{Code, page, title};
use super::paint::{BOLD, CODE, paint};

/// The page of a code for a terminal: headings bold, programs indented.
pub fn explain(code: Code, colour: bool) -> String {
    let mut out = String::new();
    let mut in_code = false;
    for line in page(code).lines() {
        if line.starts_with("```") {
            in_code = !in_code;
            continue;
        }
        let heading = line.strip_prefix("## ").or(line.strip_prefix("# "));
        let _ = match heading {
            _ if in_code && line.is_empty() => writeln!(out),
            _ if in_code => writeln!(out, "    {}", paint(colour, CODE, line)),
            Some(heading) => writeln!(out, "{}", paint(colour, BOLD, heading)),
            None => writeln!(out, "{}", prose(line)),
        };
    }
    out
}

/// A line of prose; a reference to another page is its code alone.
fn prose(line: &str) -> Cow<'_, str> {
    let reference = line.strip_prefix("- [").and_then(|rest| {
        let (code, rest) = rest.split_once("](")?;
        Some(format!("- {code}{}", rest.split_once(')')?.1))
    });
    reference.map_or(Cow::Borrowed(line), Cow::Owned)
}

/// Every code with its title, one a line.
pub fn list() -> String {
    Code::ALL.iter().fold(String::new(), |mut out, code| {
        let _ = writeln!(out, "{code}  {}", title(*code));
        out
    })
}

/// The index of the pages, in Markdown.
pub fn index() -> String {
    let mut out = String::from(
        "# Diagnostics\n\nEvery code that `vpl` reports, with its page; `vpl explain CODE` shows the same.\n\
         Written from the codes by `cargo run --example diagnostics > docs/diagnostics/README.md`.\n\n\
         | code | severity | title |\n|---|---|---|\n",
    );
    for code in Code::ALL {
        let _ = writeln!(
            out,
            "| [{code}]({code}.md) | {} | {} |",
            code.severity().word(),
            title(*code)
        );
    }
    out
}

/// The codes whose numbers are nearest to that of a word; none where it has no number.
pub fn similar(word: &str) -> Vec<Code> {
    let number = |text: &str| {
        let digits = text.trim_start_matches(|c: char| !c.is_ascii_digit());
        digits.parse::<u32>().ok()
    };
    let Some(wanted) = number(word) else {
        return Vec::new();
    };
    let distance = |code: &Code| number(code.as_str()).unwrap_or(0).abs_diff(wanted);
    let mut codes = Code::ALL.to_vec();
    codes.sort_by_key(distance);
    codes.truncate(3);
    codes
}
