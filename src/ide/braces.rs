//! Which brace closes which: for the extent of blocks, also in broken text.

/// A `{` and its `}`, as bytes of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Block {
    pub open: usize,
    pub close: usize,
}

/// All pairs, ordered by their opening brace. Braces in texts and comments are none.
pub(super) fn blocks(text: &str) -> Vec<Block> {
    let mut open = Vec::new();
    let mut found = Vec::new();
    scan(text, |at, byte| match byte {
        b'{' => open.push(at),
        b'}' => found.extend(open.pop().map(|open| Block { open, close: at })),
        _ => {}
    });
    found.sort_by_key(|block| block.open);
    found
}

/// The end of the block whose head ends at a byte: one past its `}`.
pub(super) fn end_of_block(blocks: &[Block], head: usize, text: &str) -> Option<usize> {
    let next = blocks.partition_point(|b| b.open < head);
    let block = blocks.get(next)?;
    let between = text.get(head..block.open)?;
    (!between.contains('\n')).then_some(block.close + 1)
}

/// Calls `see` with every byte of code.
fn scan(text: &str, mut see: impl FnMut(usize, u8)) {
    let bytes = text.as_bytes();
    let (mut at, mut quoted) = (0, false);
    while at < bytes.len() {
        match bytes[at] {
            b'\n' => quoted = false,
            b'\\' if quoted => at += 1,
            b'"' => quoted = !quoted,
            b'/' if !quoted && bytes.get(at + 1) == Some(&b'/') => {
                at += bytes[at..].iter().take_while(|b| **b != b'\n').count();
                continue;
            }
            byte if !quoted => see(at, byte),
            _ => {}
        }
        at += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn braces_in_texts_and_comments_are_none() {
        let text = "a { \"{i}\" // }\n b { } }";
        let pairs: Vec<_> = blocks(text).iter().map(|b| (b.open, b.close)).collect();
        assert_eq!(pairs, [(2, text.len() - 1), (18, 20)]);
    }

    #[test]
    fn an_unclosed_brace_has_no_end() {
        assert_eq!(blocks("a { b { }").len(), 1);
        assert_eq!(end_of_block(&blocks("a\n{ }"), 1, "a\n{ }"), None);
        assert_eq!(end_of_block(&blocks("a { }"), 1, "a { }"), Some(5));
    }
}
