//! The field of a mesh whose neighbours are far apart in memory, solved for on the mesh in a better order: what is
//! given for its elements, there, and the field and the solution, as if nothing had been done.

use std::collections::VecDeque;
use std::sync::Arc;

use super::spanning_forest::spanning_forest;
use super::{Constraint, FieldOptions, Guidance, Guide, OrientationField, PrescribedIndex};
use crate::error::{Error, Result};
use crate::mesh::{Reordered, TriangleMesh};
use crate::monitor::{Monitor, both, may_continue, may_continue_at, span};
use crate::search::Strategy;
use crate::solve::Solution;

/// The least number of faces that are worth a thread.
const LEAST: usize = 1 << 14;

/// Solves on the mesh in a [better order](Reordered::if_scattered), if it needs one, else as it is. Field and solution
/// are those of the mesh as it is.
///
/// # Errors
/// The reason to end the call, and those of `solve`, which name elements of the mesh as it is.
pub(super) fn in_order(
    mesh: &TriangleMesh,
    options: &FieldOptions,
    strategy: Strategy,
    monitor: Monitor,
    solve: impl Fn(&TriangleMesh, &FieldOptions) -> Result<(OrientationField, Solution)>,
) -> Result<(OrientationField, Solution)> {
    // The jumps of a relaxation are no numbers of arms.
    let reordered = match strategy {
        Strategy::Relax => None,
        _ => better_order(mesh, options, monitor)?,
    };
    match reordered {
        Some(reordered) => solve_on(reordered, mesh, options, solve),
        None => solve(mesh, options),
    }
}

/// The mesh in a better order, if it needs one, and if the options can be given for it: an error names what the caller
/// knows.
fn better_order(
    mesh: &TriangleMesh,
    options: &FieldOptions,
    monitor: Monitor,
) -> Result<Option<Reordered>> {
    if !options.fit(mesh) {
        return Ok(None);
    }
    let (_watch, _memory) = (monitor.watch(), mesh.watch_memory());
    let _span = span("order mesh");
    Reordered::if_scattered(mesh)
}

fn solve_on(
    reordered: Reordered,
    given: &TriangleMesh,
    options: &FieldOptions,
    solve: impl Fn(&TriangleMesh, &FieldOptions) -> Result<(OrientationField, Solution)>,
) -> Result<(OrientationField, Solution)> {
    match solve(&reordered.mesh, &options.in_order(&reordered)) {
        Ok((field, solution)) => {
            let _memory = given.watch_memory();
            may_continue()?;
            let field = field.on_given(&reordered, given);
            drop(reordered);
            let (field, values) = field.on_forest(given, options)?;
            Ok((field, solution.with_values(values)))
        }
        Err(error) if error.is_end_of_run() => Err(error),
        // The same error of the mesh as it is names an element that the caller knows.
        Err(_) => {
            drop(reordered);
            solve(given, options)
        }
    }
}

impl OrientationField {
    /// The same crosses with jumps of zero on the forest of the problem that these options state, and the values of its
    /// unknowns. Where an arm is replaced by another, jumps over the sides of the face change with it. Angles between
    /// frames are those of the mesh, which may differ by a rounding, and by a turn where they are half a turn.
    fn on_forest(
        mut self,
        mesh: &TriangleMesh,
        options: &FieldOptions,
    ) -> Result<(Self, Vec<f64>)> {
        let constrained = self.constrained.iter().zip(&self.angles);
        let fixed = constrained.map(|(&is, &angle)| is.then_some(angle));
        let guided = options.guided(mesh, &fixed.collect::<Vec<_>>())?;
        let named = self.constrained.iter().zip(&guided);
        let is_rooted: Vec<bool> = named.map(|(&is, guide)| is || guide.is_some()).collect();
        may_continue()?;
        let step = self.step();
        let ((), in_forest) = both(
            mesh.face_count() >= LEAST,
            || self.take_transports(mesh),
            || spanning_forest(mesh, &is_rooted),
        );
        let in_forest = in_forest?;
        may_continue()?;
        let turns = self.turns_onto(mesh, &in_forest, &is_rooted);
        may_continue()?;
        for (angle, &turns) in self.angles.iter_mut().zip(&turns) {
            *angle += step * turns as f64;
        }
        let mut values = self.angles.clone();
        for (e, edge) in mesh.edges().enumerate() {
            may_continue_at(e)?;
            let (i, Some((j, _))) = (edge.first.0, edge.second) else {
                continue;
            };
            let jump = i64::from(self.period_jumps[e]) + turns[j] - turns[i];
            self.period_jumps[e] = i32::try_from(jump).map_err(|_| Error::Overflow {
                what: format!("the period jump of edge {e} is beyond 2^31"),
                index: Some(e),
            })?;
            let is_known = in_forest[e] || self.constrained[i] && self.constrained[j];
            if !is_known {
                values.push(jump as f64);
            }
        }
        Ok((self, values))
    }

