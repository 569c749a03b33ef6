//! The tokens of an LP file.

use std::collections::VecDeque;
use std::io::BufRead;

use super::words::{Section, is_name_char, section_of, starts_name};
use crate::error::Result;
use crate::problem::files::lines::{Lines, fault, quoted, value};

/// A word, number or sign.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Token {
    Number(f64),
    Name(String),
    /// `<=`, `=`, `>=` as -1, 0, 1.
    Relation(i8),
    /// Any of `+ - * / ^ [ ] :`.
    Sign(char),
    /// `->` or `<->` of an indicator.
    Arrow,
    Section(Section, String),
    EndOfFile,
}

/// The tokens of a file, with their lines.
pub(super) struct Tokens<'a> {
    lines: Lines<&'a mut dyn BufRead>,
    ahead: VecDeque<(Token, usize)>,
}

impl<'a> Tokens<'a> {
    pub fn new(reader: &'a mut dyn BufRead) -> Self {
        Tokens {
            lines: Lines::new(reader),
            ahead: VecDeque::new(),
        }
    }

    /// The token `k` places ahead.
    pub fn peek(&mut self, k: usize) -> Result<&Token> {
        while self.ahead.len() <= k {
            self.read_line()?;
        }
        Ok(&self.ahead[k].0)
    }

    /// The line of the next token.
    pub fn line(&mut self) -> Result<usize> {
        self.peek(0)?;
        Ok(self.ahead[0].1)
    }

    /// Whether two tokens ahead, which were peeked at, stand on one line.
    pub fn same_line(&self, k: usize, l: usize) -> bool {
        self.ahead[k].1 == self.ahead[l].1
    }

    /// The next token and its line.
    pub fn next(&mut self) -> Result<(Token, usize)> {
        self.peek(0)?;
        let end = (Token::EndOfFile, self.lines.number().max(1));
        Ok(self.ahead.pop_front().unwrap_or(end))
    }

    /// Takes the next token if it is this sign.
    pub fn take(&mut self, sign: char) -> Result<bool> {
        let is = *self.peek(0)? == Token::Sign(sign);
        if is {
            self.next()?;
        }
        Ok(is)
    }

    fn read_line(&mut self) -> Result<()> {
        let Some((line, text)) = self.lines.next(|_| true)? else {
            let line = self.lines.number().max(1);
            self.ahead.push_back((Token::EndOfFile, line));
            return Ok(());
        };
        let mut text = text.split('\\').next().unwrap_or_default();
        if let Some((section, rest)) = section_of(text) {
            let word = text[..text.len() - rest.len()].trim_ascii();
            let token = Token::Section(section, word.to_owned());
            self.ahead.push_back((token, line));
            text = rest;
        }
        loop {
            text = text.trim_ascii_start();
            if text.is_empty() {
                return Ok(());
            }
            let (token, len) = first_token(line, text)?;
            self.ahead.push_back((token, line));
            text = &text[len..];
        }
    }
}

/// The token at the start of `text`, which is not empty, and its length.
fn first_token(line: usize, text: &str) -> Result<(Token, usize)> {
    const RELATIONS: [(&str, i8); 7] = [
        ("<=", -1),
        ("=<", -1),
        (">=", 1),
        ("=>", 1),
        ("<", -1),
        (">", 1),
        ("=", 0),
    ];
    if let Some(arrow) = ["->", "<->"].iter().find(|arrow| text.starts_with(**arrow)) {
        return Ok((Token::Arrow, arrow.len()));
    }
    if let Some((sign, relation)) = RELATIONS.iter().find(|(sign, _)| text.starts_with(sign)) {
        return Ok((Token::Relation(*relation), sign.len()));
    }
    let first = text.chars().next().unwrap_or_default();
    if "+-*/^[]:".contains(first) {
        return Ok((Token::Sign(first), 1));
    }
    if first.is_ascii_digit() || first == '.' {
        let len = number_length(text.as_bytes());
        return Ok((Token::Number(value(line, &text[..len])?), len));
    }
    if starts_name(first) {
        let len = text.find(|c| !is_name_char(c)).unwrap_or(text.len());
        return Ok((Token::Name(text[..len].to_owned()), len));
    }
    let message = format!("{} has no meaning here", quoted(&first.to_string()));
    Err(fault(line, message))
}

/// The length of the number without a sign at the start of `text`.
fn number_length(text: &[u8]) -> usize {
    let digits = |from: usize| {
        text[from..]
            .iter()
            .take_while(|b| b.is_ascii_digit())
            .count()
    };
    let mut len = digits(0);
    if text.get(len) == Some(&b'.') {
        len += 1;
        len += digits(len);
    }
    if matches!(text.get(len), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(text.get(len + 1), Some(b'+' | b'-')));
        let exponent = if len + 1 + sign <= text.len() {
            digits(len + 1 + sign)
        } else {
            0
        };
        if exponent > 0 {
            len += 1 + sign + exponent;
        }
    }
    len
}
