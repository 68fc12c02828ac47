//! Prints the tokens of VPL files, a line of JSON a file: `cargo run --example tokens -- FILE…`.
//!
//! `tokens` are triples of a class, a first byte and the byte behind the last. The
//! test of the TextMate grammar reads this; so may any tool that colours VPL.

use vpl::lang::syntax::parse;
use vpl::lang::{FileId, tokens};

fn main() -> std::io::Result<()> {
    for file in std::env::args().skip(1) {
        let text = std::fs::read_to_string(&file)?;
        let triples = tokens(&text)
            .into_iter()
            .map(|t| (format!("{:?}", t.class), t.start, t.end));
        let line = serde_json::json!({
            "file": file,
            "well_formed": parse(FileId(0), &text).1.is_empty(),
            "tokens": triples.collect::<Vec<_>>(),
        });
        println!("{line}");
    }
    Ok(())
}
