//! The field of a mesh: its problem is stated and solved, with indices that a map can have.
//!
//! A first solve decides the indices. If no map can have them, a second solve prescribes feasible indices
//! ([`super::feasible_indices`]). A second solve also follows when the indices are decided without the
//! details of the surface ([`super::detail`]).

use super::detail::detail;
use super::feasible_indices::feasible_indices;
use super::graded_flow::graded_flow;
use super::in_order::in_order;
use super::{Constraint, FieldOptions, FieldProblem, OrientationField, PrescribedIndex};
use crate::error::{Error, Result};
use crate::mesh::TriangleMesh;
use crate::monitor::{Monitor, Stage, both, may_continue, optional};
use crate::search::Options;
use crate::solve::{Solution, Solver, solve_with};

/// The least number of faces that are worth a thread.
const LEAST: usize = 1 << 12;

/// The smoothest field, whether or not a map can follow it, and the solution that it was read from.
///
/// With a length of [details](FieldOptions::detail) this is [`solve_field`], because callers who exclude
/// details want quads.
///
/// A mesh of more than 32,768 faces whose neighbours are far apart in memory is solved on in another order, except for
/// a relaxation. Field and solution are those of the mesh as it is given.
///
/// # Errors
/// Those of [`solve_field`].
pub fn smoothest_field<'a>(
    mesh: &TriangleMesh,
    options: &FieldOptions,
    solver: &Options,
    monitor: impl Fn() -> Monitor<'a>,
) -> Result<(OrientationField, Solution)> {
    if options.detail > 0.0 {
        return solve_field(mesh, options, solver, monitor);
    }
    in_order(
        mesh,
        options,
        solver.strategy,
        monitor(),
        |mesh, options| {
            if !options.regular.is_empty() {
                let found = decided(mesh, options, solver, &monitor)?;
                return Ok((found.field, found.solution));
            }
            solve_stated(mesh, options, solver, monitor())
        },
    )
}

/// The field of the problem that these options state.
fn solve_stated(
    mesh: &TriangleMesh,
    options: &FieldOptions,
    solver: &Options,
    monitor: Monitor,
) -> Result<(OrientationField, Solution)> {
    let watch = monitor.watch();
    let problem = FieldProblem::with_options(mesh, options)?;
    drop(watch);
    let solution = solve_with(problem.problem(), solver, monitor)?;
    Ok((problem.field(mesh, &solution)?, solution))
}

/// A field, the problem that it solves, and the solver with what it has kept.
struct Decided {
    problem: FieldProblem,
    solver: Solver,
    solution: Solution,
    field: OrientationField,
}

impl Decided {
    /// The field of these options; with a first one, of the problem in which vertices are
    /// [regular](FieldOptions::regular).
    fn new(
        mesh: &TriangleMesh,
        options: &FieldOptions,
        first: Option<&OrientationField>,
        solver: &Options,
        monitor: [Monitor; 3],
    ) -> Result<Self> {
        let [watched, prepares, solves] = monitor;
        let watch = watched.watch();
        let (problem, mut kept) = prepared(mesh, options, first, solver, prepares)?;
        // The best solution of a solve that ends early has a field, too.
        drop(watch);
        let solution = kept.solve_with(solver, solves)?;
        let _memory = mesh.watch_memory();
        let field = problem.field(mesh, &solution)?;
        Ok(Decided {
            problem,
            solver: kept,
            solution,
            field,
        })
    }
}

/// The field whose problem decides the indices: the first, or one in which vertices are
/// [regular](FieldOptions::regular) that the first makes irregular.
fn decided<'a>(
    mesh: &TriangleMesh,
    options: &FieldOptions,
    solver: &Options,
    monitor: &impl Fn() -> Monitor<'a>,
) -> Result<Decided> {
    options.check_regular(mesh)?;
    let monitors = || [monitor(), monitor(), monitor()];
    let first = Decided::new(mesh, options, None, solver, monitors())?;
    may_continue()?;
    if options.regular.is_empty() || options.indices.is_some() {
        return Ok(first);
    }
    let steps = first.field.vertex_index_steps(mesh);
    let is_irregular = |v: &usize| steps.get(*v).is_some_and(|&n| n != 0);
    if !options.regular.iter().any(is_irregular) {
        return Ok(first);
    }
    let again = || Decided::new(mesh, options, Some(&first.field), solver, monitors());
    match optional(monitor, again) {
        Ok(found) => Ok(found.unwrap_or(first)),
        // Features alone may decide indices.
        Err(Error::Infeasible { .. } | Error::NoIntegerSolution { .. }) => Ok(first),
        Err(error) => Err(error),
    }
}

