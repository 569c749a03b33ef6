//! Tables of options. From one table, [`options!`] makes the struct, its defaults, its setters by name, and
//! the list of options for C, C++, Python, the program and the documentation.

use crate::error::{Error, Result};

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
    /// One of several words, or [`UNSET`] for an option that may have no value.
    Text(String),
}

/// The word for an option without a value.
pub const UNSET: &str = "unset";

/// The description of an option.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OptionInfo {
    /// Its name.
    pub name: &'static str,
    /// The type of its value.
    pub kind: OptionKind,
    /// Its default as text, or [`UNSET`] if it has none.
    pub default: &'static str,
    /// The allowed values as text. They are an interval, whose end is excluded if its bracket is round, or
    /// words or numbers with a bar between them.
    pub range: &'static str,
    /// Its effect, in one sentence without a capital and a full stop.
    pub text: &'static str,
}

/// A type that an option can have.
pub(crate) trait OptionType: Sized {
    const KIND: OptionKind;

    /// Converts the value if it has this type and is in the range that `info` states.
    fn read(info: &'static OptionInfo, value: &OptionValue) -> Result<Self>;

    fn value(&self) -> OptionValue;
}

impl OptionType for f64 {
    const KIND: OptionKind = OptionKind::Real;

    /// A whole number is accepted as well.
    fn read(info: &'static OptionInfo, value: &OptionValue) -> Result<Self> {
        let number = match *value {
            OptionValue::Real(number) => number,
            OptionValue::Integer(number) => number as f64,
            OptionValue::Text(_) => return Err(wrong_type(info)),
        };
        match allows(info.range, number) {
            true => Ok(number),
            false => Err(out_of_range(info, number)),
        }
    }

    fn value(&self) -> OptionValue {
        OptionValue::Real(*self)
    }
}

/// Whole numbers as options.
macro_rules! integers {
    ($($type:ty),*) => { $(
        impl OptionType for $type {
            const KIND: OptionKind = OptionKind::Integer;

            fn read(info: &'static OptionInfo, value: &OptionValue) -> Result<Self> {
                let OptionValue::Integer(number) = *value else {
                    return Err(wrong_type(info));
                };
                let allowed = allows(info.range, number).then(|| <$type>::try_from(number).ok());
                allowed.flatten().ok_or_else(|| out_of_range(info, number))
            }

            fn value(&self) -> OptionValue {
                OptionValue::Integer(*self as i64)
            }
        }
    )* };
}
integers!(u8, usize);

impl OptionType for bool {
    const KIND: OptionKind = OptionKind::Integer;

    fn read(info: &'static OptionInfo, value: &OptionValue) -> Result<Self> {
        Ok(u8::read(info, value)? == 1)
    }

    fn value(&self) -> OptionValue {
        OptionValue::Integer((*self).into())
    }
}

impl<T: OptionType> OptionType for Option<T> {
    const KIND: OptionKind = T::KIND;

    fn read(info: &'static OptionInfo, value: &OptionValue) -> Result<Self> {
        match value {
            OptionValue::Text(word) if word == UNSET => Ok(None),
            value => T::read(info, value).map(Some),
        }
    }

