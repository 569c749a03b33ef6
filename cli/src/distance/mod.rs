//! `roundel distance`: exact distances along a mesh, with figures, a file and a picture.

mod arguments;
mod bands;

use std::time::Instant;

use roundel::geodesic::{
    GeodesicDistance, GeodesicOptions, Source, draw_polyline, geodesic_distance,
};
use roundel::mesh::features::FeatureGraph;
use roundel::mesh::io::{self, Drawing};
use roundel::mesh::{MeshError, TriangleMesh};
use roundel::soup::io::read_polylines;
use roundel::{Error, Monitor, Result};
use roundel_pictures::draw_bands;
use serde::Serialize;

use crate::exit::Exit;
use crate::interrupt;
use crate::mesh::{Input, RepairCounts};
use crate::output;
use crate::outputs::{Content, Outputs, PICTURE};
use crate::summary::{counted, counted_vertices};
pub use arguments::Arguments;
use arguments::From;

/// What `--json` prints of distances.
#[derive(Serialize)]
struct Report {
    file: String,
    repair: RepairCounts,
    faces: usize,
    vertices: usize,
    sources: usize,
    reached: usize,
    largest_distance: f64,
    farthest_vertex: usize,
    seconds: Seconds,
    peak_memory_bytes: Option<u64>,
}

#[derive(Serialize)]
struct Seconds {
    read: f64,
    distance: f64,
    write: f64,
}

/// Runs the command and tells its outcome, once.
pub fn run(arguments: &Arguments) -> Exit {
    let told = measure(arguments).and_then(|report| tell(arguments, &report));
    output::conclude(&arguments.mesh, arguments.json, told)
}

fn measure(arguments: &Arguments) -> Result<Report> {
    let mut read = vec![Some(arguments.mesh.as_path())];
    read.extend(arguments.from.iter().map(From::file));
    let outputs = Outputs::of(&read, arguments.output.force)
        .write(arguments.out.as_ref(), Content::Mesh)?
        .write(arguments.picture.file.as_ref(), PICTURE)?;
    outputs.tell(arguments.json || arguments.output.quiet);
    let started = Instant::now();
    let input = arguments.input.read(&arguments.mesh, arguments.json)?;
    let numbers = arguments.from.iter().any(|f| matches!(f, From::Vertex(_)));
    input.keeps_numbers("--from vertex:N", numbers)?;
    let Input { mesh, repair, .. } = input;
    let read = started.elapsed().as_secs_f64();
    let started = Instant::now();
    let monitor = Monitor::default().cancel_token(interrupt::cancel_token()?);
    let sources = sources(arguments, &mesh, &monitor)?;
    let options = GeodesicOptions {
        limit: arguments.limit.unwrap_or(f64::INFINITY),
        ..GeodesicOptions::default()
    };
    let found = geodesic_distance(&mesh, &sources, &options, &monitor)?;
    let distance = started.elapsed().as_secs_f64();
    let started = Instant::now();
    write(arguments, &mesh, &found)?;
    let (farthest_vertex, largest_distance) = found.farthest();
    Ok(Report {
        file: arguments.mesh.to_string_lossy().into_owned(),
        repair,
        faces: mesh.face_count(),
        vertices: mesh.vertex_count(),
        sources: sources.len(),
        reached: found.vertices().iter().filter(|d| d.is_finite()).count(),
        largest_distance,
        farthest_vertex,
        seconds: Seconds {
            read,
            distance,
            write: started.elapsed().as_secs_f64(),
        },
        peak_memory_bytes: roundel::peak_memory(),
    })
}

/// The sources of the command line, in its order.
fn sources(
    arguments: &Arguments,
    mesh: &TriangleMesh,
    monitor: &Monitor<'_>,
) -> Result<Vec<Source>> {
    let mut sources = Vec::new();
    for from in &arguments.from {
        let (name, found) = match from {
            From::Vertex(v) => ("", vec![Source::Vertex(*v)]),
            From::Boundary => ("boundary", Source::boundary(mesh)),
            From::Features => {
                let graph = FeatureGraph::by_angle(mesh, arguments.features.to_radians())?;
                ("features", Source::features(&graph))
            }
            From::File(path) => {
                let drawn = read_polylines(path).map_err(MeshError::from)?.into_iter();
                let drawn = drawn.map(|line| draw_polyline(mesh, &line, false, monitor));
                ("FILE", drawn.collect::<Result<_>>()?)
            }
        };
        if found.is_empty() {
            return Err(Error::InvalidArgument {
                what: format!("--from {name}: there are none"),
                index: None,
            });
        }
        sources.extend(found);
    }
    Ok(sources)
}

fn write(arguments: &Arguments, mesh: &TriangleMesh, found: &GeodesicDistance) -> Result<()> {
    if let Some(path) = &arguments.out {
        let colors: Vec<[u8; 3]> = found
            .vertices()
            .iter()
            .map(|&d| bands::color(found, d))
            .collect();
        let drawing = Drawing {
            vertex_colors: Some(&colors),
            vertex_quality: Some(found.vertices()),
            ..Drawing::from(mesh)
        };
        io::write(path, drawing)?;
    }
    if let Some(path) = &arguments.picture.file {
        let view = arguments.picture.view();
        let color = |d: f64| bands::color(found, d);
        draw_bands(mesh, found.vertices(), bands::width(found), color, &view)?.write_png(path)?;
    }
    Ok(())
}

fn tell(arguments: &Arguments, report: &Report) -> Result<()> {
    if arguments.json {
        return output::print_json(report);
    }
    output::print(&format!(
        "{}: {}, {}, {}\nlargest distance {} at vertex {}, {} reached, {:.3} s\n",
        report.file,
        counted(report.faces, "face"),
        counted_vertices(report.vertices, ""),
        counted(report.sources, "source"),
        report.largest_distance,
        report.farthest_vertex,
        counted_vertices(report.reached, ""),
        report.seconds.distance,
    ))
}
