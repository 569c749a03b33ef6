//! Lines of an MPS file, cut into fields.
//!
//! The free format does not limit the length of a line; this reader does. Without a limit, a file that is not
//! MPS, or a small archive that inflates to one endless line, could fill the memory.

use std::io::{BufRead, Read};

use crate::error::{Error, Result};

/// Longest line accepted, in bytes.
pub(super) const MAX_LINE: usize = 1 << 16;

/// Limits of this size and beyond are infinite, as CPLEX, Gurobi, SCIP and Xpress have it.
pub(super) const INFINITE: f64 = 1e20;

/// The largest number of fields on a line of any section.
const MAX_FIELDS: usize = 5;

/// The lines of a file that are neither blank nor comments, one at a time.
pub(super) struct Lines<R> {
    reader: R,
    buffer: Vec<u8>,
    number: usize,
}

/// A line. A header starts in the first column, data after a blank.
pub(super) struct Line<'a> {
    /// The number of the line, counted from 1.
    pub number: usize,
    text: &'a str,
    fields: [&'a str; MAX_FIELDS + 1],
    len: usize,
}

impl<R: BufRead> Lines<R> {
    pub fn new(reader: R) -> Self {
        Lines {
            reader,
            buffer: Vec::new(),
            number: 0,
        }
    }

    /// Number of the last line read; 0 before the first.
    pub fn number(&self) -> usize {
        self.number
    }

    /// The next line that is neither blank nor a comment, or `None` at the end of the file.
    pub fn next(&mut self) -> Result<Option<Line<'_>>> {
        loop {
            self.buffer.clear();
            let mut limited = self.reader.by_ref().take(MAX_LINE as u64 + 2);
            let read = limited.read_until(b'\n', &mut self.buffer);
            let read = read.map_err(|e| Error::Io {
                message: format!("after line {}: {e}", self.number),
            })?;
            if read == 0 {
                return Ok(None);
            }
            self.number += 1;
            if self.buffer.ends_with(b"\n") {
                self.buffer.pop();
                if self.buffer.ends_with(b"\r") {
                    self.buffer.pop();
                }
            }
            if self.buffer.len() > MAX_LINE {
                return Err(fault(
                    self.number,
                    format!("the line is longer than {MAX_LINE} bytes"),
                ));
            }
            let blank = self.buffer.iter().all(|b| matches!(b, b' ' | b'\t'));
            if !blank && self.buffer[0] != b'*' {
                break;
            }
        }
        Line::new(self.number, &self.buffer).map(Some)
    }
}

impl<'a> Line<'a> {
    fn new(number: usize, bytes: &'a [u8]) -> Result<Self> {
        let control = |&b: &u8| (b < 0x20 && b != b'\t') || b == 0x7f;
        if let Some(at) = bytes.iter().position(control) {
            let message = format!("control character {:#04x} at byte {}", bytes[at], at + 1);
            return Err(fault(number, message));
        }
        let text = std::str::from_utf8(bytes)
            .map_err(|e| fault(number, format!("not UTF-8 at byte {}", e.valid_up_to() + 1)))?;
        let mut fields = [""; MAX_FIELDS + 1];
        let mut len = 0;
        for (slot, field) in fields.iter_mut().zip(text.split_ascii_whitespace()) {
            *slot = field;
            len += 1;
        }
        Ok(Line {
            number,
            text,
            fields,
            len,
        })
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
        match field.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(_) => Err(self.fault(format!("{} is not a finite number", quoted(field)))),
            Err(_) => Err(self.fault(format!("{} is not a number", quoted(field)))),
        }
    }

    /// The limit in `field`: a number, or an infinity where the size is [`INFINITE`] or more.
    pub fn limit(&self, field: &str) -> Result<f64> {
        match field.parse::<f64>() {
            Ok(value) if value.abs() >= INFINITE => Ok(f64::INFINITY.copysign(value)),
            Ok(value) if value.is_finite() => Ok(value),
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

/// A parse error at `line`.
pub(super) fn fault(line: usize, message: impl Into<String>) -> Error {
    Error::Parse {
        line,
        message: message.into(),
    }
}

/// An error that names an unsupported feature and its line.
pub(super) fn unsupported(line: usize, what: impl AsRef<str>, index: Option<usize>) -> Error {
    Error::NotSupported {
        what: format!("line {line}: {}", what.as_ref()),
        index,
        line: Some(line),
    }
}

/// A field for messages: in quotes, and cut if it is long.
pub(super) fn quoted(field: &str) -> String {
    const SHOWN: usize = 40;
    let cut: String = field.chars().take(SHOWN).collect();
    let more = if cut.len() < field.len() { "..." } else { "" };
    format!("'{}{more}'", cut.escape_debug())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fields(text: &str) -> Vec<Vec<String>> {
        let mut lines = Lines::new(text.as_bytes());
        let mut found = Vec::new();
        while let Some(line) = lines.next().unwrap() {
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
        let error = Lines::new(long.as_bytes()).next().err().unwrap();
        assert_eq!(error.line(), Some(2));
    }

    #[test]
    fn a_long_field_is_cut_in_messages() {
        assert_eq!(
            quoted(&"ab".repeat(30)),
            format!("'{}...'", "ab".repeat(20))
        );
        assert_eq!(quoted("a'b"), "'a\\'b'");
    }
}
