//! Quads by one set of options: on the mesh refined, where it is too coarse or too thin, and in another order, where
//! its own is scattered.

use std::cell::Cell;

use super::Quadrangulation;
use super::driver::{Effort, in_order};
use super::options::QuadOptions;
use super::quadrangulation::timed;
use super::refined_input::RefinedInput;
use super::reordered_input::ReorderedInput;
use super::size_metric::SizeMetric;
use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;
use crate::monitor::{Monitor, may_continue};
use crate::smooth::SmoothOptions;

/// The quads by one set of options: [`quadrangulate`](super::quadrangulate()) tells what is tried. The first
/// try spends `work` as the others do, but is made in any case.
///
/// # Errors
/// Those of [`quadrangulate`](super::quadrangulate()).
pub(super) fn by_options<'a>(
    mesh: &TriangleMesh,
    options: &QuadOptions,
    effort: Effort,
    work: &Cell<u64>,
    monitor: &impl Fn() -> Monitor<'a>,
) -> Result<Quadrangulation> {
    options.sizing.check(mesh)?;
    SizeMetric::check(mesh, options)?;
    may_continue()?;
    let features = options.guidance.features(mesh)?;
    may_continue()?;
    let mut seconds = 0.0;
    let input = timed(&mut seconds, || refined(mesh, &features, options))?;
    let Some(input) = input else {
        return of_mesh(mesh, features, options, effort, work, monitor);
    };
    let smooth = match &options.smooth {
        Some(given) => {
            let kept = FeatureGraph::from_edges(mesh, &given.features)?;
            Some(SmoothOptions {
                features: input.refined.parts_of(|edge| kept.contains(edge)),
                ..given.clone()
            })
        }
        None => None,
    };
    let density = match options.density.is_empty() {
        true => Vec::new(),
        false => input.refined.values_at_vertices(mesh, &options.density)?,
    };
    let given = QuadOptions {
        guidance: input.guidance.clone(),
        sizing: input.sizing.clone(),
        smooth,
        density,
        ..options.clone()
    };
    let features = input.features.clone();
    let mut made = of_mesh(&input.refined.mesh, features, &given, effort, work, monitor)?;
    made.seconds.refine = seconds;
    Ok(input.result_for(mesh, made))
}

/// The refined mesh, where the options allow it and the mesh needs it.
fn refined(
    mesh: &TriangleMesh,
    features: &FeatureGraph,
    options: &QuadOptions,
) -> Result<Option<RefinedInput>> {
    if !options.refine {
        return Ok(None);
    }
    let held = match &options.smooth {
        Some(given) => FeatureGraph::from_edges(mesh, &given.features)?,
        None => FeatureGraph::none(mesh),
    };
    let held = held.with(mesh, features)?;
    may_continue()?;
    RefinedInput::new(mesh, &options.guidance, &held, &options.sizing)
}

/// The quads of a mesh that is as fine as it has to be, made in an order in which neighbours are near each other.
fn of_mesh<'a>(
    mesh: &TriangleMesh,
    features: FeatureGraph,
    options: &QuadOptions,
    effort: Effort,
    work: &Cell<u64>,
    monitor: &impl Fn() -> Monitor<'a>,
) -> Result<Quadrangulation> {
    may_continue()?;
    let features = features.with_two_of_each_face(mesh);
    may_continue()?;
    let Some(input) = ReorderedInput::new(mesh, &features, options)? else {
        return in_order(mesh, features, options, effort, work, monitor);
    };
    let there = input.features.clone();
    match in_order(input.mesh(), there, &input.options, effort, work, monitor) {
        Ok(made) => Ok(input.result_for(mesh, made)),
        // The same error of the mesh as it is names an element that the caller knows.
        Err(Error::InvalidArgument { index: Some(_), .. }) => {
            in_order(mesh, features, options, effort, work, monitor)
        }
        Err(error) => Err(error),
    }
}
