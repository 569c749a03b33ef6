//! Options by name: one table from which C, C++, the program and the documentation take them.

use crate::{Error, Result};

/// How integers are decided.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Strategy {
    /// Not at all: integers stay real. Gives a lower bound.
    Relax,
    /// All at once, each to the nearest integer of the relaxation.
    Direct,
    /// One after the other, the one closest to an integer first, re-optimising exactly each time.
    Greedy,
}

impl Strategy {
    /// All strategies.
    pub const ALL: [Strategy; 3] = [Strategy::Relax, Strategy::Direct, Strategy::Greedy];

    /// The name by which options choose it.
    pub fn name(self) -> &'static str {
        match self {
            Strategy::Relax => "relax",
            Strategy::Direct => "direct",
            Strategy::Greedy => "greedy",
        }
    }
}

/// How to solve. Every field is also an entry of [`OPTIONS`], under the same name.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// How integers are decided.
    pub strategy: Strategy,
    /// Seconds after which the best solution so far is returned.
    pub time_limit: f64,
    /// Threads that may be used at most; 0 means as many as there are cores. The result does not
    /// depend on it.
    pub threads: usize,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            strategy: Strategy::Greedy,
            time_limit: f64::INFINITY,
            threads: 1,
        }
    }
}

/// The type of an option's value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OptionKind {
    /// A whole number.
    Integer,
    /// A real number.
    Real,
    /// One of several words.
    Text,
}

/// A value for an option.
#[derive(Debug, Clone, PartialEq)]
pub enum OptionValue {
    /// A whole number.
    Integer(i64),
    /// A real number.
    Real(f64),
    /// One of several words.
    Text(String),
}

/// What there is to know about one option.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OptionInfo {
    /// Its name.
    pub name: &'static str,
    /// The type of its value.
    pub kind: OptionKind,
    /// Its default, as text.
    pub default: &'static str,
    /// The values allowed, as text.
    pub range: &'static str,
    /// What it does.
    pub text: &'static str,
}

/// All options there are.
pub const OPTIONS: &[OptionInfo] = &[
    OptionInfo {
        name: "strategy",
        kind: OptionKind::Text,
        default: "greedy",
        range: "relax|direct|greedy",
        text: "how integers are decided",
    },
    OptionInfo {
        name: "time_limit",
        kind: OptionKind::Real,
        default: "inf",
        range: "[0, inf]",
        text: "seconds after which the best solution so far is returned",
    },
    OptionInfo {
        name: "threads",
        kind: OptionKind::Integer,
        default: "1",
        range: "[0, 1024]",
        text: "threads that may be used at most; 0: as many as there are cores",
    },
];

impl Options {
    /// Sets one option by name. An integer is taken where a real is wanted.
    ///
    /// # Errors
    /// [`Error::UnknownOption`], [`Error::OptionType`], [`Error::OptionRange`].
    pub fn set(&mut self, name: &str, value: &OptionValue) -> Result<()> {
        let info = info(name)?;
        match (info.name, value) {
            ("strategy", OptionValue::Text(word)) => {
                let found = Strategy::ALL.into_iter().find(|s| s.name() == word);
                self.strategy = found.ok_or_else(|| out_of_range(info, word))?;
            }
            ("time_limit", OptionValue::Real(seconds)) => self.set_time_limit(info, *seconds)?,
            ("time_limit", OptionValue::Integer(seconds)) => {
                self.set_time_limit(info, *seconds as f64)?;
            }
            ("threads", OptionValue::Integer(threads)) => {
                if !(0..=1024).contains(threads) {
                    return Err(out_of_range(info, threads));
                }
                self.threads = *threads as usize;
            }
            _ => {
                return Err(Error::OptionType {
                    name: info.name,
                    expected: match info.kind {
                        OptionKind::Integer => "a whole number",
                        OptionKind::Real => "a real number",
                        OptionKind::Text => "a word",
                    },
                });
            }
        }
        Ok(())
    }

    fn set_time_limit(&mut self, info: &'static OptionInfo, seconds: f64) -> Result<()> {
        if seconds.is_nan() || seconds < 0.0 {
            return Err(out_of_range(info, seconds));
        }
        self.time_limit = seconds;
        Ok(())
    }

    /// The value of one option by name.
    ///
    /// # Errors
    /// [`Error::UnknownOption`].
    pub fn get(&self, name: &str) -> Result<OptionValue> {
        Ok(match info(name)?.name {
            "strategy" => OptionValue::Text(self.strategy.name().into()),
            "time_limit" => OptionValue::Real(self.time_limit),
            _ => OptionValue::Integer(self.threads as i64),
        })
    }
}

fn info(name: &str) -> Result<&'static OptionInfo> {
    OPTIONS
        .iter()
        .find(|o| o.name == name)
        .ok_or_else(|| Error::UnknownOption { name: name.into() })
}

fn out_of_range(info: &'static OptionInfo, value: impl ToString) -> Error {
    Error::OptionRange {
        name: info.name,
        value: value.to_string(),
        range: info.range,
    }
}
