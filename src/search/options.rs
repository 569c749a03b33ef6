//! Options by name: one table from which C, C++, the program and the documentation take them.

use super::{Strategy, WarmStart};
use crate::linalg::Ordering;
use crate::{Error, Result};

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
    /// `adaptive`, `multiple`: integers are rounded together while their deviations sum up to at most this.
    pub rounding_threshold: f64,
    /// `adaptive`: up to this many integers are decided exactly, one at a time.
    pub exact_integers: usize,
    /// `adaptive`, `multiple`: Gauss-Seidel updates a pass, after which conjugate gradients take over.
    pub gauss_seidel_updates: usize,
    /// `adaptive`, `multiple`: Gauss-Seidel does not push on where an unknown would move by less.
    pub gauss_seidel_tolerance: f64,
    /// `adaptive`, `multiple`: conjugate-gradient iterations a pass, after which a factorization takes over.
    pub cg_iterations: usize,
    /// `adaptive`: conjugate gradients end where no unknown is further from the minimum, by the
    /// preconditioner's estimate; `multiple`: where the residual of `Q/2 x = -q/2` is no longer.
    pub cg_tolerance: f64,
    /// `adaptive`, `multiple`: whether a pass may factor when conjugate gradients fail.
    pub exact_steps: bool,
    /// What is made of the integers of an earlier solution: of the solver's last one, or those that
    /// the initial guess rounds to where there is none.
    pub warm_start: WarmStart,
    /// The order in which unknowns are eliminated, from the constraints and in factorizations.
    pub ordering: Ordering,
    /// `lattice`, `exact`, `auto`: up to this many integers are decided in a dense lattice.
    pub dense_integers: usize,
    /// `lattice`, `exact`, `auto`: beginnings that nearest plane keeps at a time.
    pub beam_width: usize,
    /// `lattice`, `exact`, `auto`: perturbation rounds after the blocks.
    pub lattice_rounds: usize,
    /// `exact`, `auto`: nodes that the proof may visit.
    pub nodes: usize,
    /// `exact`, `auto`: relative gap that ends the proof.
    pub gap: f64,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            strategy: Strategy::Auto,
            time_limit: f64::INFINITY,
            threads: 1,
            rounding_threshold: 0.5,
            exact_integers: 1000,
            gauss_seidel_updates: 100_000,
            gauss_seidel_tolerance: 1e-3,
            cg_iterations: 50,
            cg_tolerance: 1e-3,
            exact_steps: true,
            warm_start: WarmStart::Off,
            ordering: Ordering::FillReducing,
            dense_integers: 1000,
            beam_width: 256,
            lattice_rounds: 1,
            nodes: 10_000_000_000,
            gap: 0.0,
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
        default: "auto",
        range: "relax|direct|greedy|adaptive|multiple|lattice|exact|auto",
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
    OptionInfo {
        name: "rounding_threshold",
        kind: OptionKind::Real,
        default: "0.5",
        range: "[0, inf]",
        text: "adaptive, multiple: integers are rounded together while their deviations sum up to at most this",
    },
    OptionInfo {
        name: "exact_integers",
        kind: OptionKind::Integer,
        default: "1000",
        range: "[0, 2147483647]",
        text: "adaptive: up to this many integers are decided exactly, one at a time",
    },
    OptionInfo {
        name: "gauss_seidel_updates",
        kind: OptionKind::Integer,
        default: "100000",
        range: "[0, 2147483647]",
        text: "adaptive, multiple: Gauss-Seidel updates a pass, after which conjugate gradients take over",
    },
    OptionInfo {
        name: "gauss_seidel_tolerance",
        kind: OptionKind::Real,
        default: "0.001",
        range: "[0, inf]",
        text: "adaptive, multiple: Gauss-Seidel does not push on where an unknown would move by less",
    },
    OptionInfo {
        name: "cg_iterations",
        kind: OptionKind::Integer,
        default: "50",
        range: "[0, 2147483647]",
        text: "adaptive, multiple: conjugate-gradient iterations a pass, after which a factorization takes over",
    },
    OptionInfo {
        name: "cg_tolerance",
        kind: OptionKind::Real,
        default: "0.001",
        range: "[0, inf]",
        text: "adaptive: conjugate gradients end where no unknown is estimated further from the minimum; multiple: where the residual is shorter",
    },
    OptionInfo {
        name: "exact_steps",
        kind: OptionKind::Integer,
        default: "1",
        range: "[0, 1]",
        text: "adaptive, multiple: 1 if a pass may factor when conjugate gradients fail",
    },
    OptionInfo {
        name: "warm_start",
        kind: OptionKind::Text,
        default: "off",
        range: "off|offer|keep",
        text: "earlier integers: ignored, offered before the search begins, or kept as they are",
    },
    OptionInfo {
        name: "ordering",
        kind: OptionKind::Text,
        default: "fill_reducing",
        range: "fill_reducing|natural|largest_pivot",
        text: "order of eliminations and factorizations; largest_pivot solves constraints for their largest coefficient (Bommes' thesis), natural only shows what an order is worth",
    },
    OptionInfo {
        name: "dense_integers",
        kind: OptionKind::Integer,
        default: "1000",
        range: "[0, 20000]",
        text: "lattice, exact, auto: up to this many integers are decided in a dense lattice",
    },
    OptionInfo {
        name: "beam_width",
        kind: OptionKind::Integer,
        default: "256",
        range: "[1, 1000000]",
        text: "lattice, exact, auto: beginnings that nearest plane keeps at a time",
    },
    OptionInfo {
        name: "lattice_rounds",
        kind: OptionKind::Integer,
        default: "1",
        range: "[0, 2147483647]",
        text: "lattice, exact, auto: perturbation rounds after the blocks",
    },
    OptionInfo {
        name: "nodes",
        kind: OptionKind::Integer,
        default: "10000000000",
        range: "[0, 9007199254740992]",
        text: "exact, auto: nodes that the proof may visit",
    },
    OptionInfo {
        name: "gap",
        kind: OptionKind::Real,
        default: "0",
        range: "[0, inf]",
        text: "exact, auto: relative gap that ends the proof",
    },
];