    /// The same crosses with the angles between frames of the mesh.
    fn take_transports(&mut self, mesh: &TriangleMesh) {
        let step = self.step();
        let before = std::mem::replace(&mut self.kappa, Arc::new(mesh.transports()));
        let kappas = before.iter().zip(self.kappa.iter());
        for (jump, (before, kappa)) in self.period_jumps.iter_mut().zip(kappas) {
            *jump = jump.saturating_add(((before - kappa) / step).round() as i32);
        }
    }

    /// By how many arms each face has to turn so that jumps on the forest are zero. Its roots stay.
    fn turns_onto(&self, mesh: &TriangleMesh, in_forest: &[bool], is_rooted: &[bool]) -> Vec<i64> {
        let mut turns = vec![0; mesh.face_count()];
        let mut is_reached = is_rooted.to_vec();
        let mut queue: VecDeque<usize> = (0..turns.len()).filter(|&f| is_rooted[f]).collect();
        for first in 0..turns.len() {
            while let Some(face) = queue.pop_front() {
                for k in 0..3 {
                    let e = mesh.edge_of(face, k);
                    let Some((across, _)) = mesh.neighbor(face, k).filter(|_| in_forest[e]) else {
                        continue;
                    };
                    if !std::mem::replace(&mut is_reached[across], true) {
                        let jump = i64::from(self.period_jumps[e]);
                        turns[across] = turns[face] - mesh.out_of(face, k, jump);
                        queue.push_back(across);
                    }
                }
            }
            if !std::mem::replace(&mut is_reached[first], true) {
                queue.push_back(first);
            }
        }
        turns
    }
}

// Corners of faces keep their order, and angles are those from the first edge.
impl Constraint {
    fn in_order(&self, reordered: &Reordered) -> Self {
        Constraint {
            face: reordered.place_of_face(self.face),
            ..*self
        }
    }
}

impl Guide {
    fn in_order(&self, reordered: &Reordered) -> Self {
        Guide {
            face: reordered.place_of_face(self.face),
            ..*self
        }
    }
}

impl PrescribedIndex {
    fn in_order(&self, reordered: &Reordered) -> Self {
        PrescribedIndex {
            vertex: reordered.place_of_vertex(self.vertex),
            ..*self
        }
    }
}

/// The prescribed indices for a mesh in another order.
fn indices_in_order(
    given: Option<&Vec<PrescribedIndex>>,
    reordered: &Reordered,
) -> Option<Vec<PrescribedIndex>> {
    let there = |indices: &Vec<PrescribedIndex>| {
        let there = indices.iter().map(|index| index.in_order(reordered));
        there.collect()
    };
    given.map(there)
}

/// Whether all of these are faces of the mesh.
fn has_faces(mesh: &TriangleMesh, constraints: &[Constraint], guides: &[Guide]) -> bool {
    let constrained = constraints.iter().map(|c| c.face);
    let mut faces = constrained.chain(guides.iter().map(|g| g.face));
    faces.all(|face| face < mesh.face_count())
}

