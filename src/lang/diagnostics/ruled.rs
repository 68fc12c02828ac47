//! A line of source as a terminal shows it: which column every byte stands in,
//! and the part of a long line that is worth showing.

use std::iter::repeat_n;

use unicode_width::UnicodeWidthChar;

use super::paint::visible;

/// Columns between the stops of a tab.
const TAB: usize = 4;
/// Characters of a line that are looked at; a generated line can have millions.
const MOST_CHARS: usize = 10_000;
/// Columns kept to the left of what is marked, where a line is cut.
const LEAD: usize = 20;

/// A character and where it stands.
struct Cell {
    /// First byte in the line.
    at: usize,
    shown: char,
    /// First column, from 0.
    column: usize,
    width: usize,
}

/// A line whose characters have columns.
pub(super) struct Ruled {
    cells: Vec<Cell>,
    /// Column after the last character.
    end: usize,
}

impl Ruled {
    pub(super) fn new(line: &str) -> Self {
        let mut end = 0;
        let cells = line.char_indices().take(MOST_CHARS).map(|(at, c)| {
            let (shown, width) = match c {
                '\t' => (' ', TAB - end % TAB),
                c => (visible(c), visible(c).width().unwrap_or(1)),
            };
            let column = end;
            end += width;
            Cell {
                at,
                shown,
                column,
                width,
            }
        });
        let cells = cells.collect();
        Self { cells, end }
    }

    /// The column of a byte of the line.
    pub(super) fn column(&self, at: usize) -> usize {
        let next = self.cells.iter().find(|cell| cell.at >= at);
        next.map_or(self.end, |cell| cell.column)
    }

    /// The first column to show, so that `wanted` is in sight within `room` columns.
    pub(super) fn first_column(&self, wanted: usize, room: usize) -> usize {
        if self.end <= room || wanted < room.saturating_sub(LEAD) {
            return 0;
        }
        wanted.saturating_sub(LEAD)
    }

    /// The line from a column on, at most `room` columns, cut ends marked by `…`.
    pub(super) fn cut(&self, first: usize, room: usize) -> String {
        let last = first + room - usize::from(self.end > first + room);
        let mut out = String::new();
        for cell in self.cells.iter().filter(|cell| cell.column >= first) {
            let after = cell.column + cell.width;
            if after > last {
                out.push('…');
                break;
            }
            match cell.shown {
                _ if out.is_empty() && first > 0 => {
                    out.push('…');
                    out.extend(repeat_n(' ', after - first - 1));
                }
                ' ' => out.extend(repeat_n(' ', cell.width)),
                shown => out.push(shown),
            }
        }
        out.truncate(out.trim_end().len());
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tabs_and_wide_characters_have_their_columns() {
        let line = Ruled::new("\ta 大b");
        assert_eq!(line.column(0), 0);
        assert_eq!(line.column(1), 4);
        assert_eq!(line.column(3), 6);
        assert_eq!(line.column(6), 8);
        assert_eq!(line.column(7), 9);
        assert_eq!(line.cut(0, 80), "    a 大b");
    }

    #[test]
    fn a_long_line_is_cut_around_what_is_marked() {
        let line = Ruled::new(&format!("{}x{}", "a".repeat(100), "b".repeat(100)));
        let first = line.first_column(100, 40);
        let shown = line.cut(first, 40);
        assert_eq!(first, 80);
        assert_eq!(shown.chars().count(), 40);
        assert_eq!(shown.chars().nth(20), Some('x'));
        assert!(shown.starts_with('…') && shown.ends_with('…'), "{shown}");
    }

    #[test]
    fn a_terminal_takes_no_command_from_a_program() {
        assert_eq!(Ruled::new("a\u{1b}[2Jb\u{202e}c").cut(0, 80), "a\u{fffd}[2Jb\u{fffd}c");
    }
}
