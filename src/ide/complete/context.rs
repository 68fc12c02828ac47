//! Where the cursor stands: in which block, and behind which words of a statement.
//!
//! Blocks are found by their first lines, so that a brace missing far above does no
//! harm, and the statement by the tokens since then.

use std::ops::Range;

use crate::lang::syntax::{TokenClass, tokens};
use crate::lang::vocabulary::is_reserved;

/// What kind of block the cursor stands in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::ide) enum Block {
    Top,
    Library,
    Class,
    Table,
    Rule,
    Layout,
    Task,
    /// The braces of `thresholds` or `sensor_model`.
    Fields(&'static str),
    Scene,
    Test,
    /// A study, or one of its variants.
    Study,
    /// The braces of an import.
    Imports,
    /// A text or a comment.
    Prose,
}

/// A token before the cursor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::ide) struct Word<'t> {
    pub class: TokenClass,
    pub text: &'t str,
    /// Whether no space stands before it.
    pub glued: bool,
    /// Its first byte.
    pub at: usize,
}

/// The surroundings of the cursor.
#[derive(Clone, Debug)]
pub(in crate::ide) struct Context<'t> {
    pub block: Block,
    /// The library around it.
    pub library: Option<String>,
    /// The first line of the rule, class or layout around it.
    pub head: Vec<Word<'t>>,
    /// Finished statements of the block before this one, of a rule.
    pub before: Vec<Word<'t>>,
    /// The words of the statement before the word that is being typed.
    pub statement: Vec<Word<'t>>,
    pub statement_start: usize,
    /// The word that is being typed.
    pub prefix: Range<usize>,
    /// Braces that are open before it.
    pub depth: usize,
}

impl<'t> Context<'t> {
    /// The surroundings of a byte of a text.
    pub fn at(text: &'t str, offset: usize) -> Self {
        let offset = floor(text, offset);
        let prefix = prefix_start(text, offset)..offset;
        let before = &text[..prefix.start];
        let (item, entry) = enclosing(before);
        let start = entry.or(item).unwrap_or(0);
        let words = words(&text[start..prefix.start], start);
        let mut context = Self {
            block: Block::Top,
            library: item.and_then(|at| library_name(&text[at..])),
            head: Vec::new(),
            before: Vec::new(),
            statement: Vec::new(),
            statement_start: start,
            prefix,
            depth: usize::from(entry.is_some() && item.is_some()),
        };
        let outer = if entry.is_some() { Block::Library } else { Block::Top };
        context.read(&words, outer);
        if in_prose(before) {
            context.block = Block::Prose;
        }
        context
    }

