//! The problem of a map and its solver, from the field that it follows.
//!
//! The cut, the seams, the constraints and the pattern of the matrix follow from the period jumps of the field. While
//! the details of the surface still turn its directions, another thread states the problem and analyses it. Then
//! directions change linear terms alone.

use std::ops::Range;

use super::aim::relaxation;
use super::quadrangulation::timed;
use super::stretch::Stretch;
use crate::error::Result;
use crate::field::{DirectionProblem, FieldOptions, OrientationField};
use crate::map::{SeamlessProblem, Sizing};
use crate::mesh::TriangleMesh;
use crate::mesh::features::FeatureGraph;
use crate::monitor::{Monitor, SharedThreads, allowed_threads, may_continue};
use crate::search::Options;
use crate::solve::{Solution, Solver};

/// The numbers of faces for which a thread is worth while. On larger meshes the memory of the map, beside that of the
/// field, would be the most of all steps: up to 30 % more at 800,000 faces.
const FACES: Range<usize> = 1 << 12..400_000;

/// What the problem of a map depends on, besides the field.
pub(super) struct MapData<'a> {
    pub mesh: &'a TriangleMesh,
    pub sizing: &'a Sizing,
    pub features: &'a FeatureGraph,
    pub stretch: Option<&'a Stretch>,
    /// Whether integers are decided for it in any case.
    pub is_searched: bool,
}

/// The problem of a map, and its solver.
pub(super) type StatedMap = (SeamlessProblem, Solver);

