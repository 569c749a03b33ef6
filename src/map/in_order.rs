//! The problem of a map for the mesh in a better order: the same unknowns with other numbers.

use super::sizing::Density;
use super::{Combing, CutGraph, SeamlessMap, SeamlessProblem, isolines::Isoline, sectors::Sectors};
use crate::error::Result;
use crate::mesh::{Reordered, TriangleMesh};
use crate::monitor::{may_continue, span};
use crate::problem::Problem;

/// A problem for a mesh in another order, and where its unknowns are in the problem that was given.
pub(crate) struct ReorderedProblem {
    pub reordered: Reordered,
    pub problem: SeamlessProblem,
    /// For each unknown of the problem that was given, the one that it is here.
    unknowns: Vec<usize>,
}

impl ReorderedProblem {
    /// The problem `given` for its mesh in a [better order](Reordered::if_scattered), if the mesh needs it.
    ///
    /// # Errors
    /// Those of [`Reordered::if_scattered`] and of a new problem.
    pub fn if_scattered(mesh: &TriangleMesh, given: &SeamlessProblem) -> Result<Option<Self>> {
        // The map of another mesh has an error, which its caller tells.
        if given.field.check_mesh(mesh).is_err() {
            return Ok(None);
        }
        let _memory = mesh.watch_memory();
        let _span = span("order mesh");
        match Reordered::if_scattered(mesh)? {
            Some(reordered) => Self::new(mesh, given, reordered).map(Some),
            None => Ok(None),
        }
    }

    /// The problem `given` for its mesh in that order.
    ///
    /// # Errors
    /// Those of a new problem.
    pub fn new(mesh: &TriangleMesh, given: &SeamlessProblem, reordered: Reordered) -> Result<Self> {
        let (sectors, copies) = given.sectors.in_order(&reordered);
        let isolines = given.isolines.iter().map(|isoline| Isoline {
            edge: reordered.place_of_edge(mesh, isoline.edge).0,
            ends: isoline.ends.map(|copy| copies[copy as usize]),
            ..*isoline
        });
        let seams = given.seams.iter().map(|seam| {
            let sides = seam.iter().map(|&(f, k)| (reordered.place_of_face(f), k));
            sides.collect()
        });
        let mut cones = reordered.places_of_vertices(&given.cones);
        cones.sort_unstable();
        let mut problem = SeamlessProblem {
            problem: Problem::new(given.problem.variables())?,
            field: given.field.in_order(mesh, &reordered),
            cut: given.cut.in_order(mesh, &reordered),
            combing: given.combing.in_order(mesh, &reordered),
            isolines: isolines.collect(),
            seams: seams.collect(),
            cones,
            sectors,
            density: given.density.in_order(&reordered),
            elongations: reordered.of_faces(&given.elongations),
            guides: reordered.of_faces(&given.guides),
        };
        may_continue()?;
        problem.add_terms(&reordered.mesh)?;
        may_continue()?;
        let of_copies = copies.iter().flat_map(|&copy| {
            let u = 2 * copy as usize;
            [u, u + 1]
        });
        let translations = 2 * copies.len()..given.problem.variables();
        let unknowns: Vec<usize> = of_copies.chain(translations).collect();
        let integers = given.problem.integers().iter().zip(&unknowns);
        let integers = integers.filter(|(is, _)| **is).map(|(_, &unknown)| unknown);
        problem
            .problem
            .set_integers(&integers.collect::<Vec<_>>())?;
        for (pin, &unknown) in given.problem.pins().iter().zip(&unknowns) {
            if let Some(value) = *pin {
                problem.problem.pin(unknown, value)?;
            }
        }
        Ok(ReorderedProblem {
            reordered,
            problem,
            unknowns,
        })
    }

    /// The values of the unknowns of the problem that was given.
    pub fn given_values(&self, values: &[f64]) -> Vec<f64> {
        self.unknowns.iter().map(|&k| values[k]).collect()
    }

    /// A map of this problem as one of `given`, the problem that was given, and its mesh.
    pub fn given_map(
        &self,
        map: &SeamlessMap,
        mesh: &TriangleMesh,
        given: &SeamlessProblem,
    ) -> SeamlessMap {
        SeamlessMap {
            values: self.given_values(&map.values),
            copies: given.sectors.copy.clone(),
            ..map.on_given(&self.reordered, mesh)
        }
    }
}

impl Sectors {
    /// The copies of the mesh in another order, and the number there of each copy.
    fn in_order(&self, reordered: &Reordered) -> (Self, Vec<u32>) {
        let mut numbers = vec![0; self.count()];
        let mut first = Vec::with_capacity(self.first.len());
        let mut copies = 0;
        for place in 0..self.first.len() - 1 {
            let vertex = reordered.vertex(place);
            first.push(copies);
            for copy in self.first[vertex]..self.first[vertex + 1] {
                numbers[copy as usize] = copies;
                copies += 1;
            }
        }
        first.push(copies);
        let mut copy = reordered.of_faces(&self.copy);
        copy.iter_mut()
            .flatten()
            .for_each(|copy| *copy = numbers[*copy as usize]);
        (Sectors { copy, first }, numbers)
    }
}

