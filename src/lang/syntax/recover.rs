//! What is wrong with a region that the tolerant entry could not read.
//!
//! The region is parsed again by the strict entry of its kind. Where that gives
//! up is the place, and what it would have read there is what was expected.

use pest::Parser as _;
use pest::error::{Error, ErrorVariant, InputLocation};

use super::{Grammar, Rule, expected, slips, syntax_error, usage};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::names::suggest::{self, closest};
use crate::lang::source::{FileId, Span};

/// The strict entry for a kind of bad region.
pub(super) fn strict_entry(bad: Rule) -> Option<Rule> {
    Some(match bad {
        Rule::bad_item => Rule::item_only,
        Rule::bad_entry => Rule::entry_only,
        Rule::bad_row => Rule::row_only,
        Rule::bad_rule_statement => Rule::rule_statement_only,
        Rule::bad_place => Rule::place_only,
        Rule::bad_task_statement => Rule::task_statement_only,
        Rule::bad_scene_statement => Rule::scene_statement_only,
        Rule::bad_test_statement => Rule::test_statement_only,
        Rule::bad_study_statement => Rule::study_statement_only,
        _ => return None,
    })
}

/// Says what is wrong with a bad region.
pub(super) fn explain(region: Span, kind: Rule, text: &str) -> Diagnostic {
    let part = &text[region.start..region.end];
    let strict = strict_entry(kind).unwrap_or(Rule::item_only);
    let Err(error) = Grammar::parse(strict, part) else {
        return syntax_error(region, "this cannot be read here").help("put each statement on a line of its own");
    };
    let at = match error.location {
        InputLocation::Pos(at) | InputLocation::Span((at, _)) => at,
    };
    let expected = match error.variant {
        ErrorVariant::ParsingError { positives, .. } => expected::essential(&expected::names(&positives)),
        ErrorVariant::CustomError { .. } => return too_complex(region.file, &error),
    };
    let found = word_at(part, at);
    let place = Span::new(region.file, region.start + at, region.start + at + found.len());
    if found.is_empty() {
        return unfinished(region, at, &expected, part, strict);
    }
    let failure = Failure {
        part,
        at,
        found,
        place,
        expected: &expected,
        strict,
    };
    slips::answer(&failure).unwrap_or_else(|| unexpected(&failure))
}

/// Where the strict entry gave up.
pub(super) struct Failure<'a> {
    /// The bad region.
    pub part: &'a str,
    /// Up to where it was read.
    pub at: usize,
    /// What stands there.
    pub found: &'a str,
    pub place: Span,
    pub expected: &'a [String],
    strict: Rule,
}

impl Failure<'_> {
    /// Whether another text in place of the region can be read, or further than it.
    pub fn is_mended_by(&self, text: &str) -> bool {
        match Grammar::parse(self.strict, text) {
            Ok(_) => true,
            Err(error) => match error.location {
                InputLocation::Pos(end) | InputLocation::Span((end, _)) => end > self.at + 1,
            },
        }
    }

    /// The line that was not read to its end.
    pub fn line(&self) -> &str {
        line_at(self.part, self.at)
    }

    /// Whether one of some items or entries is due.
    pub fn begins_something(&self) -> bool {
        self.at == 0 && matches!(self.strict, Rule::item_only | Rule::entry_only)
    }
}

fn line_at(part: &str, at: usize) -> &str {
    let start = part[..at].rfind('\n').map_or(0, |end| end + 1);
    part[start..].lines().next().unwrap_or("").trim_start()
}

/// The parser gave up before an answer.
pub(super) fn too_complex(file: FileId, error: &Error<Rule>) -> Diagnostic {
    let at = match error.location {
        InputLocation::Pos(at) | InputLocation::Span((at, _)) => at,
    };
    Diagnostic::new(Code::E0108, Span::new(file, at, at), "this file is too complex to read")
        .help("split it into modules")
}

fn unexpected(failure: &Failure<'_>) -> Diagnostic {
    let Failure {
        part,
        at,
        found,
        place,
        expected,
        ..
    } = *failure;
    let words: Vec<&str> = expected
        .iter()
        .filter_map(|e| e.strip_prefix('`')?.strip_suffix('`'))
        .collect();
    let is_word = found.starts_with(|c: char| c.is_ascii_alphabetic());
    let similar = suggest::foreign(found)
        .filter(|word| words.contains(word))
        .or_else(|| is_word.then(|| closest(found, words.iter().copied())).flatten());
    let out = syntax_error(place, message(expected, &format!("found `{found}`"))).label("not expected here");
    match similar {
        Some(word) => {
            let out = out.help(format!("did you mean `{word}`?"));
            let mended = format!("{}{word}{}", &part[..at], &part[at + found.len()..]);
            match failure.is_mended_by(&mended) {
                true => out.fix(format!("write `{word}`"), place, word),
                false => out,
            }
        }
        None => out.maybe_help(advice(found, expected).or_else(|| usage_help(part, at, failure.strict))),
    }
}

