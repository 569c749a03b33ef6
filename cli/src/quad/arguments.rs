//! The command line of `roundel quad`.

use std::path::PathBuf;

use roundel::Strategy;
use roundel::mesh::mirror::Mirror;

use super::density::Density;
use super::keep::Keep;
use crate::exit;
use crate::field::Directions;
use crate::mesh::MeshFlags;
use crate::options::{QuadFlags, SolverOptions};
use crate::outputs::OutputFlags;
use crate::parametrize::SizingFlags;
use crate::picture::PictureFlags;
use crate::threads::TraceFlags;

/// Turn a triangle mesh into quads: field, map and extraction in one.
///
/// The solver's options apply to the solve of the map; the time limit is that of the whole run, and the
/// threads are also those of the field's solve. Features become chains of edges, and so does the
/// boundary unless it is free.
#[derive(clap::Args)]
#[command(after_help = exit::HELP)]
pub struct Arguments {
    /// The mesh: a file (.obj, .off, .ply, .stl, .gltf, .glb, also .gz), - for standard input, or
    /// shape:NAME or shape:NAME:TRIANGLES for one of the shapes that `roundel shape --help` lists
    #[arg(value_name = "MESH")]
    pub mesh: PathBuf,

    /// Write the quads to this file: .obj, .off, .ply or .usda; as .stl, .gltf or .glb, which hold no
    /// quads, they are split into triangles
    #[arg(short, long, value_name = "QUADS.obj")]
    pub out: Option<PathBuf>,

    /// Carry these attributes of the file to the quads, separated by commas: materials, groups, colors, uv
    /// (texture coordinates), scalars (all other numbers of PLY vertices); or all, or none. By default all that
    /// can be read
    #[arg(long, value_name = "NAME,...", value_parser = Keep::parse)]
    pub keep: Option<Keep>,

    #[command(flatten)]
    pub sizing: SizingFlags,

    /// How dense quads are at every vertex, as a factor of the number of edges along a length: a file with one number
    /// a vertex; property:NAME, a scalar property of the vertices of the mesh (PLY); or colors, the colours of its
    /// vertices (OBJ, PLY, glTF), where red is 2, white 1 and cyan 1/2
    #[arg(long, value_name = "DENSITY.txt|property:NAME|colors", value_parser = Density::parse)]
    pub density: Option<Density>,

    /// A vertex that sizes change near with --near vertices; may be repeated
    #[arg(long, value_name = "VERTEX")]
    pub near_vertex: Vec<usize>,

    #[command(flatten)]
    pub directions: Directions,

    /// The strategy that decides the integers of the field
    #[arg(long, value_name = "WORD", default_value = "adaptive", value_parser = deciding)]
    pub field_strategy: Strategy,

    /// Make the quads symmetric about a plane, cut the mesh there, and mirror one side: x, y, z (through
    /// the centre of the bounding box; the side of larger coordinates is kept), -x, -y, -z (the other side),
    /// auto (the plane is found), or NX,NY,NZ,D (the points p with N . p = D |N|; N points to the side that is
    /// kept). May be repeated for planes that are perpendicular to each other
    #[arg(long, value_name = "PLANE", value_parser = mirror, allow_hyphen_values = true)]
    pub mirror: Vec<Mirror>,

    #[command(flatten)]
    pub flags: QuadFlags,

    /// Write a page for a browser with all figures and an interactive view of field, map and quads
    #[arg(long, value_name = "REPORT.html")]
    pub report: Option<PathBuf>,

    #[command(flatten)]
    pub picture: PictureFlags,

    /// Measure the largest distance of the quads from the mesh, at 25 points of each, for the summary and JSON
    #[arg(long)]
    pub measure_distance: bool,

    /// Also solve field and map with these strategies, separated by commas, and show their results in
    /// the summary, the page and JSON
    #[arg(long, value_name = "WORD,...", value_delimiter = ',', value_parser = any)]
    pub compare_strategies: Vec<Strategy>,

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

fn mirror(text: &str) -> Result<Mirror, String> {
    text.parse()
        .map_err(|error: roundel::Error| error.to_string())
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
        .ok_or_else(|| format!("expected one of {}", words.join(", ")))
}
