//! The lines of a text file, one at a time, and what can be wrong with one.
//!
//! The formats do not limit the length of a line; these readers do. Without a limit, a file of another kind,
//! or a small archive that inflates to one endless line, could fill the memory.

use std::io::{BufRead, Read};

use crate::error::{Error, Result};

/// Longest line accepted, in bytes.
pub(in crate::problem) const MAX_LINE: usize = 1 << 16;

/// Limits of this size and beyond are infinite, as CPLEX, Gurobi, SCIP and Xpress have it.
pub(in crate::problem) const INFINITE: f64 = 1e20;

/// The lines of a file.
pub(in crate::problem) struct Lines<R> {
    reader: R,
    buffer: Vec<u8>,
    number: usize,
}

impl<R: BufRead> Lines<R> {
    pub fn new(reader: R) -> Self {
        Lines {
            reader,
            buffer: Vec::new(),
            number: 0,
        }
    }

    /// Number of the last line read, counted from 1; 0 before the first.
    pub fn number(&self) -> usize {
        self.number
    }

    /// The next line that `counts` and is not blank, without its end, or `None` at the end of the file.
    pub fn next(&mut self, counts: impl Fn(&[u8]) -> bool) -> Result<Option<(usize, &str)>> {
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
                let message = format!("the line is longer than {MAX_LINE} bytes");
                return Err(fault(self.number, message));
            }
            let blank = self.buffer.iter().all(|b| matches!(b, b' ' | b'\t'));
            if !blank && counts(&self.buffer) {
                break;
            }
        }
        let text = text_of(self.number, &self.buffer)?;
        Ok(Some((self.number, text)))
    }
}

fn text_of(number: usize, bytes: &[u8]) -> Result<&str> {
    let control = |&b: &u8| (b < 0x20 && b != b'\t') || b == 0x7f;
    if let Some(at) = bytes.iter().position(control) {
        let message = format!("control character {:#04x} at byte {}", bytes[at], at + 1);
        return Err(fault(number, message));
    }
    let not_utf8 = |at: usize| fault(number, format!("not UTF-8 at byte {}", at + 1));
    std::str::from_utf8(bytes).map_err(|e| not_utf8(e.valid_up_to()))
}

/// The value of `field` on `line`, which must be a finite number.
pub(in crate::problem) fn value(line: usize, field: &str) -> Result<f64> {
    match field.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(fault(
            line,
            format!("{} is not a finite number", quoted(field)),
        )),
        Err(_) => Err(fault(line, format!("{} is not a number", quoted(field)))),
    }
}

/// A limit, infinite if its size is [`INFINITE`] or more.
pub(in crate::problem) fn limited(value: f64) -> f64 {
    if value.abs() >= INFINITE {
        f64::INFINITY.copysign(value)
    } else {
        value
    }
}

/// Refuses a finite limit that readers take for infinite.
pub(in crate::problem) fn writable_limit(what: &str, index: usize, limit: f64) -> Result<()> {
    if limit.is_finite() && limit.abs() >= INFINITE {
        return Err(Error::NotSupported {
            what: format!("{what} {index} is {limit}, which readers of files take for infinite"),
            index: Some(index),
            line: None,
        });
    }
    Ok(())
}

/// A parse error at `line`.
pub(in crate::problem) fn fault(line: usize, message: impl Into<String>) -> Error {
    Error::Parse {
        line,
        message: message.into(),
    }
}

/// An error that names an unsupported feature and its line.
pub(in crate::problem) fn unsupported(
    line: usize,
    what: impl AsRef<str>,
    index: Option<usize>,
) -> Error {
    Error::NotSupported {
        what: format!("line {line}: {}", what.as_ref()),
        index,
        line: Some(line),
    }
}

/// A field for messages: in quotes, and cut if it is long.
pub(in crate::problem) fn quoted(field: &str) -> String {
    const SHOWN: usize = 40;
    let cut: String = field.chars().take(SHOWN).collect();
    let more = if cut.len() < field.len() { "..." } else { "" };
    format!("'{}{more}'", cut.escape_debug())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_field_is_cut_in_messages() {
        assert_eq!(
            quoted(&"ab".repeat(30)),
            format!("'{}...'", "ab".repeat(20))
        );
        assert_eq!(quoted("a'b"), "'a\\'b'");
    }
}
