//! The solve of a problem after elimination: right sides, relaxation, search, expansion, verification.

use super::around::around_relaxation;
use super::candidate::Candidate;
use super::components::by_components;
use super::expand::expand;
use super::relax::Relaxation;
use super::solution::{Counts, Seconds, Solution};
use crate::eliminate::{Centre, Elimination, ReducedModel};
use crate::error::Result;
use crate::monitor::{Monitor, Phase, may_continue};
use crate::problem::{Model, Problem};
use crate::round;
use crate::search::{
    Factors, MadeAhead, Options, SolveStatus, StoppedBy, Strategy, WarmStart, of_relaxation,
};

/// A problem with all results that do not depend on its right sides.
pub(super) struct EliminatedProblem<'a> {
    pub problem: &'a Problem,
    pub model: &'a Model,
    pub elimination: &'a Elimination,
    pub factors: &'a mut Factors,
    /// The start of a warm start, in the caller's unknowns.
    pub earlier: &'a [f64],
}

impl EliminatedProblem<'_> {
    /// Relaxation, search, expansion and verification.
    pub fn search(
        &mut self,
        reduced: ReducedModel,
        clock: &Clock,
        options: &Options,
        monitor: &mut Monitor,
    ) -> Result<Solution> {
        let sizes = sizes(&reduced);
        let decided = decide(self, reduced, options, monitor)?;
        self.conclude(sizes, decided, clock, monitor)
    }

    /// The best values for the integers of the start, without a relaxation. Values that the objective does not
    /// determine are those of the start. None if the factor for that has not been made yet.
    pub fn follow(&mut self, monitor: &mut Monitor) -> Result<Option<Solution>> {
        let (reduced, clock) = self.reduce(monitor)?;
        if !self.factors.is_prepared() {
            return Ok(None);
        }
        let watch = monitor.watch();
        let mut at = self.elimination.restrict(&reduced, self.earlier);
        for &i in reduced.integers() {
            at[i as usize] = round::nearest(at[i as usize]);
        }
        let centre = Centre::new(self.problem, self.model, self.elimination, &reduced, &at)?;
        let point = self.factors.follow(centre.model(), &vec![0.0; at.len()])?;
        let found = SearchResult {
            values: expand(&centre, self.model, Strategy::Auto, &point),
            energy: centre.model().energy(&point).0,
            lower_bound: match self.problem.is_sum_of_squares() {
                true => self.problem.constant(),
                false => f64::NEG_INFINITY,
            },
            status: SolveStatus::Feasible,
            complete: false,
            stopped_by: StoppedBy::Nothing,
            work: of_relaxation(&reduced),
        };
        drop(watch);
        let sizes = sizes(&reduced);
        self.conclude(sizes, found, &clock, monitor).map(Some)
    }

    /// The reduced model for the current right sides, and the time when it was made.
    pub fn reduce(&mut self, monitor: &mut Monitor) -> Result<(ReducedModel, Clock)> {
        let _watch = monitor.watch();
        let reduced = self.elimination.reduce(self.model, monitor)?;
        let clock = Clock {
            eliminated: monitor.seconds(),
            factored_before: self.factors.seconds(),
        };
        Ok((reduced, clock))
    }

    /// Verification of what was found in a reduced model of these [sizes].
    pub fn conclude(
        &mut self,
        sizes: [usize; 2],
        found: SearchResult,
        clock: &Clock,
        monitor: &mut Monitor,
    ) -> Result<Solution> {
        // What the caller throws away need not be verified.
        may_continue()?;
        let searched = monitor.seconds();
        let factored = self.factors.seconds() - clock.factored_before;

        let candidate = Candidate {
            values: found.values,
            energy: found.energy,
            lower_bound: found.lower_bound,
            status: found.status,
            complete: found.complete,
            stopped_by: found.stopped_by,
            has_integers: sizes[0] > 0,
        };
        let (candidate, verdict) = candidate.verified(self.problem)?;
        Ok(Solution {
            values: candidate.values,
            energy: verdict.energy,
            lower_bound: Some(candidate.lower_bound),
            status: candidate.status,
            complete: candidate.complete,
            stopped_by: candidate.stopped_by,
            work: found.work,
            counts: counts(self.model, sizes, self.factors),
            seconds: Seconds {
                eliminate: clock.eliminated,
                factor: factored,
                round: searched - clock.eliminated - factored,
                total: monitor.seconds(),
            },
            max_constraint_violation: verdict.constraint_violation,
            max_integrality_violation: verdict.integrality_violation,
        })
    }
}

/// The seconds before the search.
pub(super) struct Clock {
    eliminated: f64,
    factored_before: f64,
}

/// The result of a search.
pub(super) struct SearchResult {
    /// The caller's unknowns.
    pub values: Vec<f64>,
    pub energy: f64,
    pub lower_bound: f64,
    pub status: SolveStatus,
    pub complete: bool,
    pub stopped_by: StoppedBy,
    /// Multiplications, including those of the relaxation.
    pub work: u64,
}

