//! `roundel shape`: writes a procedural mesh to a file.

use std::path::{Path, PathBuf};

use roundel::Result;
use roundel::mesh::shape::{DEFAULT_TRIANGLES, NAMES, by_name};
use roundel::mesh::{TriangleMesh, io, jitter};

use crate::exit::Exit;
use crate::output;
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
    let mut mesh = by_name(&arguments.name, arguments.triangles)?;
    if arguments.jitter != 0.0 {
        mesh = jitter(&mesh, arguments.jitter, arguments.seed)?;
    }
    io::write(&arguments.out, &mesh)?;
    Ok(mesh)
}

/// The table of the library, as `--help` prints it.
fn names() -> String {
    let lines = NAMES
        .iter()
        .map(|(name, what)| format!("\n  {name:<17} {what}"));
    lines.fold(String::from("Shapes:"), |text, line| text + &line)
}