/// The problem of a field and its solver, up to the elimination. Details change only right sides, and so they are
/// found at the same time.
fn prepared(
    mesh: &TriangleMesh,
    options: &FieldOptions,
    first: Option<&OrientationField>,
    solver: &Options,
    monitor: Monitor,
) -> Result<(FieldProblem, Solver)> {
    let with_all = FieldOptions {
        detail: 0.0,
        ..options.clone()
    };
    let is_large = options.detail > 0.0 && mesh.face_count() >= LEAST;
    let (made, ignored): (Result<_>, _) = both(
        is_large,
        || {
            let mut problem = FieldProblem::with_options(mesh, &with_all)?;
            if let Some(first) = first {
                problem.keep_regular(mesh, options, first)?;
            }
            let mut kept = Solver::new(problem.problem())?;
            kept.expect_one_relaxation();
            kept.eliminate(solver, monitor)?;
            Ok((problem, kept))
        },
        || detail(mesh, options),
    );
    let (problem, mut kept) = made?;
    kept.set_least_squares_right_sides(&problem.right_sides(mesh, &ignored?))?;
    Ok((problem, kept))
}

/// A field whose period jumps are decided.
pub(crate) enum JumpsDecided {
    /// All of it is.
    All(OrientationField, Solution),
    /// It was found without the details of the surface, which turn its directions.
    WithoutDetails(OrientationField, Box<DirectionProblem>),
}

#[cfg(test)]
impl JumpsDecided {
    /// The field of a mesh without details of this size, and the problem of its directions.
    pub(crate) fn without(
        details: f64,
        mesh: &TriangleMesh,
    ) -> (OrientationField, DirectionProblem, FieldOptions) {
        let given = FieldOptions {
            detail: details,
            ..FieldOptions::default()
        };
        let decided = decide_jumps(mesh, &given, &Options::default(), Monitor::default);
        match decided.unwrap() {
            JumpsDecided::WithoutDetails(first, left) => (first, *left, given),
            JumpsDecided::All(..) => unreachable!("details are left out"),
        }
    }
}

/// The problem of a field whose period jumps are decided, and its solver: what is left are the directions that the
/// details of the surface give it.
pub(crate) struct DirectionProblem {
    problem: FieldProblem,
    solver: Solver,
}

impl DirectionProblem {
    /// The smoothest field for the surface with all details, with the period jumps of the solver's last
    /// solution.
    pub fn solve<'a>(
        mut self,
        mesh: &TriangleMesh,
        given: &FieldOptions,
        options: &Options,
        monitor: impl Fn() -> Monitor<'a>,
    ) -> Result<(OrientationField, Solution)> {
        let _memory = mesh.watch_memory();
        may_continue()?;
        let of_sizes = graded_flow(mesh, given)?;
        let right_sides = self.problem.right_sides(mesh, &of_sizes);
        self.solver.set_least_squares_right_sides(&right_sides)?;
        let solution = self.solver.follow(options, monitor())?;
        Ok((self.problem.field(mesh, &solution)?, solution))
    }
}

/// The smoothest field among those that a map can follow, and the solution that it was read from.
///
/// With a length of [details](FieldOptions::detail) a first field, solved for without the details,
/// decides the indices. The result is the smoothest field with these indices.
///
/// If the field makes a vertex irregular that should be [regular](FieldOptions::regular), a second one decides the
/// indices, in which it is regular.
///
/// Indices that the caller prescribes are kept in any case, and so are the [firm](FieldOptions::firm)
/// constraints. Other directions of faces around a vertex are dropped if they alone decide an index that
/// no map can have.
///
/// A scattered mesh is solved on in another order, as by [`smoothest_field`].
///
/// # Errors
/// Those of [`FieldProblem::with_options`], of [`solve`](crate::solve()) and of
/// [`FieldProblem::field`].
pub fn solve_field<'a>(
    mesh: &TriangleMesh,
    options: &FieldOptions,
    solver: &Options,
    monitor: impl Fn() -> Monitor<'a>,
) -> Result<(OrientationField, Solution)> {
    let run = monitor().run();
    let monitor = || monitor().of_run(&run);
    in_order(
        mesh,
        options,
        solver.strategy,
        monitor(),
        |mesh, options| match decide_jumps(mesh, options, solver, monitor)? {
            JumpsDecided::All(field, solution) => Ok((field, solution)),
            JumpsDecided::WithoutDetails(_, left) => left.solve(mesh, options, solver, monitor),
        },
    )
}