/// The model around the relaxation's minimiser, and the relaxation of this model, while what the search needs is made
/// on other threads where that is worth while.
fn relaxation(
    of: &mut EliminatedProblem,
    reduced: &ReducedModel,
    options: &Options,
) -> Result<(Centre, Relaxation)> {
    let (strategy, ordering) = (options.strategy, options.ordering);
    if !of.factors.is_worth_making_ahead(reduced, strategy) {
        return around_relaxation(of, reduced, strategy);
    }
    let task = || around_relaxation(of, reduced, strategy);
    let (around, ahead) = MadeAhead::during(reduced, ordering, task);
    let around = around?;
    of.factors.keep(ahead?);
    Ok(around)
}

/// The relaxation, and the search around its minimiser.
fn decide(
    of: &mut EliminatedProblem,
    reduced: ReducedModel,
    options: &Options,
    monitor: &mut Monitor,
) -> Result<SearchResult> {
    monitor.progress(Phase::Factor, 0.0)?;
    // Before the search there is no result that could be kept.
    let watch = monitor.watch();
    let (centre, relaxation) = relaxation(of, &reduced, options)?;
    drop(watch);
    of.factors.free_relaxed();
    let work = of_relaxation(&reduced);
    let status = match options.strategy {
        _ if reduced.integers().is_empty() => Some(SolveStatus::Optimal),
        Strategy::Relax => Some(SolveStatus::Relaxed),
        _ => None,
    };
    if let Some(status) = status {
        return Ok(SearchResult {
            values: expand(&centre, of.model, options.strategy, &relaxation.point),
            energy: centre.model().energy(&relaxation.point).0,
            lower_bound: relaxation.lower_bound,
            complete: status == SolveStatus::Optimal,
            stopped_by: StoppedBy::Nothing,
            status,
            work,
        });
    }
    monitor.check()?;
    let start = match options.warm_start {
        WarmStart::Off => None,
        WarmStart::Offer | WarmStart::Keep => Some(start(of, &reduced, centre.model())),
    };
    // The search needs the model around the centre alone.
    drop(reduced);
    let found = by_components(of, &centre, relaxation, options, start, monitor)?;
    Ok(SearchResult {
        values: expand(&centre, of.model, options.strategy, &found.point),
        energy: found.energy,
        lower_bound: found.lower_bound,
        status: found.status,
        complete: found.complete,
        stopped_by: found.stopped_by,
        work: work + found.work,
    })
}

/// The integers of a warm start, as steps from the centre of `model`.
fn start(of: &EliminatedProblem, reduced: &ReducedModel, model: &ReducedModel) -> Vec<f64> {
    let point = of.elimination.restrict(reduced, of.earlier);
    let step = |&i: &u32| round::nearest(point[i as usize]) - model.origin(i as usize);
    model.integers().iter().map(step).collect()
}

/// The numbers of integers and of continuous unknowns.
pub(super) fn sizes(reduced: &ReducedModel) -> [usize; 2] {
    [reduced.integers().len(), reduced.continuous().len()]
}

