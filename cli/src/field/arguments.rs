//! The command line of `roundel field`.

use std::path::PathBuf;

use super::Directions;
use crate::exit;
use crate::mesh::MeshFlags;
use crate::options::SolverOptions;
use crate::outputs::OutputFlags;
use crate::picture::PictureFlags;
use crate::threads::TraceFlags;

/// Compute the smoothest cross field of a triangle mesh.
#[derive(clap::Args)]
#[command(after_help = exit::HELP)]
pub struct Arguments {
    /// The mesh: a file (.obj, .off, .ply, .stl, .gltf, .glb, also .gz), - for standard input, or
    /// shape:NAME or shape:NAME:TRIANGLES for one of the shapes that `roundel shape --help` lists
    #[arg(value_name = "MESH")]
    pub mesh: PathBuf,

    #[command(flatten)]
    pub directions: Directions,

    /// The number of arms, evenly spaced: 1, 2, 4 (crosses) or 6
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = symmetry)]
    pub symmetry: u8,

    /// Write the field to this file. A .txt file has one line with a direction for each face, for
    /// `parametrize` and other programs; .ply, .obj and .off files have the mesh with crosses and
    /// irregular vertices, for MeshLab and Blender (.off without colours)
    #[arg(short, long, value_name = "OUT")]
    pub out: Option<PathBuf>,

    #[command(flatten)]
    pub picture: PictureFlags,

    /// Write the mixed-integer problem to this file: MPS, compressed if it ends in .gz
    #[arg(long, value_name = "P.mps[.gz]")]
    pub write_problem: Option<PathBuf>,

    /// Write a page for a browser with all figures and an interactive view of the field
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

fn symmetry(text: &str) -> Result<u8, String> {
    match text.parse() {
        Ok(arms @ (1 | 2 | 4 | 6)) => Ok(arms),
        _ => Err("the symmetry must be 1, 2, 4 or 6".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::symmetry;

    #[test]
    fn a_symmetry_is_one_that_fields_have() {
        assert_eq!(symmetry("6"), Ok(6));
        for text in ["0", "3", "8", "4.0", "cross"] {
            assert!(symmetry(text).is_err(), "{text}");
        }
    }
}
