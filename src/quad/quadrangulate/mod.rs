//! From a mesh to quads in one call: field, map, extraction and smoothing.

mod aim;
mod attempt;
mod compare;
mod missed;
mod options;

use std::time::Instant;

use super::untangle::Untangled;
use super::{
    FieldProblem, Guidance, OrientationField, QuadMesh, SeamlessProblem, SmoothOptions, smooth,
    solve_field, strips,
};
use crate::mesh::TriangleMesh;
use crate::{Monitor, Result, Solution, Solver};
use attempt::Trial;
pub use compare::Compared;
use compare::compare;
pub use options::QuadOptions;

/// Which part of a quad's edge details attract no irregular vertices below, where nobody says:
/// extraction copes with folds, and where details have irregular vertices of their own quads are
/// more even.
const DETAIL: f64 = 0.25;

/// Quads, and how they were come by.
#[derive(Debug)]
pub struct Quadrangulation {
    /// The quads, smoothed if that was asked for.
    pub quads: QuadMesh,
    /// The field that they follow.
    pub field: OrientationField,
    /// The solution of the field's problem.
    pub field_solution: Solution,
    /// The map that they were extracted from.
    pub untangled: Untangled,
    /// The solution of the map's problem.
    pub solution: Solution,
    /// Edges of the mesh that edges of quads follow, in increasing order.
    pub features: Vec<usize>,
    /// Those of them that no edge of a quad runs along: collapsed or folded by the map.
    pub missed_features: Vec<usize>,
    /// What other strategies make of both problems, where that was asked for.
    pub compared: Vec<Compared>,
    /// What each step took.
    pub seconds: QuadSeconds,
}

/// Wall-clock seconds a step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct QuadSeconds {
    /// The field's problem and its solution.
    pub field: f64,
    /// The map's problem and its solution.
    pub map: f64,
    /// Extraction, and untangling where it was needed.
    pub extract: f64,
    /// Smoothing.
    pub smooth: f64,
    /// The solves that are compared.
    pub compare: f64,
}

/// Turns a mesh into quads. `monitor` makes one watcher for each step.
///
/// Whether the result is made of nothing but quads it tells itself ([`QuadMesh::is_conforming`]).
/// Features so close that rounding puts them on one line are held apart where the quads conform then.
/// Extraction copes with nearly all folds; untangling is tried only if its quads do not conform, and
/// kept if they do then, or there is less to repair.
///
/// # Errors
/// Those of [`solve_field`], [`SeamlessProblem::with_features`], [`solve`](crate::solve()),
/// [`untangle`](super::untangle::untangle), [`extract`](super::extract) and [`smooth`].
pub fn quadrangulate<'a>(
    mesh: &TriangleMesh,
    options: &QuadOptions,
    monitor: impl Fn() -> Monitor<'a>,
) -> Result<Quadrangulation> {
    let mut seconds = QuadSeconds::default();
    options.sizing.check(mesh)?;
    let features = options.guidance.features(mesh)?;
    let detail = || DETAIL * options.sizing.edge_length(mesh);
    let guidance = Guidance {
        detail: Some(options.guidance.detail.unwrap_or_else(detail)),
        ..options.guidance.clone()
    };
    let wishes = guidance.field_options(mesh, &features)?;
    let (field, field_solution) = timed(&mut seconds.field, || {
        solve_field(mesh, &wishes, &options.field, &monitor)
    })?;
    let (problem, solution, apart) = timed(&mut seconds.map, || {
        let mut problem = SeamlessProblem::with_features(mesh, &field, &options.sizing, &features)?;
        let mut solver = Solver::new(problem.problem())?;
        aim::aim(mesh, &mut problem, &mut solver, &options.sizing, monitor())?;
        let solution = solver.solve_with(&options.map, monitor())?;
        let apart = strips::hold_apart(mesh, &problem, &solution, &options.map, &monitor)?;
        Ok((problem, solution, apart))
    })?;
    let features: Vec<usize> = features.edges().collect();
    let best = timed(&mut seconds.extract, || {
        let trial = Trial {
            mesh,
            features: &features,
            options: &options.map,
            may_untangle: options.untangle,
            monitor: &monitor,
        };
        let Some((held, decided)) = apart else {
            return trial.best(&problem, solution);
        };
        let best = trial.best(&held, decided)?;
        match best.is_whole() {
            true => Ok(best),
            false => Ok(best.or(trial.best(&problem, solution)?)),
        }
    })?;
    let mut quads = best.quads;
    if let Some(given) = &options.smooth {
        timed(&mut seconds.smooth, || {
            let given = SmoothOptions {
                features: [&given.features[..], &features].concat(),
                ..given.clone()
            };
            smooth(&mut quads, mesh, &given, &mut monitor())
        })?;
    }
    let compared = timed(&mut seconds.compare, || {
        if options.compare.is_empty() {
            return Ok(Vec::new());
        }
        let field = FieldProblem::with_options(mesh, &wishes)?;
        let both = [
            (field.problem(), &options.field),
            (problem.problem(), &options.map),
        ];
        compare(both, &options.compare, &monitor)
    })?;
    Ok(Quadrangulation {
        quads,
        field,
        field_solution,
        untangled: best.map,
        solution: best.solution,
        features,
        missed_features: best.missed,
        compared,
        seconds,
    })
}

fn timed<T>(seconds: &mut f64, step: impl FnOnce() -> Result<T>) -> Result<T> {
    let started = Instant::now();
    let result = step();
    *seconds = started.elapsed().as_secs_f64();
    result
}
