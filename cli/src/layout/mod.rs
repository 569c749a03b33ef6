//! `roundel layout`: quads that follow a layout, and the layout that quads have.

mod along;
mod of;
mod page;

use std::path::PathBuf;

use crate::exit::{self, Exit};
use crate::mesh::MeshFlags;
use crate::outputs::OutputFlags;

/// Make quads that follow a layout, or find the layout of quads.
///
/// With a mesh and --layout, the mesh is covered with quads whose irregular vertices are those of the layout, a coarse
/// mesh of polygons near the surface. With --of, the layout of a quad mesh is found: the base complex has all lines from
/// irregular vertices, straight on to the next irregular vertex or the boundary. In the motorcycle graph a line stops
/// where it meets another. The simplified layout has the same irregular vertices and fewer patches, whose arcs may leave
/// the lines of the quads.
#[derive(clap::Args)]
#[command(after_help = exit::HELP)]
pub struct Arguments {
    /// The mesh that quads are made on: a file (.obj, .off, .ply, .stl, .gltf, .glb, also .gz), - for standard input, or
    /// shape:NAME or shape:NAME:TRIANGLES for one of the shapes that `roundel shape --help` lists
    #[arg(
        value_name = "MESH",
        requires = "layout",
        required_unless_present = "of"
    )]
    mesh: Option<PathBuf>,

    /// The quad mesh whose layout is found: a file (.obj, .off, .ply, also .gz), an oriented manifold with or
    /// without boundary
    #[arg(long, value_name = "QUADS", conflicts_with = "mesh")]
    of: Option<PathBuf>,

    #[command(flatten)]
    along: along::AlongFlags,

    #[command(flatten)]
    found: of::OfFlags,

    /// Write the quads, or with --of the layout: nodes as vertices, patches as faces, arcs as lines over further vertices
    #[arg(short, long, value_name = "OUT.obj")]
    out: Option<PathBuf>,

    /// Write a page for a browser with the quads to be turned and zoomed, patches in colours, the number of edges along
    /// each arc, and all figures
    #[arg(long, value_name = "REPORT.html")]
    report: Option<PathBuf>,

    /// Print one JSON object instead of the summary
    #[arg(long)]
    json: bool,

    #[command(flatten)]
    output: OutputFlags,

    #[command(flatten)]
    input: MeshFlags,
}

/// Runs the command and tells its outcome, once.
pub fn run(arguments: &Arguments) -> Exit {
    match &arguments.of {
        Some(quads) => of::run(arguments, quads),
        None => along::run(arguments),
    }
}
