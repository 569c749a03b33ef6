//! The command line of `roundel field`.

use std::path::PathBuf;

use super::Directions;
use crate::exit;
use crate::options::SolverOptions;

/// Compute the smoothest cross field of a triangle mesh.
#[derive(clap::Args)]
#[command(after_help = exit::HELP)]
pub struct Arguments {
    /// The mesh: a file (.obj, .off, .ply) or shape:NAME[:TRIANGLES], see `roundel shape --help`
    #[arg(value_name = "MESH")]
    pub mesh: PathBuf,

    #[command(flatten)]
    pub directions: Directions,

    /// Write the mesh with crosses and irregular vertices to this file, to be looked at in MeshLab
    /// or Blender (.ply and .obj have colours, .off not)
    #[arg(short, long, value_name = "OUT")]
    pub out: Option<PathBuf>,

    /// Draw a picture to this PNG file
    #[arg(long, value_name = "OUT.png")]
    pub picture: Option<PathBuf>,

    /// Width and height of the picture in pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "1600x1200", value_parser = size)]
    pub picture_size: [usize; 2],

    /// Write the mixed-integer problem to this file: MPS, compressed if it ends in .gz
    #[arg(long, value_name = "P.mps[.gz]")]
    pub write_problem: Option<PathBuf>,

    /// Print one JSON object instead of the summary
    #[arg(long)]
    pub json: bool,

    #[command(flatten)]
    pub solver: SolverOptions,
}

fn size(text: &str) -> Result<[usize; 2], String> {
    let (width, height) = text.split_once('x').ok_or("not WIDTHxHEIGHT")?;
    let pixels = |text: &str| match text.parse() {
        Ok(pixels) if (1..=16_384).contains(&pixels) => Ok(pixels),
        _ => Err(format!("'{text}' is not a number of pixels, 1 to 16384")),
    };
    Ok([pixels(width)?, pixels(height)?])
}

#[cfg(test)]
mod tests {
    use super::size;

    #[test]
    fn a_size_is_two_numbers_of_pixels() {
        assert_eq!(size("640x480"), Ok([640, 480]));
        for text in ["640", "640x", "0x480", "640x16385", "-1x2", "640x480x2"] {
            assert!(size(text).is_err(), "{text}");
        }
    }
}