/// The region ended too early: the place is where its text ends.
fn unfinished(region: Span, at: usize, expected: &[String], part: &str, strict: Rule) -> Diagnostic {
    let end = region.start + part[..at].trim_end().len();
    let last = Span::new(region.file, end, end);
    let unclosed = expected.iter().any(|e| e == "`}`") && at >= part.trim_end().len();
    if unclosed && let Some((open, due)) = unclosed_brace(part) {
        let open = region.start + open;
        let due = region.start + due;
        return syntax_error(Span::new(region.file, due, due), "a `}` is missing")
            .label("expected here")
            .related(Span::new(region.file, open, open + 1), "this `{` is not closed")
            .help("add the missing `}`");
    }
    let out = syntax_error(last, message(expected, "found the end of the line")).label("here");
    let closing = [')', ']']
        .into_iter()
        .find(|bracket| expected.contains(&format!("`{bracket}`")));
    if let Some(bracket) = closing {
        let help = format!("add the missing `{bracket}`");
        let end = end - region.start;
        let mended = format!("{}{bracket}{}", &part[..end], &part[end..]);
        let out = out.help(help.clone());
        return match Grammar::parse(strict, &mended) {
            Ok(_) => out.fix(help, last, bracket.to_string()),
            Err(_) => out,
        };
    }
    if expected.iter().any(|e| e.starts_with("the end of the text")) {
        return out.help("close the text with `\"` on its line");
    }
    out.maybe_help(usage_help(part, at, strict))
}

/// How the statement on the line that was not read is written, or the whole region.
fn usage_help(part: &str, at: usize, strict: Rule) -> Option<String> {
    let usage = match strict {
        Rule::place_only => Some("code[1] at [450 mm, 0 mm, 250 mm] facing +x"),
        _ => usage::of(line_at(part, at)).or_else(|| usage::of(part)),
    };
    usage.map(|usage| format!("write `{usage}`"))
}

fn message(expected: &[String], found: &str) -> String {
    match expected {
        [] => format!("this cannot be read: {found}"),
        _ => format!("expected {}, {found}", expected::list(expected)),
    }
}

/// Advice for slips that the expected tokens alone do not explain.
fn advice(found: &str, expected: &[String]) -> Option<String> {
    let has = |token: &str| expected.iter().any(|e| e == token);
    match found {
        "\"" if has("the end of the text (`\"`)") => {
            Some("a text ends on its line with `\"`; write `\\{` for a brace in it".into())
        }
        "#" => Some("a comment begins with `//`".into()),
        "*" if has("a name") && has("`{`") => {
            Some("nothing imports all of a module: name what you take, `use std.views.{sphere, ring}`".into())
        }
        "," if expected == ["`{`"] => Some("a rule concludes one feature: write a rule for each".into()),
        "," if expected == ["the end of the line"] => Some("a statement has one value, and ends with its line".into()),
        "/*" | "*" => Some("a comment begins with `//` and ends with its line".into()),
        "feature" | "class" | "classes" | "rule" | "layout" if has("`library`") => {
            Some(format!("`{found}` belongs inside the braces of a `library`"))
        }
        _ if has("`0` or `1`") => Some("a row is a name and its cells, 0 or 1, with spaces between".into()),
        _ if suggest::RESERVED.contains(&found) => Some(format!(
            "`{found}` begins a declaration: it is reserved, and stands neither here nor as a name"
        )),
        _ if expected == ["the end of the line"] => Some("a statement ends with its line, or with `;`".into()),
        _ => None,
    }
}

/// The word or mark at an offset.
pub(super) fn word_at(text: &str, at: usize) -> &str {
    let rest = text.get(at..).unwrap_or("");
    let Some(first) = rest.chars().next() else {
        return "";
    };
    if matches!(first, '\n' | '\r') {
        return "";
    }
    let word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if word(first) {
        let end = rest.find(|c| !word(c)).unwrap_or(rest.len());
        return &rest[..end];
    }
    ["/*", "=>", "==", "->", ".."]
        .into_iter()
        .find(|mark| rest.starts_with(mark))
        .unwrap_or(&rest[..first.len_utf8()])
}

/// The offset of a brace that is not closed, and the one where its partner is due: the
/// end of the text, or where a `}` stands further left than the line of its partner.
fn unclosed_brace(text: &str) -> Option<(usize, usize)> {
    let mut open: Vec<(usize, usize)> = Vec::new();
    let (mut start, mut code_end) = (0, 0);
    for line in text.split_inclusive('\n') {
        let code = line.split("//").next().unwrap_or(line);
        let indent = code.len() - code.trim_start().len();
        let mut quoted = false;
        for (k, c) in code.char_indices() {
            match c {
                '"' => quoted = !quoted,
                '{' if !quoted => open.push((start + k, indent)),
                '}' if !quoted => match open.pop() {
                    Some((at, further)) if k == indent && further > indent => return Some((at, code_end)),
                    _ => {}
                },
                _ => {}
            }
        }
        if !code.trim().is_empty() {
            code_end = start + code.trim_end().len();
        }
        start += line.len();
    }
    open.pop().map(|(at, _)| (at, code_end))
}

#[cfg(test)]
mod tests {
    use super::unclosed_brace;

    #[test]
    fn a_brace_is_due_where_the_indentation_says_so() {
        let text = "library l {\n  layout a {\n    b\n}\n";
        let open = text.find("{\n    b");
        assert_eq!(unclosed_brace(text), open.zip(text.find("\n}")));
        let flat = "library l {\nlayout a {\nb\n}\n";
        assert_eq!(unclosed_brace(flat), Some((10, flat.trim_end().len())));
        assert_eq!(unclosed_brace("a { b }"), None);
    }
}
