//! Lines of text files, counted from 1, whatever ends them: LF, CR LF, or CR alone.

use std::str::FromStr;

use crate::soup::SoupError;

/// What the editors of some systems put before UTF-8.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// The lines of a text and their numbers.
#[derive(Clone)]
pub(super) struct Lines<'a> {
    rest: Option<&'a [u8]>,
    line: usize,
}

impl<'a> Lines<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Lines {
            rest: Some(bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes)),
            line: 0,
        }
    }

    /// What follows the lines taken.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.rest.unwrap_or_default()
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (usize, &'a [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        let rest = self.rest?;
        self.line += 1;
        let end = rest.iter().position(|&b| b == b'\n' || b == b'\r');
        let (line, after) = rest.split_at(end.unwrap_or(rest.len()));
        self.rest = after
            .strip_prefix(b"\r\n")
            .or(after.get(1..))
            .filter(|after| !after.is_empty());
        Some((self.line, line))
    }
}

/// A line without its comment, which starts with `#`.
pub(super) fn said(line: &[u8]) -> &[u8] {
    let end = line.iter().position(|&b| b == b'#');
    &line[..end.unwrap_or(line.len())]
}

/// A word as a number.
pub(super) fn number<T: FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// The words of a file.
#[derive(Clone)]
pub(super) struct Words<'a> {
    lines: Lines<'a>,
    /// The number of the current line.
    line: usize,
    /// What is left of it.
    rest: &'a [u8],
}

impl<'a> Words<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Words::of(Lines::new(bytes))
    }

    /// The words of the lines that are left.
    pub(super) fn of(lines: Lines<'a>) -> Self {
        Words {
            line: lines.line.max(1),
            lines,
            rest: &[],
        }
    }

    /// Goes to the next line that says something, which is to hold what is expected.
    pub(super) fn next_line(&mut self, expected: &str) -> Result<(), SoupError> {
        for (line, text) in self.lines.by_ref() {
            self.line = line;
            self.rest = said(text).trim_ascii();
            if !self.rest.is_empty() {
                return Ok(());
            }
        }
        Err(self.wrong(&format!("the file ends before {expected}")))
    }

    /// The next word of the line.
    pub(super) fn on_this_line(&mut self) -> Option<&'a [u8]> {
        self.rest = self.rest.trim_ascii_start();
        let end = self.rest.iter().position(u8::is_ascii_whitespace);
        let (word, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
        self.rest = rest;
        (!word.is_empty()).then_some(word)
    }

    /// Passes over bytes of the line.
    pub(super) fn take_here(&mut self, count: usize) {
        self.rest = self
            .rest
            .trim_ascii_start()
            .get(count..)
            .unwrap_or_default();
    }

    /// The next word as a number, on this line or the next.
    pub(super) fn number<T: FromStr>(&mut self, expected: &str) -> Result<T, SoupError> {
        let word = self.word(expected)?;
        number(word).ok_or_else(|| self.unexpected(word, expected))
    }

    /// The next word, on this line or the next.
    pub(super) fn word(&mut self, expected: &str) -> Result<&'a [u8], SoupError> {
        if let Some(word) = self.on_this_line() {
            return Ok(word);
        }
        self.next_line(expected)?;
        Ok(self.on_this_line().unwrap_or_default())
    }

    /// Whether any word follows.
    pub(super) fn has_more(&self) -> bool {
        let mut ahead = self.clone();
        ahead.on_this_line().is_some() || ahead.next_line("").is_ok()
    }

    /// The rest of the line is passed over.
    pub(super) fn end_line(&mut self) {
        self.rest = &[];
    }

    pub(super) fn unexpected(&self, word: &[u8], expected: &str) -> SoupError {
        let word = String::from_utf8_lossy(&word[..word.len().min(20)]);
        self.wrong(&format!("'{word}' is not {expected}"))
    }

    /// An error at this line.
    pub(super) fn wrong(&self, message: &str) -> SoupError {
        SoupError::Parse {
            line: self.line,
            message: message.to_owned(),
        }
    }
}
