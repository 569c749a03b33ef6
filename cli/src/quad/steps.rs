//! The steps of the command: the mesh is read, and the quads are made and written.

use std::time::Instant;

use roundel::mesh::TriangleMesh;
use roundel::mesh::io::format_of;
use roundel::quad::{QuadOptions, Quadrangulation, quadrangulate};
use roundel::transfer::transfer_attributes;
use roundel::{Options, Result};

use super::keep::Kept;
use super::{Arguments, density};
use crate::changes::Changes;
use crate::mesh::{Input, Reading, RepairCounts, Wanted};
use crate::output;
use crate::outputs::{Content, Outputs, PAGE, TRACE, folder_of};
use crate::progress::Progress;

/// Quads, and what they were made from.
pub(super) struct Solved {
    pub(super) mesh: TriangleMesh,
    pub(super) repair: RepairCounts,
    /// On the mesh of field and map.
    pub(super) changes: Changes,
    pub(super) options: QuadOptions,
    pub(super) made: Quadrangulation,
    pub(super) kept: Kept,
    pub(super) read_seconds: f64,
}

pub(super) fn solve(arguments: &Arguments) -> Result<Solved> {
    let started = Instant::now();
    check_outputs(arguments)?;
    let mut progress = Progress::start(arguments.output.quiet)?;
    let default = QuadOptions::default();
    let mut map = arguments.solver.over(default.map.clone())?;
    progress.limit(&mut map, started);
    let keep = arguments.keep.clone().unwrap_or_default();
    let wanted = Wanted {
        features: arguments.directions.attributes(),
        attributes: keep.reading(arguments.out.as_deref())?,
    };
    let input = arguments
        .input
        .read_with(&arguments.mesh, arguments.json, wanted)?;
    arguments.directions.keep_numbers(&input)?;
    input.keeps_numbers("--density", arguments.density.is_some())?;
    input.keeps_numbers("--near-vertex", !arguments.near_vertex.is_empty())?;
    let Input {
        mesh,
        repair,
        changes,
        features: by_attributes,
        mut attributes,
        refused,
    } = input;
    keep.choose(&mut attributes)?;
    let mut not_kept = refused;
    let density = match &arguments.density {
        Some(path) => density::read(path)?,
        None => Vec::new(),
    };
    let read_seconds = started.elapsed().as_secs_f64();
    let (mut guidance, features) = arguments.directions.of_map(&mesh, by_attributes.as_ref())?;
    // Those of the command line's file are among them.
    guidance.feature_edges = features.edges().collect();
    let options = QuadOptions {
        sizing: arguments.sizing.of()?,
        density,
        near_vertices: arguments.near_vertex.clone(),
        guidance,
        vary_curvature: !arguments.directions.says_curvature(),
        field: Options {
            strategy: arguments.field_strategy,
            ..map.clone()
        },
        map,
        mirror: arguments.mirror.clone(),
        compare: arguments.compare_strategies.clone(),
        ..default
    };
    let options = arguments.flags.over(options)?;
    let made = quadrangulate(&mesh, &options, || progress.monitor())?;
    let mut kept = Kept::default();
    if let Some(path) = &arguments.out {
        attributes.keep_what_fits(format_of(path)?);
        attributes.move_libraries(folder_of(&arguments.mesh), folder_of(path));
        let started = Instant::now();
        let monitor = &mut progress.monitor();
        match transfer_attributes(&mesh, &made.quads, &attributes, monitor) {
            Ok(attributes) => kept.attributes = attributes,
            // Quads are worth more than what need not be kept.
            Err(error) if wanted.attributes == Reading::IfSound => not_kept = Some(error),
            Err(error) => return Err(error),
        }
        kept.seconds = started.elapsed().as_secs_f64();
        output::write_quads(&made.quads, &kept.attributes, path)?;
    }
    kept.tell_refused(not_kept, arguments);
    let changes = match made.refined.is_some() || made.mirrored.is_some() {
        true => {
            let faces = 0..made.mesh(&mesh).face_count();
            let given = faces.map(|face| made.face_of_given(face) as u32);
            changes.on_refined(&given.collect::<Vec<_>>())
        }
        false => changes,
    };
    Ok(Solved {
        mesh,
        repair,
        changes,
        options,
        made,
        kept,
        read_seconds,
    })
}

/// Checks all that is to be written.
fn check_outputs(arguments: &Arguments) -> Result<()> {
    let [lines, guide] = arguments.directions.files();
    let lengths = arguments.sizing.edge_lengths.as_deref();
    let density = arguments.density.as_deref();
    let read = [
        Some(arguments.mesh.as_path()),
        lines,
        guide,
        lengths,
        density,
    ];
    let outputs = Outputs::of(&read, arguments.output.force)
        .write(arguments.out.as_ref(), Content::Mesh)?
        .write(arguments.report.as_ref(), PAGE)?
        .write(arguments.tracing.trace.as_ref(), TRACE)?;
    outputs.tell(arguments.json || arguments.output.quiet);
    Ok(())
}
