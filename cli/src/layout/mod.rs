//! `roundel layout`: layouts of quads.

mod of;

use std::path::PathBuf;

use crate::exit::{self, Exit};
use crate::outputs::OutputFlags;

/// Find the layout of a quad mesh: patches, and the arcs between them.
///
/// The base complex has all lines from irregular vertices, straight on to the next irregular vertex or the
/// boundary. In the motorcycle graph a line stops where it meets another. The simplified layout has the same
/// irregular vertices and fewer patches, whose arcs may leave the lines of the quads.
#[derive(clap::Args)]
#[command(after_help = exit::HELP)]
pub struct Arguments {
    /// The quad mesh whose layout is found: a file (.obj, .off, .ply, also .gz), an oriented manifold with or
    /// without boundary
    #[arg(long, value_name = "QUADS")]
    of: PathBuf,

    #[command(flatten)]
    found: of::Flags,

    /// Write the layout: nodes as vertices, patches as faces, arcs as lines over further vertices
    #[arg(short, long, value_name = "LAYOUT.obj")]
    out: Option<PathBuf>,

    /// Print one JSON object instead of the summary
    #[arg(long)]
    json: bool,

    #[command(flatten)]
    output: OutputFlags,
}

/// Runs the command and tells its outcome, once.
pub fn run(arguments: &Arguments) -> Exit {
    of::run(arguments)
}