impl Options {
    /// Sets one option by name. An integer is taken where a real is wanted.
    ///
    /// # Errors
    /// [`Error::UnknownOption`], [`Error::OptionType`], [`Error::OptionRange`].
    pub fn set(&mut self, name: &str, value: &OptionValue) -> Result<()> {
        let info = info(name)?;
        match info.name {
            "strategy" => self.strategy = word(info, value, Strategy::ALL, Strategy::name)?,
            "time_limit" => self.time_limit = real(info, value)?,
            "threads" => self.threads = integer(info, value, 1024)?,
            "rounding_threshold" => self.rounding_threshold = real(info, value)?,
            "exact_integers" => self.exact_integers = integer(info, value, LARGEST)?,
            "gauss_seidel_updates" => self.gauss_seidel_updates = integer(info, value, LARGEST)?,
            "gauss_seidel_tolerance" => self.gauss_seidel_tolerance = real(info, value)?,
            "cg_iterations" => self.cg_iterations = integer(info, value, LARGEST)?,
            "cg_tolerance" => self.cg_tolerance = real(info, value)?,
            "exact_steps" => self.exact_steps = integer(info, value, 1)? == 1,
            "warm_start" => self.warm_start = word(info, value, WarmStart::ALL, WarmStart::name)?,
            "ordering" => self.ordering = word(info, value, Ordering::ALL, Ordering::name)?,
            "dense_integers" => self.dense_integers = integer(info, value, 20_000)?,
            "beam_width" => self.beam_width = whole(info, value, 1, 1_000_000)?,
            "lattice_rounds" => self.lattice_rounds = integer(info, value, LARGEST)?,
            "nodes" => self.nodes = integer(info, value, 1 << 53)?,
            _ => self.gap = real(info, value)?,
        }
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
            "threads" => OptionValue::Integer(self.threads as i64),
            "rounding_threshold" => OptionValue::Real(self.rounding_threshold),
            "exact_integers" => OptionValue::Integer(self.exact_integers as i64),
            "gauss_seidel_updates" => OptionValue::Integer(self.gauss_seidel_updates as i64),
            "gauss_seidel_tolerance" => OptionValue::Real(self.gauss_seidel_tolerance),
            "cg_iterations" => OptionValue::Integer(self.cg_iterations as i64),
            "cg_tolerance" => OptionValue::Real(self.cg_tolerance),
            "exact_steps" => OptionValue::Integer(self.exact_steps.into()),
            "warm_start" => OptionValue::Text(self.warm_start.name().into()),
            "ordering" => OptionValue::Text(self.ordering.name().into()),
            "dense_integers" => OptionValue::Integer(self.dense_integers as i64),
            "beam_width" => OptionValue::Integer(self.beam_width as i64),
            "lattice_rounds" => OptionValue::Integer(self.lattice_rounds as i64),
            "nodes" => OptionValue::Integer(self.nodes as i64),
            _ => OptionValue::Real(self.gap),
        })
    }
}

