//! A declaration as it is written: from its head to the brace that closes it.

use super::tokens::tokens;

/// The text of the declaration whose head begins at byte `start`, its indentation
/// included; its head alone where nothing closes it.
pub fn block(text: &str, start: usize) -> &str {
    let mut depth = 0_usize;
    let mut end = start;
    for token in tokens(text).into_iter().filter(|t| t.start >= start) {
        match token.text(text) {
            "{" => depth += 1,
            "}" => depth = depth.saturating_sub(1),
            _ => {}
        }
        if token.text(text).starts_with(['\n', '\r']) && depth == 0 {
            break;
        }
        end = token.end;
        if depth == 0 && token.text(text) == "}" {
            break;
        }
    }
    let line = text
        .get(..start)
        .and_then(|before| before.rfind('\n'))
        .map_or(0, |k| k + 1);
    let indented = text.get(line..start).is_some_and(|before| before.trim().is_empty());
    let from = if indented { line } else { start };
    text.get(from..end).unwrap_or("")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_ends_with_its_own_brace() {
        let text = "vpl 1\nlibrary l {\n  rule -> a {  // no } here\n    detect d(\"}\")\n  }\n\n  rule -> b\n}\n";
        let rule = text.find("rule -> a").unwrap();
        assert_eq!(
            block(text, rule),
            "  rule -> a {  // no } here\n    detect d(\"}\")\n  }"
        );
        let bare = text.find("rule -> b").unwrap();
        assert_eq!(block(text, bare), "  rule -> b");
        assert_eq!(block(text, 10_000), "");
    }
}
