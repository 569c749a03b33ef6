//! From a mesh to quads in one call: field, map, extraction and smoothing.

use std::time::Instant;

use super::attempt::{Attempt, Trial, is_hopeless};
use super::compare::Compared;
use super::compare::compare;
use super::fields::{Decided, decide};
use super::missed::missed;
use super::options::QuadOptions;
use crate::extract::QuadMesh;
use crate::field::{FieldProblem, Guidance, OrientationField};
use crate::map::hold_apart;
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;
use crate::smooth::{SmoothOptions, smooth};
use crate::untangle::Untangled;
use crate::{Monitor, Result, Solution};

/// Which part of a quad's edge details attract no irregular vertices below, where nobody says:
/// extraction copes with folds, and where details have irregular vertices of their own quads are
/// more even.
const DETAIL: f64 = 0.25;

/// What is tried next where quads do not conform: fewer irregular vertices leave less to fold.
const COARSER: [f64; 2] = [1.0, 2.0];

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
/// kept if they do then, or there is less to repair. Where they still do not, and nobody says how
/// large details are, the field is decided anew for larger ones.
///
/// # Errors
/// Those of [`solve_field`](crate::field::solve_field), [`solve`](crate::solve()),
/// [`SeamlessProblem::with_features`](crate::map::SeamlessProblem::with_features),
/// [`untangle`](crate::untangle::untangle), [`extract`](crate::extract) and [`smooth`].
pub fn quadrangulate<'a>(
    mesh: &TriangleMesh,
    options: &QuadOptions,
    monitor: impl Fn() -> Monitor<'a>,
) -> Result<Quadrangulation> {
    let mut seconds = QuadSeconds::default();
    options.sizing.check(mesh)?;
    let features = options.guidance.features(mesh)?;
    let edge = options.sizing.edge_length(mesh);
    let at = |detail: f64| QuadOptions {
        guidance: Guidance {
            detail: options.guidance.detail.or(Some(detail * edge)),
            ..options.guidance.clone()
        },
        ..options.clone()
    };
    let mut best = go(mesh, &at(DETAIL), &features, &monitor, &mut seconds)?;
    for coarser in COARSER {
        let is_hopeless = is_hopeless(mesh, &best.attempt.map.map);
        if best.attempt.conforms || options.guidance.detail.is_some() || is_hopeless {
            break;
        }
        let next = go(mesh, &at(coarser), &features, &monitor, &mut seconds)?;
        if next.attempt.is_better_than(&best.attempt) {
            best = next;
        }
    }
    let Made { decided, attempt } = best;
    let features: Vec<usize> = features.edges().collect();
    let (mut quads, mut missed_features) = (attempt.quads, attempt.missed);
    if let Some(given) = &options.smooth {
        timed(&mut seconds.smooth, || {
            let given = SmoothOptions {
                features: [&given.features[..], &features].concat(),
                ..given.clone()
            };
            smooth(&mut quads, mesh, &given, &mut monitor())?;
            missed_features = missed(mesh, &quads, &missed_features);
            Ok(())
        })?;
    }
    let compared = timed(&mut seconds.compare, || {
        if options.compare.is_empty() {
            return Ok(Vec::new());
        }
        let field = FieldProblem::with_options(mesh, &decided.wishes)?;
        let both = [
            (field.problem(), &options.field),
            (decided.problem.problem(), &options.map),
        ];
        compare(both, &options.compare, &monitor)
    })?;
    Ok(Quadrangulation {
        quads,
        field: decided.field,
        field_solution: decided.field_solution,
        untangled: attempt.map,
        solution: attempt.solution,
        features,
        missed_features,
        compared,
        seconds,
    })
}

/// A field, its map and its quads.
struct Made {
    decided: Decided,
    attempt: Attempt,
}

/// Field, map and quads for details of one size.
fn go<'a>(
    mesh: &TriangleMesh,
    options: &QuadOptions,
    features: &FeatureGraph,
    monitor: &impl Fn() -> Monitor<'a>,
    seconds: &mut QuadSeconds,
) -> Result<Made> {
    let of_both = [&mut seconds.field, &mut seconds.map];
    let mut decided = decide(mesh, options, features, monitor, of_both)?;
    let problem = &decided.problem;
    let (solution, apart) = timed(&mut seconds.map, || {
        let solution = decided.solver.solve_with(&options.map, monitor())?;
        let apart = match is_hopeless(mesh, &problem.map(mesh, &solution)?) {
            true => None,
            false => hold_apart(mesh, problem, &solution, &options.map, monitor)?,
        };
        Ok((solution, apart))
    })?;
    let features: Vec<usize> = features.edges().collect();
    let attempt = timed(&mut seconds.extract, || {
        let trial = Trial {
            mesh,
            features: &features,
            options: &options.map,
            may_untangle: options.untangle,
            monitor,
        };
        let Some((held, decided)) = apart else {
            return trial.best(problem, solution);
        };
        let best = trial.best(&held, decided)?;
        match best.is_whole() {
            true => Ok(best),
            false => Ok(best.or(trial.best(problem, solution)?)),
        }
    })?;
    Ok(Made { decided, attempt })
}

pub(super) fn timed<T>(seconds: &mut f64, step: impl FnOnce() -> Result<T>) -> Result<T> {
    let started = Instant::now();
    let result = step();
    *seconds += started.elapsed().as_secs_f64();
    result
}
