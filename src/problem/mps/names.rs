//! Names of rows and columns: the rules for a name, and the number of each name.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use super::lines::{Line, quoted};
use crate::error::{Error, Result};

/// The longest name, in bytes. Two of them and a number always fit on a line.
const MAX_NAME: usize = 1 << 12;

/// Names in order of appearance, without repetition.
pub(super) struct Names {
    /// The kind of things that are named, for messages.
    what: &'static str,
    numbers: HashMap<String, u32>,
    lines: Vec<usize>,
}

impl Names {
    pub fn new(what: &'static str) -> Self {
        Names {
            what,
            numbers: HashMap::new(),
            lines: Vec::new(),
        }
    }

    pub fn len(&self) -> usize {
        self.lines.len()
    }

    /// Inserts a new name from `line` and returns its number.
    pub fn insert(&mut self, line: &Line, name: &str) -> Result<usize> {
        check_name(name).map_err(|fault| line.fault(format!("{} {fault}", self.what)))?;
        let number = self.len();
        // The sizes of the library are limited to those of C's int32_t.
        if number >= i32::MAX as usize {
            return Err(Error::Overflow {
                what: format!("line {}: more than 2^31 - 1 {}s", line.number, self.what),
                index: Some(number),
            });
        }
        match self.numbers.entry(name.to_owned()) {
            Entry::Vacant(entry) => entry.insert(number as u32),
            Entry::Occupied(entry) => {
                let first = self.lines[*entry.get() as usize];
                let name = quoted(name);
                return Err(line.fault(format!("{} {name} is already on line {first}", self.what)));
            }
        };
        self.lines.push(line.number);
        Ok(number)
    }

    /// The number of a name that was inserted before.
    pub fn find(&self, line: &Line, name: &str) -> Result<usize> {
        match self.numbers.get(name) {
            Some(&number) => Ok(number as usize),
            None => Err(line.fault(format!("there is no {} {}", self.what, quoted(name)))),
        }
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

/// Checks whether a file can hold `name`. The error gives the reason.
pub(super) fn check_name(name: &str) -> std::result::Result<(), String> {
    let blank = |c: char| c.is_ascii_whitespace() || c.is_ascii_control();
    if name.is_empty() {
        return Err("name is empty".into());
    }
    if name.contains(blank) {
        return Err(format!("name {} has a blank in it", quoted(name)));
    }
    if name.len() > MAX_NAME {
        return Err(format!("name {} is too long", quoted(name)));
    }
    if name == "'MARKER'" {
        return Err(format!("name {} is reserved", quoted(name)));
    }
    Ok(())
}

/// Checks whether a file can hold `title` as the name of the problem, which may contain blanks. The error
/// gives the reason.
pub(super) fn check_title(title: &str) -> std::result::Result<(), String> {
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
