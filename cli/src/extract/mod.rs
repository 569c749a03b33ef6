//! `roundel extract`: the quads of a map from any program.

use std::fmt;
use std::path::PathBuf;
use std::time::Instant;

use roundel::Result;
use roundel::extract::{IntegerGridMap, QuadMesh, extract};
use roundel::mesh::attributes::SurfaceAttributes;
use roundel::mesh::{TriangleMesh, io};
use roundel::smooth::{SmoothOptions, smooth};
use serde::Serialize;

use crate::exit::{self, Exit};
use crate::output;
use crate::outputs::{Content, OutputFlags, Outputs};
use crate::progress::Progress;
use crate::quad::{QuadCounts, tell_faults, words};
use crate::summary::{counted, line};

/// Extract the quads of a map that another program made.
///
/// The map must be an integer-grid map: over every seam its coordinates change by a quarter turn and
/// integers, and irregular vertices are at integer points. Folded faces are allowed.
#[derive(clap::Args)]
#[command(after_help = exit::HELP)]
pub struct Arguments {
    /// The mesh with coordinates at every corner: v, vt and f v/vt lines
    #[arg(value_name = "UV.obj")]
    map: PathBuf,

    /// Write the quads to this file: .obj, .off, .ply or .usda; as .stl, .gltf or .glb, which hold no
    /// quads, they are split into triangles
    #[arg(short, long, value_name = "QUADS.obj")]
    out: Option<PathBuf>,

    /// Do not smooth the quads
    #[arg(long)]
    no_smooth: bool,

    /// Print one JSON object instead of the summary
    #[arg(long)]
    json: bool,

    #[command(flatten)]
    output: OutputFlags,
}

/// The share of a run that extraction takes.
const EXTRACT: f64 = 0.6;

/// Runs the command and tells its outcome, once.
pub fn run(arguments: &Arguments) -> Exit {
    let told = solve(arguments).and_then(|solved| match arguments.json {
        true => output::print_json(&Report::new(arguments, &solved)),
        false => {
            output::print(&solved.to_string())?;
            tell_faults(&arguments.map, &solved.quads);
            Ok(())
        }
    });
    output::conclude(&arguments.map, arguments.json, told)
}

struct Solved {
    mesh: TriangleMesh,
    quads: QuadMesh,
    read: f64,
    extract: f64,
    smooth: f64,
}

fn solve(arguments: &Arguments) -> Result<Solved> {
    let read_only = [Some(arguments.map.as_path())];
    let outputs = Outputs::of(&read_only, arguments.output.force)
        .write(arguments.out.as_ref(), Content::Mesh)?;
    outputs.tell(arguments.json || arguments.output.quiet);
    let progress = Progress::start(arguments.output.quiet)?;
    let started = Instant::now();
    let (mesh, uvs) = io::read_textured(&arguments.map)?;
    let read = started.elapsed().as_secs_f64();
    let started = Instant::now();
    progress.next_call(0.0, EXTRACT);
    let exact = IntegerGridMap::new(&mesh, &uvs)?;
    let mut quads = extract(&mesh, &exact, &mut progress.monitor())?;
    let extract = started.elapsed().as_secs_f64();
    let started = Instant::now();
    if !arguments.no_smooth {
        progress.next_call(EXTRACT, 1.0);
        let options = SmoothOptions::default();
        smooth(&mut quads, &mesh, &options, &mut progress.monitor())?;
    }
    let smooth = started.elapsed().as_secs_f64();
    if let Some(path) = &arguments.out {
        output::write_quads(&quads, &SurfaceAttributes::default(), path)?;
    }
    Ok(Solved {
        mesh,
        quads,
        read,
        extract,
        smooth,
    })
}

/// What `--json` prints.
#[derive(Serialize)]
struct Report {
    file: String,
    status: &'static str,
    faces: usize,
    #[serde(flatten)]
    quads: QuadCounts,
    seconds: Seconds,
}

#[derive(Serialize)]
struct Seconds {
    read: f64,
    extract: f64,
    smooth: f64,
}

impl Report {
    fn new(arguments: &Arguments, solved: &Solved) -> Self {
        Report {
            file: arguments.map.to_string_lossy().into_owned(),
            status: "feasible",
            faces: solved.mesh.face_count(),
            quads: QuadCounts::new(&solved.quads),
            seconds: Seconds {
                read: solved.read,
                extract: solved.extract,
                smooth: solved.smooth,
            },
        }
    }
}

impl fmt::Display for Solved {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let faces = counted(self.mesh.face_count(), "face");
        line(f, "read", &faces, self.read)?;
        line(f, "quads", &words(&self.quads), self.extract + self.smooth)
    }
}
