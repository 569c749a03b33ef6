//! `roundel repair`: a mesh that every strict reader accepts, made from a file of any kind.

use std::path::{Path, PathBuf};

use roundel::Result;
use roundel::mesh::{TriangleMesh, io};
use roundel::soup::{Edits, Repaired};
use serde::Serialize;

use crate::exit::{self, Exit};
use crate::mesh::{MeshFlags, RepairCounts};
use crate::output;
use crate::outputs::{Content, Outputs};
use crate::summary::counted;

/// Turn a polygon soup into an oriented manifold triangle mesh, and tell what was done.
///
/// Vertices of equal position are welded, polygons triangulated, duplicates and triangles without area
/// removed, faces turned to one side, and edges and vertices with too many faces cut open. A mesh that
/// needs nothing of this is written as it is.
#[derive(clap::Args)]
#[command(after_help = exit::HELP)]
pub struct Arguments {
    /// The file: .obj, .off, .ply, .stl, .gltf or .glb, also compressed (.gz), or - for standard input
    #[arg(value_name = "IN")]
    pub file: PathBuf,

    /// Write the mesh to this file: .obj, .off, .ply, .stl, .gltf, .glb or .usda
    #[arg(short, long, value_name = "OUT")]
    pub out: Option<PathBuf>,

    /// Write to this file what was done, one entry for each edit, and the input polygon of each triangle
    /// and the input vertex of each vertex
    #[arg(long, value_name = "EDITS.json", conflicts_with = "strict")]
    pub edits: Option<PathBuf>,

    /// Print one JSON object instead of the summary
    #[arg(long)]
    pub json: bool,

    /// Overwrite a file that is read
    #[arg(long, help_heading = "Output")]
    pub force: bool,

    /// Do not say that no file will be written
    #[arg(short, long, help_heading = "Output")]
    pub quiet: bool,

    #[command(flatten)]
    pub input: MeshFlags,
}

/// Runs the command and tells its outcome, once.
pub fn run(arguments: &Arguments) -> Exit {
    let told = repair(arguments).and_then(|(mesh, edits)| tell(arguments, &mesh, &edits));
    output::conclude(&arguments.file, arguments.json, told)
}

fn repair(arguments: &Arguments) -> Result<(TriangleMesh, Edits)> {
    let outputs = Outputs::of(&[Some(&arguments.file)], arguments.force)
        .write(arguments.out.as_ref(), Content::Mesh)?
        .write(arguments.edits.as_ref(), Content::Text)?;
    outputs.tell(arguments.json || arguments.quiet);
    if arguments.input.strict {
        let mesh = arguments.input.read(&arguments.file, true)?.mesh;
        write(arguments, &mesh)?;
        return Ok((mesh, Edits::default()));
    }
    let soup = arguments.input.read_soup(&arguments.file)?;
    let (mesh, repaired) = arguments.input.repaired(&soup)?;
    write(arguments, &mesh)?;
    if let Some(path) = &arguments.edits {
        write_edits(path, &repaired)?;
    }
    Ok((mesh, repaired.edits))
}

fn write(arguments: &Arguments, mesh: &TriangleMesh) -> Result<()> {
    match &arguments.out {
        Some(path) => Ok(io::write(path, mesh)?),
        None => Ok(()),
    }
}

/// The file of `--edits`.
#[derive(Serialize)]
struct EditList<'a> {
    edits: Vec<Entry>,
    triangle_origin: &'a [Option<u32>],
    vertex_origin: &'a [Option<u32>],
}

/// One edit; `docs/soup.md` says what the numbers count.
#[derive(Serialize)]
struct Entry {
    kind: &'static str,
    element: u32,
    other: Option<u32>,
}

fn write_edits(path: &Path, repaired: &Repaired) -> Result<()> {
    let entries = repaired.edits.list().iter().map(|edit| Entry {
        kind: edit.kind.name(),
        element: edit.element,
        other: edit.other,
    });
    let list = EditList {
        edits: entries.collect(),
        triangle_origin: &repaired.triangle_origin,
        vertex_origin: &repaired.vertex_origin,
    };
    output::write_json(path, &list)
}

/// What `--json` prints of a repair.
#[derive(Serialize)]
struct RepairReport {
    file: String,
    faces: usize,
    vertices: usize,
    boundary_loops: usize,
    components: usize,
    euler_characteristic: i64,
    repair: RepairCounts,
}

fn tell(arguments: &Arguments, mesh: &TriangleMesh, edits: &Edits) -> Result<()> {
    let report = RepairReport {
        file: arguments.file.to_string_lossy().into_owned(),
        faces: mesh.face_count(),
        vertices: mesh.vertex_count(),
        boundary_loops: mesh.boundary_loops().len(),
        components: mesh.components().count,
        euler_characteristic: mesh.euler_characteristic(),
        repair: RepairCounts::new(edits),
    };
    if arguments.json {
        return output::print_json(&report);
    }
    let done = match edits.is_empty() {
        true => "nothing to repair".to_owned(),
        false => edits.summary(),
    };
    output::print(&format!(
        "{}: {}, {}, {}, {}\n{done}\n",
        report.file,
        counted(report.faces, "face"),
        counted(report.components, "component"),
        counted(report.boundary_loops, "boundary loop"),
        format_args!("Euler characteristic {}", report.euler_characteristic),
    ))
}