fn counts(model: &Model, [integers, continuous]: [usize; 2], factors: &Factors) -> Counts {
    Counts {
        variables: model.variables(),
        integers: model.integer().iter().filter(|&&i| i).count(),
        constraints: model.constraints().rows(),
        inequalities: 0,
        reduced_integers: integers,
        reduced_continuous: continuous,
        factor_nonzeros: factors.entries(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::{FieldProblem, curvature_constraints};
    use crate::mesh::TriangleMesh;
    use crate::mesh::shape::by_name;
    use crate::monitor::{spawned, traced};
    use crate::solve::{Solver, solve};

    #[test]
    fn values_follow_the_integers_of_the_last_solution_without_a_relaxation() {
        let mesh = by_name("torus", 1_000).unwrap();
        let directions = curvature_constraints(&mesh, 0.02).unwrap();
        let stated = FieldProblem::new(&mesh, &directions).unwrap();
        let mut field = stated.problem().clone();
        let options = Options {
            strategy: Strategy::Adaptive,
            ..Options::default()
        };
        let keep = Options {
            warm_start: WarmStart::Keep,
            ..options.clone()
        };
        let rhs = field.least_squares().0.rhs();
        let turned: Vec<f64> = (0..rhs.len())
            .map(|k| rhs[k] + 0.1 * (k as f64).sin())
            .collect();
        // With a linear term squares alone are no bound.
        for slope in [0.0, 0.01] {
            let mut linear = vec![0.0; field.variables()];
            (linear[0], linear[1]) = (slope, -slope);
            field.set_linear(&linear).unwrap();
            let solved = || {
                let mut solver = Solver::new(&field).unwrap();
                let first = solver.solve(&options).unwrap();
                solver.set_least_squares_right_sides(&turned).unwrap();
                (solver, first)
            };
            let expected = solved().0.solve(&keep).unwrap();
            let (mut solver, first) = solved();
            let (followed, trace) = traced(false, || solver.follow(&options, Monitor::default()));
            let followed = followed.unwrap();
            assert!(trace.spans.iter().any(|span| span.name == "centre"));
            assert!(trace.spans.iter().all(|span| span.name != "relax"));
            assert_eq!(followed.status(), expected.status());
            assert!((followed.energy() - expected.energy()).abs() < 1e-9 * expected.energy());
            assert!(followed.energy() != first.energy());
            for (a, b) in followed.values().iter().zip(expected.values()) {
                assert!((a - b).abs() < 1e-9, "{a} {b}");
            }
            let bound = followed.lower_bound().unwrap();
            assert!(bound <= expected.lower_bound().unwrap() + 1e-9);
            assert_eq!(bound.is_finite(), slope == 0.0);
            // Without the factor it is a solve that keeps the integers.
            let mut other = Solver::new(&field).unwrap();
            other.set_guess(first.values()).unwrap();
            let kept = other.follow(&options, Monitor::default()).unwrap();
            assert!((kept.energy() - first.energy()).abs() < 1e-9 * first.energy());
        }
    }

    #[test]
    fn values_take_no_more_memory_than_they_need() {
        let mesh = by_name("torus", 1_000).unwrap();
        let field = FieldProblem::new(&mesh, &[]).unwrap();
        let solution = solve(field.problem(), &Options::default()).unwrap();
        assert_eq!(solution.values.capacity(), field.problem().variables());
    }

    #[test]
    fn a_solver_that_expects_one_relaxation_frees_its_factor() {
        let mesh = by_name("torus", 1_000).unwrap();
        let field = FieldProblem::new(&mesh, &[]).unwrap();
        let of = |strategy| Options {
            strategy,
            ..Options::default()
        };
        for is_one in [false, true] {
            let mut solver = Solver::new(field.problem()).unwrap();
            if is_one {
                solver.expect_one_relaxation();
            }
            solver.solve(&of(Strategy::Adaptive)).unwrap();
            let (relaxed, trace) = traced(false, || solver.solve(&of(Strategy::Relax)));
            assert_eq!(relaxed.unwrap().status(), SolveStatus::Relaxed);
            let is_made = trace.spans.iter().any(|span| span.name == "factor");
            assert_eq!(is_made, is_one);
        }
    }

    #[test]
    fn the_factor_that_the_search_needs_is_made_beside_the_relaxation() {
        let mesh = by_name("torus", 3_000).unwrap();
        let field = FieldProblem::new(&mesh, &[]).unwrap();
        let of = |strategy, threads| {
            let options = Options {
                strategy,
                threads,
                ..Options::default()
            };
            solve(field.problem(), &options).unwrap()
        };
        let one = of(Strategy::Adaptive, 1);
        let other = || {
            let two = of(Strategy::Adaptive, 2);
            assert_eq!(one.values(), two.values());
            assert_eq!(one.energy().to_bits(), two.energy().to_bits());
            assert!(two.seconds().factor <= two.seconds().total);
        };
        assert!(spawned(other) > 0);
        let relaxed = || drop(of(Strategy::Relax, 2));
        assert_eq!(spawned(relaxed), 0, "no search follows");
    }

    #[test]
    fn the_factors_of_components_are_made_beside_the_relaxation_too() {
        // Two meshes in one, with directions that cut off small parts.
        let torus = by_name("torus", 3_000).unwrap();
        let count = torus.vertex_count() as u32;
        let apart = torus.vertices().iter().map(|p| [p[0] + 9.0, p[1], p[2]]);
        let vertices = torus.vertices().iter().copied().chain(apart);
        let others = torus.triangles().iter().map(|t| t.map(|v| v + count));
        let triangles = torus.triangles().iter().copied().chain(others);
        let mesh = TriangleMesh::new(vertices.collect(), triangles.collect()).unwrap();
        let directions = curvature_constraints(&mesh, 0.02).unwrap();
        let field = FieldProblem::new(&mesh, &directions).unwrap();
        let solved = |threads| {
            let options = Options {
                strategy: Strategy::Adaptive,
                threads,
                ..Options::default()
            };
            let (solution, trace) = traced(false, || solve(field.problem(), &options).unwrap());
            let rounding = trace
                .spans
                .iter()
                .filter(|span| span.name == "adaptive rounding");
            let begins = rounding
                .map(|span| span.start)
                .fold(f64::INFINITY, f64::min);
            let factors = trace.spans.iter().filter(|span| span.name == "factor");
            let later = factors.filter(|span| span.start >= begins).count();
            (solution, later)
        };
        let (one, later) = solved(1);
        assert_eq!(later, 2);
        let (two, later) = solved(2);
        assert_eq!(later, 0);
        assert_eq!(one.values(), two.values());
        assert_eq!(one.energy().to_bits(), two.energy().to_bits());
        assert_eq!(one.lower_bound(), two.lower_bound());
    }
}
