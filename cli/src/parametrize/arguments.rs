//! The command line of `roundel parametrize`.

use std::path::PathBuf;

use roundel::Strategy;

use super::sizing::SizingFlags;
use crate::exit;
use crate::field::Directions;
use crate::mesh::MeshFlags;
use crate::options::SolverOptions;
use crate::outputs::OutputFlags;
use crate::threads::TraceFlags;

/// Compute a seamless parametrization of a triangle mesh that follows a cross field.
///
/// The field comes from a file, or is that of `roundel field` with the same flags. Features,
/// and the boundary unless it is free, become isolines of integer value: chains of quads' edges.
/// The solver's options are those of the parametrization; the time limit is that of the whole run,
/// and the threads are also those of the field's solve.
#[derive(clap::Args)]
#[command(after_help = exit::HELP)]
pub struct Arguments {
    /// The mesh: a file (.obj, .off, .ply, .stl, .gltf, .glb, also .gz), - for standard input, or
    /// shape:NAME or shape:NAME:TRIANGLES for one of the shapes that `roundel shape --help` lists
    #[arg(value_name = "MESH")]
    pub mesh: PathBuf,

    /// Take the field from this file, as `roundel field -o FIELD.txt` writes it: one line with a
    /// direction X Y Z for each face, matched over edges by the nearest arms
    #[arg(long, value_name = "FIELD.txt")]
    #[arg(conflicts_with_all = ["constrain_curvature", "curvature_weight", "fix", "field_strategy", "guide_curves", "feature_curves"])]
    pub field: Option<PathBuf>,

    #[command(flatten)]
    pub directions: Directions,

    /// The strategy that decides the integers of the field
    #[arg(long, value_name = "WORD", default_value = "adaptive", value_parser = strategy)]
    pub field_strategy: Strategy,

    #[command(flatten)]
    pub sizing: SizingFlags,

    /// The most rounds of local stiffening around folded triangles, before they are untangled
    #[arg(
        long,
        value_name = "TIMES",
        default_value_t = 5,
        conflicts_with = "no_untangle"
    )]
    pub stiffen: usize,

    /// Do not untangle: leave the triangles that the map folds
    #[arg(long)]
    pub no_untangle: bool,

    /// Do not refine the mesh first where edges are longer than three edges of the quads or angles are
    /// below 2 degrees. With a field from a file the mesh is never refined
    #[arg(long)]
    pub no_refine: bool,

    /// Write the mesh, refined if it was, with the coordinates of its corners to this file
    #[arg(short, long, value_name = "UV.obj")]
    pub out: Option<PathBuf>,

    /// Write the mixed-integer problem to this file: MPS, compressed if it ends in .gz
    #[arg(long, value_name = "P.mps[.gz]")]
    pub write_problem: Option<PathBuf>,

    /// Write a page for a browser with all figures and an interactive view of the map
    #[arg(long, value_name = "REPORT.html")]
    pub report: Option<PathBuf>,

    /// Print one JSON object instead of the summary
    #[arg(long)]
    pub json: bool,

    #[command(flatten)]
    pub output: OutputFlags,

    #[command(flatten)]
    pub tracing: TraceFlags,

    #[command(flatten)]
    pub input: MeshFlags,

    #[command(flatten)]
    pub solver: SolverOptions,
}

/// A strategy that decides integers: a field needs them.
fn strategy(text: &str) -> Result<Strategy, String> {
    let mut deciding = Strategy::ALL.into_iter().filter(|&s| s != Strategy::Relax);
    let words: Vec<&str> = deciding.clone().map(Strategy::name).collect();
    deciding
        .find(|s| s.name() == text)
        .ok_or_else(|| format!("expected one of {}", words.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_field_needs_a_strategy_that_decides_integers() {
        assert_eq!(strategy("direct"), Ok(Strategy::Direct));
        let refused = strategy("relax").unwrap_err();
        assert!(refused.contains("greedy"), "{refused}");
    }
}
