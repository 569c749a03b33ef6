//! The field that a map follows: from a file, or from a solve.

use std::path::Path;
use std::time::Instant;

use roundel::field::{Guidance, OrientationField, solve_field};
use roundel::map::Sizing;
use roundel::mesh::TriangleMesh;
use roundel::mesh::features::FeatureGraph;
use roundel::{Monitor, Options, Result};

use super::Arguments;
use crate::field::named;

/// A field, and how it was found.
pub(super) struct FieldSource {
    pub(super) field: OrientationField,
    /// The strategy that decided it, if it was solved for.
    pub(super) strategy: Option<&'static str>,
    /// Sum of squared angles between matched crosses, as `roundel field` reports it.
    pub(super) energy: f64,
    /// Seconds of the solve, or of reading.
    pub(super) seconds: f64,
}

/// The field of the command line.
pub(super) fn of<'a>(
    arguments: &Arguments,
    mesh: &TriangleMesh,
    (guidance, features, sizing): (&Guidance, &FeatureGraph, &Sizing),
    options: &Options,
    monitor: impl Fn() -> Monitor<'a>,
) -> Result<FieldSource> {
    match &arguments.field {
        Some(path) => read(path, mesh),
        None => solve(
            arguments,
            mesh,
            (guidance, features, sizing),
            options,
            monitor,
        ),
    }
}

fn read(path: &Path, mesh: &TriangleMesh) -> Result<FieldSource> {
    let started = Instant::now();
    let field = OrientationField::read(mesh, path).map_err(|error| named(path, error))?;
    Ok(FieldSource {
        strategy: None,
        energy: field.energy(mesh),
        seconds: started.elapsed().as_secs_f64(),
        field,
    })
}

fn solve<'a>(
    arguments: &Arguments,
    mesh: &TriangleMesh,
    (guidance, features, sizing): (&Guidance, &FeatureGraph, &Sizing),
    options: &Options,
    monitor: impl Fn() -> Monitor<'a>,
) -> Result<FieldSource> {
    let options = Options {
        strategy: arguments.field_strategy,
        ..options.clone()
    };
    let follow = guidance.map_options(mesh, features, sizing.edge_length(mesh))?;
    let started = Instant::now();
    let (field, solution) = solve_field(mesh, &follow, &options, monitor)?;
    Ok(FieldSource {
        field,
        strategy: Some(options.strategy.name()),
        energy: solution.energy(),
        seconds: started.elapsed().as_secs_f64(),
    })
}
