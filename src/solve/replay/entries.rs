//! A parser for JSON objects of names and plain values, entry by entry.
//!
//! A map that serde derives silently takes the last of two equal names. An error raised after an entry was
//! read gets the line of the next token. So each value is checked while the parser is still on its line.

use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, Visitor};

use crate::search::OptionValue;

/// Passes each entry of an object to a function. If the function refuses an entry, the error has that
/// entry's line.
pub(super) struct Entries<F>(pub F);

/// The function's result.
pub(super) type Verdict = std::result::Result<(), String>;

impl<'de, F: FnMut(&str, OptionValue) -> Verdict> Visitor<'de> for Entries<F> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(mut self, mut map: A) -> std::result::Result<(), A::Error> {
        while let Some(name) = map.next_key::<String>()? {
            map.next_value_seed(Entry {
                name: &name,
                take: &mut self.0,
            })?;
        }
        Ok(())
    }
}

struct Entry<'a, F> {
    name: &'a str,
    take: &'a mut F,
}

impl<F: FnMut(&str, OptionValue) -> Verdict> Entry<'_, F> {
    fn take<E: Error>(self, value: OptionValue) -> std::result::Result<(), E> {
        (self.take)(self.name, value).map_err(E::custom)
    }
}

impl<'de, F: FnMut(&str, OptionValue) -> Verdict> DeserializeSeed<'de> for Entry<'_, F> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(
        self,
        deserializer: D,
    ) -> std::result::Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<F: FnMut(&str, OptionValue) -> Verdict> Visitor<'_> for Entry<'_, F> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a number or a word")
    }

    fn visit_i64<E: Error>(self, value: i64) -> std::result::Result<(), E> {
        self.take(OptionValue::Integer(value))
    }

    fn visit_u64<E: Error>(self, value: u64) -> std::result::Result<(), E> {
        self.take(match i64::try_from(value) {
            Ok(value) => OptionValue::Integer(value),
            Err(_) => OptionValue::Real(value as f64),
        })
    }

    fn visit_f64<E: Error>(self, value: f64) -> std::result::Result<(), E> {
        self.take(OptionValue::Real(value))
    }

    fn visit_str<E: Error>(self, value: &str) -> std::result::Result<(), E> {
        self.take(OptionValue::Text(value.to_owned()))
    }
}
