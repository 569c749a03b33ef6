//! Names of rows and columns: the rules for a name, and the number of each name.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use super::lines::{fault, quoted};
use crate::error::{Error, Result};

/// The longest name, in bytes. Two of them and a number always fit on a line.
const MAX_NAME: usize = 1 << 12;

/// Names in order of appearance, without repetition.
pub(in crate::problem) struct NameList {
    /// The kind of things that are named, for messages.
    what: &'static str,
    numbers: HashMap<String, u32>,
    lines: Vec<usize>,
}

impl NameList {
    pub fn new(what: &'static str) -> Self {
        NameList {
            what,
            numbers: HashMap::new(),
            lines: Vec::new(),
        }
    }

    pub fn len(&self) -> usize {
        self.lines.len()
    }

    /// Inserts a new name from `line` and returns its number.
    pub fn insert(&mut self, line: usize, name: &str) -> Result<usize> {
        check_word(name).map_err(|reason| fault(line, format!("{} {reason}", self.what)))?;
        let number = self.len();
        // The sizes of the library are limited to those of C's int32_t.
        if number >= i32::MAX as usize {
            return Err(Error::Overflow {
                what: format!("line {line}: more than 2^31 - 1 {}s", self.what),
                index: Some(number),
            });
        }
        match self.numbers.entry(name.to_owned()) {
            Entry::Vacant(entry) => entry.insert(number as u32),
            Entry::Occupied(entry) => {
                let first = self.lines[*entry.get() as usize];
                let name = quoted(name);
                let what = self.what;
                return Err(fault(
                    line,
                    format!("{what} {name} is already on line {first}"),
                ));
            }
        };
        self.lines.push(line);
        Ok(number)
    }

    /// The number of a name that was inserted before.
    pub fn find(&self, line: usize, name: &str) -> Result<usize> {
        match self.numbers.get(name) {
            Some(&number) => Ok(number as usize),
            None => Err(fault(
                line,
                format!("there is no {} {}", self.what, quoted(name)),
            )),
        }
    }

    /// The number of a name, if it was inserted before.
    pub fn number(&self, name: &str) -> Option<usize> {
        self.numbers.get(name).map(|&number| number as usize)
    }

    /// The name with this number.
    pub fn name(&self, number: usize) -> &str {
        let mut names = self.numbers.iter();
        let found = names.find(|(_, other)| **other as usize == number);
        found.map_or("", |(name, _)| name)
    }

    /// All names, in order.
    pub fn into_vec(self) -> Vec<String> {
        let mut names = vec![String::new(); self.lines.len()];
        for (name, number) in self.numbers {
            names[number as usize] = name;
        }
        names
    }
}

/// Checks whether `name` is text of a length that a file may hold. The error gives the reason.
fn check_word(name: &str) -> std::result::Result<(), String> {
    if name.is_empty() {
        return Err("name is empty".into());
    }
    if name.len() > MAX_NAME {
        return Err(format!("name {} is too long", quoted(name)));
    }
    if name == "'MARKER'" {
        return Err(format!("name {} is reserved", quoted(name)));
    }
    Ok(())
}

/// Checks whether a free-format file can hold `name`. The error gives the reason.
pub(in crate::problem) fn check_name(name: &str) -> std::result::Result<(), String> {
    if !is_plain(name) {
        return Err(format!("name {} has a blank in it", quoted(name)));
    }
    check_word(name)
}

/// Whether `name` has no blank in it. Fixed-format MPS has names with blanks.
pub(in crate::problem) fn is_plain(name: &str) -> bool {
    !name.contains(|c: char| c.is_ascii_whitespace() || c.is_ascii_control())
}

/// Checks whether a file can hold `title` as the name of the problem, which may contain blanks. The error
/// gives the reason.
pub(in crate::problem) fn check_title(title: &str) -> std::result::Result<(), String> {
    if title.trim_ascii() != title || title.contains(|c: char| c.is_ascii_control()) {
        return Err(format!(
            "title {} has blanks around it or is no text",
            quoted(title)
        ));
    }
    if title.len() > MAX_NAME {
        return Err(format!("title {} is too long", quoted(title)));
    }
    Ok(())
}