impl CutGraph {
    fn in_order(&self, given: &TriangleMesh, reordered: &Reordered) -> Self {
        let edges = 0..given.edge_count();
        let is_cut = edges.map(|place| self.contains(reordered.edge(given, place)));
        CutGraph {
            is_cut: is_cut.collect(),
        }
    }
}

impl Combing {
    fn in_order(&self, given: &TriangleMesh, reordered: &Reordered) -> Self {
        let edges = 0..given.edge_count();
        let transitions = edges.map(|place| {
            let edge = reordered.edge(given, place);
            let transition = self.transitions[edge];
            match reordered.place_of_edge(given, edge) {
                (_, true) => (4 - transition) % 4,
                (_, false) => transition,
            }
        });
        Combing {
            transitions: transitions.collect(),
            quarters: reordered.of_faces(&self.quarters),
        }
    }
}

impl Density {
    fn in_order(&self, reordered: &Reordered) -> Self {
        match self {
            Density::Uniform(density) => Density::Uniform(*density),
            Density::Faces(faces) => Density::Faces(reordered.of_faces(faces)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::{Guidance, smoothest_field};
    use crate::map::Sizing;
    use crate::mesh::shape::by_name;
    use crate::mesh::shuffled;
    use crate::monitor::Monitor;
    use crate::search::{Options, Strategy};
    use crate::solve::{Solver, solve, verify};

    /// A problem with cones, features and sizes for every face, or one of a plane without cones.
    fn problem_of(name: &str) -> (TriangleMesh, SeamlessProblem) {
        let mesh = shuffled(&by_name(name, 1_500).unwrap());
        let guidance = Guidance {
            feature_angle: Some(0.6),
            ..Guidance::default()
        };
        let features = guidance.features(&mesh).unwrap();
        let options = guidance.field_options(&mesh, &features).unwrap();
        let adaptive = Options {
            strategy: Strategy::Adaptive,
            ..Options::default()
        };
        let (field, _) = smoothest_field(&mesh, &options, &adaptive, Monitor::default).unwrap();
        let length = |f: usize| 0.1 + 0.05 * mesh.corner_positions(f)[0][0].abs();
        let lengths = (0..mesh.face_count()).map(|f| [length(f), 1.1 * length(f)]);
        let sizing = Sizing::Lengths(lengths.collect());
        let problem = SeamlessProblem::with_features(&mesh, &field, &sizing, &features).unwrap();
        (mesh, problem)
    }

    #[test]
    fn solutions_in_another_order_are_solutions_of_the_problem_as_it_is() {
        for name in ["gear", "plane", "genus-2"] {
            let (mesh, given) = problem_of(name);
            let reordered = Reordered::new(&mesh).unwrap();
            let there = ReorderedProblem::new(&mesh, &given, reordered).unwrap();
            let ordered = &there.reordered.mesh;
            assert_ne!(mesh.triangles(), ordered.triangles());
            let solution = solve(there.problem.problem(), &Options::default()).unwrap();
            let values = there.given_values(solution.values());
            let verdict = verify(given.problem(), &values).unwrap();
            let error = verdict.energy - solution.energy();
            assert!(error.abs() < 1e-9 * solution.energy(), "{name} {error}");
            assert_eq!(verdict.integrality_violation, 0.0, "{name}");
            assert!(verdict.constraint_violation < 1e-9, "{name}");
            let of_problem = there.problem.map(ordered, &solution).unwrap();
            let map = there.given_map(&of_problem, &mesh, &given);
            let expected = SeamlessMap::new(&given, &mesh, &values).unwrap();
            let error = map.energy - expected.energy;
            assert!(error.abs() < 1e-9 * map.energy, "{name} {error}");
            let energy = expected.energy;
            assert!(SeamlessMap { energy, ..map } == expected, "{name}");
        }
    }

    #[test]
    fn gradients_of_another_map_are_kept() {
        let (mesh, mut given) = problem_of("gear");
        let mut solver = Solver::new(given.problem()).unwrap();
        let solution = solver.solve(&Options::default()).unwrap();
        let map = given.map(&mesh, &solution).unwrap();
        let elongations = (0..mesh.face_count()).map(|f| 1.0 + 0.1 * (f as f64).sin());
        given.elongate(&mesh, elongations.collect()).unwrap();
        let finer = (&given, &map);
        let guided = given.guided(&mesh, 1.5, finer, &mut solver).unwrap();
        for given in [given.clone(), guided] {
            let reordered = Reordered::new(&mesh).unwrap();
            let there = ReorderedProblem::new(&mesh, &given, reordered).unwrap();
            let ordered = &there.reordered.mesh;
            for place in 0..ordered.face_count() {
                let face = there.reordered.face(place);
                let [here, wanted] = [
                    there.problem.wanted(ordered, place),
                    given.wanted(&mesh, face),
                ];
                assert_eq!(here, wanted);
            }
            let field = &there.problem.field;
            assert!(field.on_given(&there.reordered, &mesh) == given.field);
        }
    }
}
