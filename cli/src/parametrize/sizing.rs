//! The flags for the size of quads, of every command that makes a map.

use std::path::{Path, PathBuf};

use roundel::Error;
use roundel::map::{SeamlessOptions, Sizing};

/// A number of quads, a length of their edges, or a length for every face.
#[derive(clap::Args)]
#[group(multiple = false)]
pub struct SizingFlags {
    /// The target number of quads [default: 1000]
    #[arg(long, value_name = "N", value_parser = quads, allow_negative_numbers = true)]
    pub quads: Option<usize>,

    /// The edge length of quads, in units of the mesh
    #[arg(long, value_name = "L", value_parser = length, allow_negative_numbers = true)]
    pub edge_length: Option<f64>,

    /// Take the edge lengths from this file, one line for each face: one number, or two, along the arm
    /// that the field has there and across it
    #[arg(long, value_name = "SIZES.txt")]
    pub edge_lengths: Option<PathBuf>,
}

impl SizingFlags {
    /// The sizing of the command line.
    pub fn of(&self) -> roundel::Result<Sizing> {
        match (self.edge_length, &self.edge_lengths) {
            (Some(length), _) => Ok(Sizing::EdgeLength(length)),
            (_, Some(path)) => read(path),
            _ => {
                let default = SeamlessOptions::default().quads;
                Ok(Sizing::Quads(self.quads.unwrap_or(default)))
            }
        }
    }
}

fn read(path: &Path) -> roundel::Result<Sizing> {
    let text = std::fs::read_to_string(path).map_err(|reason| Error::Io {
        message: format!("{}: {reason}", path.display()),
    })?;
    let mut lengths = Vec::new();
    for (line, content) in (1..).zip(text.lines()) {
        let content = content.split('#').next().unwrap_or_default();
        let words = content.split_whitespace().map(str::parse);
        let numbers: Result<Vec<f64>, _> = words.collect();
        match numbers.as_deref() {
            Ok([]) => {}
            Ok(&[length]) => lengths.push([length; 2]),
            Ok(&[along, across]) => lengths.push([along, across]),
            _ => {
                let file = path.display();
                return Err(Error::Parse {
                    line,
                    message: format!("expected one or two lengths of a face ({file})"),
                });
            }
        }
    }
    Ok(Sizing::Lengths(lengths))
}

fn quads(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(0) | Err(_) => Err("the number of quads must be at least 1".into()),
        Ok(quads) => Ok(quads),
    }
}

fn length(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(length) if length > 0.0 && length.is_finite() => Ok(length),
        _ => Err("the length must be finite and above 0".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::{length, quads};

    #[test]
    fn quads_are_at_least_one() {
        assert_eq!(quads("250"), Ok(250));
        for text in ["0", "-3", "1.5", "", "many"] {
            assert!(quads(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_length_is_above_zero() {
        assert_eq!(length("0.25"), Ok(0.25));
        for text in ["0", "-3", "nan", "inf", "long"] {
            assert!(length(text).is_err(), "{text}");
        }
    }
}
