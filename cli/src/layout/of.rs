//! `roundel layout --of`: from quads back to their layout.

use std::fmt;
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::ValueEnum;
use roundel::layout::found::{
    Drift, FoundLayout, QuadSurface, SimplifyOptions, SplinePatches, simplify,
};
use roundel::mesh::MeshError;
use roundel::soup::io as soup;
use roundel::{Monitor, Result};
use serde::Serialize;

use super::Arguments;
use super::page::Found;
use crate::exit::Exit;
use crate::interrupt;
use crate::output;
use crate::outputs::{Content, Outputs, PAGE};
use crate::page::Rows;
use crate::summary::{counted, line};

const OBJ: Content = Content::Only(&["obj"]);
const SPLINES: Content = Content::Only(&["json", "obj", "step", "stp"]);

/// The tolerance of patches if none is given, as a part of the diagonal of the bounding box.
const TOLERANCE: f64 = 1e-3;

/// Flags of a layout that is found.
#[derive(clap::Args)]
pub struct OfFlags {
    /// The layout that is written
    #[arg(long, value_name = "WORD", conflicts_with = "layout", value_enum, default_value_t = Kind::Base)]
    kind: Kind,

    /// The largest drift of the arcs of a simplified layout across the lines of the quads, in edges of quads
    #[arg(long, value_name = "EDGES", conflicts_with = "layout", value_parser = above_zero)]
    deviation: Option<f64>,

    /// The angle between quads, in degrees, from which on an edge stays a line of the quads of a simplified
    /// layout
    #[arg(long, value_name = "DEGREES", conflicts_with = "layout", value_parser = above_zero)]
    features: Option<f64>,

    /// Write the quads with a group for every patch; those of a simplified layout are new ones that follow it
    #[arg(long, value_name = "GROUPS.obj", conflicts_with = "layout")]
    groups: Option<PathBuf>,

    /// Write every patch as a bicubic B-spline surface: .json, .step, or free-form surfaces in .obj
    #[arg(long, value_name = "PATCHES", conflicts_with = "layout")]
    patches: Option<PathBuf>,

    /// The largest distance of these surfaces from the vertices of the quads [default: a thousandth of the
    /// diagonal of the bounding box]
    #[arg(long, value_name = "DISTANCE", requires = "patches", value_parser = above_zero)]
    tolerance: Option<f64>,
}

/// The kinds of layouts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    /// All lines from irregular vertices, which cross each other
    Base,
    /// Lines that stop where they meet another
    Motorcycle,
    /// The same irregular vertices, and fewer patches
    Simplified,
}

fn above_zero(text: &str) -> std::result::Result<f64, String> {
    match text.parse() {
        Ok(number) if number > 0.0 => Ok(number),
        _ => Err("expected a number above zero".into()),
    }
}

/// Runs the command and tells its outcome, once.
pub fn run(arguments: &Arguments, quads: &Path) -> Exit {
    let told = find(arguments, quads).and_then(|report| match arguments.json {
        true => output::print_json(&report),
        false => output::print(&report.to_string()),
    });
    output::conclude(quads, arguments.json, told)
}

/// What `--json` prints.
#[derive(Serialize)]
struct Report {
    file: String,
    quads: usize,
    vertices: usize,
    irregular: usize,
    euler_characteristic: i64,
    kind: Kind,
    base: Counts,
    motorcycle: Counts,
    simplified: Option<Counts>,
    written: Option<Counts>,
    subdivisions: Vec<usize>,
    deviation: f64,
    mean_angle: f64,
    surfaces: Option<Surfaces>,
    seconds: Seconds,
}

#[derive(Serialize)]
struct Counts {
    nodes: usize,
    arcs: usize,
    patches: usize,
}

#[derive(Serialize)]
struct Surfaces {
    control_points: usize,
    tolerance: f64,
    deviation: f64,
    is_within: bool,
}

#[derive(Serialize)]
struct Seconds {
    read: f64,
    layouts: f64,
    simplify: f64,
    surfaces: f64,
}

impl Counts {
    fn new(layout: &FoundLayout) -> Self {
        Counts {
            nodes: layout.nodes.len(),
            arcs: layout.arcs.len(),
            patches: layout.patches.len(),
        }
    }
}

