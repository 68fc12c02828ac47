//! Characters that no program has: answered by what was meant.
//!
//! A replacement is offered as a fix where the region can be read with it, or further
//! than without it.

use super::build::replace;
use super::recover::Failure;
use super::syntax_error;
use crate::lang::diagnostics::{Diagnostic, Fix};
use crate::lang::source::Span;

/// What a character means, and what is written for it.
struct Slip {
    found: &'static str,
    message: &'static str,
    help: &'static str,
    /// Instead of it.
    right: Option<&'static str>,
}

const fn slip(found: &'static str, message: &'static str, help: &'static str, right: Option<&'static str>) -> Slip {
    Slip {
        found,
        message,
        help,
        right,
    }
}

const SLIPS: &[Slip] = &[
    slip(
        "“”„‟«»",
        "a curly quote begins no text",
        "a text stands in straight quotes, `\"…\"`",
        Some("\""),
    ),
    slip(
        "'‘’`",
        "a single quote begins no text",
        "a text stands in double quotes, `\"…\"`",
        Some("\""),
    ),
    slip("−–—", "this dash is no minus sign", "write `-`", Some("-")),
    slip(
        "×·",
        "this sign is no operator",
        "a product is written with `*`",
        Some("*"),
    ),
    slip(
        "÷",
        "this sign is no operator",
        "a quotient is written with `/`",
        Some("/"),
    ),
    slip(
        "\u{a0}\u{2002}\u{2003}\u{2009}\u{202f}\u{3000}",
        "this is no plain space",
        "write a space instead",
        Some(" "),
    ),
    slip(
        "\u{200b}\u{200c}\u{200d}\u{2060}",
        "an invisible character",
        "take it out",
        Some(""),
    ),
    slip(
        "\u{feff}",
        "a byte order mark inside of the file",
        "take it out",
        Some(""),
    ),
    slip(
        "≥≤<>≠",
        "nothing is compared in VPL",
        "a threshold is a name and its value: `near: 10 mm`",
        None,
    ),
    slip("^", "there are no powers", "write the product out with `*`", None),
    slip(
        "%",
        "`%` is a unit and stands behind a number",
        "write a share like `99 %`",
        None,
    ),
    slip("@$&|~?!\\", "VPL has no such sign", "take it out", None),
];

/// Answers what stands where the region could not be read on.
pub(super) fn answer(failure: &Failure<'_>) -> Option<Diagnostic> {
    bullet(failure)
        .or_else(|| quoted_name(failure))
        .or_else(|| python_import(failure))
        .or_else(|| index_by_dot(failure))
        .or_else(|| character(failure))
}

/// A character that no program has.
fn character(failure: &Failure<'_>) -> Option<Diagnostic> {
    let sign = failure.found.chars().next()?;
    let slip = SLIPS.iter().find(|s| s.found.contains(sign))?;
    if slip.right.is_none() && failure.begins_something() {
        return None;
    }
    let out = syntax_error(failure.place, slip.message)
        .label("not expected here")
        .help(slip.help);
    let Some(right) = slip.right else {
        return Some(out);
    };
    let wrong = (failure.part.char_indices()).filter(|(_, c)| slip.found.contains(*c));
    let edits: Vec<(usize, usize)> = wrong.map(|(k, c)| (k, c.len_utf8())).collect();
    Some(mended(out, failure, &edits, right, slip.help))
}

/// `"near": 10 mm`, as in JSON.
fn quoted_name(failure: &Failure<'_>) -> Option<Diagnostic> {
    let name_is_due = failure.expected.iter().any(|e| e == "a name");
    if failure.found != "\"" || !name_is_due {
        return None;
    }
    let mut edits = Vec::new();
    let mut from = failure.at;
    while let Some(open) = failure.part[from..].find('"').map(|k| from + k) {
        let inside = &failure.part[open + 1..];
        let word = inside
            .find(|c: char| !c.is_ascii_alphanumeric() && c != '_')
            .unwrap_or(inside.len());
        let close = open + 1 + word;
        if word == 0 || !failure.part[close..].starts_with('"') {
            break;
        }
        edits.extend([(open, 1), (close, 1)]);
        from = close + 1;
    }
    let message = "a name stands without quotes";
    let out = syntax_error(failure.place, message).label("not expected here");
    let help = "take the quotes off: only texts have them";
    Some(mended(out.help(help), failure, &edits, "", help))
}

/// `from std.views import sphere`.
fn python_import(failure: &Failure<'_>) -> Option<Diagnostic> {
    let rest = failure.part.trim_end().strip_prefix("from ")?;
    let (module, names) = rest.split_once(" import ")?;
    let (module, names) = (module.trim(), names.trim());
    let plain = |c: char| c.is_ascii_alphanumeric() || "_., ".contains(c);
    if failure.at > 0 || !rest.chars().all(plain) {
        return None;
    }
    let right = match names.contains(',') {
        true => format!("use {module}.{{{names}}}"),
        false => format!("use {module}.{names}"),
    };
    let length = failure.part.trim_end().len();
    let help = format!("write `{right}`");
    let out = syntax_error(failure.place, "an import begins with `use`").help(help.clone());
    Some(mended(out, failure, &[(0, length)], &right, &help))
}

/// `code.2 at …`: an index stands in brackets.
fn index_by_dot(failure: &Failure<'_>) -> Option<Diagnostic> {
    let rest = failure.part.get(failure.at + 1..)?;
    let digits = rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    let name = failure.part[..failure.at].ends_with(|c: char| c.is_ascii_alphanumeric() || c == '_');
    if failure.found != "." || digits == 0 || !name {
        return None;
    }
    let right = format!("[{}]", &rest[..digits]);
    let out = syntax_error(failure.place, "an index stands in brackets").label("not expected here");
    let help = format!("write `{right}`");
    Some(mended(
        out.help(help.clone()),
        failure,
        &[(failure.at, 1 + digits)],
        &right,
        &help,
    ))
}

/// `- near: 10 mm`, as lists are written in YAML.
fn bullet(failure: &Failure<'_>) -> Option<Diagnostic> {
    let begins_line = failure.part[..failure.at]
        .rsplit('\n')
        .next()
        .is_none_or(|before| before.trim().is_empty());
    if failure.found != "-" || !begins_line || !failure.line().starts_with("- ") {
        return None;
    }
    Some(
        syntax_error(failure.place, "a `-` begins no line")
            .label("not expected here")
            .help("what belongs together stands between `{` and `}`, the values of a list between `[` and `]`"),
    )
}

/// With a fix that replaces some ranges of the region, where that helps.
fn mended(out: Diagnostic, failure: &Failure<'_>, ranges: &[(usize, usize)], right: &str, what: &str) -> Diagnostic {
    let mut text = String::new();
    let mut end = 0;
    for (start, length) in ranges {
        text.push_str(&failure.part[end..*start]);
        text.push_str(right);
        end = start + length;
    }
    text.push_str(&failure.part[end..]);
    if ranges.is_empty() || !failure.is_mended_by(&text) {
        return out;
    }
    let region = failure.place.start - failure.at;
    let edit = |(start, length): &(usize, usize)| {
        let at = region + start;
        replace(Span::new(failure.place.file, at, at + length), right)
    };
    let mut out = out;
    out.fixes.push(Fix {
        message: what.to_owned(),
        edits: ranges.iter().map(edit).collect(),
    });
    out
}