impl FieldOptions {
    /// The same options for a mesh in another order.
    fn in_order(&self, reordered: &Reordered) -> Self {
        let constraints = self.constraints.iter().map(|c| c.in_order(reordered));
        let guides = self.guides.iter().map(|g| g.in_order(reordered));
        FieldOptions {
            symmetry: self.symmetry,
            constraints: constraints.collect(),
            firm: self.firm,
            guides: guides.collect(),
            indices: indices_in_order(self.indices.as_ref(), reordered),
            regular: reordered.places_of_vertices(&self.regular),
            kept_turns: reordered.places_of_vertices(&self.kept_turns),
            detail: self.detail,
            lengths: match self.lengths.is_empty() {
                true => Vec::new(),
                false => reordered.of_vertices(&self.lengths),
            },
        }
    }

    /// Whether these name only elements that the mesh has, and give a length to all of its vertices or to none.
    fn fit(&self, mesh: &TriangleMesh) -> bool {
        let indices = self.indices.iter().flatten().map(|index| index.vertex);
        let others = self.regular.iter().chain(&self.kept_turns).copied();
        let has_lengths = self.lengths.is_empty() || self.lengths.len() == mesh.vertex_count();
        has_lengths
            && has_faces(mesh, &self.constraints, &self.guides)
            && indices.chain(others).all(|v| v < mesh.vertex_count())
    }
}

impl Guidance {
    /// The same guidance for a mesh in another order than `given`.
    pub(crate) fn in_order(&self, given: &TriangleMesh, reordered: &Reordered) -> Self {
        let constraints = self.constraints.iter().map(|c| c.in_order(reordered));
        let guides = self.guides.iter().map(|g| g.in_order(reordered));
        let vertex = |vertex: usize| reordered.place_of_vertex(vertex);
        let lines = self.feature_lines.iter().map(|line| line.map(vertex));
        Guidance {
            constraints: constraints.collect(),
            guides: guides.collect(),
            indices: indices_in_order(self.indices.as_ref(), reordered),
            feature_lines: lines.collect(),
            feature_edges: reordered.places_of_edges(given, &self.feature_edges),
            ..self.clone()
        }
    }

