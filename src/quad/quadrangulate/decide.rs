//! Field and map, for more or fewer faces that the curvature constrains.
//!
//! How many it should be depends on the shape, and a few more or less send irregular vertices to
//! other places. The energy of the map tells: the less it is, the more its quads are squares of one
//! size. So on meshes that are not large several numbers are tried, and the map of least energy is
//! taken.

use super::{aim, scale, timed};
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;
use crate::quad::{FieldProblem, Guidance, OrientationField, QuadOptions, SeamlessProblem};
use crate::{Monitor, Result, Solution, Solver, solve_with};

/// Numbers of constrained faces that are tried, as multiples of the one asked for, in this order.
const TRIES: [f64; 6] = [1.0, 1.5, 0.5, 2.0, 0.25, 3.0];

/// All tries together may have so many faces, but the first has what it has.
const FACES: usize = 39_000;

/// A map of more integers than this takes too long to be decided twice.
const INTEGERS: usize = 300;

/// The two problems and their solutions.
pub(super) struct Decided {
    pub(super) field_problem: FieldProblem,
    pub(super) field: OrientationField,
    pub(super) field_solution: Solution,
    pub(super) problem: SeamlessProblem,
    pub(super) solution: Solution,
}

/// The best of the tries. `seconds` are those of fields and of maps.
pub(super) fn decide<'a>(
    mesh: &TriangleMesh,
    options: &QuadOptions,
    features: &FeatureGraph,
    monitor: &impl Fn() -> Monitor<'a>,
    seconds: [&mut f64; 2],
) -> Result<Decided> {
    let [of_field, of_map] = seconds;
    let given = options.guidance.constrain_curvature;
    let part = |multiple: f64| {
        let per_quad = multiple * options.constrained_per_quad;
        scale::part_of_faces(mesh, &options.sizing, per_quad)
    };
    let mut best = attempt(
        mesh,
        options,
        (features, given.max(part(TRIES[0]))),
        monitor,
        [of_field, of_map],
    )?;
    let count = match best.solution.counts().reduced_integers {
        0..=INTEGERS => FACES / mesh.face_count().max(1),
        _ => 1,
    };
    for multiple in TRIES.into_iter().take(count).skip(1) {
        if part(multiple) <= given {
            continue;
        }
        let seconds = [&mut *of_field, &mut *of_map];
        let found = attempt(mesh, options, (features, part(multiple)), monitor, seconds)?;
        if found.solution.energy() < best.solution.energy() {
            best = found;
        }
    }
    Ok(best)
}

/// Field and map with this part of the faces constrained.
fn attempt<'a>(
    mesh: &TriangleMesh,
    options: &QuadOptions,
    (features, part): (&FeatureGraph, f64),
    monitor: &impl Fn() -> Monitor<'a>,
    [of_field, of_map]: [&mut f64; 2],
) -> Result<Decided> {
    let (field_problem, field, field_solution) = timed(of_field, || {
        let rounds = scale::smoothing_rounds(mesh, &options.sizing);
        let guidance = Guidance {
            constrain_curvature: part,
            ..options.guidance.clone()
        };
        let wishes = guidance.field_options_at(mesh, features, rounds)?;
        let problem = FieldProblem::with_options(mesh, &wishes)?;
        let solution = solve_with(problem.problem(), &options.field, monitor())?;
        let field = problem.field(mesh, &solution)?;
        Ok((problem, field, solution))
    })?;
    let (problem, solution) = timed(of_map, || {
        let mut problem = SeamlessProblem::with_features(mesh, &field, &options.sizing, features)?;
        let mut solver = Solver::new(problem.problem())?;
        aim::aim(mesh, &mut problem, &mut solver, &options.sizing, monitor())?;
        let solution = solver.solve_with(&options.map, monitor())?;
        Ok((problem, solution))
    })?;
    Ok(Decided {
        field_problem,
        field,
        field_solution,
        problem,
        solution,
    })
}
