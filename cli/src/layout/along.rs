//! `roundel layout MESH --layout`: quads that follow a layout.

use std::fmt;
use std::path::PathBuf;
use std::time::Instant;

use roundel::layout::{
    BaseLayout, DrawnLayout, LayoutOptions, LayoutQuads, LayoutSizing, layout_quads, read_layout,
};
use roundel::mesh::TriangleMesh;
use roundel::mesh::attributes::SurfaceAttributes;
use roundel::mesh::io::{self, Drawing};
use roundel::smooth::SmoothOptions;
use roundel::{Error, Result};
use serde::Serialize;

use super::Arguments;
use super::page::Followed;
use crate::exit::Exit;
use crate::mesh::{Input, RepairCounts};
use crate::output;
use crate::outputs::{Content, Outputs, PAGE};
use crate::progress::Progress;
use crate::quad::{QuadCounts, tell_faults, words};
use crate::summary::{counted, line};

/// Flags of quads that follow a layout.
#[derive(clap::Args)]
pub struct AlongFlags {
    /// The layout that quads follow: an OBJ file of polygons, its lines the courses of arcs
    #[arg(
        long,
        value_name = "LAYOUT.obj",
        requires = "mesh",
        conflicts_with = "of"
    )]
    pub layout: Option<PathBuf>,

    /// About this many quads
    #[arg(long, value_name = "N", default_value_t = 1000, conflicts_with = "of")]
    #[arg(value_parser = clap::value_parser!(u32).range(1..))]
    quads: u32,

    /// Edges of about this length, in units of the mesh, instead of a number of quads
    #[arg(long, value_name = "LENGTH", conflicts_with_all = ["quads", "fewest", "of"])]
    edge_length: Option<f64>,

    /// As few quads as the layout allows
    #[arg(long, conflicts_with_all = ["quads", "of"])]
    fewest: bool,

    /// Fix the number of edges of quads between two vertices of the layout, counted from 1 as in its file; may be
    /// repeated
    #[arg(long, value_name = "A-B=N", conflicts_with = "of", value_parser = fix)]
    fix: Vec<[usize; 3]>,

    /// Cut arcs whose course the file gives into the mesh, and keep them there; else they only go about that way
    #[arg(long, conflicts_with = "of")]
    hold_arcs: bool,

    /// Keep vertices of the layout with four patches where they are, too; else they slide as arcs do
    #[arg(long, conflicts_with = "of")]
    hold_vertices: bool,

    /// Do not smooth the quads
    #[arg(long, conflicts_with = "of")]
    no_smooth: bool,

    /// Write the mesh with the faces of each patch in a colour of their own: .ply or .off
    #[arg(long, value_name = "PATCHES.ply", conflicts_with = "of")]
    colors: Option<PathBuf>,

    /// The largest number of threads; 0: one for each core
    #[arg(long, value_name = "N", conflicts_with = "of", default_value_t = 0)]
    threads: usize,
}

fn fix(text: &str) -> std::result::Result<[usize; 3], String> {
    let parts = text.split_once('=').and_then(|(ends, edges)| {
        let (a, b) = ends.split_once('-')?;
        let numbers = [a, b, edges].map(|word| word.parse().ok().filter(|&n: &usize| n > 0));
        Some([numbers[0]?, numbers[1]?, numbers[2]?])
    });
    parts.ok_or_else(|| "expected two vertices and a number of edges, such as 3-7=12".into())
}

/// Runs the command and tells its outcome, once.
pub fn run(arguments: &Arguments) -> Exit {
    let file = arguments.mesh.clone().unwrap_or_default();
    let told = solve(arguments).and_then(|solved| match arguments.json {
        true => output::print_json(&Report::new(arguments, &solved)),
        false => {
            output::print(&solved.to_string())?;
            tell_faults(&file, &solved.found.quads);
            Ok(())
        }
    });
    output::conclude(&file, arguments.json, told)
}

struct Solved {
    mesh: TriangleMesh,
    repair: RepairCounts,
    found: LayoutQuads,
    read: f64,
    seconds: f64,
}

fn solve(arguments: &Arguments) -> Result<Solved> {
    let flags = &arguments.along;
    let (Some(mesh_file), Some(layout_file)) = (&arguments.mesh, &flags.layout) else {
        return Err(Error::InvalidArgument {
            what: "a mesh and --layout, or --of, are needed".into(),
            index: None,
        });
    };
    let read_only = [Some(mesh_file.as_path()), Some(layout_file.as_path())];
    let outputs = Outputs::of(&read_only, arguments.output.force)
        .write(arguments.out.as_ref(), Content::Mesh)?
        .write(flags.colors.as_ref(), Content::Only(&["ply", "off"]))?
        .write(arguments.report.as_ref(), PAGE)?;
    outputs.tell(arguments.json || arguments.output.quiet);
    let progress = Progress::start(arguments.output.quiet)?;
    let started = Instant::now();
    let Input {
        mesh,
        repair,
        changes,
        ..
    } = arguments.input.read(mesh_file, arguments.json)?;
    let DrawnLayout { layout, curves } = read_layout(layout_file)?;
    let read = started.elapsed().as_secs_f64();
    let options = LayoutOptions {
        sizing: match flags.edge_length {
            Some(length) => LayoutSizing::EdgeLength(length),
            None if flags.fewest => LayoutSizing::Fewest,
            None => LayoutSizing::Quads(flags.quads as usize),
        },
        fixed: fixed(&layout, &flags.fix)?,
        curves,
        hold_curves: flags.hold_arcs,
        hold_regular: flags.hold_vertices,
        smooth: (!flags.no_smooth).then(SmoothOptions::default),
        threads: flags.threads,
    };
    let started = Instant::now();
    progress.next_call(0.0, 1.0);
    let found = layout_quads(&mesh, &layout, &options, || progress.monitor())?;
    let seconds = started.elapsed().as_secs_f64();
    if let Some(path) = &arguments.out {
        output::write_quads(&found.quads, &SurfaceAttributes::default(), path)?;
    }
    if let Some(path) = &flags.colors {
        let colors: Vec<[u8; 3]> = found.patches.iter().map(|&patch| color(patch)).collect();
        let drawing = Drawing {
            triangle_colors: Some(&colors),
            ..Drawing::from(&mesh)
        };
        io::write(path, drawing)?;
    }
    if let Some(path) = &arguments.report {
        let page = Followed {
            name: mesh_file,
            mesh: &mesh,
            changes: &changes,
            found: &found,
            seconds: &[("read", read), ("quads", seconds)],
        };
        page.write(path)?;
    }
    Ok(Solved {
        mesh,
        repair,
        found,
        read,
        seconds,
    })
}

