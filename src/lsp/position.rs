//! Lines and characters of the protocol, and bytes of a text.
//!
//! A line ends with `\n`, `\r\n` or `\r`; a character is a UTF-16 code unit, or a byte
//! where the client asked for UTF-8. Positions out of range mean the nearest one.

use std::cell::Cell;
use std::ops::Range as Bytes;

use gen_lsp_types::{Position, Range};

/// What a character of a position is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Utf8,
    Utf16,
}

/// A text with its lines.
#[derive(Debug)]
pub(super) struct Positions<'t> {
    text: &'t str,
    encoding: Encoding,
    starts: Vec<usize>,
    /// The last answer: line start, byte, character. Answers in order cost little, though
    /// a line be endless.
    last: Cell<(usize, usize, usize)>,
}

impl<'t> Positions<'t> {
    pub fn new(text: &'t str, encoding: Encoding) -> Self {
        let bytes = text.as_bytes();
        let ends = bytes.iter().enumerate().filter(|(k, byte)| match byte {
            b'\n' => true,
            b'\r' => bytes.get(k + 1) != Some(&b'\n'),
            _ => false,
        });
        Self {
            text,
            encoding,
            starts: std::iter::once(0).chain(ends.map(|(k, _)| k + 1)).collect(),
            last: Cell::new((0, 0, 0)),
        }
    }

    /// The position of a byte.
    pub fn position(&self, offset: usize) -> Position {
        let offset = offset.min(self.text.len());
        let line = self.starts.partition_point(|start| *start <= offset) - 1;
        let start = self.starts[line];
        let (from, counted) = match self.last.get() {
            (known, at, counted) if known == start && at <= offset => (at, counted),
            _ => (start, 0),
        };
        let part = self.text.get(from..offset).unwrap_or("");
        let character = counted + self.length(part);
        self.last.set((start, offset, character));
        Position {
            line: line as u32,
            character: character as u32,
        }
    }

    /// The byte of a position.
    pub fn offset(&self, position: Position) -> usize {
        let Some(start) = self.starts.get(position.line as usize).copied() else {
            return self.text.len();
        };
        let end = self.starts.get(position.line as usize + 1).copied();
        let line = &self.text[start..end.unwrap_or(self.text.len())];
        let line = line.trim_end_matches(['\n', '\r']);
        let mut left = position.character as usize;
        for (at, c) in line.char_indices() {
            let width = self.width(c);
            if left < width {
                return start + at;
            }
            left -= width;
        }
        start + line.len()
    }

    pub fn range(&self, bytes: Bytes<usize>) -> Range {
        Range {
            start: self.position(bytes.start),
            end: self.position(bytes.end),
        }
    }

    pub fn bytes(&self, range: Range) -> Bytes<usize> {
        let (a, b) = (self.offset(range.start), self.offset(range.end));
        a.min(b)..a.max(b)
    }

    /// Characters of a part.
    pub fn length(&self, part: &str) -> usize {
        match self.encoding {
            Encoding::Utf8 => part.len(),
            Encoding::Utf16 => part.chars().map(char::len_utf16).sum(),
        }
    }

    fn width(&self, c: char) -> usize {
        match self.encoding {
            Encoding::Utf8 => c.len_utf8(),
            Encoding::Utf16 => c.len_utf16(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(line: u32, character: u32) -> Position {
        Position { line, character }
    }

    #[test]
    fn characters_are_code_units() {
        let text = "aä😀b\r\nc\rd\n";
        let wide = Positions::new(text, Encoding::Utf16);
        let narrow = Positions::new(text, Encoding::Utf8);
        let b = text.find('b').unwrap();
        assert_eq!((wide.position(b), narrow.position(b)), (at(0, 4), at(0, 7)));
        assert_eq!((wide.offset(at(0, 4)), narrow.offset(at(0, 7))), (b, b));
        assert_eq!(wide.position(text.find('c').unwrap()), at(1, 0));
        assert_eq!(wide.position(text.find('d').unwrap()), at(2, 0));
        assert_eq!(wide.position(text.len()), at(3, 0));
    }

    #[test]
    fn positions_out_of_range_mean_the_nearest() {
        let text = "aä😀\r\nb";
        let p = Positions::new(text, Encoding::Utf16);
        assert_eq!(p.offset(at(0, 99)), text.find('\r').unwrap());
        assert_eq!(p.offset(at(9, 0)), text.len());
        assert_eq!(p.offset(at(0, 3)), text.find('😀').unwrap(), "inside of a character");
        assert_eq!(p.position(99), at(1, 1));
        assert_eq!(
            p.bytes(Range {
                start: at(1, 1),
                end: at(0, 0)
            }),
            0..text.len()
        );
    }

    #[test]
    fn every_byte_of_a_text_goes_there_and_back() {
        let text = "x\n\r\n\rßß\n😀\r\n";
        for encoding in [Encoding::Utf8, Encoding::Utf16] {
            let p = Positions::new(text, encoding);
            let ends = |k: usize| text[k..].starts_with('\n') && text[..k].ends_with('\r');
            for k in (0..=text.len()).filter(|k| text.is_char_boundary(*k) && !ends(*k)) {
                assert_eq!(p.offset(p.position(k)), k, "{encoding:?}");
            }
        }
    }
}
