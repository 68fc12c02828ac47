//! A table of published numbers, which stands beside ours and is never compared.
//!
//! CSV: lines that begin with `#` say where it is from; then `method` and the objects,
//! and a row a method.

use std::fs::File;
use std::io::Read;

use super::error::StudyError;

/// Numbers of others.
#[derive(Clone, Debug, PartialEq)]
pub struct Published {
    /// Where they are from.
    pub source: String,
    /// Columns behind the first.
    pub objects: Vec<String>,
    /// Method and its numbers.
    pub rows: Vec<(String, Vec<f64>)>,
}

/// Most bytes of a table.
const MOST_BYTES: u64 = 1 << 20;

impl Published {
    /// Reads a table.
    ///
    /// # Errors
    /// It cannot be read, or is none.
    pub fn read(path: &str) -> Result<Self, StudyError> {
        let mut text = String::new();
        let read = File::open(path).and_then(|f| f.take(MOST_BYTES).read_to_string(&mut text));
        let wrong = |reason: String| StudyError::Published {
            file: path.to_owned(),
            reason,
        };
        read.map_err(|e| wrong(format!("cannot be read: {e}")))?;
        Self::parse(&text).map_err(wrong)
    }

    fn parse(text: &str) -> Result<Self, String> {
        let mut source = Vec::new();
        let mut lines = text
            .lines()
            .enumerate()
            .filter(|(_, line)| match line.strip_prefix('#') {
                Some(said) => {
                    source.push(said.trim().to_owned());
                    false
                }
                None => !line.trim().is_empty(),
            });
        let (_, head) = lines.next().ok_or("is empty")?;
        let cells = |line: &str| line.split(',').map(|c| c.trim().to_owned()).collect::<Vec<_>>();
        let head = cells(head);
        if head.first().map(String::as_str) != Some("method") || head.len() < 2 {
            return Err("does not begin with `method,OBJECT,…`".into());
        }
        let mut rows = Vec::new();
        for (k, line) in lines {
            let cells = cells(line);
            if cells.len() != head.len() {
                return Err(format!(
                    "has {} cells in line {}, and its head has {}",
                    cells.len(),
                    k + 1,
                    head.len()
                ));
            }
            let numbers = cells[1..]
                .iter()
                .map(|c| c.parse::<f64>().ok().filter(|x| x.is_finite()));
            let numbers: Option<Vec<f64>> = numbers.collect();
            rows.push((
                cells[0].clone(),
                numbers.ok_or_else(|| format!("has no number in line {}", k + 1))?,
            ));
        }
        Ok(Self {
            source: source.join(" "),
            objects: head[1..].to_vec(),
            rows,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_read_and_others_are_told_what_is_wrong() {
        let table = Published::parse("# From a book.\n\nmethod, m1, m2\nGN,5,8\n").unwrap();
        assert_eq!((table.source.as_str(), table.objects.len()), ("From a book.", 2));
        assert_eq!(table.rows, [("GN".to_owned(), vec![5.0, 8.0])]);
        let wrong = |text: &str| Published::parse(text).unwrap_err();
        assert!(wrong("").contains("empty"));
        assert!(wrong("m1,m2\n").contains("method"));
        assert!(wrong("method,m1\nGN,5,8\n").contains("3 cells in line 2"));
        assert!(wrong("method,m1\nGN,NaN\n").contains("no number in line 2"));
    }
}
