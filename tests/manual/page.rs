//! The code blocks of a page.

/// A code block.
#[derive(Debug, PartialEq)]
pub struct Block {
    pub kind: Kind,
    pub text: String,
    /// The line of its first line, from 1.
    pub line: usize,
}

#[derive(Debug, PartialEq)]
pub enum Kind {
    Program,
    Fragment,
    /// More of a file.
    Part(String),
    /// Commands and what they say.
    Console,
}

/// The blocks that tests look at, in order.
pub fn blocks(text: &str) -> Vec<Block> {
    let mut found = Vec::new();
    let mut lines = text.lines().enumerate();
    while let Some((_, line)) = lines.next() {
        let indent = line.len() - line.trim_start().len();
        let Some(info) = line.trim_start().strip_prefix("```") else {
            continue;
        };
        let mut block = Block {
            kind: Kind::Console,
            text: String::new(),
            line: 0,
        };
        for (k, line) in lines.by_ref() {
            if line.trim_start() == "```" {
                break;
            }
            if block.line == 0 {
                block.line = k + 1;
            }
            block.text.push_str(line.get(indent..).unwrap_or("").trim_end());
            block.text.push('\n');
        }
        if let Some(kind) = kind(info, &block.text) {
            block.kind = kind;
            found.push(block);
        }
    }
    found
}

fn kind(info: &str, text: &str) -> Option<Kind> {
    match info.split_once(',') {
        Some(("vpl", file)) => Some(Kind::Part(file.trim().to_owned())),
        None if info == "vpl" && text.starts_with("vpl 1") => Some(Kind::Program),
        None if info == "vpl" => Some(Kind::Fragment),
        None if info == "console" && text.starts_with("$ vpl ") => Some(Kind::Console),
        _ => None,
    }
}

/// Whether a written transcript is what was said; `...` stands for anything.
pub fn alike(written: &str, said: &str) -> bool {
    let (written, said): (Vec<&str>, Vec<&str>) = (written.lines().collect(), said.lines().collect());
    lines_alike(&written, &said)
}

fn lines_alike(written: &[&str], said: &[&str]) -> bool {
    match written {
        [] => said.is_empty(),
        [any, rest @ ..] if any.trim() == "..." => (0..=said.len()).any(|k| lines_alike(rest, &said[k..])),
        [line, rest @ ..] => {
            let [first, others @ ..] = said else { return false };
            let same = match line.strip_suffix("...") {
                Some(begin) => first.starts_with(begin),
                None => line.trim_end() == first.trim_end(),
            };
            same && lines_alike(rest, others)
        }
    }
}

/// The page with its console blocks replaced where they differ.
pub fn with(text: &str, said: &[(&Block, String)]) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    for (block, said) in said.iter().rev() {
        if alike(&block.text, said) {
            continue;
        }
        let (first, count) = (block.line - 1, block.text.lines().count());
        lines.splice(first..first + count, said.lines().map(str::to_owned));
    }
    lines.join("\n") + "\n"
}
