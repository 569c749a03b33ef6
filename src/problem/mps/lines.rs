//! Lines of an MPS file, cut into fields.

use std::io::BufRead;

use super::sections::Section;
use crate::error::{Error, Result};
use crate::problem::files::lines::{Lines, fault, limited, quoted, unsupported, value};

/// The largest number of fields on a line of any section.
const MAX_FIELDS: usize = 5;

/// A line. A header starts in the first column, data after a blank.
pub(super) struct Line<'a> {
    /// The number of the line, counted from 1.
    pub number: usize,
    text: &'a str,
    fields: [&'a str; MAX_FIELDS + 1],
    len: usize,
}

/// The next line that is neither blank nor a comment, or `None` at the end of the file.
pub(super) fn next_line<R: BufRead>(lines: &mut Lines<R>) -> Result<Option<Line<'_>>> {
    let line = lines.next(|line| line[0] != b'*')?;
    Ok(line.map(|(number, text)| Line::new(number, text)))
}

impl<'a> Line<'a> {
    fn new(number: usize, text: &'a str) -> Self {
        let mut fields = [""; MAX_FIELDS + 1];
        let mut len = 0;
        for (slot, field) in fields.iter_mut().zip(text.split_ascii_whitespace()) {
            *slot = field;
            len += 1;
        }
        Line {
            number,
            text,
            fields,
            len,
        }
    }

    /// The line with its fields cut by the columns of fixed format (2-3, 5-12, 15-22, 25-36, 40-47, 50-61),
    /// where names may have blanks in them, or `None` if text stands between those columns.
    pub fn by_columns(&self) -> Option<Line<'a>> {
        const COLUMNS: [(usize, usize); 6] =
            [(1, 3), (4, 12), (14, 22), (24, 36), (39, 47), (49, 61)];
        if self.text.contains('\t') {
            return None;
        }
        // Columns are characters. The byte at which each starts, and the end of the text for all beyond.
        let starts: Vec<usize> = self.text.char_indices().map(|(at, _)| at).collect();
        let byte = |column: usize| starts.get(column).copied().unwrap_or(self.text.len());
        let cut = |from: usize, to: usize| self.text[byte(from)..byte(to)].trim_ascii();
        let mut fields = [""; MAX_FIELDS + 1];
        let mut len = 0;
        let mut end = 0;
        for (from, to) in COLUMNS {
            if !cut(end, from).is_empty() {
                return None;
            }
            end = to;
            let field = cut(from, to);
            if !field.is_empty() {
                fields[len] = field;
                len += 1;
            }
        }
        let rest = cut(end, usize::MAX);
        rest.is_empty().then_some(Line {
            number: self.number,
            text: self.text,
            fields,
            len,
        })
    }

    /// Whether the fields are as many as `section` has on a line, with numbers where it has numbers.
    pub fn fits(&self, section: Section) -> bool {
        let number = |k: usize| self.fields[k].parse::<f64>().is_ok();
        match (section, self.len) {
            (Section::Rows, len) => len == 2,
            (Section::Columns, 3) if self.fields[1] == "'MARKER'" => true,
            (Section::Rhs | Section::Ranges, 2) => number(1),
            (Section::Rhs | Section::Ranges, 4) => number(1) && number(3),
            (Section::Bounds, 2 | 3) => true,
            (Section::Bounds, 4) => number(3),
            (Section::Bounds, _) => false,
            (Section::ObjSense, _) => true,
            (_, 3) => number(2),
            (_, 5) => number(2) && number(4),
            _ => false,
        }
    }

    pub fn is_header(&self) -> bool {
        !self.text.starts_with([' ', '\t'])
    }

    /// The fields. For a line with too many, the list is one longer than any section allows.
    pub fn fields(&self) -> &[&'a str] {
        &self.fields[..self.len]
    }

    /// The text after the first field.
    pub fn rest(&self) -> &'a str {
        let text = self.text.trim_ascii();
        text[self.fields[0].len()..].trim_ascii_start()
    }

    /// The error for a malformed line.
    pub fn fault(&self, message: impl Into<String>) -> Error {
        fault(self.number, message)
    }

    /// The error for a line that needs something the library does not support.
    pub fn unsupported(&self, what: impl AsRef<str>) -> Error {
        unsupported(self.number, what, None)
    }

    /// The value of `field`, which must be a finite number.
    pub fn value(&self, field: &str) -> Result<f64> {
        value(self.number, field)
    }

    /// The limit in `field`: a number, or an infinity where the size is [`INFINITE`] or more.
    ///
    /// [`INFINITE`]: crate::problem::files::lines::INFINITE
    pub fn limit(&self, field: &str) -> Result<f64> {
        match field.parse::<f64>().map(limited) {
            Ok(limit) if !limit.is_nan() => Ok(limit),
            _ => self.value(field),
        }
    }

    /// The limit in `field`, which must not be the infinity that no number meets.
    pub fn limit_but(&self, impossible: f64, field: &str) -> Result<f64> {
        let limit = self.limit(field)?;
        if limit == impossible {
            return Err(self.fault(format!("no number meets the limit {}", quoted(field))));
        }
        Ok(limit)
    }

    /// The leading name and the one or two pairs (name, number) that follow it.
    pub fn named_pairs(&self) -> Result<(&'a str, impl Iterator<Item = (&'a str, &'a str)>)> {
        let (3 | 5) = self.len else {
            return Err(self.wrong_length("a name and one or two pairs of name and number"));
        };
        Ok((self.fields[0], self.pairs(1)))
    }

    /// The pairs of fields from `first` on.
    pub fn pairs(&self, first: usize) -> impl Iterator<Item = (&'a str, &'a str)> {
        let fields = self.fields[first..self.len].chunks_exact(2);
        fields.map(|pair| (pair[0], pair[1]))
    }

    /// The error that this line has too few or too many fields.
    pub fn wrong_length(&self, expected: &str) -> Error {
        let last = self.fields[self.len - 1];
        let found = if self.len > MAX_FIELDS {
            format!("more than {MAX_FIELDS} fields")
        } else {
            format!("{} fields, the last is {}", self.len, quoted(last))
        };
        self.fault(format!("expected {expected}, found {found}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::files::lines::MAX_LINE;

    fn fields(text: &str) -> Vec<Vec<String>> {
        let mut lines = Lines::new(text.as_bytes());
        let mut found = Vec::new();
        while let Some(line) = next_line(&mut lines).unwrap() {
            found.push(line.fields().iter().map(|f| f.to_string()).collect());
        }
        found
    }

    #[test]
    fn comments_blank_lines_and_carriage_returns_say_nothing() {
        let found = fields("* a comment\r\n\r\n  \t \nROWS\r\n\tN  OBJ \r\n * name");
        assert_eq!(found, [vec!["ROWS"], vec!["N", "OBJ"], vec!["*", "name"]]);
    }

    #[test]
    fn a_line_at_the_limit_is_read_and_one_byte_more_is_an_error() {
        let fits = format!(" {}\r\n", "x".repeat(MAX_LINE - 1));
        assert_eq!(fields(&fits)[0][0].len(), MAX_LINE - 1);
        let long = format!("\n {}", "x".repeat(MAX_LINE));
        let error = next_line(&mut Lines::new(long.as_bytes())).err().unwrap();
        assert_eq!(error.line(), Some(2));
    }
}