impl MapData<'_> {
    /// The problem of the map that follows this field.
    pub fn state(&self, field: &OrientationField) -> Result<StatedMap> {
        let (mesh, features) = (self.mesh, self.features);
        let mut problem = SeamlessProblem::with_features(mesh, field, self.sizing, features)?;
        if let Some(stretch) = self.stretch {
            problem.elongate(mesh, stretch.elongations(field.angles()))?;
        }
        may_continue()?;
        let mut solver = Solver::new(problem.problem())?;
        if self.is_searched {
            solver.expect_search();
        }
        Ok((problem, solver))
    }

    /// The field with the details of the surface, which `first` has left out, and the problem of its map. The times of
    /// both are added to `seconds`. What is done for the map before the field is finished counts as time of the field.
    pub fn state_with_details<'m>(
        &self,
        (first, left): (&OrientationField, DirectionProblem),
        (given, options): (&FieldOptions, &Options),
        monitor: &impl Fn() -> Monitor<'m>,
        [of_field, of_map]: [&mut f64; 2],
    ) -> Result<(OrientationField, Solution, StatedMap)> {
        let mesh = self.mesh;
        let solve = || left.solve(mesh, given, options, monitor);
        if !self.is_worth_a_thread() {
            let (field, solution) = timed(of_field, solve)?;
            let stated = timed(of_map, || self.state(&field))?;
            return Ok((field, solution, stated));
        }
        let ahead = |monitor: &mut Monitor| -> Result<StatedMap> {
            let (problem, mut solver) = self.state(first)?;
            solver.analyse(&relaxation(), monitor)?;
            Ok((problem, solver))
        };
        let others = allowed_threads() / 2;
        let own = allowed_threads() - others;
        let shared = SharedThreads::among(2);
        let mut of_call = monitor();
        std::thread::scope(|scope| {
            let worker = of_call.worker().with_threads(others, &shared);
            let beside = worker.start(scope, own, ahead);
            let (field, solution) = timed(of_field, || shared.task(own, solve))?;
            let stated = timed(of_map, || {
                let (mut problem, mut solver) = beside.wait(&mut of_call)?;
                match problem.follow_directions(mesh, &field, &mut solver)? {
                    true => Ok((problem, solver)),
                    false => self.state(&field),
                }
            })?;
            Ok((field, solution, stated))
        })
    }

    /// Whether it is worth a thread of its own before the directions of the field are known. They decide which
    /// coordinate is constant along a feature, and how much quads are stretched.
    fn is_worth_a_thread(&self) -> bool {
        let depends = self.stretch.is_some() || !self.features.curves().is_empty();
        allowed_threads() > 1 && FACES.contains(&self.mesh.face_count()) && !depends
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::{JumpsDecided, solve_field};
    use crate::mesh::shape::by_name;
    use crate::monitor::{Span, traced, with_threads};
    use crate::problem::Model;

    fn data<'a>(
        mesh: &'a TriangleMesh,
        sizing: &'a Sizing,
        features: &'a FeatureGraph,
    ) -> MapData<'a> {
        MapData {
            mesh,
            sizing,
            features,
            stretch: None,
            is_searched: true,
        }
    }

    fn linear(problem: &SeamlessProblem) -> Vec<f64> {
        let model = Model::new(problem.problem()).unwrap();
        model.gradient().to_vec()
    }

    #[test]
    fn a_map_that_is_stated_ahead_is_that_of_the_field() {
        let mesh = by_name("torus", 6_000).unwrap();
        let (sizing, features) = (Sizing::Quads(300), FeatureGraph::none(&mesh));
        let map = data(&mesh, &sizing, &features);
        let solver = Options::default();
        let with = |threads| {
            let (found, trace) = traced(false, || {
                with_threads(threads, || {
                    assert_eq!(map.is_worth_a_thread(), threads > 1);
                    let (first, left, given) = JumpsDecided::without(0.1, &mesh);
                    let (both, mut seconds) = ((&first, left), [0.0; 2]);
                    let [of_field, of_map] = &mut seconds;
                    let options = (&given, &solver);
                    let stated = map.state_with_details(
                        both,
                        options,
                        &Monitor::default,
                        [of_field, of_map],
                    );
                    let (field, _, (problem, mut solver)) = stated.unwrap();
                    assert_ne!(field.angles(), first.angles());
                    assert!(seconds.iter().all(|&s| s > 0.0));
                    let relaxed = solver.solve(&relaxation()).unwrap();
                    (field, linear(&problem), relaxed, given)
                })
            });
            let mut stated = trace
                .spans
                .iter()
                .filter(|span| span.name == "assemble map");
            assert!(stated.all(|span| span.thread == usize::from(threads > 1)));
            assert!(trace.spans.iter().any(|span| span.name == "assemble map"));
            found
        };
        let [one, two] = [1, 2].map(with);
        assert_eq!(one.0, two.0);
        assert_eq!(one.1, two.1);
        assert_eq!(one.2.values(), two.2.values());
        assert_eq!(one.2.energy().to_bits(), two.2.energy().to_bits());
        let (whole, _) = solve_field(&mesh, &one.3, &solver, Monitor::default).unwrap();
        assert_eq!(whole, two.0);
    }

    #[test]
    fn a_map_ahead_has_half_of_the_threads() {
        let mesh = by_name("torus", 24_000).unwrap();
        let (sizing, features) = (Sizing::Quads(300), FeatureGraph::none(&mesh));
        let solver = Options::default();
        let (first, left, given) = JumpsDecided::without(0.1, &mesh);
        let (stated, trace) = traced(false, || {
            let map = data(&mesh, &sizing, &features);
            let (both, options, mut seconds) = ((&first, left), (&given, &solver), [0.0; 2]);
            let [of_field, of_map] = &mut seconds;
            let seconds = [of_field, of_map];
            with_threads(4, || {
                map.state_with_details(both, options, &Monitor::default, seconds)
            })
        });
        assert!(stated.is_ok());
        let mut spans = trace.spans.iter();
        let ahead = spans.find(|span| span.name == "assemble map").unwrap();
        assert_eq!(ahead.thread, 2);
        let is_shared = |span: &Span| span.start > ahead.start && span.end < ahead.end;
        let mut on_last = trace.spans.iter().filter(|span| span.thread == 3);
        assert!(on_last.any(is_shared));
    }

    #[test]
    fn a_map_with_isolines_or_of_other_jumps_is_stated_anew() {
        let mesh = by_name("torus", 600).unwrap();
        let of = |detail| {
            let options = FieldOptions {
                detail,
                ..FieldOptions::default()
            };
            solve_field(&mesh, &options, &Options::default(), Monitor::default).unwrap()
        };
        let (field, _) = of(0.0);
        let sizing = Sizing::Quads(100);
        let mut edges = 0..mesh.edge_count();
        let jumps = field.period_jumps();
        let inner = edges.find(|&e| jumps[e] == 0).unwrap();
        let lines = FeatureGraph::from_edges(&mesh, &[inner]).unwrap();
        let without = FeatureGraph::none(&mesh);
        for (features, is_followed) in [(&without, true), (&lines, false)] {
            let map = data(&mesh, &sizing, features);
            let (mut problem, mut solver) = map.state(&field).unwrap();
            let same = problem.follow_directions(&mesh, &field, &mut solver);
            assert_eq!(same.unwrap(), is_followed);
            with_threads(2, || assert!(!map.is_worth_a_thread(), "it is small"));
        }
        let directions = vec![[0.3, 0.5, 0.8]; mesh.face_count()];
        let other = OrientationField::from_directions(&mesh, &directions).unwrap();
        let (mut problem, mut solver) = data(&mesh, &sizing, &without).state(&field).unwrap();
        let before = linear(&problem);
        let same = problem.follow_directions(&mesh, &other, &mut solver);
        assert!(!same.unwrap());
        assert_eq!(before, linear(&problem));
    }
}