/// The arcs whose number of edges is fixed.
fn fixed(layout: &BaseLayout, asked: &[[usize; 3]]) -> Result<Vec<(usize, u32)>> {
    let arc = |&[a, b, edges]: &[usize; 3]| {
        let arc = layout.arc_between(a - 1, b - 1);
        let arc = arc.ok_or_else(|| Error::InvalidArgument {
            what: format!("--fix {a}-{b}: no edge of the layout joins vertices {a} and {b}"),
            index: Some(a - 1),
        })?;
        Ok((arc, u32::try_from(edges).unwrap_or(u32::MAX)))
    };
    asked.iter().map(arc).collect()
}

/// A colour for a patch: hues a golden section of the circle apart.
fn color(patch: u32) -> [u8; 3] {
    let hue = (f64::from(patch) * 0.618_033_988_749_895).fract() * 6.0;
    let of = |offset: f64| {
        let along = (hue + offset) % 6.0;
        let share = (2.0 - (along - 3.0).abs()).clamp(0.0, 1.0);
        (90.0 + 150.0 * share).round() as u8
    };
    [of(3.0), of(1.0), of(5.0)]
}

/// What `--json` prints.
#[derive(Serialize)]
struct Report<'a> {
    file: String,
    layout: String,
    repair: RepairCounts,
    faces: usize,
    patches: usize,
    arcs: Vec<Arc>,
    spokes: &'a [Vec<u32>],
    edge_length: f64,
    energy: f64,
    lower_bound: f64,
    optimal: bool,
    folded: usize,
    as_prescribed: bool,
    #[serde(flatten)]
    quads: QuadCounts,
    seconds: Seconds,
}

/// An arc: its vertices, counted from 1 as in the file, its length and the number of edges.
#[derive(Serialize)]
struct Arc {
    ends: [u32; 2],
    length: f64,
    edges: u32,
}

#[derive(Serialize)]
struct Seconds {
    read: f64,
    quads: f64,
}

impl<'a> Report<'a> {
    fn new(arguments: &Arguments, solved: &'a Solved) -> Self {
        let name = |file: &Option<PathBuf>| {
            let file = file
                .as_ref()
                .map(|file| file.to_string_lossy().into_owned());
            file.unwrap_or_default()
        };
        let found = &solved.found;
        let layout = &found.layout;
        let arcs = layout.arcs().iter().enumerate().map(|(arc, ends)| Arc {
            ends: ends.map(|v| v + 1),
            length: found.lengths[arc],
            edges: found.subdivisions.arcs[arc],
        });
        Report {
            file: name(&arguments.mesh),
            layout: name(&arguments.along.layout),
            repair: solved.repair.clone(),
            faces: solved.mesh.face_count(),
            patches: layout.polygons().len(),
            arcs: arcs.collect(),
            spokes: &found.subdivisions.spokes,
            edge_length: found.subdivisions.edge_length,
            energy: found.subdivisions.energy,
            lower_bound: found.subdivisions.lower_bound,
            optimal: found.subdivisions.is_optimal,
            folded: found.folded,
            as_prescribed: found.is_as_prescribed,
            quads: QuadCounts::new(&found.quads),
            seconds: Seconds {
                read: solved.read,
                quads: solved.seconds,
            },
        }
    }
}

impl fmt::Display for Solved {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let found = &self.found;
        let faces = counted(self.mesh.face_count(), "face");
        line(f, "read", &faces, self.read)?;
        let numbers = &found.subdivisions.arcs;
        let [least, most] = [numbers.iter().min(), numbers.iter().max()].map(|n| n.unwrap_or(&0));
        let proof = if found.subdivisions.is_optimal {
            "optimal"
        } else {
            "not proved"
        };
        let arcs = counted(numbers.len(), "arc");
        writeln!(
            f,
            "{:<10} {arcs} of {least} to {most} edges, {proof}",
            "layout"
        )?;
        line(f, "quads", &words(&found.quads), self.seconds)?;
        if !found.is_as_prescribed {
            writeln!(
                f,
                "{:<10} irregular vertices differ from those of the layout",
                ""
            )?;
        }
        Ok(())
    }
}
