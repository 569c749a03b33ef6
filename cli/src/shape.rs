//! `roundel shape`: writes a procedural mesh to a file.

use std::path::{Path, PathBuf};

use roundel::mesh::shape::{DEFAULT_TRIANGLES, NAMES, by_name};
use roundel::mesh::{MeshError, TriangleMesh, io, jitter};
use roundel::{Error, Result};

use crate::exit::Exit;
use crate::output;
use crate::outputs::{Content, Outputs};
use crate::summary::counted;

/// Write a procedural mesh to a file.
#[derive(clap::Args)]
#[command(after_help = names())]
pub struct Arguments {
    /// Name of the shape
    #[arg(value_name = "NAME")]
    name: String,

    /// The approximate number of triangles
    #[arg(long, value_name = "N", default_value_t = DEFAULT_TRIANGLES)]
    triangles: usize,

    /// Move every vertex by random noise of up to this fraction of its shortest edge
    #[arg(
        long,
        value_name = "A",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    jitter: f64,

    /// Seed of the noise
    #[arg(long, value_name = "S", default_value_t = 0)]
    seed: u64,

    /// Write the mesh to this file: .obj, .off, .ply, .stl, .gltf, .glb or .usda
    #[arg(short, long, value_name = "OUT")]
    out: PathBuf,
}

/// The similarity of names, from 0 to 1, from which one is likely to be meant.
const LIKELY: f64 = 0.8;

/// Runs the command.
pub fn run(arguments: &Arguments) -> Exit {
    let written = write(arguments).and_then(|mesh| {
        let faces = counted(mesh.face_count(), "face");
        output::print(&format!("{}: {faces}\n", arguments.out.display()))
    });
    match written {
        Ok(()) => Exit::Solved,
        Err(error) => {
            output::complain(Path::new(&arguments.name), &error);
            Exit::of(&error)
        }
    }
}

fn write(arguments: &Arguments) -> Result<TriangleMesh> {
    Outputs::of(&[], false).write(Some(&arguments.out), Content::Mesh)?;
    let mut mesh = suggesting(by_name(&arguments.name, arguments.triangles))?;
    if arguments.jitter != 0.0 {
        mesh = jitter(&mesh, arguments.jitter, arguments.seed)?;
    }
    io::write(&arguments.out, &mesh)?;
    Ok(mesh)
}

/// A shape by name; the error for a name that is none says which one is meant, if one is near.
///
/// # Errors
/// The error of the shape.
pub fn suggesting(shape: std::result::Result<TriangleMesh, MeshError>) -> Result<TriangleMesh> {
    shape.map_err(|error| {
        let meant = match &error {
            MeshError::UnknownShape { name } => nearest(name),
            _ => None,
        };
        match meant {
            Some(meant) => Error::InvalidArgument {
                what: format!("{error}; did you mean '{meant}'?"),
                index: None,
            },
            None => error.into(),
        }
    })
}

/// The name of a shape that is likely to be meant.
fn nearest(name: &str) -> Option<&'static str> {
    let names = NAMES.iter().map(|(known, _)| *known);
    let rated = names.map(|known| (strsim::jaro_winkler(name, known), known));
    let best = rated.max_by(|a, b| a.0.total_cmp(&b.0))?;
    (best.0 >= LIKELY).then_some(best.1)
}

/// The table of the library, as `--help` prints it.
fn names() -> String {
    let lines = NAMES
        .iter()
        .map(|(name, what)| format!("\n  {name:<17} {what}"));
    lines.fold(String::from("Shapes:"), |text, line| text + &line)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn a_name_with_a_slip_means_the_nearest_shape() {
        assert_eq!(nearest("gaer"), Some("gear"));
        assert_eq!(nearest("round-cube"), Some("rounded-cube"));
        assert_eq!(nearest("teapot"), None);
    }
}