    fn value(&self) -> OptionValue {
        let unset = || OptionValue::Text(UNSET.into());
        self.as_ref().map_or_else(unset, T::value)
    }
}

/// The member of `all` with this name.
pub(crate) fn word<T: Copy, const N: usize>(
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

/// Makes an enum that has `ALL` and `name` a type of options.
macro_rules! word_option {
    ($type:ty) => {
        impl $crate::search::table::OptionType for $type {
            const KIND: $crate::search::OptionKind = $crate::search::OptionKind::Text;

            fn read(
                info: &'static $crate::search::OptionInfo,
                value: &$crate::search::OptionValue,
            ) -> $crate::error::Result<Self> {
                $crate::search::table::word(info, value, <$type>::ALL, <$type>::name)
            }

            fn value(&self) -> $crate::search::OptionValue {
                $crate::search::OptionValue::Text(self.name().into())
            }
        }
    };
}
pub(crate) use word_option;

/// Whether a range, written as in [`OptionInfo::range`], contains a number.
fn allows<N: std::str::FromStr + PartialOrd>(range: &str, number: N) -> bool {
    let Some((low, high)) = range.split_once(", ") else {
        let mut numbers = range.split('|').filter_map(|word| word.parse::<N>().ok());
        return numbers.any(|one| one == number);
    };
    let (from, low) = low.split_at(1);
    let (high, to) = high.split_at(high.len() - 1);
    let above = low.parse::<N>().is_ok_and(|low| match from {
        "[" => number >= low,
        _ => number > low,
    });
    above
        && high.parse::<N>().is_ok_and(|high| match to {
            "]" => number <= high,
            _ => number < high,
        })
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

fn out_of_range(info: &'static OptionInfo, value: impl ToString) -> Error {
    Error::OptionRange {
        name: info.name,
        value: value.to_string(),
        range: info.range,
    }
}

/// The entry with this name.
pub(crate) fn info_of(table: &'static [OptionInfo], name: &str) -> Result<&'static OptionInfo> {
    let found = table.iter().find(|info| info.name == name);
    found.ok_or_else(|| Error::UnknownOption { name: name.into() })
}

/// Makes a struct of options from one table of `name: Type = default, "default as text" in "range", "what
/// it does";`. A member after `and` is not an option. An option with two functions after `by` is not a
/// member.
macro_rules! options {
    (
        $(#[$about:meta])*
        pub struct $name:ident, $(#[$listed:meta])* $table:ident {$(
            $(#[$more:meta])*
            $option:ident: $type:ty = $default:expr, $told:literal in $range:expr, $text:literal;
        )*}
        and {$(
            $(#[$doc:meta])*
            $member:ident: $member_type:ty = $value:expr;
        )*}
        by {$(
            $by:ident: $by_type:ty, $by_told:literal in $by_range:expr, $by_text:literal, $get:expr, $set:expr;
        )*}
    ) => {
        $(#[$about])*
        #[derive(Debug, Clone, PartialEq)]
        pub struct $name {
            $(
                #[doc = concat!("Option `", stringify!($option), "`: ", $text, ".")]
                #[doc = ""]
                $(#[$more])*
                pub $option: $type,
            )*
            $($(#[$doc])* pub $member: $member_type,)*
        }

        impl Default for $name {
            fn default() -> Self {
                $name {
                    $($option: $default,)*
                    $($member: $value,)*
                }
            }
        }

        $(#[$listed])*
        pub const $table: &[$crate::search::OptionInfo] = &[
            $($crate::search::OptionInfo {
                name: stringify!($by),
                kind: <$by_type as $crate::search::table::OptionType>::KIND,
                default: $by_told,
                range: $by_range,
                text: $by_text,
            },)*
            $($crate::search::OptionInfo {
                name: stringify!($option),
                kind: <$type as $crate::search::table::OptionType>::KIND,
                default: $told,
                range: $range,
                text: $text,
            },)*
        ];

        impl $name {
            /// Sets one option by name. A whole number is taken where a real one is wanted.
            ///
            /// # Errors
            /// [`UnknownOption`](crate::Error::UnknownOption),
            /// [`OptionType`](crate::Error::OptionType),
            /// [`OptionRange`](crate::Error::OptionRange).
            pub fn set(
                &mut self,
                name: &str,
                value: &$crate::search::OptionValue,
            ) -> $crate::error::Result<()> {
                use $crate::search::table::{OptionType, info_of};
                let info = info_of($table, name)?;
                $(if name == stringify!($by) {
                    let set: fn(&mut Self, $by_type) = $set;
                    set(self, <$by_type>::read(info, value)?);
                })*
                $(if name == stringify!($option) {
                    self.$option = <$type>::read(info, value)?;
                })*
                Ok(())
            }

            /// The value of one option by name.
            ///
            /// # Errors
            /// [`UnknownOption`](crate::Error::UnknownOption).
            pub fn get(&self, name: &str) -> $crate::error::Result<$crate::search::OptionValue> {
                use $crate::search::table::OptionType;
                $(if name == stringify!($by) {
                    let get: fn(&Self) -> $by_type = $get;
                    return Ok(get(self).value());
                })*
                $(if name == stringify!($option) {
                    return Ok(self.$option.value());
                })*
                Err($crate::error::Error::UnknownOption { name: name.into() })
            }
        }
    };
}
pub(crate) use options;

/// Makes an enum of words from one table of `Variant = "word": "what it stands for",`.
macro_rules! words {
    (
        $(#[$about:meta])*
        pub enum $name:ident {
            $(#[$marked:meta])* $first:ident = $first_word:literal: $first_text:literal,
            $($variant:ident = $word:literal: $text:literal,)*
        }
    ) => {
        $(#[$about])*
        pub enum $name {
            #[doc = $first_text]
            $(#[$marked])*
            $first,
            $(#[doc = $text] $variant,)*
        }

        impl $name {
            /// All of them.
            pub const ALL: [$name; [$first_word, $($word),*].len()] =
                [$name::$first, $($name::$variant),*];

            /// Their names with a bar between them, as the range of an option.
            pub(crate) const WORDS: &str = concat!($first_word, $("|", $word),*);

            /// The name by which options choose it.
            pub fn name(self) -> &'static str {
                match self {
                    $name::$first => $first_word,
                    $($name::$variant => $word,)*
                }
            }
        }

        $crate::search::table::word_option!($name);
    };
}
pub(crate) use words;

/// Tests that a table agrees with its struct.
#[cfg(test)]
pub(crate) fn hold<T: Default>(
    table: &'static [OptionInfo],
    set: fn(&mut T, &str, &OptionValue) -> Result<()>,
    get: fn(&T, &str) -> Result<OptionValue>,
) {
    for info in table {
        let (name, defaults) = (info.name, T::default());
        let value = get(&defaults, name).unwrap();
        let text = match &value {
            OptionValue::Text(word) => word.clone(),
            OptionValue::Real(number) => number.to_string(),
            OptionValue::Integer(number) => number.to_string(),
        };
        assert_eq!(text, info.default, "{name}");
        let other = match info.kind {
            OptionKind::Text => {
                let other = info.range.split('|').find(|&word| word != text);
                OptionValue::Text(other.unwrap().into())
            }
            OptionKind::Real => OptionValue::Real(match allows(info.range, 0.25) {
                true => 0.25,
                false => 1.25,
            }),
            OptionKind::Integer => match text.parse::<i64>() {
                Ok(number) if allows(info.range, number - 1) => OptionValue::Integer(number - 1),
                _ => OptionValue::Integer(1),
            },
        };
        let mut options = T::default();
        set(&mut options, name, &other).unwrap();
        assert_eq!(get(&options, name).unwrap(), other, "{name}");
        set(&mut options, name, &value).unwrap();
        let far = match info.kind {
            OptionKind::Text => OptionValue::Text("luck".into()),
            OptionKind::Real => OptionValue::Real(f64::NAN),
            OptionKind::Integer => OptionValue::Integer(-1),
        };
        let refused = set(&mut options, name, &far).unwrap_err();
        assert!(refused.to_string().contains(info.range), "{refused}");
        let wrong = match info.kind {
            OptionKind::Text => OptionValue::Integer(1),
            _ => OptionValue::Text("luck".into()),
        };
        let refused = set(&mut options, name, &wrong).unwrap_err();
        assert!(matches!(refused, Error::OptionType { .. }), "{refused}");
    }
}

#[cfg(test)]
mod tests {
    use super::allows;

    #[test]
    fn a_range_holds_its_ends_where_the_brackets_are_square() {
        for (range, inside, outside) in [
            (
                "[0, inf]",
                vec![0.0, 7.5, f64::INFINITY],
                vec![-0.1, f64::NAN],
            ),
            ("[0, inf)", vec![0.0, 1e300], vec![f64::INFINITY, f64::NAN]),
            ("(0, 2.5]", vec![1e-300, 2.5], vec![0.0, 2.6]),
            ("1|2|4|6", vec![1.0, 6.0], vec![0.0, 3.0]),
        ] {
            assert!(inside.iter().all(|&x| allows(range, x)), "{range}");
            assert!(!outside.iter().any(|&x| allows(range, x)), "{range}");
        }
        assert!(allows("[0, 9007199254740992]", 1_i64 << 53));
        assert!(!allows("[0, 9007199254740992]", (1_i64 << 53) + 1));
    }
}
