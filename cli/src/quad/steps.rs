//! The steps of the command: the mesh is read, and the quads are made and written.

use std::time::Instant;

use roundel::mesh::TriangleMesh;
use roundel::quad::{QuadOptions, Quadrangulation, quadrangulate};
use roundel::{Options, Result};

use super::Arguments;
use crate::changes::Changes;
use crate::mesh::{Input, RepairCounts};
use crate::progress::Progress;
use crate::{interrupt, output};

/// Quads, and what they were made from.
pub(super) struct Solved {
    pub(super) mesh: TriangleMesh,
    pub(super) repair: RepairCounts,
    /// On the mesh of field and map.
    pub(super) changes: Changes,
    pub(super) options: QuadOptions,
    pub(super) made: Quadrangulation,
    pub(super) read_seconds: f64,
}

pub(super) fn solve(arguments: &Arguments) -> Result<Solved> {
    output::check_quads_file(arguments.out.as_deref())?;
    let token = interrupt::cancel_token()?;
    let progress = Progress::start();
    let default = QuadOptions::default();
    let map = arguments.solver.over(default.map.clone())?;
    let started = Instant::now();
    let input = arguments.input.read(&arguments.mesh, arguments.json)?;
    arguments.directions.keep_numbers(&input)?;
    let Input {
        mesh,
        repair,
        changes,
    } = input;
    let read_seconds = started.elapsed().as_secs_f64();
    let (mut guidance, features) = arguments.directions.of_map(&mesh)?;
    // Those of the command line's file are among them.
    guidance.feature_edges = features.edges().collect();
    let options = QuadOptions {
        sizing: arguments.sizing.of()?,
        guidance,
        vary_curvature: !arguments.directions.says_curvature(),
        field: Options {
            strategy: arguments.field_strategy,
            ..map.clone()
        },
        map,
        compare: arguments.compare_strategies.clone(),
        ..default
    };
    let options = arguments.flags.over(options)?;
    let monitor = || progress.monitor().cancel_token(token.clone());
    let made = quadrangulate(&mesh, &options, monitor)?;
    if let Some(path) = &arguments.out {
        output::write_quads(&made.quads, path)?;
    }
    let changes = match &made.refined {
        Some(refined) => changes.on_refined(&refined.face_origin),
        None => changes,
    };
    Ok(Solved {
        mesh,
        repair,
        changes,
        options,
        made,
        read_seconds,
    })
}