    /// Follows braces and ends of statements.
    fn read(&mut self, words: &[Word<'t>], outer: Block) {
        let mut blocks = vec![outer];
        let mut round = 0usize;
        let mut begin = 0;
        for (k, word) in words.iter().enumerate() {
            match (word.class, word.text) {
                (TokenClass::Punctuation, "(" | "[") => round += 1,
                (TokenClass::Punctuation, ")" | "]") => round = round.saturating_sub(1),
                (TokenClass::Punctuation, "{") => {
                    let inner = opened(*blocks.last().unwrap_or(&Block::Top), &words[begin..k]);
                    if inner != Block::Library {
                        self.head = words[begin..k].to_vec();
                    }
                    blocks.push(inner);
                    self.depth += 1;
                    (begin, round) = (k + 1, 0);
                }
                (TokenClass::Punctuation, "}") => {
                    blocks.pop();
                    self.depth = self.depth.saturating_sub(1);
                    // The `}` of a class still belongs to its statement: `} prior 10 %`.
                    (begin, round) = (k, 0);
                }
                (TokenClass::Punctuation, ";") | (TokenClass::Newline, _) if round == 0 => {
                    self.before.extend(&words[begin..k]);
                    begin = k + 1;
                }
                _ => {}
            }
        }
        self.block = blocks.last().copied().unwrap_or(Block::Top);
        if self.block == Block::Top && outer == Block::Library && blocks.is_empty() {
            self.library = None;
        }
        self.statement = words[begin..]
            .iter()
            .filter(|w| w.class != TokenClass::Newline)
            .copied()
            .collect();
        self.statement_start = words.get(begin).map_or(self.prefix.start, |w| w.at);
    }
}

/// The block that a brace opens, after the words before it.
fn opened(around: Block, words: &[Word<'_>]) -> Block {
    match (around, words.first().map_or("", |w| w.text)) {
        (Block::Top, "library") => Block::Library,
        (Block::Top, "task") => Block::Task,
        (Block::Top, "scene") => Block::Scene,
        (Block::Top, "test") => Block::Test,
        (Block::Top, "study") | (Block::Study, "variant") => Block::Study,
        (Block::Top, "use") => Block::Imports,
        (Block::Library, "rule") => Block::Rule,
        (Block::Library, "layout") => Block::Layout,
        (Block::Library, "class") => Block::Class,
        (Block::Library, "classes") => Block::Table,
        (Block::Task | Block::Study, "thresholds") => Block::Fields("thresholds"),
        (Block::Task | Block::Study, "sensor_model") => Block::Fields("sensor_model"),
        _ => Block::Prose,
    }
}

/// The beginning of the item and of the library's entry around the end of a text.
fn enclosing(before: &str) -> (Option<usize>, Option<usize>) {
    let mut entry = None;
    let mut end = before.len();
    loop {
        let start = before[..end].rfind('\n').map_or(0, |n| n + 1);
        let line = &before[start..end];
        let indent = line.len() - line.trim_start().len();
        let first = first_word(&line[indent..]);
        let rest = line[indent + first.len()..].trim_start();
        let last = end == before.len();
        if is_item(first, rest, last) {
            return (Some(start + indent), entry);
        }
        if entry.is_none() && is_entry(first, rest) {
            entry = Some(start + indent);
        }
        if start == 0 {
            return (None, None);
        }
        end = start - 1;
    }
}

fn is_item(first: &str, rest: &str, unfinished: bool) -> bool {
    match first {
        "let" => !rest.is_empty(),
        "use" => rest.starts_with('"') || rest.split(' ').next().is_some_and(|word| word.contains('.')),
        // In a task, `library NAME` is a statement.
        "library" | "task" | "scene" | "test" | "study" => rest.contains('{') || (unfinished && rest.contains('(')),
        _ => false,
    }
}

fn is_entry(first: &str, rest: &str) -> bool {
    let named = !rest.is_empty();
    matches!(first, "feature" | "class" | "layout") && named || matches!(first, "classes" | "rule")
}

fn first_word(line: &str) -> &str {
    let end = line
        .find(|c: char| !c.is_ascii_alphanumeric() && c != '_')
        .unwrap_or(line.len());
    &line[..end]
}

/// The name behind `library`.
fn library_name(item: &str) -> Option<String> {
    let name = first_word(item.strip_prefix("library ")?.trim_start());
    (!name.is_empty() && !is_reserved(name)).then(|| name.to_owned())
}

fn words(text: &str, offset: usize) -> Vec<Word<'_>> {
    let mut end = 0;
    let mut found = Vec::new();
    for token in tokens(text) {
        if !matches!(token.class, TokenClass::Comment | TokenClass::Doc) {
            found.push(Word {
                class: token.class,
                text: token.text(text),
                glued: token.start == end,
                at: offset + token.start,
            });
        }
        end = token.end;
    }
    found
}

/// Where the word before a byte begins; of `10mm` it is the unit.
fn prefix_start(text: &str, offset: usize) -> usize {
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '%' || c == '°';
    let start = text[..offset]
        .rfind(|c| !is_word(c))
        .map_or(0, |at| at + text[at..].chars().next().map_or(1, char::len_utf8));
    let word = &text[start..offset];
    let number = word.len() - word.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    start + number
}

/// Whether the end of a text is inside a comment or a text.
fn in_prose(before: &str) -> bool {
    let line = &before[before.rfind('\n').map_or(0, |n| n + 1)..];
    let (mut quoted, mut escaped, mut slash) = (false, false, false);
    for c in line.chars() {
        match c {
            _ if escaped => escaped = false,
            '\\' if quoted => escaped = true,
            '"' => quoted = !quoted,
            '/' if !quoted && slash => return true,
            _ => {}
        }
        slash = c == '/' && !quoted;
    }
    quoted
}

/// The nearest beginning of a character at or before a byte.
pub(in crate::ide) fn floor(text: &str, offset: usize) -> usize {
    let mut at = offset.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The context at the `‸` of a text.
    #[track_caller]
    fn at(text: &str) -> (Block, String, String) {
        let offset = text.find('‸').unwrap();
        let text = text.replace('‸', "");
        let context = Context::at(&text, offset);
        let words: Vec<&str> = context.statement.iter().map(|w| w.text).collect();
        (context.block, words.join(" "), text[context.prefix].to_owned())
    }

    fn said(block: Block, words: &str, prefix: &str) -> (Block, String, String) {
        (block, words.to_owned(), prefix.to_owned())
    }

    #[test]
    fn blocks_are_found_though_nothing_is_closed() {
        assert_eq!(at("vpl 1\nli‸"), said(Block::Top, "", "li"));
        assert_eq!(at("vpl 1\nlibrary a {\n  fea‸"), said(Block::Library, "", "fea"));
        assert_eq!(
            at("vpl 1\nlibrary a {\n  rule -> b {\n    detect c‸"),
            said(Block::Rule, "detect", "c")
        );
        assert_eq!(at("task t {\n  library ‸\n}"), said(Block::Task, "library", ""));
        assert_eq!(
            at("task t {\n  thresholds { near: 1 mm, ‸"),
            said(Block::Fields("thresholds"), "near : 1 mm ,", "")
        );
    }

    #[test]
    fn a_statement_begins_on_its_line() {
        assert_eq!(at("library a {\n  rule -> b { }\n  ‸\n}"), said(Block::Library, "", ""));
        assert_eq!(at("library a {\n  class b { c } ‸\n}"), said(Block::Library, "}", ""));
    }

    #[test]
    fn a_new_item_ends_what_was_left_open() {
        assert_eq!(
            at("library a {\n  rule -> b {\nscene s {\n  object o = ‸"),
            said(Block::Scene, "object o =", "")
        );
    }

    #[test]
    fn a_unit_is_typed_behind_its_number() {
        assert_eq!(at("let a = 10m‸"), said(Block::Top, "let a = 10", "m"));
        assert_eq!(at("let a = 10 ‸"), said(Block::Top, "let a = 10", ""));
    }

    #[test]
    fn nothing_is_typed_in_comments() {
        assert_eq!(at("let a = 1 // b‸").0, Block::Prose);
        assert_eq!(at("let a = \"b‸").0, Block::Prose);
        assert_eq!(at("let a = \"//\" ‸").0, Block::Top);
    }
}
