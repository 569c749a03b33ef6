//! The command line of `roundel distance`.

use std::path::{Path, PathBuf};

use crate::exit;
use crate::mesh::MeshFlags;
use crate::outputs::OutputFlags;
use crate::picture::PictureFlags;

/// Compute the exact distance along a triangle mesh from vertices, features or the boundary.
#[derive(clap::Args)]
#[command(after_help = exit::HELP)]
pub struct Arguments {
    /// The mesh: a file (.obj, .off, .ply, .stl, .gltf, .glb, also .gz), - for standard input, or
    /// shape:NAME or shape:NAME:TRIANGLES for one of the shapes that `roundel shape --help` lists
    #[arg(value_name = "MESH")]
    pub mesh: PathBuf,

    /// Measure from here: vertex:NUMBER, features, boundary, or an OBJ file whose line elements are drawn
    /// onto the surface; may be repeated
    #[arg(long, value_name = "SOURCE", required = true, value_parser = from)]
    pub from: Vec<From>,

    /// The angle between faces, in degrees, from which on an edge is a feature
    #[arg(long, value_name = "DEGREES", default_value_t = 40.0, value_parser = angle)]
    pub features: f64,

    /// Stop at this distance: what is farther is infinite
    #[arg(long, value_name = "DISTANCE", value_parser = limit)]
    pub limit: Option<f64>,

    /// Write the mesh with bands of colour to this file. PLY has the distance of every vertex as `quality`
    #[arg(short, long, value_name = "OUT")]
    pub out: Option<PathBuf>,

    #[command(flatten)]
    pub picture: PictureFlags,

    /// Print one JSON object instead of the summary
    #[arg(long)]
    pub json: bool,

    #[command(flatten)]
    pub output: OutputFlags,

    #[command(flatten)]
    pub input: MeshFlags,
}

/// What `--from` names.
#[derive(Debug, Clone, PartialEq)]
pub enum From {
    Vertex(usize),
    Features,
    Boundary,
    File(PathBuf),
}

impl From {
    /// The file that is read.
    pub fn file(&self) -> Option<&Path> {
        match self {
            From::File(path) => Some(path),
            _ => None,
        }
    }
}

fn from(text: &str) -> Result<From, String> {
    match text {
        "features" => Ok(From::Features),
        "boundary" => Ok(From::Boundary),
        _ => match text.strip_prefix("vertex:").map(str::parse) {
            Some(Ok(vertex)) => Ok(From::Vertex(vertex)),
            None if text.to_lowercase().ends_with(".obj") => Ok(From::File(text.into())),
            _ => Err("expected vertex:NUMBER, features, boundary or a file LINES.obj".into()),
        },
    }
}

fn angle(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(degrees) if (0.0..=180.0).contains(&degrees) => Ok(degrees),
        _ => Err("the angle must be from 0 to 180 degrees".into()),
    }
}

fn limit(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(limit) if limit >= 0.0 => Ok(limit),
        _ => Err("the limit must be a number that is not negative".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::{From, angle, from, limit};

    #[test]
    fn sources_are_vertices_features_and_the_boundary() {
        assert_eq!(from("vertex:12"), Ok(From::Vertex(12)));
        assert_eq!(from("features"), Ok(From::Features));
        assert_eq!(from("boundary"), Ok(From::Boundary));
        assert_eq!(from("lines.OBJ"), Ok(From::File("lines.OBJ".into())));
        for text in ["", "12", "vertex", "vertex:-1", "vertex:x", "face:3"] {
            assert!(from(text).is_err(), "{text}");
        }
    }

    #[test]
    fn angles_and_limits_are_numbers_in_range() {
        assert_eq!((angle("40"), limit("0.5")), (Ok(40.0), Ok(0.5)));
        assert!(angle("181").is_err() && angle("NaN").is_err());
        assert!(limit("-1").is_err() && limit("NaN").is_err());
    }
}
