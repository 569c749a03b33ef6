//! The lines of a QPLIB file as records of words and numbers.

use std::io::BufRead;

use crate::error::{Error, Result};
use crate::problem::files::lines::{Lines, fault, quoted, unsupported, value};

/// The largest number of unknowns or constraints. Defaults let a file of a few bytes ask for any number.
const MOST: usize = 2_000_000;

/// The records of a file, one for each line that is neither blank nor a comment.
pub(super) struct Records<'a> {
    lines: Lines<&'a mut dyn BufRead>,
}

/// A line, cut into words.
pub(super) struct Record<'a> {
    /// The number of the line, counted from 1.
    pub line: usize,
    text: &'a str,
}

impl<'a> Records<'a> {
    pub fn new(reader: &'a mut dyn BufRead) -> Self {
        Records {
            lines: Lines::new(reader),
        }
    }

    /// The next record, or `None` at the end of the file.
    pub fn next(&mut self) -> Result<Option<Record<'_>>> {
        let comment =
            |line: &[u8]| matches!(line.trim_ascii_start().first(), Some(b'#' | b'!' | b'%'));
        let counts = |line: &[u8]| !comment(line);
        let line = self.lines.next(counts)?;
        Ok(line.map(|(line, text)| Record { line, text }))
    }

    /// The next record, which must be there.
    pub fn expect(&mut self, what: &str) -> Result<Record<'_>> {
        let last = self.lines.number().max(1);
        let ended = || fault(last, format!("the file ends before {what}"));
        self.next()?.ok_or_else(ended)
    }

    /// The next record's number.
    pub fn number(&mut self, what: &str) -> Result<f64> {
        self.expect(what)?.value(0)
    }

    /// The next record's count of unknowns or constraints.
    pub fn size(&mut self, what: &str) -> Result<usize> {
        let record = self.expect(what)?;
        let size = record.count(0)?;
        if size > MOST {
            return Err(unsupported(
                record.line,
                format!("more than {MOST} {what}"),
                None,
            ));
        }
        Ok(size)
    }

    /// A matrix or vector: a count and as many lines of `N` indices and a value. Each goes to `take` with its
    /// line. An index is below its limit and counted from zero.
    pub fn sparse<const N: usize>(
        &mut self,
        what: &str,
        limits: [usize; N],
        mut take: impl FnMut(usize, [usize; N], f64) -> Result<()>,
    ) -> Result<()> {
        let count = self.expect(what)?.count(0)?;
        for _ in 0..count {
            let record = self.expect(what)?;
            let mut indices = [0; N];
            for (k, limit) in limits.into_iter().enumerate() {
                indices[k] = record.index(k, limit)?;
            }
            take(record.line, indices, record.value(N)?)?;
        }
        Ok(())
    }

    /// A vector of `len` numbers: a default, and a count of entries that differ.
    pub fn vector(&mut self, what: &str, len: usize) -> Result<Vec<f64>> {
        let mut values = filled(len, self.number(what)?)?;
        let mut given = filled(len, false)?;
        self.sparse(what, [len], |line, [i], value| {
            if std::mem::replace(&mut given[i], true) {
                return Err(fault(
                    line,
                    format!("entry {} of {what} is given twice", i + 1),
                ));
            }
            values[i] = value;
            Ok(())
        })?;
        Ok(values)
    }
}

impl<'a> Record<'a> {
    /// The word at a position.
    pub fn word(&self, position: usize) -> Result<&'a str> {
        let mut words = self.text.split_ascii_whitespace();
        let few = || {
            fault(
                self.line,
                format!("expected at least {} words", position + 1),
            )
        };
        words.nth(position).ok_or_else(few)
    }

    /// The number at a position.
    pub fn value(&self, position: usize) -> Result<f64> {
        value(self.line, self.word(position)?)
    }

    /// The count at a position.
    pub fn count(&self, position: usize) -> Result<usize> {
        let word = self.word(position)?;
        let wrong = |_| fault(self.line, format!("{} is not a count", quoted(word)));
        word.parse().map_err(wrong)
    }

    /// The index at a position: from 1 to `limit` in the file, from 0 in the result.
    pub fn index(&self, position: usize, limit: usize) -> Result<usize> {
        let number = self.count(position)?;
        if number == 0 || number > limit {
            let message = format!("index {number} is not between 1 and {limit}");
            return Err(fault(self.line, message));
        }
        Ok(number - 1)
    }
}

/// A vector of equal values.
pub(super) fn filled<T: Clone>(len: usize, value: T) -> Result<Vec<T>> {
    let mut values = Vec::new();
    let reserved = values.try_reserve_exact(len);
    reserved.map_err(|_| Error::OutOfMemory {
        what: "the unknowns and rows of a file",
    })?;
    values.resize(len, value);
    Ok(values)
}