    /// Whether this names only elements that the mesh has.
    pub(crate) fn fits(&self, mesh: &TriangleMesh) -> bool {
        let indices = self.indices.iter().flatten().map(|index| index.vertex);
        let lines = self.feature_lines.iter().flatten().copied();
        has_faces(mesh, &self.constraints, &self.guides)
            && indices.chain(lines).all(|v| v < mesh.vertex_count())
            && self.feature_edges.iter().all(|&e| e < mesh.edge_count())
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;
    use std::f64::consts::{FRAC_PI_2, TAU};

    use super::*;
    use crate::field::{FieldProblem, smoothest_field, solve_field};
    use crate::mesh::shape::by_name;
    use crate::mesh::shuffled;
    use crate::monitor::{CancelToken, traced, with_threads};
    use crate::search::Options;
    use crate::solve::verify;

    fn constraint(face: usize, angle: f64) -> Constraint {
        Constraint { face, angle }
    }

    fn guide(face: usize, weight: f64) -> Guide {
        Guide {
            face,
            angle: -0.2,
            weight,
        }
    }

    fn index(vertex: usize, steps: i32) -> PrescribedIndex {
        PrescribedIndex { vertex, steps }
    }

    /// What is changed in options.
    type Change<'a> = &'a dyn Fn(&mut FieldOptions);

    type Found = Result<(OrientationField, Solution)>;

    fn by(strategy: Strategy) -> Options {
        Options {
            strategy,
            ..Options::default()
        }
    }

    fn on_given(mesh: &TriangleMesh, options: &FieldOptions) -> Found {
        solve_field(mesh, options, &by(Strategy::Adaptive), Monitor::default)
    }

    /// The field of a small mesh, which is put into another order nevertheless.
    fn on_reordered(mesh: &TriangleMesh, options: &FieldOptions) -> Found {
        solve_on(Reordered::new(mesh).unwrap(), mesh, options, on_given)
    }

    /// How far an angle is from the nearest arm, in steps from arm to arm.
    fn off(field: &OrientationField, face: usize, angle: f64) -> f64 {
        let steps = (field.angles()[face] - angle) / FRAC_PI_2;
        (steps - steps.round()).abs()
    }

    fn directions() -> FieldOptions {
        FieldOptions {
            constraints: vec![constraint(40, 0.3), constraint(310, 1.1)],
            guides: vec![guide(700, 1e6), guide(123, 0.1)],
            ..FieldOptions::default()
        }
    }

    #[test]
    fn directions_are_followed_and_the_energy_is_that_of_the_mesh_as_it_is() {
        let mesh = by_name("torus", 800).unwrap();
        let options = directions();
        let (field, solution) = on_reordered(&mesh, &options).unwrap();
        let energy = field.energy(&mesh) + field.guide_energy(&options.guides);
        assert!((energy - solution.energy()).abs() < 1e-9, "{energy}");
        assert!(off(&field, 40, 0.3).max(off(&field, 310, 1.1)) < 1e-12);
        assert!(off(&field, 700, -0.2) < 1e-3);
        let constrained = field.constrained().iter().enumerate();
        let constrained = constrained.filter(|(_, is)| **is).map(|(face, _)| face);
        assert!(constrained.eq([40, 310]));
        // The values are those of the problem of the mesh as it is.
        let problem = FieldProblem::with_options(&mesh, &options).unwrap();
        assert!(problem.field(&mesh, &solution).unwrap() == field);
        let verdict = verify(problem.problem(), solution.values()).unwrap();
        assert!((verdict.energy - solution.energy()).abs() < 1e-9);
        assert_eq!(verdict.integrality_violation, 0.0);
    }

    #[test]
    fn vertices_have_the_indices_and_lengths_that_were_given() {
        let mesh = by_name("torus", 800).unwrap();
        let indices = vec![index(20, 1), index(33, -2), index(250, 1)];
        let lengths = mesh.vertices().iter().map(|p| 1.5 + p[0] / 2.0);
        let options = FieldOptions {
            indices: Some(indices.clone()),
            lengths: lengths.collect(),
            ..FieldOptions::default()
        };
        let (field, solution) = on_reordered(&mesh, &options).unwrap();
        let steps = field.vertex_index_steps(&mesh);
        let irregular = field.irregular_vertices(&mesh);
        let found = irregular.into_iter().map(|v| index(v, steps[v]));
        assert!(found.eq(indices));
        let (_, wanted) = on_given(&mesh, &options).unwrap();
        let error = solution.energy() - wanted.energy();
        assert!(error.abs() < 1e-9 * wanted.energy(), "{error}");
    }

    #[test]
    fn vertices_are_regular_that_should_be() {
        let mesh = by_name("rounded-cube", 1_200).unwrap();
        let (field, _) = on_given(&mesh, &FieldOptions::default()).unwrap();
        let first = field.irregular_vertices(&mesh)[0];
        let options = FieldOptions {
            regular: vec![first],
            ..FieldOptions::default()
        };
        let (field, _) = on_reordered(&mesh, &options).unwrap();
        let irregular = field.irregular_vertices(&mesh);
        assert!(!irregular.is_empty() && !irregular.contains(&first));
    }

    #[test]
    fn lists_keep_their_order() {
        let mesh = by_name("torus", 800).unwrap();
        let reordered = Reordered::new(&mesh).unwrap();
        let options = FieldOptions {
            firm: 1,
            regular: vec![7, 300, 2],
            kept_turns: vec![9, 4],
            detail: 0.25,
            ..directions()
        };
        let there = options.in_order(&reordered);
        assert_eq!((there.firm, there.detail), (1, 0.25));
        let vertices = |there: &[usize]| -> Vec<usize> {
            let given = there.iter().map(|&place| reordered.vertex(place));
            given.collect()
        };
        assert_eq!(vertices(&there.regular), options.regular);
        assert_eq!(vertices(&there.kept_turns), options.kept_turns);
        let faces = there.constraints.iter().map(|c| reordered.face(c.face));
        assert!(faces.eq([40, 310]));
    }

    /// Two tori, and a sheet of their size.
    fn tori_and_sheet() -> [TriangleMesh; 2] {
        let torus = by_name("torus", 600).unwrap();
        let count = torus.vertex_count() as u32;
        let apart = torus.vertices().iter().map(|p| [p[0] - 9.0, p[1], p[2]]);
        let vertices = torus.vertices().iter().copied().chain(apart).collect();
        let others = torus.triangles().iter().map(|t| t.map(|v| v + count));
        let triangles = torus.triangles().iter().copied().chain(others).collect();
        [
            TriangleMesh::new(vertices, triangles).unwrap(),
            by_name("plane", 600).unwrap(),
        ]
    }

    #[test]
    fn errors_are_those_of_the_mesh_as_it_is() {
        let [tori, sheet] = tori_and_sheet();
        let on_boundary = (0..sheet.vertex_count()).rfind(|&v| sheet.is_boundary_vertex(v));
        let around = |vertex| tori.ring(vertex).map(|(face, _)| constraint(face, 0.0));
        let changes: [(Option<usize>, &TriangleMesh, Change); 6] = [
            (Some(17), &tori, &|o| {
                o.lengths = vec![1.0; tori.vertex_count()];
                o.lengths[17] = f64::NAN;
            }),
            (None, &tori, &|o| o.indices = Some(vec![index(400, 1)])),
            (Some(200), &tori, &|o| {
                o.constraints = around(200).collect();
                o.indices = Some(vec![index(200, 1), index(7, -1)]);
            }),
            (Some(0), &tori, &|o| o.guides = vec![guide(9, -1.0)]),
            (Some(0), &sheet, &|o| o.regular = vec![on_boundary.unwrap()]),
            (None, &sheet, &|o| o.detail = -1.0),
        ];
        for (named, mesh, change) in changes {
            let mut options = FieldOptions::default();
            change(&mut options);
            assert!(options.fit(mesh));
            let error = on_reordered(mesh, &options).unwrap_err();
            assert_eq!(error.index(), named, "{error}");
            assert_eq!(error, on_given(mesh, &options).unwrap_err());
        }
    }

    #[test]
    fn elements_that_are_not_there_are_left_to_the_mesh_as_it_is() {
        let mesh = by_name("torus", 600).unwrap();
        let (faces, vertices) = (mesh.face_count(), mesh.vertex_count());
        assert!(FieldOptions::default().fit(&mesh));
        let changes: [Change; 6] = [
            &|o| o.constraints = vec![constraint(faces, 0.0)],
            &|o| o.guides = vec![guide(faces, 1.0)],
            &|o| o.indices = Some(vec![index(vertices, 0)]),
            &|o| o.regular = vec![vertices],
            &|o| o.kept_turns = vec![vertices],
            &|o| o.lengths = vec![1.0; vertices - 1],
        ];
        for change in changes {
            let mut options = FieldOptions::default();
            change(&mut options);
            assert!(!options.fit(&mesh));
        }
    }

    #[test]
    fn scattered_meshes_are_solved_on_in_order_and_the_same_on_all_threads() {
        let mesh = shuffled(&by_name("torus", 33_000).unwrap());
        // Most faces have a direction: the problem is small.
        let constrained = (0..mesh.face_count()).filter(|face| face % 8 != 0);
        let options = FieldOptions {
            constraints: constrained
                .map(|f| constraint(f, 1e-3 * f as f64))
                .collect(),
            ..FieldOptions::default()
        };
        let [one, three] = [1, 3].map(|threads| {
            let solver = by(Strategy::Adaptive);
            let solve = || smoothest_field(&mesh, &options, &solver, Monitor::default);
            with_threads(threads, solve).unwrap()
        });
        assert!(one.0 == three.0 && one.1.values() == three.1.values());
        let (field, solution) = one;
        // The other entry does the same.
        let solve = || on_given(&mesh, &options).unwrap();
        let as_it_is = |mesh: &TriangleMesh, options: &FieldOptions| {
            let problem = FieldProblem::with_options(mesh, options)?;
            let solution = crate::solve::solve(problem.problem(), &by(Strategy::Adaptive))?;
            Ok((problem.field(mesh, &solution)?, solution))
        };
        let reordered = Reordered::new(&mesh).unwrap();
        let wanted = solve_on(reordered, &mesh, &options, as_it_is).unwrap();
        let (found, trace) = traced(false, solve);
        assert!(trace.spans.iter().any(|span| span.name == "order mesh"));
        assert!(wanted.0 == field && found.0 == field);
        assert!(as_it_is(&mesh, &options).unwrap().0 != field);
        let error = field.energy(&mesh) - solution.energy();
        assert!(error.abs() < 1e-9 * solution.energy(), "{error}");
        assert!(
            options
                .constraints
                .iter()
                .all(|c| off(&field, c.face, c.angle) < 1e-12)
        );
        let problem = FieldProblem::with_options(&mesh, &options).unwrap();
        assert!(problem.field(&mesh, &solution).unwrap() == field);
    }

    #[test]
    fn frames_half_a_turn_apart_are_those_of_the_mesh_as_it_is() {
        // Squares of two triangles whose first edges are opposite, turned so that coordinates are rounded.
        let (sin, cos) = 0.7f64.sin_cos();
        let at = |i: u32, j: u32| 21 * i + j;
        let squares = |n: u32| (0..n).flat_map(move |i| (0..n).map(move |j| (i, j)));
        let points = squares(21).map(|(i, j)| {
            let (x, y) = (f64::from(i), f64::from(j));
            [cos * x - sin * y, sin * x + cos * y, 0.0]
        });
        let triangles = squares(20).flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [c, d, a]]
        });
        let mesh = TriangleMesh::new(points.collect(), triangles.collect()).unwrap();
        let (field, solution) = on_reordered(&mesh, &directions()).unwrap();
        let problem = FieldProblem::with_options(&mesh, &directions()).unwrap();
        assert!(problem.field(&mesh, &solution).unwrap() == field);
        // The same field, with half turns the other way round.
        let kappas = field.kappa().iter().enumerate();
        let half_turns: Vec<usize> = kappas.filter(|(_, k)| **k > 3.1).map(|(e, _)| e).collect();
        assert!(half_turns.len() > 100);
        let (mut other, mut kappa) = (field.clone(), field.kappa().to_vec());
        for e in half_turns {
            kappa[e] -= TAU;
            other.period_jumps[e] += 4;
        }
        other.kappa = Arc::new(kappa);
        let (found, values) = other.on_forest(&mesh, &directions()).unwrap();
        assert!(found == field && values == solution.values());
        let verdict = verify(problem.problem(), solution.values()).unwrap();
        assert!((verdict.energy - solution.energy()).abs() < 1e-9);
    }

    #[test]
    fn a_relaxation_is_solved_on_the_mesh_as_it_is() {
        let mesh = shuffled(&by_name("torus", 33_000).unwrap());
        let stop = |there: &TriangleMesh, _: &FieldOptions| {
            assert_eq!(there.triangles(), mesh.triangles());
            Err(Error::TimeLimit)
        };
        let options = FieldOptions::default();
        let found = in_order(&mesh, &options, Strategy::Relax, Monitor::default(), stop);
        assert_eq!(found.unwrap_err(), Error::TimeLimit);
    }

    #[test]
    fn runs_that_end_are_not_begun_again() {
        let mesh = shuffled(&by_name("torus", 33_000).unwrap());
        let options = FieldOptions::default();
        let calls = Cell::new(0);
        let ended = |there: &TriangleMesh, _: &FieldOptions| {
            calls.set(calls.get() + 1);
            assert_ne!(there.triangles(), mesh.triangles());
            Err(Error::TimeLimit)
        };
        let found = in_order(&mesh, &options, Strategy::Auto, Monitor::default(), ended);
        assert_eq!((found.unwrap_err(), calls.get()), (Error::TimeLimit, 1));
        let token = CancelToken::new();
        token.cancel();
        let monitor = Monitor::default().cancel_token(token);
        let found = in_order(&mesh, &options, Strategy::Auto, monitor, ended);
        assert_eq!((found.unwrap_err(), calls.get()), (Error::Cancelled, 1));
    }
}
