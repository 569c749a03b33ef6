//! The steps of the command: the mesh is read, and the quads are made and written.

use std::time::Instant;

use roundel::mesh::TriangleMesh;
use roundel::mesh::io::format_of;
use roundel::quad::{QuadOptions, Quadrangulation, quadrangulate};
use roundel::transfer::transfer_attributes;
use roundel::{Options, Result};
use roundel_pictures::draw_quads;

use super::Arguments;
use super::density::Density;
use super::keep::Kept;
use crate::changes::Changes;
use crate::field::{CurveCounts, Followed, too_short};
use crate::mesh::{Input, Reading, RepairCounts, Wanted};
use crate::output;
use crate::outputs::{Content, Outputs, PAGE, PICTURE, TRACE, folder_of};
use crate::page::distances;
use crate::progress::Progress;

/// Quads, and what they were made from.
pub(super) struct Solved {
    pub(super) mesh: TriangleMesh,
    pub(super) repair: RepairCounts,
    /// On the mesh of field and map.
    pub(super) changes: Changes,
    pub(super) curves: Option<CurveCounts>,
    pub(super) options: QuadOptions,
    pub(super) made: Quadrangulation,
    pub(super) kept: Kept,
    /// How many sharp edges are too short to be features.
    pub(super) too_short: usize,
    /// The largest distance of the quads from the mesh, if that was asked for.
    pub(super) distance: Option<f64>,
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
    let density = arguments.density.as_ref();
    let for_quads = keep.reading(arguments.out.as_deref())?;
    let wanted = Wanted {
        features: arguments.directions.attributes(),
        attributes: match density {
            Some(density) if density.file().is_none() => Reading::Yes,
            _ => for_quads,
        },
    };
    let input = arguments
        .input
        .read_with(&arguments.mesh, arguments.json, wanted)?;
    arguments.directions.keep_numbers(&input)?;
    let of_file = density.and_then(Density::file);
    input.keeps_numbers("--density FILE", of_file.is_some())?;
    input.keeps_numbers("--near-vertex", !arguments.near_vertex.is_empty())?;
    let Input {
        mesh,
        repair,
        changes,
        features: by_attributes,
        mut attributes,
        refused,
    } = input;
    let density = match density {
        Some(density) => density.of(&attributes)?,
        None => Vec::new(),
    };
    keep.choose(&mut attributes)?;
    let mut not_kept = refused;
    let read_seconds = started.elapsed().as_secs_f64();
    let sizing = arguments.sizing.of()?;
    let edge_length = Some(sizing.edge_length(&mesh));
    let given = (arguments.directions).of_map(&mesh, by_attributes.as_ref(), edge_length)?;
    let mut of_sharp = given.0.clone();
    let curves = &arguments.directions.curves;
    let Followed {
        cut,
        guidance,
        sizing,
        counts: curves,
        ..
    } = curves.follow(&mesh, given, sizing)?;
    let (mesh, uncut, density, changes) = match cut {
        Some(cut) => {
            let density = match density.is_empty() {
                true => density,
                false => cut.values_at_vertices(&mesh, &density)?,
            };
            let changes = changes.on_refined(&cut.face_origin);
            (cut.mesh, Some(mesh), density, changes)
        }
        None => (mesh, None, density, changes),
    };
    let options = QuadOptions {
        sizing,
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
    of_sharp.feature_length = made.feature_length;
    let too_short = too_short(uncut.as_ref().unwrap_or(&mesh), &of_sharp)?;
    let mut kept = Kept::default();
    if let Some(path) = &arguments.out {
        attributes.keep_what_fits(format_of(path)?);
        attributes.move_libraries(folder_of(&arguments.mesh), folder_of(path));
        let started = Instant::now();
        let monitor = &mut progress.monitor();
        let given = uncut.as_ref().unwrap_or(&mesh);
        match transfer_attributes(given, &made.quads, &attributes, monitor) {
            Ok(attributes) => kept.attributes = attributes,
            // Quads are worth more than what need not be kept.
            Err(error) if for_quads == Reading::IfSound => not_kept = Some(error),
            Err(error) => return Err(error),
        }
        kept.seconds = started.elapsed().as_secs_f64();
        output::write_quads(&made.quads, &kept.attributes, path)?;
    }
    kept.tell_refused(not_kept, arguments);
    if let Some(path) = &arguments.picture.file {
        draw_quads(&made.quads, &arguments.picture.view())?.write_png(path)?;
    }
    let distance = arguments.measure_distance.then(|| {
        let all = distances(&made.quads, &mesh);
        f64::from(all.into_iter().fold(0.0, f32::max))
    });
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
        curves,
        options,
        made,
        kept,
        too_short,
        distance,
        read_seconds,
    })
}

/// Checks all that is to be written.
fn check_outputs(arguments: &Arguments) -> Result<()> {
    let lengths = arguments.sizing.edge_lengths.as_deref();
    let density = arguments.density.as_ref().and_then(Density::file);
    let mut read = vec![Some(arguments.mesh.as_path()), lengths, density];
    read.extend(arguments.directions.files());
    let outputs = Outputs::of(&read, arguments.output.force)
        .write(arguments.out.as_ref(), Content::Mesh)?
        .write(arguments.report.as_ref(), PAGE)?
        .write(arguments.picture.file.as_ref(), PICTURE)?
        .write(arguments.tracing.trace.as_ref(), TRACE)?;
    outputs.tell(arguments.json || arguments.output.quiet);
    Ok(())
}
