//! The command line of `roundel quad`.

use std::path::PathBuf;

use roundel::Strategy;
use roundel::mesh::TriangleMesh;
use roundel::quad::SeamlessOptions;

use crate::exit;
use crate::field::Directions;
use crate::options::SolverOptions;

/// Turn a triangle mesh into quads: field, map and extraction in one.
///
/// The solver's options are those of the map; time limit and threads hold for each of the two
/// solves.
#[derive(clap::Args)]
#[command(after_help = exit::HELP)]
pub struct Arguments {
    /// The mesh: a file (.obj, .off, .ply), or shape:NAME or shape:NAME:TRIANGLES for one of the
    /// shapes that `roundel shape --help` lists
    #[arg(value_name = "MESH")]
    pub mesh: PathBuf,

    /// Write the quads to this file
    #[arg(short, long, value_name = "QUADS.obj")]
    pub out: Option<PathBuf>,

    /// About how many quads
    #[arg(long, value_name = "N", default_value_t = SeamlessOptions::default().quads)]
    #[arg(value_parser = count, allow_negative_numbers = true)]
    quads: usize,

    /// About how long their edges, instead of how many
    #[arg(long, value_name = "L", conflicts_with = "quads", value_parser = length)]
    #[arg(allow_negative_numbers = true)]
    edge_length: Option<f64>,

    #[command(flatten)]
    pub directions: Directions,

    /// How the field's integers are decided
    #[arg(long, value_name = "WORD", default_value = "greedy", value_parser = deciding)]
    pub field_strategy: Strategy,

    /// Leave faces that the map turns over as they are
    #[arg(long)]
    pub no_untangle: bool,

    /// Leave vertices where the map has them
    #[arg(long)]
    pub no_smooth: bool,

    /// Print one JSON object instead of the summary
    #[arg(long)]
    pub json: bool,

    #[command(flatten)]
    pub solver: SolverOptions,
}

impl Arguments {
    /// How many quads to aim at on a mesh.
    pub fn target(&self, mesh: &TriangleMesh) -> usize {
        match self.edge_length {
            Some(length) => ((mesh.surface_area() / (length * length)).round() as usize).max(1),
            None => self.quads,
        }
    }
}

fn deciding(text: &str) -> Result<Strategy, String> {
    let mut all = Strategy::ALL.into_iter().filter(|&s| s != Strategy::Relax);
    let words: Vec<&str> = all.clone().map(Strategy::name).collect();
    all.find(|s| s.name() == text)
        .ok_or_else(|| format!("not one of {}", words.join(", ")))
}

fn count(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(0) | Err(_) => Err("not a number of quads, 1 or more".into()),
        Ok(quads) => Ok(quads),
    }
}

fn length(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(length) if length > 0.0 && f64::is_finite(length) => Ok(length),
        _ => Err("not a length above zero".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::{count, length};

    #[test]
    fn a_length_is_above_zero_and_finite() {
        assert_eq!(length("0.25"), Ok(0.25));
        for text in ["0", "-1", "nan", "inf", "short", ""] {
            assert!(length(text).is_err(), "{text}");
        }
    }

    #[test]
    fn quads_are_at_least_one() {
        assert_eq!(count("250"), Ok(250));
        for text in ["0", "-3", "1.5", "", "many"] {
            assert!(count(text).is_err(), "{text}");
        }
    }
}