/// The first part of [`solve_field`]: all but the details of the surface, on the mesh in the order that it has.
///
/// # Errors
/// Those of [`solve_field`].
pub(crate) fn decide_jumps<'a>(
    mesh: &TriangleMesh,
    options: &FieldOptions,
    solver: &Options,
    monitor: impl Fn() -> Monitor<'a>,
) -> Result<JumpsDecided> {
    let run = monitor().run();
    run.name_stage(Stage::Field);
    let monitor = || monitor().of_run(&run);
    let Decided {
        problem,
        solver: kept,
        solution,
        field,
    } = decided(mesh, options, solver, &monitor)?;
    let _memory = mesh.watch_memory();
    may_continue()?;
    if options.indices.is_some() || options.symmetry != 4 {
        return Ok(JumpsDecided::All(field, solution));
    }
    let found = field.vertex_index_steps(mesh);
    let steps = feasible_indices(mesh, found.clone(), &options.regular);
    may_continue()?;
    if steps == found {
        let left = DirectionProblem {
            problem,
            solver: kept,
        };
        return Ok(match options.detail > 0.0 {
            true => JumpsDecided::WithoutDetails(field, Box::new(left)),
            false => JumpsDecided::All(field, solution),
        });
    }
    let irregular = (0..steps.len()).filter(|&v| steps[v] != 0);
    let indices = irregular.map(|vertex| PrescribedIndex {
        vertex,
        steps: steps[vertex],
    });
    let mut feasible = FieldOptions {
        indices: Some(indices.collect()),
        detail: 0.0,
        ..options.clone()
    };
    for _ in 0..2 {
        match solve_stated(mesh, &feasible, solver, monitor()) {
            // Directions alone may decide an index.
            Err(
                Error::InvalidArgument { .. }
                | Error::Infeasible { .. }
                | Error::NoIntegerSolution { .. },
            ) => give_way(mesh, &field, &mut feasible),
            other => return other.map(|(field, solution)| JumpsDecided::All(field, solution)),
        }
    }
    Ok(JumpsDecided::All(field, solution))
}

/// Removes the directions of faces around vertices whose prescribed index differs from that of the field.
fn give_way(mesh: &TriangleMesh, field: &OrientationField, options: &mut FieldOptions) {
    let mut steps = field.vertex_index_steps(mesh);
    for given in options.indices.iter().flatten() {
        steps[given.vertex] -= given.steps;
    }
    let regular = |c: &Constraint| mesh.corners(c.face).iter().all(|&v| steps[v] == 0);
    let given = std::mem::take(&mut options.constraints).into_iter();
    let kept = given
        .enumerate()
        .filter(|(k, c)| *k < options.firm || regular(c));
    options.constraints = kept.map(|(_, c)| c).collect();
}

#[cfg(test)]
mod tests {
    use super::super::feasible_indices::MOST;
    use super::*;
    use crate::monitor::traced;

    /// A cone so steep that the smoothest field turns with it: more than half a turn at the tip.
    fn horn(sides: u32) -> TriangleMesh {
        let at = |ring: u32, k: u32| 1 + (ring - 1) * sides + k % sides;
        let mut points = vec![[0.0, 0.0, 20.0]];
        let mut triangles = Vec::new();
        for ring in 1..=20u32 {
            let radius = 0.1 * f64::from(ring);
            for k in 0..sides {
                let (sin, cos) =
                    (std::f64::consts::TAU * f64::from(k) / f64::from(sides)).sin_cos();
                points.push([radius * cos, radius * sin, 20.0 - f64::from(ring)]);
                if ring == 1 {
                    triangles.push([0, at(1, k), at(1, k + 1)]);
                } else {
                    let [a, b] = [at(ring - 1, k), at(ring - 1, k + 1)];
                    let [c, d] = [at(ring, k), at(ring, k + 1)];
                    triangles.extend([[a, c, d], [a, d, b]]);
                }
            }
        }
        TriangleMesh::new(points, triangles).unwrap()
    }

    #[test]
    fn no_vertex_keeps_an_index_that_no_map_can_have() {
        let mesh = horn(8);
        let options = FieldOptions::default();
        let problem = FieldProblem::with_options(&mesh, &options).unwrap();
        let solution = solve_with(problem.problem(), &Options::default(), Monitor::default());
        let smoothest = problem.field(&mesh, &solution.unwrap()).unwrap();
        let before = smoothest.vertex_index_steps(&mesh);
        assert!(before[0] > MOST, "{}", before[0]);
        let (field, _) =
            solve_field(&mesh, &options, &Options::default(), Monitor::default).unwrap();
        let after = field.vertex_index_steps(&mesh);
        assert!(after.iter().all(|&n| n <= MOST), "{after:?}");
        assert_eq!(after.iter().sum::<i32>(), before.iter().sum::<i32>());
    }

    #[test]
    fn directions_from_details_need_no_relaxation() {
        let mesh = crate::mesh::shape::by_name("torus", 1_000).unwrap();
        let (first, left, given) = JumpsDecided::without(0.1, &mesh);
        let (found, trace) = traced(false, || {
            left.solve(&mesh, &given, &Options::default(), Monitor::default)
        });
        let (field, _) = found.unwrap();
        assert_eq!(field.period_jumps(), first.period_jumps());
        assert_ne!(field.angles(), first.angles());
        assert!(trace.spans.iter().any(|span| span.name == "centre"));
        assert!(trace.spans.iter().all(|span| span.name != "relax"));
    }

    #[test]
    fn a_field_that_a_map_can_follow_is_left_alone() {
        let mesh = crate::mesh::shape::by_name("rounded-cube", 600).unwrap();
        let options = FieldOptions::default();
        let problem = FieldProblem::with_options(&mesh, &options).unwrap();
        let solution = solve_with(problem.problem(), &Options::default(), Monitor::default());
        let smoothest = problem.field(&mesh, &solution.unwrap()).unwrap();
        let (field, _) =
            solve_field(&mesh, &options, &Options::default(), Monitor::default).unwrap();
        assert_eq!(field, smoothest);
    }
}