fn find(arguments: &Arguments, quads: &Path) -> Result<Report> {
    let flags = &arguments.found;
    let outputs = Outputs::of(&[Some(quads)], arguments.output.force)
        .write(arguments.out.as_ref(), OBJ)?
        .write(flags.groups.as_ref(), OBJ)?
        .write(flags.patches.as_ref(), SPLINES)?
        .write(arguments.report.as_ref(), PAGE)?;
    outputs.tell(arguments.json || arguments.output.quiet);
    let started = Instant::now();
    let soup = soup::read(quads).map_err(MeshError::from)?;
    let given = QuadSurface::from_soup(&soup)?;
    let read = started.elapsed().as_secs_f64();
    let started = Instant::now();
    let base = FoundLayout::base_complex(&given);
    let motorcycle = FoundLayout::motorcycle_graph(&given);
    let counts = [&base, &motorcycle].map(Counts::new);
    let layouts = started.elapsed().as_secs_f64();
    let started = Instant::now();
    let irregular = (0..given.positions().len()).filter(|&v| given.is_irregular(v));
    let irregular = irregular.count();
    let sizes = (
        given.quads().len(),
        given.positions().len(),
        given.euler_characteristic(),
    );
    let (new, layout, drift) = match flags.kind {
        Kind::Base => (None, base, Drift::default()),
        Kind::Motorcycle => (None, motorcycle, Drift::default()),
        Kind::Simplified => {
            let options = SimplifyOptions {
                deviation: flags.deviation.unwrap_or(f64::INFINITY),
                features: flags.features.map_or(f64::INFINITY, f64::to_radians),
                ..SimplifyOptions::default()
            };
            let token = interrupt::cancel_token()?;
            let found = simplify(&given, &options, || {
                Monitor::default().cancel_token(token.clone())
            })?;
            (Some(found.surface), found.layout, found.drift)
        }
    };
    let surface = new.as_ref().unwrap_or(&given);
    let simplify = started.elapsed().as_secs_f64();
    let started = Instant::now();
    let mut written = None;
    if let Some(path) = &arguments.out {
        let simple = match flags.kind {
            Kind::Motorcycle => layout.clone(),
            Kind::Base | Kind::Simplified => FoundLayout::simple_complex(surface),
        };
        simple.write_obj(surface, path)?;
        written = Some(Counts::new(&simple));
    }
    if let Some(path) = &flags.groups {
        layout.write_groups(surface, path)?;
    }
    let surfaces = write_surfaces(flags, surface, &layout)?;
    let [base, motorcycle] = counts;
    let report = Report {
        file: quads.to_string_lossy().into_owned(),
        quads: sizes.0,
        vertices: sizes.1,
        irregular,
        euler_characteristic: sizes.2,
        kind: flags.kind,
        base,
        motorcycle,
        simplified: (flags.kind == Kind::Simplified).then(|| Counts::new(&layout)),
        written,
        subdivisions: layout
            .arcs
            .iter()
            .map(|arc| arc.vertices.len() - 1)
            .collect(),
        deviation: drift.largest,
        mean_angle: drift.mean_angle,
        surfaces,
        seconds: Seconds {
            read,
            layouts,
            simplify,
            surfaces: started.elapsed().as_secs_f64(),
        },
    };
    if let Some(path) = &arguments.report {
        let page = Found {
            name: quads,
            given: &given,
            surface,
            layout: &layout,
            rows: report.rows(),
            seconds: &report.seconds.steps(),
        };
        page.write(path)?;
    }
    Ok(report)
}

fn write_surfaces(
    flags: &OfFlags,
    surface: &QuadSurface,
    layout: &FoundLayout,
) -> Result<Option<Surfaces>> {
    let Some(path) = &flags.patches else {
        return Ok(None);
    };
    let tolerance = flags
        .tolerance
        .unwrap_or_else(|| TOLERANCE * diagonal(surface));
    let fitted = SplinePatches::fit(surface, layout, tolerance)?;
    let extension = path.extension().map(|e| e.to_ascii_lowercase());
    match extension.as_ref().and_then(|e| e.to_str()) {
        Some("json") => fitted.write_json(path)?,
        Some("obj") => fitted.write_obj(path)?,
        _ => fitted.write_step(path)?,
    }
    Ok(Some(Surfaces {
        control_points: fitted.points.len(),
        tolerance,
        deviation: fitted.deviation,
        is_within: fitted.is_within,
    }))
}

/// The diagonal of the bounding box.
fn diagonal(surface: &QuadSurface) -> f64 {
    let extent = |axis: usize| {
        let along = surface.positions().iter().map(|p| p[axis]);
        along.clone().fold(f64::MIN, f64::max) - along.fold(f64::MAX, f64::min)
    };
    (0..3).map(|axis| extent(axis).powi(2)).sum::<f64>().sqrt()
}

impl Seconds {
    fn steps(&self) -> [(&'static str, f64); 4] {
        [
            ("read", self.read),
            ("layouts", self.layouts),
            ("simplify", self.simplify),
            ("surfaces", self.surfaces),
        ]
    }
}

impl Report {
    /// What a page tells of the layouts.
    fn rows(&self) -> Rows {
        let mut rows = vec![
            ("base complex", self.base.to_string()),
            ("motorcycle graph", self.motorcycle.to_string()),
        ];
        if let Some(simplified) = &self.simplified {
            rows.push(("simplified", simplified.to_string()));
            rows.push(("drift of arcs", self.drift_words()));
        }
        if let Some(surfaces) = &self.surfaces {
            rows.push(("surfaces", surfaces.to_string()));
        }
        rows
    }

    fn drift_words(&self) -> String {
        let [drift, angle] = [self.deviation, self.mean_angle];
        format!("{drift:.2} quads at most, {angle:.1} degrees on average")
    }
}

impl fmt::Display for Surfaces {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let points = counted(self.control_points, "control point");
        write!(f, "{points}, at most {:.3e} off", self.deviation)
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let quads = format!(
            "{}, {} irregular",
            counted(self.quads, "quad"),
            self.irregular
        );
        line(f, "read", &quads, self.seconds.read)?;
        line(f, "base", &self.base.to_string(), self.seconds.layouts)?;
        writeln!(f, "{:<10} {}", "motorcycle", self.motorcycle)?;
        if let Some(simplified) = &self.simplified {
            line(
                f,
                "simplified",
                &simplified.to_string(),
                self.seconds.simplify,
            )?;
            writeln!(f, "{:<10} {}", "drift", self.drift_words())?;
        }
        if let Some(written) = &self.written {
            writeln!(f, "{:<10} {written}", "written")?;
        }
        if let Some(surfaces) = &self.surfaces {
            line(f, "surfaces", &surfaces.to_string(), self.seconds.surfaces)?;
        }
        Ok(())
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let [nodes, arcs] = [counted(self.nodes, "node"), counted(self.arcs, "arc")];
        let plural = if self.patches == 1 { "" } else { "es" };
        write!(f, "{nodes}, {arcs}, {} patch{plural}", self.patches)
    }
}