/// The largest whole number that an option without a limit of its own takes.
const LARGEST: i64 = i32::MAX as i64;

/// The one of `all` whose name is given.
fn word<T: Copy, const N: usize>(
    info: &'static OptionInfo,
    value: &OptionValue,
    all: [T; N],
    name: fn(T) -> &'static str,
) -> Result<T> {
    let OptionValue::Text(word) = value else {
        return Err(wrong_type(info));
    };
    let found = all.into_iter().find(|&one| name(one) == word);
    found.ok_or_else(|| out_of_range(info, word))
}

/// A real number that is not negative.
fn real(info: &'static OptionInfo, value: &OptionValue) -> Result<f64> {
    let number = match *value {
        OptionValue::Real(number) => number,
        OptionValue::Integer(number) => number as f64,
        OptionValue::Text(_) => return Err(wrong_type(info)),
    };
    if number.is_nan() || number < 0.0 {
        return Err(out_of_range(info, number));
    }
    Ok(number)
}

/// A whole number from 0 to `largest`.
fn integer(info: &'static OptionInfo, value: &OptionValue, largest: i64) -> Result<usize> {
    whole(info, value, 0, largest)
}

/// A whole number from `least` to `largest`.
fn whole(
    info: &'static OptionInfo,
    value: &OptionValue,
    least: i64,
    largest: i64,
) -> Result<usize> {
    let OptionValue::Integer(number) = *value else {
        return Err(wrong_type(info));
    };
    if !(least..=largest).contains(&number) {
        return Err(out_of_range(info, number));
    }
    Ok(number as usize)
}

fn wrong_type(info: &'static OptionInfo) -> Error {
    Error::OptionType {
        name: info.name,
        expected: match info.kind {
            OptionKind::Integer => "a whole number",
            OptionKind::Real => "a real number",
            OptionKind::Text => "a word",
        },
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_option_of_the_table_starts_at_its_default_and_comes_back_as_set() {
        for info in OPTIONS {
            let defaults = Options::default();
            let value = defaults.get(info.name).unwrap();
            let text = match &value {
                OptionValue::Text(word) => word.clone(),
                OptionValue::Real(number) => number.to_string(),
                OptionValue::Integer(number) => number.to_string(),
            };
            assert_eq!(text, info.default, "{}", info.name);
            let other = match &value {
                OptionValue::Text(word) => {
                    let mut words = info.range.split('|');
                    OptionValue::Text(words.find(|w| w != word).unwrap().into())
                }
                OptionValue::Real(_) => OptionValue::Real(0.25),
                OptionValue::Integer(number) => OptionValue::Integer(number - 1),
            };
            let mut options = Options::default();
            options.set(info.name, &other).unwrap();
            assert_eq!(options.get(info.name).unwrap(), other, "{}", info.name);
            let changed = OPTIONS
                .iter()
                .filter(|o| options.get(o.name) != defaults.get(o.name));
            assert_eq!(changed.count(), 1, "{} changes itself alone", info.name);
        }
    }
}
