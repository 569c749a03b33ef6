//! The command line of `roundel quad`.

use std::path::PathBuf;

use roundel::Strategy;

use crate::exit;
use crate::field::Directions;
use crate::options::SolverOptions;
use crate::parametrize::SizingFlags;

/// Turn a triangle mesh into quads: field, map and extraction in one.
///
/// The solver's options are those of the map, which is decided by `lattice` unless --strategy says
/// otherwise; time limit and threads hold for each of the two solves. Features, and the boundary
/// unless it is free, become chains of edges.
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

    #[command(flatten)]
    pub sizing: SizingFlags,

    #[command(flatten)]
    pub directions: Directions,

    /// How the field's integers are decided
    #[arg(long, value_name = "WORD", default_value = "adaptive", value_parser = deciding)]
    pub field_strategy: Strategy,

    /// Leave faces that the map turns over as they are
    #[arg(long)]
    pub no_untangle: bool,

    /// Leave vertices where the map has them
    #[arg(long)]
    pub no_smooth: bool,

    /// Write a page with field, map and quads, to be turned and zoomed in a browser, and all figures
    #[arg(long, value_name = "REPORT.html")]
    pub report: Option<PathBuf>,

    /// Solve field and map by these strategies as well, parted by commas, and show what each finds in
    /// summary, page and JSON
    #[arg(long, value_name = "WORD,...", value_delimiter = ',', value_parser = any)]
    pub compare_strategies: Vec<Strategy>,

    /// Print one JSON object instead of the summary
    #[arg(long)]
    pub json: bool,

    #[command(flatten)]
    pub solver: SolverOptions,
}

fn deciding(text: &str) -> Result<Strategy, String> {
    one_of(text, |strategy| strategy != Strategy::Relax)
}

fn any(text: &str) -> Result<Strategy, String> {
    one_of(text, |_| true)
}

fn one_of(text: &str, allowed: impl Fn(Strategy) -> bool) -> Result<Strategy, String> {
    let mut all = Strategy::ALL.into_iter().filter(|&s| allowed(s));
    let words: Vec<&str> = all.clone().map(Strategy::name).collect();
    all.find(|s| s.name() == text)
        .ok_or_else(|| format!("not one of {}", words.join(", ")))
}
