//! The command line of `roundel field`.

use std::path::PathBuf;

use super::Directions;
use crate::exit;
use crate::mesh::MeshFlags;
use crate::options::SolverOptions;
use crate::outputs::OutputFlags;
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

    /// Draw a picture to this PNG file
    #[arg(long, value_name = "OUT.png")]
    pub picture: Option<PathBuf>,

    /// Width and height of the picture in pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "1600x1200", value_parser = size)]
    pub picture_size: [usize; 2],

    /// The direction from which the picture looks at the mesh
    #[arg(long, value_name = "X,Y,Z", default_value = "0.55,0.42,0.8", value_parser = direction)]
    #[arg(allow_hyphen_values = true)]
    pub picture_from: [f64; 3],

    /// The direction that points upwards in the picture
    #[arg(long, value_name = "X,Y,Z", default_value = "0,1,0", value_parser = direction)]
    #[arg(allow_hyphen_values = true)]
    pub picture_up: [f64; 3],

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

/// A size of a picture.
pub fn size(text: &str) -> Result<[usize; 2], String> {
    let (width, height) = text.split_once('x').ok_or("expected WIDTHxHEIGHT")?;
    let pixels = |text: &str| match text.parse() {
        Ok(pixels) if (1..=8_192).contains(&pixels) => Ok(pixels),
        _ => Err(format!("'{text}' is not a number of pixels from 1 to 8192")),
    };
    Ok([pixels(width)?, pixels(height)?])
}

/// A direction in space.
pub fn direction(text: &str) -> Result<[f64; 3], String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(str::parse).collect();
    let numbers = numbers.map_err(|_| "expected X,Y,Z")?;
    numbers
        .try_into()
        .map_err(|_| String::from("expected X,Y,Z"))
}

#[cfg(test)]
mod tests {
    use super::{direction, size, symmetry};

    #[test]
    fn a_symmetry_is_one_that_fields_have() {
        assert_eq!(symmetry("6"), Ok(6));
        for text in ["0", "3", "8", "4.0", "cross"] {
            assert!(symmetry(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_direction_of_view_is_three_numbers() {
        assert_eq!(direction("-1,0.5,2"), Ok([-1.0, 0.5, 2.0]));
        for text in ["", "1,2", "1,2,3,4", "1,2,z"] {
            assert!(direction(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_size_is_two_numbers_of_pixels() {
        assert_eq!(size("640x480"), Ok([640, 480]));
        for text in ["640", "640x", "0x480", "640x8193", "-1x2", "640x480x2"] {
            assert!(size(text).is_err(), "{text}");
        }
    }
}
