//! The format of the replay file: JSON, with the options under their names in the table of options.

use std::collections::{BTreeMap, BTreeSet};

use serde::de::Deserializer;
use serde::ser::{SerializeMap, Serializer};
use serde::{Deserialize, Serialize};

use super::entries::Entries;
use crate::error::{Error, Result};
use crate::search::{OPTIONS, OptionInfo, OptionKind, OptionValue, Options};

/// The version of the format that is written. No other version can be read.
const FORMAT: u64 = 1;

/// The contents of a replay file.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Replay {
    pub format: u64,
    /// The version of the library that wrote the file. It is information for the reader of a bug report.
    pub library: String,
    /// The sizes of the problem, which detect a replay file of another problem.
    pub variables: usize,
    pub constraints: usize,
    #[serde(serialize_with = "write_options", deserialize_with = "read_options")]
    pub options: Options,
    /// The pinned variables.
    pub pins: Values,
    /// The variables with a nonzero guess.
    pub guess: Values,
}

/// Values of some variables.
#[derive(Debug, Default, PartialEq, Serialize)]
pub(super) struct Values(pub BTreeMap<usize, f64>);

impl Default for Replay {
    fn default() -> Self {
        Replay {
            format: FORMAT,
            library: env!("CARGO_PKG_VERSION").into(),
            variables: 0,
            constraints: 0,
            options: Options::default(),
            pins: Values::default(),
            guess: Values::default(),
        }
    }
}

impl Replay {
    pub fn to_text(&self) -> Result<String> {
        let text = serde_json::to_string_pretty(self).map_err(|e| Error::InvalidArgument {
            what: e.to_string(),
            index: None,
        })?;
        Ok(text + "\n")
    }

    pub fn parse(bytes: &[u8]) -> Result<Self> {
        /// The format is read first, since the meaning of all other entries depends on it.
        #[derive(Deserialize)]
        struct Header {
            format: u64,
        }
        let header: Header = serde_json::from_slice(bytes).map_err(parse_error)?;
        if header.format != FORMAT {
            return Err(Error::NotSupported {
                what: format!("replay format {} (only {FORMAT} is)", header.format),
                index: None,
                line: format_line(bytes),
            });
        }
        serde_json::from_slice(bytes).map_err(parse_error)
    }
}

/// The line of the format's entry. Reading the number as a string fails on that line.
fn format_line(bytes: &[u8]) -> Option<usize> {
    #[derive(Deserialize)]
    struct Located {
        #[serde(rename = "format")]
        _format: String,
    }
    let located = serde_json::from_slice::<Located>(bytes);
    located.err().map(|e| e.line())
}

fn parse_error(error: serde_json::Error) -> Error {
    let text = error.to_string();
    // The library's own message starts with the line, so serde's copy at the end is removed.
    let place = format!(" at line {} column {}", error.line(), error.column());
    Error::Parse {
        line: error.line().max(1),
        message: text.strip_suffix(&place).unwrap_or(&text).to_owned(),
    }
}

fn write_options<S: Serializer>(
    options: &Options,
    serializer: S,
) -> std::result::Result<S::Ok, S::Error> {
    let mut map = serializer.serialize_map(Some(OPTIONS.len()))?;
    for info in OPTIONS {
        match options.get(info.name).map_err(serde::ser::Error::custom)? {
            OptionValue::Integer(value) => map.serialize_entry(info.name, &value)?,
            // JSON has no literal for infinity.
            OptionValue::Real(f64::INFINITY) => map.serialize_entry(info.name, "inf")?,
            OptionValue::Real(value) => map.serialize_entry(info.name, &value)?,
            OptionValue::Text(value) => map.serialize_entry(info.name, &value)?,
        }
    }
    map.end()
}

fn read_options<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> std::result::Result<Options, D::Error> {
    let mut options = Options::default();
    let mut seen = BTreeSet::new();
    deserializer.deserialize_map(Entries(|name: &str, value| {
        let is_real = |o: &OptionInfo| o.name == name && o.kind == OptionKind::Real;
        let value = match value {
            OptionValue::Text(word) if word == "inf" && OPTIONS.iter().any(is_real) => {
                OptionValue::Real(f64::INFINITY)
            }
            other => other,
        };
        if !seen.insert(name.to_owned()) {
            return Err(format!("option '{name}' has two values"));
        }
        options.set(name, &value).map_err(|e| e.to_string())
    }))?;
    Ok(options)
}

impl<'de> Deserialize<'de> for Values {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        let mut values = BTreeMap::new();
        deserializer.deserialize_map(Entries(|name: &str, value| {
            let variable: usize = match name.parse() {
                Ok(variable) => variable,
                Err(_) => return Err(format!("'{}' is no variable", name.escape_debug())),
            };
            let value = match value {
                OptionValue::Real(value) => value,
                OptionValue::Integer(value) => value as f64,
                OptionValue::Text(_) => {
                    return Err(format!("the value of variable {variable} is no number"));
                }
            };
            match values.insert(variable, value) {
                None => Ok(()),
                Some(_) => Err(format!("variable {variable} has two values")),
            }
        }))?;
        Ok(Values(values))
    }
}
